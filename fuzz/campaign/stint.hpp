// A stint: consecutive cases of a target, done by one thread. Its findings are shrunk later, one at a time.
#pragma once

#include <atomic>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "fuzz/campaign/campaign.hpp"
#include "fuzz/campaign/shrink.hpp"

namespace lorentz::fuzz {

struct Stint {
  std::size_t target;        ///< index in the plan's targets
  std::uint64_t begin, end;  ///< indices

  friend auto members_of(Stint& self) { return std::tie(self.target, self.begin, self.end); }
};

struct StintResult {
  TargetTally met;  ///< by this stint alone
  struct Kept {
    Finding finding;
    std::uint64_t ordinal;  ///< among the stint's findings of its sort, from 1

    friend auto members_of(Kept& self) { return std::tie(self.finding, self.ordinal); }
  };
  std::vector<Kept> kept;

  friend auto members_of(StintResult& self) { return std::tie(self.met, self.kept); }
};

class StintRunner {
 public:
  StintRunner(const Plan& plan, const MakeAnswerer& make_answerer, const std::atomic<bool>& stop);
  ~StintRunner();

  /// Nothing if it was stopped. `known` is the number of findings of each sort that the target is certain to
  /// have from earlier indices; findings beyond the plan's `keep` are only counted.
  std::optional<StintResult> run(const Stint& stint, const std::map<std::string, std::uint64_t>& known);

  /// Shrinks a finding that is due, for at most `seconds`. If the time does not end it, the result is the
  /// same in every thread. A finding that does not fail again stays as it was found. Nothing if it was
  /// stopped.
  std::optional<Finding> shrink(Finding finding, double seconds);

  /// The engine broke at least once. (It was started again.)
  bool answerer_failed() const { return answerer_failed_ || answerer_->failed(); }

  /// The number of cases that a stint should have, if they do not take long.
  std::uint64_t batch_size() const { return answerer_->batch_size(); }

 private:
  struct Case;
  struct SceneContext;
  struct Questions;
  void pose(const Stint& stint, Questions& questions);
  void pose_in_other_words(cases::Random& random, Questions& questions, std::size_t first);
  void ask(Questions& questions);
  void take(Questions& questions, const std::map<std::string, std::uint64_t>& known);
  Finding finding_of(const cases::Target& target, const Case& one, const std::string& sort,
                     const Examined& examined);
  Shrunk shrink_case(const ReadCase& found, const Examined& like, LimitAt limit,
                     const std::function<bool()>& is_late);
  std::unique_ptr<Answerer> new_answerer() const;
  void replace_broken_answerer();

  const Plan& plan_;
  const MakeAnswerer& make_answerer_;
  const std::atomic<bool>& stop_;
  std::unique_ptr<Answerer> answerer_;
  bool answerer_failed_ = false;
};

/// The name of a finding in its campaign: TARGET/INDEX, or TARGET/INDEX.STEP of a variant; an `r` follows if
/// it was found in other words.
std::string label_of(const Finding& finding);

}  // namespace lorentz::fuzz
