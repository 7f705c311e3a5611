#include "fuzz/campaign/time_limit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lorentz::fuzz {

using namespace cases;

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// The time used if nothing is hit.
constexpr double kSomeTime = 100, kLeastTime = 2 * std::numeric_limits<double>::denorm_min();

// The range of the bits by which `before` and `after` differ from the time.
constexpr int kFewestBits = 20, kMostBits = 51;

}  // namespace

std::string words_of(LimitAt limit) {
  static const std::string kWords[] = {"",
                                       "limit at the time",
                                       "limit just below the time",
                                       "limit just above the time",
                                       "limit at half the time",
                                       "limit at twice the time"};
  if (limit.place == LimitAt::before || limit.place == LimitAt::after)
    return "limit 2^-" + std::to_string(limit.bits) +
           (limit.place == LimitAt::before ? " before the time" : " after the time");
  return kWords[limit.place];
}

LimitAt limit_in(std::string_view words) {
  for (const LimitAt limit : {LimitAt::time, LimitAt::below, LimitAt::above, LimitAt::half, LimitAt::twice})
    if (words.ends_with(words_of(limit))) return limit;
  for (int bits = kFewestBits; bits <= kMostBits; ++bits)
    for (const LimitAt limit : {LimitAt(LimitAt::before, bits), LimitAt(LimitAt::after, bits)})
      if (words.ends_with(words_of(limit))) return limit;
  return LimitAt::none;
}

LimitAt drawn_limit(Random& random, const Answer& exact) {
  if (exact.outcome == Outcome::error) return LimitAt::none;
  const bool hit = exact.outcome == Outcome::hit;
  if (hit && !std::isfinite(*exact.time)) return LimitAt::none;
  const bool at_once = hit && *exact.time == 0;  // fractions of it are the same
  if (!at_once && random.one_in(4)) return random.one_in(2) ? LimitAt::half : LimitAt::twice;
  if (!at_once && random.one_in(2))
    return {random.one_in(2) ? LimitAt::before : LimitAt::after,
            static_cast<int>(random.integer(kFewestBits, kMostBits))};
  const auto at = random.one_in(2) ? LimitAt::time : random.one_in(2) ? LimitAt::below : LimitAt::above;
  return at_once ? LimitAt::above : at;  // a limit is above 0
}

double limit_of(LimitAt limit, const Answer& exact) {
  // All limits are above 0, also the one below the time.
  const double time = exact.outcome == Outcome::hit ? std::max(*exact.time, kLeastTime) : kSomeTime;
  const double share = std::ldexp(1, -limit.bits);
  switch (limit.place) {
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
    case LimitAt::before:
      return time * (1 - share);
    case LimitAt::after:
      break;
  }
  return time * (1 + share);
}

}  // namespace lorentz::fuzz
