#include "oracle/horizon/channel_scene.hpp"

#include <algorithm>
#include <cmath>

#include "oracle/exact/inside.hpp"
#include "oracle/exact/shape.hpp"
#include "oracle/exact/short_basis.hpp"
#include "oracle/integers/dyadic.hpp"

namespace lorentz::oracle {
namespace {

template <std::size_t D>
Z determinant_of(const std::array<ZVec<D>, D>& a) {
  if constexpr (D == 2)
    return cross(a[0], a[1]);
  else
    return dot(cross(a[0], a[1]), a[2]);
}

template <std::size_t D>
Obstacle<D> obstacle_of(const Atom& atom, long exponent) {
  Obstacle<D> obstacle;
  obstacle.position = scaled_vector<D>(atom.position, exponent);
  std::optional<Z> radius;
  if (atom.is_ball()) {
    radius = scaled(atom.radius, exponent);
  } else {
    for (std::size_t i = 0; i < D; ++i) obstacle.axes[i] = scaled_vector<D>(atom.semiaxes[i], exponent);
    radius = ball_radius<D>(shape_of<D>(obstacle.axes));
  }
  obstacle.ball = radius.has_value();
  for (std::size_t i = 0; i < D && radius; ++i)
    for (std::size_t k = 0; k < D; ++k) obstacle.axes[i][k] = i == k ? *radius : Z(0);
  return obstacle;
}

}  // namespace

double log2_of(const Z& a) {
  const auto [mantissa, exponent] = approximation(a);
  return std::log2(std::fabs(mantissa)) + static_cast<double>(exponent);
}

template <std::size_t D>
Z Obstacle<D>::half_width2(const ZVec<D>& normal) const {
  if (ball) return axes[0][0] * axes[0][0] * dot(normal, normal);
  Z sum = 0;
  for (const ZVec<D>& axis : axes) {
    const Z part = dot(axis, normal);
    sum += part * part;
  }
  return sum;
}

template <std::size_t D>
Z ObstacleLattice<D>::period(const ZVec<D>& normal) const {
  Z divisor = 0;
  for (const ZVec<D>& u : vectors) divisor = gcd(divisor, dot(u, normal));
  return divisor;
}

template <std::size_t D>
Blocked ObstacleLattice<D>::block(const Obstacle<D>& obstacle, const ZVec<D>& normal) const {
  const Z centre = dot(obstacle.position, normal), half2 = obstacle.half_width2(normal);
  return {centre, half2, centre, half2};
}

template <std::size_t D>
void set_cofactors(ObstacleLattice<D>& lattice) {
  const auto& u = lattice.vectors;
  std::array<ZVec<D>, D> columns;
  if constexpr (D == 2)
    columns = {ZVec<2>{u[1][1], Z(-u[1][0])}, ZVec<2>{Z(-u[0][1]), u[0][0]}};
  else
    columns = {cross(u[1], u[2]), cross(u[2], u[0]), cross(u[0], u[1])};
  for (std::size_t i = 0; i < D; ++i)
    for (std::size_t k = 0; k < D; ++k) {
      lattice.cofactors[i].p[k] = columns[i][k];
      lattice.cofactors[i].n[k] = i == k ? 1 : 0;
    }
  lattice.volume = abs(determinant_of<D>(u));
}

template <std::size_t D>
ChannelScene<D>::ChannelScene(const Scene& scene, double unit_length)
    : exponent(common_exponent(scene, unit_length).get()), unit(scaled(unit_length, exponent)) {
  for (const Lattice& lattice : scene.lattices) {
    ObstacleLattice<D> exact;
    Basis<D> basis;
    for (std::size_t i = 0; i < D; ++i) {
      exact.given[i] = basis[i].p = scaled_vector<D>(lattice.vectors[i], exponent);
      basis[i].n[i] = 1;
    }
    reduce(basis, EuclideanForm<D>{});
    for (std::size_t i = 0; i < D; ++i) exact.vectors[i] = basis[i].p, exact.names[i] = basis[i].n;
    set_cofactors<D>(exact);
    for (const Atom& atom : lattice.atoms) exact.obstacles.push_back(obstacle_of<D>(atom, exponent));
    std::stable_sort(exact.obstacles.begin(), exact.obstacles.end(), [](const auto& a, const auto& b) {
      return abs(determinant_of<D>(a.axes)) > abs(determinant_of<D>(b.axes));
    });
    lattices.push_back(std::move(exact));
  }
}

template <std::size_t D>
std::vector<Gap> gaps_of(const ObstacleLattice<D>& lattice, const ZVec<D>& normal, const Z& period,
                         std::size_t& work) {
  // If there are many obstacles, the first few nearly always cover the circle already.
  std::vector<Blocked> blocks;
  for (std::size_t count = 8;; count *= 4) {
    count = std::min(count, lattice.obstacles.size());
    while (blocks.size() < count) blocks.push_back(lattice.block(lattice.obstacles[blocks.size()], normal));
    work += count;
    std::vector<Gap> gaps = gaps_between(blocks, period);
    if (gaps.empty() || count == lattice.obstacles.size()) return gaps;
  }
}

namespace {

// True for the row through the origin, first = j step. It has two primitive points, +-step, however long it
// is.
template <std::size_t D>
bool is_through_origin(const LatticePoint<D>& first, const LatticePoint<D>& step) {
  for (std::size_t i = 0; i < D; ++i) {
    if (step.n[i] == 0) continue;
    LatticePoint<D> rest = first;
    rest.add_multiple(-floor_div(first.n[i], step.n[i]), step);
    return rest.n == ZVec<D>{};
  }
  return false;
}

// The basis must be reduced.
template <std::size_t D>
std::size_t count_points(const Basis<D>& basis, const Z& bound2, std::size_t most) {
  std::size_t count = 0;
  visit_ball<D>(basis, LatticePoint<D>{}, bound2,
                [&](const LatticePoint<D>& first, const LatticePoint<D>& step, const Z& last) {
                  if (last > most) {
                    if (is_through_origin(first, step)) return (count += 3) > most;
                    count = most + 1;
                    return true;
                  }
                  count +=
                      std::min<std::size_t>(last.get_ui() + 1, is_through_origin(first, step) ? 3 : most);
                  return count > most;
                });
  return count;
}

}  // namespace

template <std::size_t D>
std::size_t points_in_ball(Basis<D> basis, const Z& bound2, std::size_t most) {
  reduce(basis, EuclideanForm<D>{});
  return count_points<D>(basis, bound2, most);
}

template <std::size_t D>
bool visit_primitive(Basis<D> basis, const Z& bound2, std::size_t most, const NormalVisitor<D>& visit,
                     const std::function<void(std::size_t, std::size_t)>& step_done) {
  reduce(basis, EuclideanForm<D>{});
  const std::size_t total = count_points<D>(basis, bound2, most);
  if (total > most) return false;
  std::size_t seen = 0;
  visit_ball<D>(basis, LatticePoint<D>{}, bound2,
                [&](const LatticePoint<D>& first, const LatticePoint<D>& step, const Z& last) {
                  if (is_through_origin(first, step)) {
                    if (last > 0) visit(step);
                    return false;
                  }
                  LatticePoint<D> point = first;
                  for (Z left = last; left >= 0; --left) {
                    Z divisor = 0;
                    for (const Z& n : point.n) divisor = gcd(divisor, n);
                    if (divisor == 1 && point.n > ZVec<D>{}) visit(point);
                    point.add_multiple(1, step);
                    if (step_done) step_done(++seen, total);
                  }
                  return false;
                });
  return true;
}

#define LORENTZ_CHANNEL_SCENE(D)                                                                        \
  template struct Obstacle<D>;                                                                          \
  template struct ObstacleLattice<D>;                                                                   \
  template struct ChannelScene<D>;                                                                      \
  template std::vector<Gap> gaps_of(const ObstacleLattice<D>&, const ZVec<D>&, const Z&, std::size_t&); \
  template void set_cofactors(ObstacleLattice<D>&);                                                     \
  template std::size_t points_in_ball(Basis<D>, const Z&, std::size_t);                                 \
  template bool visit_primitive(Basis<D>, const Z&, std::size_t, const NormalVisitor<D>&,               \
                                const std::function<void(std::size_t, std::size_t)>&);

LORENTZ_CHANNEL_SCENE(2)
LORENTZ_CHANNEL_SCENE(3)
#undef LORENTZ_CHANNEL_SCENE

}  // namespace lorentz::oracle
