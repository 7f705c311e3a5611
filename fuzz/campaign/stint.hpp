// A stint: consecutive cases of a target, worked through by one thread. What it finds is shrunk later, one
// finding at a time.
#pragma once

#include <atomic>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "fuzz/campaign/campaign.hpp"

namespace lorentz::fuzz {

struct Stint {
  std::size_t target;        ///< of the plan's
  std::uint64_t begin, end;  ///< indices
};

struct StintResult {
  TargetTally met;  ///< of this stint alone
  struct Kept {
    Finding finding;
    std::uint64_t ordinal;  ///< among the stint's findings of its sort, from 1
  };
  std::vector<Kept> kept;
};

class StintRunner {
 public:
  StintRunner(const Plan& plan, const MakeAnswerer& make_answerer, const std::atomic<bool>& stop);
  ~StintRunner();

  /// Nothing if it was stopped. `known` is how many findings of each sort the target has for certain from
  /// earlier indices: those beyond the plan's `keep` are counted only.
  std::optional<StintResult> run(const Stint& stint, const std::map<std::string, std::uint64_t>& known);

  /// A finding that is due, shrunk for so many seconds at the most; without these it is the same whoever does
  /// it. One that does not fail again stays as it was found. Nothing if it was stopped.
  std::optional<Finding> shrink(Finding finding, double seconds);

  /// The engine broke at least once. (It was made anew.)
  bool answerer_failed() const { return answerer_failed_; }

  /// How many cases a stint should have, if they do not take long.
  std::uint64_t batch_size() const { return answerer_->batch_size(); }

 private:
  struct Case;
  struct SceneContext;
  struct Questions;
  void pose(const Stint& stint, Questions& questions);
  void pose_in_other_words(cases::Random& random, Questions& questions, std::size_t first);
  static std::optional<Case> in_other_digits(cases::Random& random, const Case& one);
  void ask(Questions& questions);
  void take(Questions& questions, const std::map<std::string, std::uint64_t>& known, StintResult& result);
  Finding finding_of(const Case& one, const std::string& sort, const Examined& examined);
  void replace_broken_answerer();

  const Plan& plan_;
  const MakeAnswerer& make_answerer_;
  const std::atomic<bool>& stop_;
  std::unique_ptr<Answerer> answerer_;
  bool answerer_failed_ = false;
};

/// The name of a finding in its campaign: TARGET/INDEX, or TARGET/INDEX.STEP of a variant; with an `r` behind
/// it if it was found in other words.
std::string label_of(const Finding& finding);

}  // namespace lorentz::fuzz
