#include "fuzz/campaign/work.hpp"

#include <chrono>

namespace lorentz::fuzz {

Workers::Workers(const Plan& plan, const MakeSubject& make_subject, WorkSource& source, unsigned jobs)
    : plan_(plan), make_subject_(make_subject), source_(source) {
  for (unsigned i = 0; i < jobs; ++i) threads_.emplace_back([this] { work(); });
}

void Workers::join() {
  for (std::thread& thread : threads_) thread.join();
  threads_.clear();
}

void Workers::work() {
  using Clock = std::chrono::steady_clock;
  try {
    BatchRunner runner(plan_, make_subject_, source_.stop());
    while (const auto assignment = source_.take(runner.batch_size())) {
      const auto start = Clock::now();
      Done done{assignment->batch};
      if (assignment->due)
        done.shrunk = runner.shrink(*assignment->due, assignment->most_seconds);
      else
        done.result = runner.run(assignment->batch, assignment->known);
      done.seconds = std::chrono::duration<double>(Clock::now() - start).count();
      if (runner.subject_failed()) source_.subject_failed();
      source_.hand_in(std::move(done));
    }
  } catch (...) {
    source_.fail(std::current_exception());
  }
}

}  // namespace lorentz::fuzz
