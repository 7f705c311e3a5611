// Judges an answer by the exact one (docs/verdicts.md). The caller chooses the tolerance: k ulps of the
// inputs. By how many ulps the inputs would have to move to make an answer right is computed.
#pragma once

#include <optional>
#include <vector>

#include <lorentz/answer.hpp>
#include <lorentz/claim.hpp>
#include <lorentz/pimpl.hpp>
#include <lorentz/query.hpp>
#include <lorentz/scene.hpp>

namespace lorentz::oracle {

enum class Verdict {
  agree,        ///< the same outcome and the same obstacle; `wrong_time` says whether its time is off
  ill_posed,    ///< another answer, which some movement of each input by at most k ulps makes right
  wrong,        ///< another answer, which no such movement makes right
  undecided,    ///< the engine answered that it does not know, or `later`
  unsupported,  ///< the engine answered that it does not support this kind of query
  error,        ///< the query is invalid, or the engine answered that it is, or failed
  missing       ///< no answer was given
};

/// The default tolerance k, in ulps of the inputs.
inline constexpr double kDefaultUlps = 4;

/// The largest number of obstacles and stretches of the line that Judge::excused examines before it gives up.
inline constexpr long kExcusedBudget = 20'000;

/// If a time is off by more than this many times the change that an ulp in each input makes, it is not a
/// rounding error but another quantity, such as the time at which the line leaves the obstacle.
constexpr double other_quantity_from(NumberFormat precision) {
  return precision == NumberFormat::binary64 ? 0x1p30 : 0x1p14;
}

/// How an answer compares with the exact one.
struct Judgement {
  Verdict verdict = Verdict::missing;
  /// If the obstacle hit is right and a finite time is given: |t - t_exact| / ulp(t_exact), with the rounded
  /// t_exact. If only the exit's time is wrong: the same for that.
  std::optional<double> ulps = {};
  /// For ill_posed and wrong: the least number of ulps by which the inputs must move to make the answer
  /// right. For wrong it is a lower bound, because the first reason to reject the answer ends the search; it
  /// is infinite if nothing can make the answer right. For a wrong time: the tolerance that it would have
  /// needed, in units of its condition; infinite if the time is NaN.
  double departs = 0;
  bool wrong_time = false;      ///< for `agree`: the obstacle is right, but a time is beyond its tolerance
  bool other_quantity = false;  ///< a wrong time that no rounding explains (other_quantity_from)
  /// For ill_posed and wrong: the obstacle that `departs` is about (the one that is named and missed, or that
  /// is passed over, or that contains x). Empty if the scene does not have the named obstacle, and if nothing
  /// needs to move (a tie that was decided the other way).
  std::optional<ObstacleId> obstacle = {};
};

/// An answer other than the exact one, and the least number of ulps by which each input must move to make it
/// right.
struct ExcusedAnswer {
  Answer answer;  ///< without a time
  double ulps = 0;
};

/// Judges answers to queries in one scene.
///
///  1. An answer is `wrong` if no movement of each input by up to `ulps` units in its last place makes it
///     right (to first order, docs/verdicts.md). It is `ill_posed` if some such movement does.
///  2. The time of the right obstacle is a wrong time if its error, in its ulps, is more than `ulps` and more
///     than `ulps` times its condition. The answer agrees nevertheless, however large the error of the time.
///     An exit_time, also of `inside`, is judged in the same way, by its own condition.
///  3. With `ulps` = 0, an answer is the exact one or `wrong`, and a time is correctly rounded or a wrong
///     time. Not even a tie that was decided the other way is forgiven.
///  4. Ulps are those of the claim's precision. With a time tolerance T, a time t is wrong if it is off by
///     more than T t, and only then. A later obstacle is forgiven if each obstacle entered earlier is entered
///     at most T times its time before, and not yet left.
///  5. If the claim has another rule for starts inside, the exact answer must be the one by that rule. `inside` is
///     wrong then; whether x lies in an obstacle is one of the decisions that ulps may excuse.
///  6. Any number of threads may use one judge.
///  7. excused() lists what judge() forgives, and nothing else.
///
/// Cost: negligible if the two answers agree, otherwise 100 us and more.
class Judge {
 public:
  /// Throws InputError if the scene is invalid (flaw_of) or has dependent vectors (dependence_in), or if the
  /// claim's tolerance is below zero or NaN.
  explicit Judge(const Scene& scene, const Claim& claim = {});
  Judge(Judge&&) noexcept;
  Judge& operator=(Judge&&) noexcept;
  ~Judge();

  /// `exact` is the oracle's answer to the query without a time limit. Throws InputError if `ulps` is below
  /// zero or NaN.
  Judgement judge(const Query& query, const Answer& exact, const Answer& given,
                  double ulps = kDefaultUlps) const;

  /// True if x lies in the open obstacle, which must exist. Decided exactly.
  bool contains(const Query& query, const ObstacleId& obstacle) const;

  /// All answers that judge() calls ill-posed with this tolerance, the one with the least ExcusedAnswer::ulps
  /// first. With this list, answers can be judged without a Judge. Nothing if there are more than `most` or
  /// infinitely many, or if too many obstacles come into question (kExcusedBudget). The claim's time
  /// tolerance and its rule for starts inside are ignored.
  std::optional<std::vector<ExcusedAnswer>> excused(const Query& query, const Answer& exact, double ulps,
                                                    std::size_t most) const;

 private:
  struct Impl;
  Pimpl<const Impl> impl_;
};

}  // namespace lorentz::oracle
