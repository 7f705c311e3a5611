// Does a program answer a question wrong by itself, or by a count, or not again?
#pragma once

#include <functional>
#include <memory>

#include "judge/examination.hpp"

namespace lorentz::judge {

/// Questions in a row, at the most.
inline constexpr std::size_t kMostRepetitions = 1000;

/// Asks new starts of the program the finding's simplest question, alone and then kMostRepetitions times in a
/// row, each for so many seconds at the most, and notes in the finding what came of it. `start` makes an
/// examination that has asked nothing yet.
void recheck(Finding& finding, const std::function<std::unique_ptr<Examination>()>& start, double seconds);

}  // namespace lorentz::judge
