#include "verdict.hpp"

#include <cmath>
#include <limits>

namespace lorentz::oracle {
namespace {

double ulp(double t) {
  return std::nextafter(t, std::numeric_limits<double>::infinity()) - t;
}

}  // namespace

Judgement judge(const Answer& exact, const Answer& given) {
  if (exact.outcome == Outcome::error) return {Verdict::error, {}};
  switch (given.outcome) {
    case Outcome::undecided:
      return {Verdict::undecided, {}};
    case Outcome::later:
      return {Verdict::undecided, {}};  // it looked no farther
    case Outcome::error:
      return {given.unsupported ? Verdict::unsupported : Verdict::error, {}};
    default:
      break;
  }
  if (given.outcome != exact.outcome) return {Verdict::wrong, {}};
  if (exact.outcome == Outcome::never) return {Verdict::agree, {}};
  if (!(given.obstacle == exact.obstacle)) return {Verdict::wrong, {}};
  Judgement judgement{Verdict::agree, {}};
  const bool measurable = exact.time && given.time && std::isfinite(*given.time) &&
                          *exact.time < std::numeric_limits<double>::max();
  if (measurable) judgement.ulps = std::fabs(*given.time - *exact.time) / ulp(*exact.time);
  return judgement;
}

}  // namespace lorentz::oracle
