// How often a program must be asked a question before it goes wrong: some fail by a count, not by a question.
#pragma once

#include <functional>
#include <memory>

#include "judge/examination.hpp"

namespace lorentz::judge {

/// Questions in a row, at the most.
inline constexpr std::size_t kMostRepetitions = 1000;

/// The number of times that a new start of the program must be asked the finding's simplest question until it
/// goes wrong in the finding's way: 1 if it does so at once. Nothing if it does not within kMostRepetitions,
/// or in so many seconds. `start` makes an examination that has asked nothing yet.
std::optional<std::size_t> repetitions_to_fail(const Finding& finding,
                                               const std::function<std::unique_ptr<Examination>()>& start,
                                               double seconds);

}  // namespace lorentz::judge
