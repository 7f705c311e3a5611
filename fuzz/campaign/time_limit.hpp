// Time limits at and beside the time of a hit.
#pragma once

#include <string>
#include <string_view>

#include <lorentz/answer.hpp>
#include "question/cases/random.hpp"

namespace lorentz::fuzz {

/// The place of a limit, relative to the time t of the hit.
struct LimitAt {
  enum Side { none, time, below, above, half, twice, before, after };

  Side place = none;
  int bits = 0;  ///< of `before` and `after`: at t (1 - 2^-bits), t (1 + 2^-bits)

  LimitAt() = default;
  LimitAt(Side at, int at_bits = 0) : place(at), bits(at_bits) {}
  friend bool operator==(const LimitAt&, const LimitAt&) = default;
};

/// Like "limit at the time"; empty without a limit.
std::string words_of(LimitAt limit);

/// The limit that such words end with; none for other words.
LimitAt limit_in(std::string_view words);

/// A drawn limit for a question with this exact answer; none if its time is not finite.
LimitAt drawn_limit(cases::Random& random, const Answer& exact);

/// The limit of a question with this exact answer. `never` and `inside` have no time, so a fixed time is
/// used.
double limit_of(LimitAt limit, const Answer& exact);

}  // namespace lorentz::fuzz
