// Judging an answer by the exact one, with a tolerance that is derived and not guessed (docs/verdicts.md).
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
  ill_posed,    ///< another one, but the inputs need to move by no more than k ulps each for it to be right
  wrong,        ///< another one, and not so
  undecided,    ///< it said that it does not know, or `later`
  unsupported,  ///< it said that it does not do this kind of query
  error,        ///< it said that the query is invalid, or it broke
  missing       ///< there is no answer
};

/// The tolerance k, in ulps of the inputs, unless told otherwise.
inline constexpr double kDefaultUlps = 4;

/// How many obstacles and stretches of the line Judge::excused looks at before it says that they are too many.
inline constexpr long kExcusedBudget = 20'000;

/// A time that is off by more than this many times what an ulp in each input makes of it is not rounded: it is
/// another quantity, such as the time at which the line leaves the obstacle.
constexpr double other_quantity_from(NumberFormat precision) {
  return precision == NumberFormat::binary64 ? 0x1p30 : 0x1p14;
}

/// What an answer is worth beside the exact one.
struct Judgement {
  Verdict verdict = Verdict::missing;
  /// Where the obstacle hit is right and a finite time is given: |t - t_exact| / ulp(t_exact), from the
  /// rounded t_exact.
  std::optional<double> ulps = {};
  /// Of ill_posed and wrong: by how many ulps the inputs must move at least for the answer to be right. Of
  /// wrong answers a lower bound (what condemned it first); infinite if nothing can make it right. Of a wrong
  /// time: the tolerance that it would have needed, in units of its condition; infinite if it is not finite.
  double departs = 0;
  bool wrong_time = false;      ///< of `agree`: the obstacle is right, the time is beyond its tolerance
  bool other_quantity = false;  ///< a wrong time that no rounding explains (other_quantity_from)
  /// Of ill_posed and wrong: the obstacle that `departs` is about (the one that is named and missed, or that
  /// is passed over, or that contains x). Nothing if the scene does not have the obstacle that was named, and
  /// where nothing needs to move (a tie that was decided the other way).
  std::optional<ObstacleId> obstacle = {};
};

/// An answer other than the exact one, and by how many ulps each input must move, at least, for it to be right.
struct ExcusedAnswer {
  Answer answer;  ///< without a time
  double ulps = 0;
};

/// Judges answers to the queries of one scene.
///
///  1. `wrong` is an answer that no movement of each input by up to `ulps` units in its last place makes
///     right (to first order, docs/verdicts.md); `ill_posed` one that some such movement does.
///     held by "Each answer gets its verdict",
///             "An answer that a few ulps would make right is ill-posed, with the tolerance that it needs"
///  2. The time of the right obstacle is a wrong time if it errs, in its ulps, by more than `ulps` and by
///     more than `ulps` times its condition. The answer agrees nevertheless, by however much the time is off.
///     held by "Errors of the time are counted in ulps, and judged by the condition",
///             "A time that is off by a good part of itself is another quantity"
///  3. With `ulps` = 0 an answer is the exact one or `wrong`, and a time the correctly rounded one or a wrong
///     time: not even a tie is forgiven that was decided the other way.
///     held by "Where no ulp is forgiven an answer is the exact one or wrong"
///  4. An ulp is one of the claim's precision. With a time tolerance T a time t is wrong if it is off by more
///     than T t, and only then; a later obstacle is forgiven where each one entered earlier is entered at most T
///     times its time before, and not yet left.
///     held by "In binary32 an ulp is one of 24 bits",
///             "A tolerance of times, and what it forgives of the order"
///  5. Any number of threads may ask one judge.
///     held by "Many threads may ask one engine, oracle, walk and judge"
///  6. excused() lists what judge() forgives, and nothing else.
///     held by "Excused answers are those that the judge calls ill-posed"
///
/// Cost: nothing to speak of where the two agree, else 100 us and more.
class Judge {
 public:
  /// Throws InputError for a scene with a flaw (flaw_of) or dependent vectors (dependence_in).
  explicit Judge(const Scene& scene, const Claim& claim = {});
  Judge(Judge&&) noexcept;
  Judge& operator=(Judge&&) noexcept;
  ~Judge();

  /// `exact` is the oracle's answer to the query without a time limit. Costs nothing to speak of where the
  /// two agree.
  Judgement judge(const Query& query, const Answer& exact, const Answer& given,
                  double ulps = kDefaultUlps) const;

  /// All answers that judge() calls ill-posed with this tolerance, by `ulps`, the least first: whoever has them can
  /// judge without a Judge. Nothing if they are more than `most`, or endless, or too many obstacles come into
  /// question (kExcusedBudget). The claim's time tolerance is not looked at.
  std::optional<std::vector<ExcusedAnswer>> excused(const Query& query, const Answer& exact, double ulps,
                                                    std::size_t most) const;

 private:
  struct Impl;
  Pimpl<const Impl> impl_;
};

}  // namespace lorentz::oracle
