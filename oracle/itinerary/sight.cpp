#include "oracle/itinerary/sight.hpp"

namespace lorentz::oracle {
namespace {

// The levels m that are tried: from kUsual on, finer as long as the state allows. If the state does not allow
// kUsual, the levels get coarser, down to kCoarsest.
constexpr long kUsual = 32, kCoarsest = 4;

// Decisions need more digits than the states of one collision have in common.
constexpr long kDecisionBits = 256;

template <std::size_t D>
Bound sum(const std::array<Bound, D>& bounds) {
  Bound total;
  for (const Bound& bound : bounds) total += bound;
  return total;
}

// A rational ray near the state: x' = x / 2^bits, v' = v / 2^bits for integers x and v.
template <std::size_t D>
ExactQuery<D> rational_ray(const Seen<D>& seen, long bits) {
  ZVec<D> x, v;
  for (std::size_t i = 0; i < D; ++i) {
    x[i] = shifted_left(seen.centre[i], bits) + seen.state.y[i].rounded(bits);
    v[i] = seen.state.v[i].rounded(bits);
  }
  return ExactQuery<D>(x, -bits, v, -bits, seen.from);
}

template <std::size_t D>
Ball time_of(const ExactQuery<D>& query, const ExactEntry<D>& entry) {
  return scaled((Ball(entry.s) - sqrt(Ball(entry.d))) / Ball(entry.v2),
                query.length_exponent - query.velocity_exponent);
}

template <std::size_t D>
ObstacleId obstacle_of(const ExactEntry<D>& entry) {
  return {entry.lattice, entry.atom, to_cell(entry.n)};
}

// The same ray, starting from its position at the time theta / 2^bits.
template <std::size_t D>
ExactQuery<D> later_ray(const ExactQuery<D>& ray, const Z& theta, long bits, const ObstacleId& from) {
  ZVec<D> x;  // times are in units of 2^-bits, velocities of 2^velocity_exponent, lengths of both
  for (std::size_t i = 0; i < D; ++i) {
    x[i] = shifted_left(ray.x[i], bits);
    x[i].add_product(theta, ray.velocity.v[i]);
  }
  return ExactQuery<D>(x, ray.length_exponent - bits, ray.velocity.v, ray.velocity_exponent, from);
}

// The distance of a from the span of a lattice's vectors, which must be fewer than D.
template <std::size_t D>
Ball beside_span(const typename IntegerScene<D>::Lattice& lattice, const BallVec<D>& a) {
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
template <std::size_t D>
Bound reach_of(const typename IntegerScene<D>::Atom& atom) {
  if (!atom.semiaxes) return Ball(atom.radius).size();
  Bound reach;
  for (const ZVec<D>& axis : *atom.semiaxes) reach += Ball(ceil_sqrt(dot(axis, axis))).size();
  return reach;
}

// Integers a and one exponent, such that a 2^exponent are the middles.
template <std::size_t D>
std::pair<ZVec<D>, long> exact_middles(const BallVec<D>& balls) {
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

// The ray of the middle of a state; it is rational.
template <std::size_t D>
ExactQuery<D> exact_ray(const Seen<D>& seen) {
  auto [x, length_exponent] = exact_middles<D>(seen.state.y);
  const auto [v, velocity_exponent] = exact_middles<D>(seen.state.v);
  for (std::size_t i = 0; i < D; ++i) x[i] += shifted_left(seen.centre[i], -length_exponent);
  return ExactQuery<D>(x, length_exponent, v, velocity_exponent, seen.from);
}

template <std::size_t D>
IntegerScene<D> scene_resized(IntegerScene<D> scene, long level, int sign) {
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
template <std::size_t D>
Bound inscribed_radius(const ExactAtom<D>& atom) {
  Z squares = 1;
  if (atom.frame) {
    squares = 0;
    for (const ZVec<D>& row : atom.frame->to_ball) squares += dot(row, row);
  }
  return (Ball(atom.radius) / sqrt(Ball(squares))).least_size();
}

}  // namespace

template <std::size_t D>
Sight<D>::Sight(IntegerScene<D> scene) : integers_(std::move(scene)), exact_(integers_) {
  for (const auto& lattice : exact_.lattices) {
    auto& forms = forms_.emplace_back();
    for (const auto& atom : lattice.atoms) {
      forms.emplace_back(atom);
      const Bound radius = inscribed_radius(atom);
      if (least_radius_.is_zero() || radius < least_radius_) least_radius_ = radius;
    }
  }
}

template <std::size_t D>
ZVec<D> Sight<D>::centre_of(const ObstacleId& obstacle) const {
  return oracle::centre_of<D>(exact_, obstacle.lattice, obstacle.atom, to_zvec<D>(obstacle.cell), {},
                              exact_.exponent);
}

template <std::size_t D>
const ExactScene<D>& Sight<D>::resized(long level, int sign) {
  auto place = resized_.find({level, sign});
  if (place == resized_.end())
    place =
        resized_.emplace(std::pair(level, sign), ExactScene<D>(scene_resized(integers_, level, sign))).first;
  return place->second;
}

template <std::size_t D>
std::variant<ObstacleId, Unseen> Sight<D>::next(const Seen<D>& seen) {
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

template <std::size_t D>
std::variant<ObstacleId, Unseen> Sight<D>::next_exactly(const Seen<D>& seen) const {
  const auto sighting = first_entry(exact_, exact_ray(seen));
  if (sighting.around) return Unseen::around;
  if (!sighting.earliest.found()) return Unseen::never;
  return obstacle_of(sighting.earliest.entry());
}

template <std::size_t D>
std::variant<ObstacleId, Unseen, typename Sight<D>::Doubt> Sight<D>::next_at(const Seen<D>& seen,
                                                                             long level) {
  const Ball::WorkingPrecision precision(kDecisionBits + level);
  const Bound allowed = Bound::power_of_two(-level) * least_radius_;
  const Bound y_error = sum<D>(seen.y_error), v_error = sum<D>(seen.v_error);
  for (long bits = 2 * level + 16 - std::min(0L, least_radius_.exponent());;) {
    const ExactQuery<D> ray = rational_ray(seen, bits);
    if (ray.velocity.v2 == 0) return Doubt::look_closer;
    const auto first = first_entry(resized(level, +1), ray);
    if (first.around && !(allowed < y_error + Bound(D) * Bound::power_of_two(-bits)) &&
        smallest_around(resized(level, -1), ray))
      return Unseen::around;
    if (first.around) return Doubt::look_closer;
    // The doubt, if any, that the deviation of the particle from the ray within this time leaves about the
    // answer.
    const auto doubt_within = [&](const Bound& time) -> std::optional<Doubt> {
      const Bound of_state = y_error + time * v_error;
      const Bound of_rounding = Bound(D) * (Bound(1) + time) * Bound::power_of_two(-bits);
      if (allowed < of_state + of_state) return Doubt::grow_less;
      if (!(allowed < of_rounding + of_rounding)) return std::nullopt;
      bits += of_rounding.exponent() - allowed.exponent() + 4;
      return Doubt::look_closer;
    };
    if (!first.earliest.found()) {
      const Bound time = time_of_escape(seen);
      if (!time.is_finite()) return Doubt::look_closer;
      const auto doubt = doubt_within(time);
      if (!doubt) return Unseen::never;
      if (*doubt == Doubt::grow_less) return *doubt;
      continue;
    }
    const ObstacleId obstacle = obstacle_of(first.earliest.entry());

    const auto collision = collide(seen.anywhere(centre_of(obstacle)), form_of(obstacle));
    if (!collision || !collision->flight.is_positive()) return Doubt::look_closer;
    const Bound time = collision->flight.size();
    if (!time.is_finite()) return Doubt::look_closer;

    if (const auto doubt = doubt_within(time)) {
      if (*doubt == Doubt::grow_less) return *doubt;
      continue;
    }
    if (is_alone(level, ray, first.earliest.entry(), collision->flight)) return obstacle;
    return Doubt::look_closer;
  }
}

// Let p be the part of the position beside the span of a lattice, and u the same part of v. From
// (|p| + reach) / |u| on, |p + t u| is more than an obstacle's reach. Infinite if v may lie in the span, as
// it always does for a crystal.
template <std::size_t D>
Bound Sight<D>::time_of_escape(const Seen<D>& seen) const {
  Bound latest;
  for (const auto& lattice : integers_.lattices)
    for (const auto& atom : lattice.atoms) {
      if (lattice.rank == D) return Bound(HUGE_VAL);
      const State<D> state = seen.anywhere(atom.position);
      latest = std::max(latest, (beside_span<D>(lattice, state.y).size() + reach_of<D>(atom)) /
                                    beside_span<D>(lattice, state.v).least_size());
    }
  return latest;
}

// True if the ray enters no other grown obstacle before the true collision is over.
template <std::size_t D>
bool Sight<D>::is_alone(long level, const ExactQuery<D>& ray, const ExactEntry<D>& entry,
                        const Ball& flight) {
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

template class Sight<2>;
template class Sight<3>;

}  // namespace lorentz::oracle
