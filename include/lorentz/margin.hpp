// How hard a query is: the margin of its answer and the condition of its time (docs/verdicts.md).
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

/// Margins are computed up to this many ulps; a larger margin is reported as this value.
inline constexpr double kLargestMargin = 0x1p20;

/// A decision that an answer rests on.
enum class DecisionKind {
  containing,  ///< does the obstacle contain x?
  meeting,     ///< does the line meet the obstacle?
  order        ///< is the obstacle entered before the one that is hit?
};

/// The largest number of obstacles that the search for a margin examines before it accepts the smallest
/// margin among them.
inline constexpr long kMarginBudget = 10'000;

struct HardestDecision {
  DecisionKind kind = DecisionKind::meeting;
  ObstacleId obstacle;
  bool yes = false;  ///< the decision
  /// How far the inputs must move to change the decision, in ulps of each input; to first order.
  double margin = 0;
};

/// An obstacle that a flight passes closely on its way to the answer.
struct PassedObstacle {
  ObstacleId obstacle;
  double time = 0;  ///< when the line is nearest to the centre, in coordinates in which the obstacle is a
                    ///< ball; at most 1e300
  std::string time_decimal;  ///< the same to 10 significant digits, however large
  double gap = 0;            ///< distance of the line from the obstacle, in radii there; below 0: it is met
  double margin = 0;  ///< of the decision whether the line meets it, in ulps; not limited to kLargestMargin
};

/// How near the line of a query comes to one obstacle, ignoring all others. Lengths are in units of the
/// obstacle's radius, in coordinates in which it is a ball.
struct Approach {
  double gap = 0;        ///< distance of the line from the obstacle; below 0: the line meets it
  double start_gap = 0;  ///< distance of x from the obstacle; below 0: it contains x
  bool ahead = true;     ///< the line is nearest to the obstacle's centre at t > 0
};

/// The exact relation of a line and one obstacle, ignoring all others: what an engine has to decide about the
/// two.
struct Crossing {
  int discriminant = 0;  ///< its sign: 1 the line meets the open obstacle, 0 it touches it, -1 it misses it
  std::string time_decimal;           ///< if 1: when the chord begins, to 17 digits; negative if behind x
  std::array<std::string, 3> centre;  ///< in hexadecimal with all bits, such as "-0x3p-1"
  bool is_centre_binary64 = true;     ///< each component of the centre is a binary64
};

/// Measures how hard queries in one scene are.
///
///  1. If each input moves by less than the margin, in units of its last place, the answer stays as it is.
///     Among movements of twice the margin, some change it. This holds to first order. Where first order is
///     not enough, the margin is only an estimate: among tiny obstacles, in very long flights in 3D, and
///     where the line grazes one of two overlapping obstacles and their order decides (docs/verdicts.md).
///  2. The condition is the largest change of the time, in its ulps, that one ulp in each input can cause.
///
/// Cost: 100 us and more, depending on the obstacles near the flight. Allocates. Any number of threads may
/// use one object.
class Margins {
 public:
  /// Throws InputError if the scene is invalid (flaw_of) or has dependent vectors (dependence_in). Ulps are
  /// those of `precision`.
  explicit Margins(const Scene& scene, NumberFormat precision = NumberFormat::binary64);
  Margins(Margins&&) noexcept;
  Margins& operator=(Margins&&) noexcept;
  ~Margins();

  /// The decision with the smallest margin of all decisions that the exact answer rests on. An `error` has
  /// none. `never` has one only if every lattice repeats in fewer directions than the scene has dimensions.
  /// The margin is at most kLargestMargin; at that value the decision has no meaning. `budget` limits the
  /// obstacles examined at each width of the search. With a smaller budget the margin is more often only an
  /// upper bound; 0 runs a single narrow search of about 500 obstacles.
  std::optional<HardestDecision> hardest_decision(const Query& query, const Answer& exact,
                                                  long budget = kMarginBudget) const;

  /// The obstacles that the flight of an exact `hit` passes most closely, in units of their radii, up to and
  /// including the obstacle that it hits. They are in order of time, at most `most` of them.
  std::vector<PassedObstacle> passed(const Query& query, const Answer& exact, std::size_t most) const;

  /// Both require an obstacle that exists.
  Approach approach(const Query& query, const ObstacleId& obstacle) const;
  Crossing crossing(const Query& query, const ObstacleId& obstacle) const;

  /// The sum over all inputs q of |dt/dq| ulp(q), divided by ulp(t): how many ulps of t one ulp in each input
  /// can cause. Requires an exact `hit`.
  double condition(const Query& query, const Answer& exact) const;

  /// The same sum in the time's own unit: the change of t when every input moves by one ulp. Requires an
  /// exact `hit`.
  double time_change(const Query& query, const Answer& exact) const;

 private:
  struct Impl;
  Pimpl<const Impl> impl_;
};

}  // namespace lorentz::oracle
