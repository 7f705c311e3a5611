// Time limits at and beside the time of a hit.
#pragma once

#include <string>
#include <string_view>

#include <lorentz/answer.hpp>
#include "cases/random.hpp"

namespace lorentz::fuzz {

/// Where a limit is, seen from the time t of the hit.
struct LimitAt {
  enum Side { none, time, below, above, half, twice, before, after };

  Side place = none;
  int bits = 0;  ///< of `before` and `after`: at t (1 - 2^-bits), t (1 + 2^-bits)

  LimitAt() = default;
  LimitAt(Side at, int at_bits = 0) : place(at), bits(at_bits) {}
  friend bool operator==(const LimitAt&, const LimitAt&) = default;
};

/// Like "limit at the time"; empty for none.
std::string words_of(LimitAt limit);

/// The one that such words end with; none of other words.
LimitAt limit_in(std::string_view words);

/// One for a question with this exact answer; where its time is not finite, none.
LimitAt drawn_limit(cases::Random& random, const Answer& exact);

/// The limit of a question with this exact answer. `never` and `inside` have no time: any limit will do.
double limit_of(LimitAt limit, const Answer& exact);

}  // namespace lorentz::fuzz
