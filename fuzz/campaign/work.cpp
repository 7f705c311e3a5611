#include "fuzz/campaign/work.hpp"

#include <chrono>

namespace lorentz::fuzz {

Workers::Workers(const Plan& plan, const MakeAnswerer& make_answerer, WorkSource& source, unsigned jobs)
    : plan_(plan), make_answerer_(make_answerer), source_(source) {
  for (unsigned i = 0; i < jobs; ++i) threads_.emplace_back([this] { work(); });
}

void Workers::work() {
  using Clock = std::chrono::steady_clock;
  try {
    StintRunner runner(plan_, make_answerer_, source_.stop());
    while (const auto assignment = source_.take(runner.batch_size())) {
      const auto start = Clock::now();
      Done done{assignment->stint};
      if (assignment->due)
        done.shrunk = runner.shrink(*assignment->due, assignment->most_seconds);
      else
        done.result = runner.run(assignment->stint, assignment->known);
      done.seconds = std::chrono::duration<double>(Clock::now() - start).count();
      done.answerer_failed = runner.answerer_failed();
      source_.hand_in(std::move(done));
    }
  } catch (...) {
    source_.fail(std::current_exception());
  }
}

}  // namespace lorentz::fuzz
