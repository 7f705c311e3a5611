// How fast engines are over the same queries, in alternating rounds. Nothing is judged.
#pragma once

#include "question/engines.hpp"
#include "question/question.hpp"
#include "question/tally.hpp"

namespace lorentz::question {

struct RaceOptions {
  int rounds = 5;
  double timeout = AnswererOptions::kDefaultTimeout;  ///< of another program
  Listener listener = {};
  bool strict = false;                   ///< of another program: AnswererOptions::strict
  double start_timeout = 0;              ///< AnswererOptions::start_timeout
  std::function<bool()> enough = {};     ///< AnswererOptions::enough
  std::vector<std::size_t> counts = {};  ///< how many of the questions each engine is asked; empty: all
  /// Of each engine an answerer that runs already, and is not ended here. Empty, or null: a new one is made.
  std::vector<Answerer*> running = {};
};

/// The engines' speeds, on one thread. A round of an engine ends after ten seconds. Another program is timed by the wall,
/// pipes and all, from the first query to the last answer; a library by its own calls. Where it broke it is not run
/// again.
std::vector<Speed> race(std::span<const Question> questions, const std::vector<EngineInfo>& engines,
                        const RaceOptions& options = {});

}  // namespace lorentz::question
