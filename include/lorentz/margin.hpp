// How hard a question was: the margin of its answer and the condition of its time (docs/verdicts.md).
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include <lorentz/answer.hpp>
#include <lorentz/claim.hpp>
#include <lorentz/pimpl.hpp>
#include <lorentz/query.hpp>
#include <lorentz/scene.hpp>

namespace lorentz::oracle {

/// Margins are computed up to this many ulps; a larger one is reported as this.
inline constexpr double kLargestMargin = 0x1p20;

/// A decision that an answer rests on.
enum class DecisionKind {
  containing,  ///< does the obstacle contain x?
  meeting,     ///< does the line meet the obstacle?
  order        ///< is the obstacle entered before the one that is hit?
};

/// How many obstacles the search for a margin looks at, at the most, before it is content with the smallest
/// margin of those.
inline constexpr long kMarginBudget = 10'000;

struct HardestDecision {
  DecisionKind kind = DecisionKind::meeting;
  ObstacleId obstacle;
  bool yes = false;  ///< what was decided
  /// In ulps: how far the inputs must move, each by so many ulps, to change it; to first order.
  double margin = 0;
};

/// An obstacle that a flight came near, on its way to the answer.
struct PassedObstacle {
  ObstacleId obstacle;
  double time = 0;  ///< at which the line is nearest to its centre, in the coordinates in which it is a ball;
                    ///< at most 1e300
  std::string time_decimal;  ///< the same to 10 significant digits, however large
  double gap = 0;     ///< distance of the line from it, in units of its radius there; below 0: it is met
  double margin = 0;  ///< of that decision, in ulps; not limited
};

/// How near the line of a query comes to one obstacle, whatever else is in the way. Lengths in units of the
/// obstacle's radius, in the coordinates in which it is a ball.
struct Approach {
  double gap = 0;        ///< distance of the line from the obstacle; below 0: the line meets it
  double start_gap = 0;  ///< distance of x from it; below 0: it contains x
  bool ahead = true;     ///< the line is nearest to its centre at t > 0
};

/// A line and one obstacle, exactly: what an engine has to decide of the two, whatever else is in the way.
struct Crossing {
  int discriminant = 0;  ///< its sign: 1 the line meets the open obstacle, 0 it touches it, -1 it misses it
  std::string time_decimal;  ///< of 1: the first boundary point of the chord, to 17 digits; below 0 behind x
  std::array<std::string, 3> centre;  ///< hexadecimal, as "-0x3p-1", all bits that there are
  bool is_centre_binary64 = true;     ///< each component of it is a binary64
};

/// How hard the questions of one scene were.
///
///  1. Inputs that move by less than the margin (each by so many units in its last place) leave the
///     answer as it is; of those that move by twice as much some change it. To first order: where the
///     change is strongly curved, as in 3D along lattice planes, the margin is too large
///     (docs/verdicts.md).
///     held by "Inputs moved by less than the margin give the same answer, moved by twice it some give
///     another"
///  2. The condition is what one ulp in each input can make of the time, in its ulps.
///     held by "Conditions: what each input makes of the time"
///
/// Cost: 100 us and more, by the obstacles that the flight comes near. Allocates. Any number of threads
/// may ask one.
class Margins {
 public:
  /// Throws InputError for a scene with a flaw (flaw_of) or dependent vectors (dependence_in). Ulps are those of
  /// `precision`.
  explicit Margins(const Scene& scene, NumberFormat precision = NumberFormat::binary64);
  Margins(Margins&&) noexcept;
  Margins& operator=(Margins&&) noexcept;
  ~Margins();

  /// The decision with the smallest margin of all that the exact answer rests on. An error has none; `never`
  /// has one only where every lattice repeats in fewer directions than there are. The margin is at most
  /// kLargestMargin (then the decision means nothing). With a smaller budget (of which each width of the
  /// search has its own) the margin is an upper bound more often; 0: one narrow search, some 500 obstacles.
  std::optional<HardestDecision> hardest_decision(const Query& query, const Answer& exact,
                                                  long budget = kMarginBudget) const;

  /// The obstacles that the flight of an exact `hit` passed at the smallest distances in units of their
  /// radii, up to and with the one that it hit; in order of time, `most` of them at most.
  std::vector<PassedObstacle> passed(const Query& query, const Answer& exact, std::size_t most) const;

  /// Of an obstacle that must exist.
  Approach approach(const Query& query, const ObstacleId& obstacle) const;
  Crossing crossing(const Query& query, const ObstacleId& obstacle) const;

  /// The sum over the inputs of |dt/dq| ulp(q), over ulp(t): how many ulps of t one ulp in each input can
  /// make. Requires an exact `hit`.
  double condition(const Query& query, const Answer& exact) const;

  /// The same sum, in the time's own unit: the change of t when every input moves by an ulp. Requires an exact `hit`.
  double time_change(const Query& query, const Answer& exact) const;

 private:
  struct Impl;
  Pimpl<const Impl> impl_;
};

}  // namespace lorentz::oracle
