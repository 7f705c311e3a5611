#include "report/calls.hpp"

#include <algorithm>
#include <cmath>

#include "src/exchange/json_writer.hpp"

namespace lorentz::report {
namespace {

// The verdicts that are counted, and where.
constexpr std::pair<oracle::Verdict, std::size_t Call::*> kCounts[] = {
    {oracle::Verdict::agree, &Call::right},
    {oracle::Verdict::ill_posed, &Call::ill_posed},
    {oracle::Verdict::wrong, &Call::wrong},
    {oracle::Verdict::undecided, &Call::undecided}};

}  // namespace

void Calls::add(std::optional<double> size, oracle::Verdict verdict, std::optional<double> radii_off) {
  const double its = std::fabs(size.value_or(0));
  if (!(its > 0) || !std::isfinite(its)) return;
  for (const auto& [counted, count] : kCounts)
    if (counted == verdict) {
      Call call{.radii_off = radii_off.value_or(0)};
      call.*count = 1;
      add(static_cast<int>(std::floor(std::log10(its))), call);
    }
}

void Calls::add(int decade, const Call& call) {
  Call& its = by_decade_[decade];
  for (const auto& [verdict, count] : kCounts) its.*count += call.*count;
  its.radii_off = std::max(its.radii_off, call.radii_off);
}

void Calls::add(const Calls& others) {
  for (const auto& [decade, call] : others.by_decade_) add(decade, call);
}

void append_json(std::string& out, const Calls& calls) {
  out += json::text_of(json::objects(calls.by_decade(), [](json::Members& one, const auto& decade) {
    const auto& [exponent, call] = decade;
    one.add("decade", exponent, "right", call.right, "ill_posed", call.ill_posed, "wrong", call.wrong,
            "undecided", call.undecided, "radii_off", call.radii_off);
  }));
}

}  // namespace lorentz::report
