// Measures how fast engines answer the same queries, in alternating rounds. Answers are not judged.
#pragma once

#include "question/engines.hpp"
#include "question/question.hpp"
#include "question/tally.hpp"

namespace lorentz::question {

struct RaceOptions {
  int rounds = 5;
  /// For engines outside this program; the listener also gets the progress. A race times one thread.
  AnswererOptions answerer = {};
  std::vector<std::size_t> counts = {};  ///< how many questions each engine is asked; empty: all
  /// For each engine an answerer that runs already; race() does not end it. A new one is made if the list is
  /// empty or the pointer null.
  std::vector<Answerer*> running = {};
};

/// The engines' speeds, on one thread. A round of an engine ends after ten seconds, except that of an external program, which is
/// timed by the wall clock, pipes included, from the first query to the last answer; a library by its own
/// calls. A program that failed is not run again.
std::vector<Speed> race(std::span<const Question> questions, const std::vector<EngineInfo>& engines,
                        const RaceOptions& options = {});

}  // namespace lorentz::question
