// A batch: consecutive cases of a target, worked through by one thread. What it finds is shrunk later, one
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

struct Batch {
  std::size_t target;        ///< of the plan's
  std::uint64_t begin, end;  ///< indices
};

struct BatchResult {
  TargetTally met;  ///< of this batch alone
  struct Kept {
    Finding finding;
    std::uint64_t ordinal;  ///< among the batch's findings of its sort, from 1
  };
  std::vector<Kept> kept;
};

class BatchRunner {
 public:
  BatchRunner(const Plan& plan, const MakeSubject& make_subject, const std::atomic<bool>& stop);
  ~BatchRunner();

  /// Nothing if it was stopped. `known` is how many findings of each sort the target has for certain from
  /// earlier indices: those beyond the plan's `keep` are counted only.
  std::optional<BatchResult> run(const Batch& batch, const std::map<std::string, std::uint64_t>& known);

  /// A finding that is due, shrunk for so many seconds at the most; without these it is the same whoever does
  /// it. One that does not fail again stays as it was found. Nothing if it was stopped.
  std::optional<Finding> shrink(Finding finding, double seconds);

  /// The subject broke at least once. (It was made anew.)
  bool subject_failed() const { return subject_failed_; }

  /// How many cases a batch should have, if they do not take long.
  std::uint64_t batch_size() const { return subject_->batch_size(); }

 private:
  struct Case;
  struct SceneContext;
  struct Questions;
  void pose(const Batch& batch, Questions& questions);
  void pose_in_other_words(cases::Random& random, Questions& questions, std::size_t first);
  static std::optional<Case> in_other_digits(cases::Random& random, const Case& one);
  void ask(Questions& questions);
  void take(Questions& questions, const std::map<std::string, std::uint64_t>& known, BatchResult& result);
  Finding finding_of(const Case& one, const std::string& sort, const Examined& examined);
  void replace_broken_subject();

  const Plan& plan_;
  const MakeSubject& make_subject_;
  const std::atomic<bool>& stop_;
  std::unique_ptr<Subject> subject_;
  bool subject_failed_ = false;
};

/// The name of a finding in its campaign: TARGET/INDEX, or TARGET/INDEX.STEP of a variant; with an `r` behind
/// it if it was found in other words.
std::string label_of(const Finding& finding);

}  // namespace lorentz::fuzz
