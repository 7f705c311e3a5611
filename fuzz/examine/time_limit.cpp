#include "fuzz/examine/time_limit.hpp"

#include <cmath>
#include <limits>

namespace lorentz::fuzz {

using namespace cases;

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Where nothing is hit.
constexpr double kSomeTime = 100;

}  // namespace

std::string_view words_of(LimitAt limit) {
  constexpr std::string_view kWords[] = {"",
                                         "limit at the time",
                                         "limit just below the time",
                                         "limit just above the time",
                                         "limit at half the time",
                                         "limit at twice the time"};
  return kWords[static_cast<int>(limit)];
}

LimitAt limit_in(std::string_view words) {
  for (const LimitAt limit : {LimitAt::time, LimitAt::below, LimitAt::above, LimitAt::half, LimitAt::twice})
    if (words.ends_with(words_of(limit))) return limit;
  return LimitAt::none;
}

LimitAt drawn_limit(Random& random, Subject::Limits limits, const Answer& exact) {
  if (limits == Subject::Limits::none || exact.outcome == Outcome::error) return LimitAt::none;
  if (exact.outcome == Outcome::hit && !(std::isfinite(*exact.time) && *exact.time > 0)) return LimitAt::none;
  if (limits == Subject::Limits::rough || random.one_in(4))
    return random.one_in(2) ? LimitAt::half : LimitAt::twice;
  return random.one_in(2) ? LimitAt::time : random.one_in(2) ? LimitAt::below : LimitAt::above;
}

double limit_of(LimitAt limit, const Answer& exact) {
  const double time = exact.outcome == Outcome::hit ? *exact.time : kSomeTime;
  switch (limit) {
    case LimitAt::none:
      return kInfinity;
    case LimitAt::time:
      return time;
    case LimitAt::below:
      return std::nextafter(time, -kInfinity);
    case LimitAt::above:
      return std::nextafter(time, kInfinity);
    case LimitAt::half:
      return time / 2;
    case LimitAt::twice:
      return 2 * time;
  }
  return kInfinity;
}

}  // namespace lorentz::fuzz
