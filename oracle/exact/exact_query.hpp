// One query as integers. Private to oracle/.
#pragma once

#include <optional>

#include <lorentz/query.hpp>

#include "oracle/exact/exact_line.hpp"

namespace lorentz::oracle {

template <std::size_t D>
Cell to_cell(const ZVec<D>& n) {
  Cell cell;
  for (std::size_t i = 0; i < D; ++i) cell[i] = to_integer(n[i]);
  return cell;
}

template <std::size_t D>
ZVec<D> to_zvec(const Cell& cell) {
  ZVec<D> n;
  for (std::size_t i = 0; i < D; ++i) n[i] = to_z(cell[i]);
  return n;
}

/// Lengths times 2^-length_exponent, velocities times 2^-velocity_exponent.
template <std::size_t D>
struct ExactQuery {
  long length_exponent, velocity_exponent;
  ZVec<D> x;
  ExactVelocity<D> velocity;
  std::optional<ObstacleId> from;
  ZVec<D> from_cell;

  /// From numbers that are integers already; length_exponent is at most the scene's.
  ExactQuery(const ZVec<D>& place, long of_lengths, const ZVec<D>& v, long of_velocities,
             const std::optional<ObstacleId>& leaves)
      : length_exponent(of_lengths),
        velocity_exponent(of_velocities),
        x(place),
        velocity{v, dot(v, v)},
        from(leaves) {
    if (from) from_cell = to_zvec<D>(from->cell);
  }

  /// The unit of length is 2^-finer times the one that the numbers need.
  ExactQuery(const ExactScene<D>& scene, const Query& query, long finer = 0) : from(query.from) {
    CommonExponent of_x, of_v;
    for (std::size_t i = 0; i < D; ++i) {
      of_x.see(query.x[i]);
      of_v.see(query.v[i]);
    }
    length_exponent = (query.x == Vec{} ? scene.exponent : std::min(scene.exponent, of_x.get())) - finer;
    velocity_exponent = of_v.get();
    x = scaled_vector<D>(query.x, length_exponent);
    velocity.v = scaled_vector<D>(query.v, velocity_exponent);
    velocity.v2 = dot(velocity.v, velocity.v);
    if (from) from_cell = to_zvec<D>(from->cell);
  }

  /// The coordinates of `from` if it is one of this atom's obstacles, else null.
  const ZVec<D>* from_in(int lattice, int atom) const {
    return from && from->lattice == lattice && from->atom == atom ? &from_cell : nullptr;
  }

  View<D> view(const ExactScene<D>& scene, int lattice, int atom) const {
    return scene.view(lattice, atom, x, velocity, length_exponent);
  }

  /// Where the line meets this obstacle, before x or after it; it does not meet it if d <= 0.
  ExactEntry<D> meeting(const ExactScene<D>& scene, const ObstacleId& id) const {
    const View<D> own = view(scene, id.lattice, id.atom);
    const ZVec<D> n = to_zvec<D>(id.cell);
    ZVec<D> c = centre_of<D>(scene, id.lattice, id.atom, n, x, length_exponent);
    if (const auto& frame = scene.lattices[id.lattice].atoms[id.atom].frame) c = frame->to_ball * c;
    const Z s = dot(own.velocity.v, c), v2 = own.velocity.v2;
    return {s, (own.radius2 - dot(c, c)) * v2 + s * s, v2, n, id.lattice, id.atom};
  }

  /// Times are in units of 2 to this power.
  long time_exponent() const { return length_exponent - velocity_exponent; }

  /// t = (s - sqrt(d)) / v^2 in the query's own units.
  Quadratic time_of(const ExactEntry<D>& entry) const {
    return {entry.s, -1, entry.d, entry.v2, time_exponent()};
  }
  /// t = (s + sqrt(d)) / v^2: when the line leaves the obstacle.
  Quadratic exit_time_of(const ExactEntry<D>& entry) const {
    return {entry.s, +1, entry.d, entry.v2, time_exponent()};
  }
};

/// Calls visit(lattice, atom) for every atom of the scene, in order.
template <std::size_t D, class Visit>
void for_each_atom(const ExactScene<D>& scene, const Visit& visit) {
  for (int l = 0; l < static_cast<int>(scene.lattices.size()); ++l)
    for (int a = 0; a < static_cast<int>(scene.lattices[l].atoms.size()); ++a) visit(l, a);
}

}  // namespace lorentz::oracle
