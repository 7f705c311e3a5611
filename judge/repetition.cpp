#include "judge/repetition.hpp"

namespace lorentz::judge {

void recheck(Finding& finding, const std::function<std::unique_ptr<Examination>()>& start, double seconds) {
  const Example& example = finding.simplest;
  finding.recheck = Recheck::no_time;
  for (const std::size_t copies : {std::size_t{1}, kMostRepetitions}) {
    const std::unique_ptr<Examination> anew = start();
    anew->limit(seconds);
    const auto [failed, all_answered] = anew->repeat(example.question, copies, example.diagnosis);
    anew->finish();
    if (failed) {
      finding.recheck = Recheck::fails;
      finding.repetitions = *failed;
    }
    if (failed || !all_answered) return;
  }
  finding.recheck = Recheck::passes;
}

}  // namespace lorentz::judge
