// Makes golden records: the exact answer, confirmed by a second opinion, with its margin, condition and
// proof.
#pragma once

#include <functional>

#include <lorentz/certificate_check.hpp>
#include <lorentz/errors.hpp>
#include <lorentz/margin.hpp>
#include <lorentz/oracle.hpp>
#include <lorentz/prover.hpp>
#include <lorentz/verdict.hpp>
#include <lorentz/walk.hpp>
#include "judge/golden/record.hpp"
#include "src/exchange/exchange_write.hpp"

namespace lorentz::golden {

struct MadeRecord {
  Record record;  ///< has no tag except perhaps `needs-judge`
  bool walked =
      false;  ///< `walk` could answer, and agrees; else the second opinion is the checked certificate alone
  std::optional<oracle::HardestDecision> hardest = {};  ///< on which the answer rests
};

/// An exact answer, with kDigits digits of its time, and its proof. In a scene of one single obstacle it has its
/// exit_time, for those who intersect rays with such shapes.
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
  explicit Maker(const Scene& scene, Others others = {}, NumberFormat precision = NumberFormat::binary64)
      : Maker(scene, lorentz::scene_line(scene), std::move(others), precision) {}
  /// For a scene that a set contains in this line; ids depend on its text.
  Maker(const Scene& scene, std::string scene_line, Others others = {},
        NumberFormat precision = NumberFormat::binary64);

  /// The scene's line, without the line end.
  const std::string& scene_line() const { return scene_line_; }

  /// Throws std::logic_error if the check refutes the proof; and ProofTooLong.
  Proved prove(const Query& query) const;

  /// Throws std::logic_error if the opinions differ; then the oracle is wrong, and nothing may be published.
  /// Also throws ProofTooLong.
  MadeRecord make(std::string question, const std::optional<Query>& query) const;

  /// Says what is wrong with a record, or nothing: the id does not belong to the question; its numbers, or
  /// those of the scene, are not of the precision; the certificate does not prove the answer; a margin,
  /// condition, time_change or comment that it has differs, or the acceptable answers (since format 2); walk, if asked, gives
  /// another answer.
  std::optional<std::string> flaw_of(const Record& record, const std::optional<Query>& query, bool ask_walk,
                                     int format = kFormat) const;

 private:
  std::string asked_of(const Query& query) const;
  Answer walked(const Query& query) const;
  std::optional<oracle::HardestDecision> measure(const Query& query, Record& record) const;
  void excuse(const Query& query, Record& record) const;

  const Scene scene_;
  const std::string scene_line_;
  const NumberFormat precision_;
  const Others others_;
  const oracle::Oracle oracle_;
  const oracle::Walk walk_;
  const oracle::Margins margins_;
  const oracle::Judge judge_;
  const oracle::Prover prover_;
  const oracle::CertificateCheck check_;
};

/// All tags that the program gives to questions, each with the sentence that explains it.
const std::vector<std::pair<std::string, std::string>>& seen_tags();

/// The tags of a question with this exact answer and this hardest decision (or nothing).
std::vector<std::string> tags_seen(const Scene& scene, const Query& query, const Answer& exact,
                                   const std::optional<oracle::HardestDecision>& decision);

}  // namespace lorentz::golden
