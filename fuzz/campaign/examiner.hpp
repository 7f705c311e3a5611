// How a campaign asks an engine and judges its replies: what it counts, and what it calls a finding.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "fuzz/campaign/time_limit.hpp"
#include "question/counts.hpp"
#include "question/engines.hpp"
#include "question/question.hpp"

namespace lorentz::fuzz {

/// The judgement of a reply: one of agree (also ill-posed), wrong, wrong_time, undecided, unsupported, error (also missing).
using Kind = question::Count;

/// Which kinds are findings.
struct Sought {
  bool times = false;                  ///< wrong_time
  bool undecided = true;               ///< undecided
  double ulps = oracle::kDefaultUlps;  ///< the tolerance; at 0 an answer is exact or wrong
  bool is_finding(Kind kind) const;
};

using question::Answerer;
using question::Place;
using question::Question;
using question::Reply;

/// Makes the answerers that a campaign examines.
question::MakeAnswerer answerer_maker(const question::EngineInfo& engine,
                                      const question::AnswererOptions& options = {});

/// The replies to all questions of the source, in order. If another program was given up on the way, the rest
/// is asked again, one question at a time: a query is not in error because it was not asked.
std::vector<Reply> replies_to(const question::Source& source, Answerer& answerer);

/// Whether an answer differs from the exact one only by the choice among obstacles that contain x, or are entered
/// together: in other words for the scene another of them may be the first. The outcome is the same, and the
/// time is the same to the bit. Decided exactly.
bool is_tie(const oracle::Judge& judge, const Query& query, const Answer& exact, const Answer& other);

struct Examined {
  Kind kind = Kind::agree;
  Answer given, exact;
  double departs = 0;  ///< as in oracle::Judgement
  std::optional<Stage> stage = {};
};

/// A place, and the answerer that is asked there.
class Examiner {
 public:
  Examiner(Answerer& answerer, std::shared_ptr<Place> place, double ulps)
      : answerer_(answerer), place_(std::move(place)), ulps_(ulps) {}

  const std::shared_ptr<Place>& place() const { return place_; }
  const Scene& scene() const { return place_->scene(); }

  /// Judges the reply to a question in this place, while no replies are due. `is_carried`: the exact answer
  /// comes from the question in other words; if the reply differs from it, the truth is computed anew.
  Examined judge(const Question& question, Reply& reply, bool is_carried = false);

  /// Asks one query, which must have no flaw, while no replies are due. Does not ask if the exact answer is outside of the
  /// claim (`unsupported`).
  Examined examine(const Query& query, LimitAt limit = LimitAt::none);

 private:
  std::optional<Answer> settled(const Question& question) const;
  Examined judge_exact(const Question& question, Reply& reply);

  Answerer& answerer_;
  std::shared_ptr<Place> place_;
  double ulps_;
};

}  // namespace lorentz::fuzz
