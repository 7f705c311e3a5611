// Time limits at and beside the time of a hit.
#pragma once

#include <string_view>

#include <lorentz/problem.hpp>
#include "cases/random.hpp"
#include "fuzz/examine/subject.hpp"

namespace lorentz::fuzz {

enum class LimitAt { none, time, below, above, half, twice };

/// Like "limit at the time"; empty for none.
std::string_view words_of(LimitAt limit);

/// The one that such words end with; none of other words.
LimitAt limit_in(std::string_view words);

/// One that the subject can be asked with at this exact answer; where its time is not finite, none.
LimitAt drawn_limit(cases::Random& random, Subject::Limits limits, const Answer& exact);

/// The limit of a question with this exact answer. `never` and `inside` have no time: any limit will do.
double limit_of(LimitAt limit, const Answer& exact);

}  // namespace lorentz::fuzz
