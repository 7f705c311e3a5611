// Checks whether a program answers a question wrong when it is asked alone, after repetitions, or not again.
#pragma once

#include <functional>
#include <memory>

#include "judge/examination.hpp"

namespace lorentz::judge {

/// The largest number of questions in a row.
inline constexpr std::size_t kMostRepetitions = 1000;

/// Asks new starts of the program the finding's simplest question, alone and then kMostRepetitions times in a
/// row, each for at most `seconds`, and records the result in the finding. `start` makes an examination that
/// has asked nothing yet.
void recheck(Finding& finding, const std::function<std::unique_ptr<Examination>()>& start, double seconds);

}  // namespace lorentz::judge
