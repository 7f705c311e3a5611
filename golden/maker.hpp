// Makes golden records: the exact answer, agreed by a second opinion, with its margin, condition and proof.
#pragma once

#include <functional>
#include <memory>

#include <lorentz/errors.hpp>
#include <lorentz/margin.hpp>
#include "golden/record.hpp"

namespace lorentz::golden {

struct MadeRecord {
  Record record;  ///< of tags only `needs-judge`, if it has that
  bool walked =
      false;  ///< `walk` could go there, and agrees; else the second opinion is the checked certificate alone
  std::optional<oracle::HardestDecision> hardest = {};  ///< that the answer rests on
};

/// An exact answer, with kDigits digits of its time, and its proof.
struct Proved {
  Answer exact;
  oracle::Certificate certificate;
};

/// An answer whose proof takes more steps than any checker goes (docs/certificates.md).
struct ProofTooLong : InputError {
  using InputError::InputError;
};

/// Who has an opinion besides the oracle; those left out are `walk` and the prover.
struct Others {
  std::function<Answer(const Query&)> walk = {};  ///< `undecided` where it cannot go
  std::function<oracle::Certificate(const Query&, const Answer&)> prove = {};
};

/// For the questions of one scene. Margins and conditions count in ulps of `precision`.
class Maker {
 public:
  explicit Maker(const Scene& scene, Others others = {}, NumberFormat precision = NumberFormat::binary64);
  /// For a scene that stands in a set, in this line: ids depend on how it is written.
  Maker(const Scene& scene, std::string scene_line, Others others = {},
        NumberFormat precision = NumberFormat::binary64);
  Maker(Maker&&) noexcept;
  ~Maker();

  /// The scene's line, without the line end.
  const std::string& scene_line() const;

  /// Throws std::logic_error if the check refutes the proof, and ProofTooLong.
  Proved prove(const Query& query) const;

  /// Throws std::logic_error if the opinions differ: then the oracle is wrong, and nothing may be published;
  /// and ProofTooLong.
  MadeRecord make(std::string question, const std::optional<Query>& query) const;

  /// What is wrong with a record, or nothing: the id does not belong to the question; its numbers, or those of
  /// the scene, are not of the precision; the certificate does not prove the answer; margin, condition,
  /// time_change, comment or the acceptable answers (since format 2) are others; walk, if asked, says otherwise.
  std::optional<std::string> flaw_of(const Record& record, const std::optional<Query>& query, bool ask_walk,
                                     int format = kFormat) const;

 private:
  std::string asked_of(const Query& query) const;

  struct Impl;
  std::unique_ptr<const Impl> impl_;
};

}  // namespace lorentz::golden
