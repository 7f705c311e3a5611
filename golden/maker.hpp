// Makes golden records: the exact answer, confirmed by a second opinion, with its margin, condition and
// proof.
#pragma once

#include <functional>
#include <memory>

#include <lorentz/errors.hpp>
#include <lorentz/margin.hpp>
#include "golden/record.hpp"

namespace lorentz::golden {

struct MadeRecord {
  Record record;  ///< has no tag except perhaps `needs-judge`
  bool walked =
      false;  ///< `walk` could answer, and agrees; else the second opinion is the checked certificate alone
  std::optional<oracle::HardestDecision> hardest = {};  ///< on which the answer rests
};

/// An exact answer, with kDigits digits of its time, and its proof.
struct Proved {
  Answer exact;
  oracle::Certificate certificate;
};

/// Thrown for an answer whose proof needs more steps than a checker allows (docs/certificates.md).
struct ProofTooLong : InputError {
  using InputError::InputError;
};

/// Opinions besides the oracle; by default `walk` and the prover.
struct Others {
  std::function<Answer(const Query&)> walk = {};  ///< `undecided` if it cannot answer
  std::function<oracle::Certificate(const Query&, const Answer&)> prove = {};
};

/// Makes records for the questions of one scene. Margins and conditions count in ulps of `precision`.
class Maker {
 public:
  explicit Maker(const Scene& scene, Others others = {}, NumberFormat precision = NumberFormat::binary64);
  /// For a scene that a set contains in this line; ids depend on its text.
  Maker(const Scene& scene, std::string scene_line, Others others = {},
        NumberFormat precision = NumberFormat::binary64);
  Maker(Maker&&) noexcept;
  ~Maker();

  /// The scene's line, without the line end.
  const std::string& scene_line() const;

  /// Throws std::logic_error if the check refutes the proof; and ProofTooLong.
  Proved prove(const Query& query) const;

  /// Throws std::logic_error if the opinions differ; then the oracle is wrong, and nothing may be published.
  /// Also throws ProofTooLong.
  MadeRecord make(std::string question, const std::optional<Query>& query) const;

  /// Says what is wrong with a record, or nothing: the id does not belong to the question; its numbers, or
  /// those of the scene, are not of the precision; the certificate does not prove the answer; margin,
  /// condition, time_change, comment or the acceptable answers (since format 2) differ; walk, if asked, gives
  /// another answer.
  std::optional<std::string> flaw_of(const Record& record, const std::optional<Query>& query, bool ask_walk,
                                     int format = kFormat) const;

 private:
  std::string asked_of(const Query& query) const;

  struct Impl;
  std::unique_ptr<const Impl> impl_;
};

}  // namespace lorentz::golden
