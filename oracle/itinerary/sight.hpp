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
#include <numeric>
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
  explicit Sight(IntegerScene<D> scene) : integers_(std::move(scene)), exact_(integers_) {
    for (const auto& lattice : exact_.lattices) {
      auto& forms = forms_.emplace_back();
      for (const auto& atom : lattice.atoms) {
        forms.emplace_back(atom);
        const Bound radius = inscribed_radius(atom);
        if (least_radius_.is_zero() || radius < least_radius_) least_radius_ = radius;
      }
    }
  }

  /// The obstacle that is certainly entered next.
  std::variant<ObstacleId, Unseen> next(const Seen<D>& seen) {
    if (seen.is_exact()) return next_exactly(seen);
    if (seen.place_is_exact() && smallest_around(exact_, exact_ray(seen))) return Unseen::around;
    const long finest =
        std::max(kUsual, Ball::WorkingPrecision::now());  // a state of this many bits allows no higher level
    long level = kUsual;
    for (bool coarser = false, finer = false; level <= finest;) {
      const auto result = next_at(seen, level);
      if (const auto* obstacle = std::get_if<ObstacleId>(&result)) return *obstacle;
      if (const auto* instead = std::get_if<Unseen>(&result)) return *instead;
      const bool closer = std::get<Doubt>(result) == Doubt::look_closer;
      if (closer ? coarser : finer || level == kCoarsest) return Unseen::blurred;
      (closer ? finer : coarser) = true;
      level = closer ? 2 * level : level / 2;
    }
    return Unseen::blurred;
  }

  const Form<D>& form_of(const ObstacleId& obstacle) const { return forms_[obstacle.lattice][obstacle.atom]; }
  ZVec<D> centre_of(const ObstacleId& obstacle) const {
    return oracle::centre_of<D>(exact_, obstacle.lattice, obstacle.atom, to_zvec<D>(obstacle.cell), {},
                                exact_.exponent);
  }
  /// The radius of the smallest ball in any obstacle, or less.
  const Bound& least_radius() const { return least_radius_; }

 private:
  // The levels m that are tried: from kUsual on, finer as long as the state allows. If the state does not
  // allow kUsual, the levels get coarser, down to kCoarsest.
  static constexpr long kUsual = 32, kCoarsest = 4;
  // Decisions need more digits than the states of one collision have in common.
  static constexpr long kDecisionBits = 256;
  enum class Doubt { grow_less, look_closer };

  std::variant<ObstacleId, Unseen> next_exactly(const Seen<D>& seen) const {
    const auto sighting = first_entry(exact_, exact_ray(seen));
    if (sighting.around) return Unseen::around;
    if (!sighting.earliest.found()) return Unseen::never;
    return obstacle_of(sighting.earliest.entry());
  }

  std::variant<ObstacleId, Unseen, Doubt> next_at(const Seen<D>& seen, long level) {
    const Ball::WorkingPrecision precision(kDecisionBits + level);
    const Bound allowed = Bound::power_of_two(-level) * least_radius_;
    const auto sum = [](const auto& errors) {
      return std::accumulate(errors.begin(), errors.end(), Bound());
    };
    const Bound y_error = sum(seen.y_error), v_error = sum(seen.v_error);
    for (long bits = 2 * level + 16 - std::min(0L, least_radius_.exponent());;) {
      const ExactQuery<D> ray = rational_ray(seen, bits);
      if (ray.velocity.v2 == 0) return Doubt::look_closer;
      const auto first = first_entry(resized(level, +1), ray);
      if (first.around && !(allowed < y_error + Bound(D) * Bound::power_of_two(-bits)) &&
          smallest_around(resized(level, -1), ray))
        return Unseen::around;
      if (first.around) return Doubt::look_closer;
      std::optional<ObstacleId> obstacle;
      std::optional<EnclosedCollision<D>> collision;
      if (first.earliest.found()) {
        obstacle = obstacle_of(first.earliest.entry());
        collision = collide(seen.anywhere(centre_of(*obstacle)), form_of(*obstacle));
        if (!collision || !collision->flight.is_positive()) return Doubt::look_closer;
      }
      const Bound time = collision ? collision->flight.size() : time_of_escape(seen);
      if (!time.is_finite()) return Doubt::look_closer;
      // How far the particle can be from the ray within this time.
      const Bound of_state = y_error + time * v_error;
      const Bound of_rounding = Bound(D) * (Bound(1) + time) * Bound::power_of_two(-bits);
      if (allowed < of_state + of_state) return Doubt::grow_less;
      if (allowed < of_rounding + of_rounding) {
        bits += of_rounding.exponent() - allowed.exponent() + 4;
        continue;
      }
      if (!collision) return Unseen::never;
      if (is_alone(level, ray, first.earliest.entry(), collision->flight)) return *obstacle;
      return Doubt::look_closer;
    }
  }

  // True if the ray enters no other grown obstacle before the true collision is over.
  bool is_alone(long level, const ExactQuery<D>& ray, const ExactEntry<D>& entry, const Ball& flight) {
    const Ball entered = time_of(ray, entry);
    // theta is a time shortly before that: the ray moves by less than a grown obstacle has grown
    const Bound speed = Ball(ceil_sqrt(ray.velocity.v2)).size() * Bound::power_of_two(ray.velocity_exponent);
    const long bits = std::max(0L, level + 8 + (speed / least_radius_).exponent());
    const Z theta = std::max(Z(0), entered.lower().rounded(bits) - 1);
    const ExactQuery<D> rest = later_ray(ray, theta, bits, obstacle_of(entry));
    const auto second = first_entry(resized(level, +1), rest);
    if (second.around) return false;
    return !second.earliest.found() ||
           surely_less(flight, scaled(Ball(theta), -bits) + time_of(rest, second.earliest.entry()));
  }

  // Let p be the part of the position beside the span of a lattice, and u the same part of v. From
  // (|p| + reach) / |u| on, |p + t u| is more than an obstacle's reach. Infinite if v may lie in the span, as
  // it always does for a crystal.
  Bound time_of_escape(const Seen<D>& seen) const {
    Bound latest;
    for (const auto& lattice : integers_.lattices) {
      if (lattice.rank == D) return Bound(HUGE_VAL);
      for (const auto& atom : lattice.atoms) {
        const State<D> state = seen.anywhere(atom.position);
        latest = std::max(latest, (beside_span(lattice, state.y).size() + reach_of(atom)) /
                                      beside_span(lattice, state.v).least_size());
      }
    }
    return latest;
  }

  // The distance of a from the span of a lattice's vectors, which must be fewer than D.
  static Ball beside_span(const typename IntegerScene<D>::Lattice& lattice, const BallVec<D>& a) {
    if (lattice.rank == 0) return sqrt(dot(a, a));
    if constexpr (D == 3)
      if (lattice.rank == 2) {
        const BallVec<3> normal = balls<3>(cross(lattice.vectors[0], lattice.vectors[1]));
        return dot(a, normal) / sqrt(dot(normal, normal));
      }
    const BallVec<D> b = balls<D>(lattice.vectors[0]);
    return sqrt(across_squared(a, b) / dot(b, b));
  }

  // Every point of an obstacle is within this distance of its centre.
  static Bound reach_of(const typename IntegerScene<D>::Atom& atom) {
    if (!atom.semiaxes) return Ball(atom.radius).size();
    Bound reach;
    for (const ZVec<D>& axis : *atom.semiaxes) reach += Ball(ceil_sqrt(dot(axis, axis))).size();
    return reach;
  }

  // A rational ray near the state: x' = x / 2^bits, v' = v / 2^bits for integers x and v.
  static ExactQuery<D> rational_ray(const Seen<D>& seen, long bits) {
    ZVec<D> x, v;
    for (std::size_t i = 0; i < D; ++i) {
      x[i] = shifted_left(seen.centre[i], bits) + seen.state.y[i].rounded(bits);
      v[i] = seen.state.v[i].rounded(bits);
    }
    return ExactQuery<D>(x, -bits, v, -bits, seen.from);
  }

  // The ray of the middle of a state; it is rational.
  static ExactQuery<D> exact_ray(const Seen<D>& seen) {
    auto [x, length_exponent] = exact_middles(seen.state.y);
    const auto [v, velocity_exponent] = exact_middles(seen.state.v);
    for (std::size_t i = 0; i < D; ++i) x[i] += shifted_left(seen.centre[i], -length_exponent);
    return ExactQuery<D>(x, length_exponent, v, velocity_exponent, seen.from);
  }

  // Integers a and one exponent, such that a 2^exponent are the middles.
  static std::pair<ZVec<D>, long> exact_middles(const BallVec<D>& balls) {
    std::array<Ball::Exact, D> parts;
    long exponent = 0;
    for (std::size_t i = 0; i < D; ++i) {
      parts[i] = balls[i].exact_middle();
      exponent = std::min(exponent, parts[i].exponent);
    }
    ZVec<D> result;
    for (std::size_t i = 0; i < D; ++i)
      result[i] = shifted_left(parts[i].integer, parts[i].exponent - exponent);
    return {result, exponent};
  }

  // The ray from its position at the time theta / 2^bits on.
  static ExactQuery<D> later_ray(const ExactQuery<D>& ray, const Z& theta, long bits,
                                 const ObstacleId& from) {
    ZVec<D> x;  // times are in units of 2^-bits, velocities of 2^velocity_exponent, lengths of both
    for (std::size_t i = 0; i < D; ++i) {
      x[i] = shifted_left(ray.x[i], bits);
      x[i].add_product(theta, ray.velocity.v[i]);
    }
    return ExactQuery<D>(x, ray.length_exponent - bits, ray.velocity.v, ray.velocity_exponent, from);
  }

  static Ball time_of(const ExactQuery<D>& query, const ExactEntry<D>& entry) {
    return scaled((Ball(entry.s) - sqrt(Ball(entry.d))) / Ball(entry.v2), query.time_exponent());
  }

  static ObstacleId obstacle_of(const ExactEntry<D>& entry) {
    return {entry.lattice, entry.atom, to_cell(entry.n)};
  }

  // The scene with all obstacles grown (sign = +1) or shrunk (-1) by a factor 1 +- 2^-level.
  const ExactScene<D>& resized(long level, int sign) {
    auto place = resized_.find({level, sign});
    if (place == resized_.end())
      place = resized_.emplace(std::pair(level, sign), ExactScene<D>(scene_resized(integers_, level, sign)))
                  .first;
    return place->second;
  }

  static IntegerScene<D> scene_resized(IntegerScene<D> scene, long level, int sign) {
    const auto finer = [&](Z& length) { length = shifted_left(length, level); };
    const auto grown = [&](Z& length) { length = shifted_left(length, level) + sign * length; };
    scene.exponent -= level;
    for (auto& lattice : scene.lattices) {
      for (auto& vector : lattice.vectors) std::for_each(vector.begin(), vector.end(), finer);
      for (auto& atom : lattice.atoms) {
        std::for_each(atom.position.begin(), atom.position.end(), finer);
        grown(atom.radius);
        if (atom.semiaxes)
          for (auto& axis : *atom.semiaxes) std::for_each(axis.begin(), axis.end(), grown);
      }
    }
    return scene;
  }

  // A ball of radius |det A| / |adj A| (Frobenius norm) fits into the ellipsoid, because
  // |A^-1 y| <= |adj A| |y| / |det A|.
  static Bound inscribed_radius(const ExactAtom<D>& atom) {
    Z squares = 1;
    if (atom.frame) {
      squares = 0;
      for (const ZVec<D>& row : atom.frame->to_ball) squares += dot(row, row);
    }
    return (Ball(atom.radius) / sqrt(Ball(squares))).least_size();
  }

  IntegerScene<D> integers_;
  ExactScene<D> exact_;
  std::vector<std::vector<Form<D>>> forms_;
  Bound least_radius_;
  std::map<std::pair<long, int>, ExactScene<D>> resized_;  // by level and sign
};

}  // namespace lorentz::oracle
