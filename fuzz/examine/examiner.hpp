// Asks a subject and judges it by the oracle: what a campaign counts, and what it calls a finding.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include <lorentz/answer.hpp>
#include <lorentz/query.hpp>
#include <lorentz/scene.hpp>
#include <lorentz/verdict.hpp>
#include "compare/truth.hpp"
#include "fuzz/examine/subject.hpp"
#include "fuzz/examine/time_limit.hpp"

namespace lorentz::fuzz {

/// What a reply turned out to be.
enum class Kind {
  fine,         ///< right, or ill-posed
  unsupported,  ///< it says that it does not do this
  wrong,        ///< another obstacle, or another outcome, than any error of k ulps in the inputs explains
  wrong_time,   ///< the right obstacle, at a wrong time
  undecided,    ///< it gave up
  slow,  ///< the right obstacle, but with more than kSlowFactor times the work of a drawn flight in the same
         ///< scene
  error  ///< it calls the query none, or broke
};
inline constexpr int kKinds = 7;

std::string_view name_of(Kind kind);

/// More than so many times the median work of kDrawnFlights drawn flights in the scene, and at least
/// kLeastWork.
inline constexpr double kSlowFactor = 100, kLeastWork = 500;
inline constexpr int kDrawnFlights = 33;

/// Which kinds are findings.
struct Counts {
  bool times = false;                  ///< wrong_time
  bool undecided = true;               ///< undecided
  double ulps = oracle::kDefaultUlps;  ///< the tolerance; at 0 an answer is the exact one or wrong
  bool is_finding(Kind kind) const;
};

using compare::Truth;

struct Question {
  Query query;
  Answer exact;             ///< without the limit
  bool is_carried = false;  ///< the answer is of the question in its own words: asked anew where in doubt
  LimitAt limit = LimitAt::none;
};

struct Examined {
  Kind kind = Kind::fine;
  Answer given, exact;
  double departs = 0;  ///< as in oracle::Judgement
  std::optional<double> work;
  std::optional<Stage> stage;
  bool is_misreading = false;  ///< an error of the reader: nobody was asked
};

/// One scene and a subject in it.
class Examiner {
 public:
  /// The scene without flaws.
  Examiner(Subject& subject, const Scene& scene, double ulps, Truth truth = Truth::oracle);
  ~Examiner();

  const Scene& scene() const;
  /// The true answer to a query without flaws.
  Answer exact(const Query& query) const;

  /// Asks the subject. Its replies are for the caller to wait for, and to hand to judge().
  void ask(const Question& question);
  Examined judge(const Question& question, Reply& reply);

  /// One query, which must have no flaw, while no replies are due.
  Examined examine(const Query& query, LimitAt limit = LimitAt::none);

 private:
  Examined judge_unlimited(const Question& question, Reply& reply);
  Examined judge_limited(const Question& question, Reply& reply);
  bool is_slow(double work);

  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// The scene and the query are what they should be, also where only exact arithmetic can say so.
bool is_sound(const Scene& scene);

}  // namespace lorentz::fuzz
