#include "judge/repetition.hpp"

namespace lorentz::judge {

std::optional<std::size_t> repetitions_to_fail(const Finding& finding,
                                               const std::function<std::unique_ptr<Examination>()>& start,
                                               double seconds) {
  const Example& example = finding.simplest;
  for (const std::size_t copies : {std::size_t{1}, kMostRepetitions}) {
    const std::unique_ptr<Examination> anew = start();
    anew->limit(seconds / 2);
    const auto number = anew->first_to_fail(example.question, copies, example.diagnosis);
    anew->finish();
    if (number) return number;
  }
  return std::nullopt;
}

}  // namespace lorentz::judge
