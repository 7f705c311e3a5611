#include "oracle/horizon/channel_scene.hpp"

#include <algorithm>
#include <cmath>

#include "oracle/exact/inside.hpp"
#include "oracle/exact/quadratic.hpp"
#include "oracle/exact/shape.hpp"
#include "oracle/exact/short_basis.hpp"
#include "oracle/integers/dyadic.hpp"

namespace lorentz::oracle {
namespace {

template <std::size_t D>
Obstacle<D> obstacle_of(const typename IntegerScene<D>::Atom& atom) {
  const ZMatrix<D> axes = axes_of<D>(atom);
  const std::optional<Z> radius = ball_radius<D>(shape_of<D>(axes));
  return {atom.position, radius ? multiple_of_identity<D>(*radius) : axes, radius.has_value()};
}

}  // namespace

double log2_of(const Z& a) {
  const auto [mantissa, exponent] = approximation(a);
  return std::log2(std::fabs(mantissa)) + static_cast<double>(exponent);
}

template <std::size_t D>
Vec rounded(const ZVec<D>& a, const Z& q, long exponent) {
  Vec result{};
  for (std::size_t i = 0; i < D; ++i) result[i] = round_to_binary64({a[i], 1, 0, q, exponent});
  return result;
}

template <std::size_t D>
Blocked Obstacle<D>::block(const ZVec<D>& normal) const {
  const ZVec<D> half = axes * normal;
  const Z centre = dot(position, normal), half2 = dot(half, half);
  return {centre, half2, centre, half2};
}

template <std::size_t D>
Z ObstacleLattice<D>::period(const ZVec<D>& normal) const {
  Z divisor = 0;
  for (const ZVec<D>& u : vectors) divisor = gcd(divisor, dot(u, normal));
  return divisor;
}

template <std::size_t D>
void ObstacleLattice<D>::set_cofactors() {
  cofactors = adjugate(vectors);
  volume = abs(dot(cofactors[0], vectors[0]));
}

template <std::size_t D>
void ObstacleLattice<D>::sort_obstacles() {
  const auto size = [](const Obstacle<D>& one) { return abs(dot(adjugate(one.axes)[0], one.axes[0])); };
  std::stable_sort(obstacles.begin(), obstacles.end(),
                   [&](const auto& a, const auto& b) { return size(a) > size(b); });
}

template <std::size_t D>
ChannelScene<D>::ChannelScene(const Scene& scene, double unit_length) {
  const IntegerScene<D> integers = integer_scene<D>(scene, unit_length);
  exponent = integers.exponent;
  unit = scaled(unit_length, exponent);
  for (const auto& lattice : integers.lattices) {
    ObstacleLattice<D>& exact = lattices.emplace_back();
    exact.given = lattice.vectors;
    Basis<D> basis = basis_of(lattice.vectors);
    reduce(basis, euclidean_form);
    for (std::size_t i = 0; i < D; ++i) exact.vectors[i] = basis[i].p, exact.names[i] = basis[i].n;
    exact.set_cofactors();
    for (const auto& atom : lattice.atoms) exact.obstacles.push_back(obstacle_of<D>(atom));
    exact.sort_obstacles();
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
                  const Z in_row = is_through_origin(first, step) ? std::min(Z(3), Z(last + 1)) : last + 1;
                  count = in_row > most - count ? most + 1 : count + in_row.get_ui();
                  return count > most;
                });
  return count;
}

}  // namespace

template <std::size_t D>
std::size_t points_in_ball(Basis<D> basis, const Z& bound2, std::size_t most) {
  reduce(basis, euclidean_form);
  return count_points<D>(basis, bound2, most);
}

template <std::size_t D>
bool visit_primitive(Basis<D> basis, const Z& bound2, std::size_t most, const NormalVisitor<D>& visit,
                     const std::function<void(std::size_t, std::size_t)>& step_done) {
  reduce(basis, euclidean_form);
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

#define LORENTZ_CHANNEL_SCENE(D)                                                          \
  template struct Obstacle<D>;                                                            \
  template struct ObstacleLattice<D>;                                                     \
  template struct ChannelScene<D>;                                                        \
  template Vec rounded(const ZVec<D>&, const Z&, long);                                   \
  template std::size_t points_in_ball(Basis<D>, const Z&, std::size_t);                   \
  template bool visit_primitive(Basis<D>, const Z&, std::size_t, const NormalVisitor<D>&, \
                                const std::function<void(std::size_t, std::size_t)>&);

LORENTZ_CHANNEL_SCENE(2)
LORENTZ_CHANNEL_SCENE(3)
#undef LORENTZ_CHANNEL_SCENE

}  // namespace lorentz::oracle
