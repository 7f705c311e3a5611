// Finds the obstacle that a particle meets next, when its state is known to a limited number of bits. Private
// to oracle/itinerary.
//
// The exact search of oracle/first_hit knows no intervals, and needs none. Let the obstacles grow by a factor
// 1 + 2^-m, that is, by at least eta in every direction. Let a rational ray (x', v') be so near to the true
// one that
//   |x' - x| + t |v' - v| <= eta   for 0 <= t <= T.
// If the true ray enters an obstacle at a time t <= T, the grown obstacle contains x' + t v', so the rational
// ray enters it at t or before. So ask the exact search for the first grown obstacle o on the rational ray,
// at t1, and for the next one on the same ray from t1 on, at t2. If the true ray certainly enters o at
// t <= T < t2, then it enters nothing else before. The answer is certain, although every number in it was
// rounded. If x' is in a grown obstacle, or t2 comes too soon, m must be larger; the error of the state
// limits m.
#pragma once

#include <algorithm>
#include <map>
#include <variant>

#include "oracle/first_hit/first_entry.hpp"
#include "oracle/itinerary/collision.hpp"

namespace lorentz::oracle {

/// A state as decisions see it: the centre of the obstacle that the particle leaves, and bounds of the
/// distance of each component of the true y and v from the middle of these balls.
template <std::size_t D>
struct Seen {
  const ZVec<D>& centre;
  const State<D>& state;
  std::array<Bound, D> y_error, v_error;
  const std::optional<ObstacleId>& from;

  bool is_exact() const { return place_is_exact() && all_exact(state.v, v_error); }
  bool place_is_exact() const { return all_exact(state.y, y_error); }

  /// All states that are possible, relative to another centre.
  State<D> anywhere(const ZVec<D>& new_centre) const {
    State<D> result = state.seen_from(centre, new_centre);
    for (std::size_t i = 0; i < D; ++i) {
      result.y[i] = result.y[i].widened(y_error[i]);
      result.v[i] = result.v[i].widened(v_error[i]);
    }
    return result;
  }

 private:
  static bool all_exact(const BallVec<D>& balls, const std::array<Bound, D>& errors) {
    return std::ranges::all_of(balls, &Ball::is_exact) && std::ranges::all_of(errors, &Bound::is_zero);
  }
};

enum class Unseen {
  around,  ///< the start is inside an obstacle
  never,   ///< nothing is ever entered; possible for exact states, and if no lattice is a crystal
  blurred  ///< the state is not known well enough
};

template <std::size_t D>
class Sight {
 public:
  explicit Sight(IntegerScene<D> scene);

  /// The obstacle that is certainly entered next.
  std::variant<ObstacleId, Unseen> next(const Seen<D>& seen);

  const ExactScene<D>& scene() const { return exact_; }
  const Form<D>& form_of(const ObstacleId& obstacle) const { return forms_[obstacle.lattice][obstacle.atom]; }
  ZVec<D> centre_of(const ObstacleId& obstacle) const;
  /// The radius of the smallest ball in any obstacle, or less.
  const Bound& least_radius() const { return least_radius_; }

 private:
  enum class Doubt { grow_less, look_closer };
  std::variant<ObstacleId, Unseen> next_exactly(const Seen<D>& seen) const;
  std::variant<ObstacleId, Unseen, Doubt> next_at(const Seen<D>& seen, long level);
  Bound time_of_escape(const Seen<D>& seen) const;
  bool is_alone(long level, const ExactQuery<D>& ray, const ExactEntry<D>& entry, const Ball& flight);
  /// The scene with all obstacles grown (sign = +1) or shrunk (-1) by a factor 1 +- 2^-level.
  const ExactScene<D>& resized(long level, int sign);

  IntegerScene<D> integers_;
  ExactScene<D> exact_;
  std::vector<std::vector<Form<D>>> forms_;
  Bound least_radius_;
  std::map<std::pair<long, int>, ExactScene<D>> resized_;  // by level and sign
};

}  // namespace lorentz::oracle
