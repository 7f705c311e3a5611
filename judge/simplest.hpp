// Finds the simplest case that goes wrong in the same way, and whether it does so by itself.
#pragma once

#include <functional>
#include <memory>

#include "judge/examination.hpp"

namespace lorentz::judge {

/// Shrinks the finding's simplest example (fuzz/campaign/shrink.hpp) for at most `seconds`. The engine must
/// keep going wrong with the same cause and severity and the same outcomes, by no more radii than in the
/// finding, and in its circumstance, so that all statements about the finding also hold for its case. The example is returned
/// unchanged if there is nothing to shrink, or if the engine does not repeat its fault.
Example simplest(const Finding& finding, TimedExamination& examination, double seconds);

/// What is wrong with the answer to one question that is asked alone; nothing if nothing is, or if there is no
/// answer.
std::optional<Example> example_of(const Question& question, TimedExamination& examination);

/// Asks copies of a question one after the other. Returns the number, from 1, of the first that is answered
/// with this cause and severity. `all_answered`: there was time for all.
std::optional<std::size_t> failed_copy(const Question& question, std::size_t copies, Diagnosis like,
                                       TimedExamination& examination, bool& all_answered);

/// The largest number of questions in a row.
inline constexpr std::size_t kMostRepetitions = 1000;

/// Asks new starts of the program the finding's simplest question, alone and then kMostRepetitions times in a
/// row, each for at most `seconds`, and records the result in the finding. `start` makes an examination that
/// has asked nothing yet.
void recheck(Finding& finding, const std::function<std::unique_ptr<TimedExamination>()>& start,
             double seconds);

}  // namespace lorentz::judge
