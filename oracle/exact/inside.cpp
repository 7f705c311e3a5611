#include "oracle/exact/inside.hpp"

#include <algorithm>
#include <cmath>

namespace lorentz::oracle {
namespace {

// Visits the k with |c + k g|^2 < radius2, an open interval, as its first and last integer.
template <std::size_t D>
bool visit_row_in_ball(const LatticePoint<D>& c, const LatticePoint<D>& g, const Z& radius2,
                       const RowVisitor<D>& visit) {
  const Z gg = dot(g.p, g.p), cg = dot(c.p, g.p);
  const Z disc = cg * cg - gg * (dot(c.p, c.p) - radius2);
  if (disc <= 0) return false;
  // The ends (-cg -+ sqrt(disc)) / gg themselves are excluded.
  const Z root = ceil_sqrt(disc), first = floor_div(-cg - root, gg) + 1, last = -floor_div(cg - root, gg) - 1;
  if (first > last) return false;
  LatticePoint<D> start = c;
  start.add_multiple(first, g);
  return visit(start, g, last - first);
}

// Cuts the ball by the planes (or lines) at `level` + k `gap` along `normal`, and visits each k whose section
// can hold a point. `room2` / `scale` is the squared radius of the ball, or of the section of it, that is
// cut.
template <class Visit>
bool visit_levels(const Z& level, const Z& gap, const Z& normal2, const Z& room2, const Z& scale,
                  Visit visit) {
  // |level + k gap| < sqrt(room2 normal2 / scale)
  const Z bound = floor_sqrt(floor_div(room2 * normal2, scale));
  const Z width = abs(gap), start = gap > 0 ? level : Z(-level);
  for (Z k = ceil_div(-bound - start, width), last = floor_div(bound - start, width); k <= last; ++k)
    if (visit(k)) return true;
  return false;
}

ZVec<2> perpendicular(const ZVec<2>& a) {
  return {Z(-a[1]), a[0]};
}

}  // namespace

template <>
bool visit_ball<2>(const Basis<2>& basis, const LatticePoint<2>& offset, const Z& radius2,
                   const RowVisitor<2>& visit) {
  const ZVec<2> normal = perpendicular(basis[0].p);
  const Z level = dot(normal, offset.p), gap = dot(normal, basis[1].p);
  return visit_levels(level, gap, dot(normal, normal), radius2, 1, [&](const Z& k) {
    LatticePoint<2> row = offset;
    row.add_multiple(k, basis[1]);
    return visit_row_in_ball<2>(row, basis[0], radius2, visit);
  });
}

template <>
bool visit_ball<3>(const Basis<3>& basis, const LatticePoint<3>& offset, const Z& radius2,
                   const RowVisitor<3>& visit) {
  const ZVec<3> normal = cross(basis[0].p, basis[1].p);
  const Z normal2 = dot(normal, normal);
  const Z level = dot(normal, offset.p), gap = dot(normal, basis[2].p);
  return visit_levels(level, gap, normal2, radius2, 1, [&](const Z& k3) {
    LatticePoint<3> plane = offset;
    plane.add_multiple(k3, basis[2]);
    const Z distance = level + k3 * gap;
    const Z room2 = radius2 * normal2 - distance * distance;  // over normal2
    if (room2 <= 0) return false;
    const ZVec<3> in_plane = cross(normal, basis[0].p);
    return visit_levels(dot(in_plane, plane.p), dot(in_plane, basis[1].p), dot(in_plane, in_plane), room2,
                        normal2, [&](const Z& k2) {
                          LatticePoint<3> row = plane;
                          row.add_multiple(k2, basis[1]);
                          return visit_row_in_ball<3>(row, basis[0], radius2, visit);
                        });
  });
}

namespace {

Estimate length(const auto& vector) {
  return std::sqrt(estimate(dot(vector.p, vector.p)));
}

// About how many rows visit_ball looks at in a basis b, outermost vector last, if it looks at all of them.
// Lines or planes of the lattice are at most |b_i| apart, and in a reduced basis not much less.
template <std::size_t D>
Estimate rows_in_all(const Basis<D>& basis, Estimate radius) {
  Estimate rows = 1;
  for (std::size_t i = 1; i < D; ++i) rows *= 2 * radius / length(basis[i]) + 1;
  return rows;
}

// About how many rows it looks at if it stops at the first point. A level certainly holds a point once the
// radius of its section exceeds mu, the covering radius of the lattice within the level. This is the case at
// a depth of mu^2 / (2 r) below the surface of the ball.
template <std::size_t D>
Estimate rows_to_first(const Basis<D>& basis, Estimate radius) {
  const Estimate volume = std::fabs(estimate(determinant<D>(basis)));
  if constexpr (D == 2) {
    const Estimate mu = length(basis[0]) / 2;
    return std::min(2 * radius, mu * mu / (2 * radius)) * length(basis[0]) / volume + 1;
  } else {
    const ZVec<3> normal = cross(basis[0].p, basis[1].p);
    const Estimate area = std::sqrt(estimate(dot(normal, normal)));
    const Estimate mu = (length(basis[0]) + length(basis[1])) / 2;
    const Estimate levels = std::min(2 * radius, mu * mu / (2 * radius)) * area / volume + 1;
    return levels * (2 * std::min(radius, mu) * length(basis[0]) / area + 1);
  }
}

// Along a row n moves by step.n, so the smallest n is at one of its ends.
template <std::size_t D>
std::optional<ZVec<D>> smallest_on_row(LatticePoint<D> first, const LatticePoint<D>& step, const Z& last,
                                       const ZVec<D>* from) {
  const bool ascending = step.n > ZVec<D>{};
  if (!ascending) first.add_multiple(last, step);
  if (from && first.n == *from) {
    if (last == 0) return std::nullopt;
    first.add_multiple(ascending ? 1 : -1, step);
  }
  return first.n;
}

}  // namespace

template <std::size_t D>
std::optional<ZVec<D>> smallest_inside(const ExactScene<D>& scene, int lattice, int atom, const View<D>& view,
                                       const ZVec<D>* from, long exponent) {
  if (!view.near) return std::nullopt;
  // Few rows: look at all of them, in the short basis. A radius of many cells: take the rows in lexicographic
  // order, so that the first point is the smallest. (Floating point only chooses the cheaper way here.)
  constexpr Estimate kFewRows = 64;
  const Estimate radius = estimate(view.radius), rows = rows_in_all<D>(view.basis, radius);
  const Basis<D> ordered =
      rows > kFewRows ? scene.lexicographic_basis(lattice, atom, view, exponent) : view.basis;
  const bool many = rows > kFewRows && rows_to_first<D>(ordered, radius) < rows;
  std::optional<ZVec<D>> smallest;
  const RowVisitor<D> visit = [&](const LatticePoint<D>& first, const LatticePoint<D>& step, const Z& last) {
    const auto candidate = smallest_on_row<D>(first, step, last, from);
    if (candidate && (!smallest || *candidate < *smallest)) smallest = candidate;
    return many && smallest;
  };
  visit_ball<D>(many ? ordered : view.basis, view.offset, view.radius2, visit);
  return smallest;
}

template std::optional<ZVec<2>> smallest_inside(const ExactScene<2>&, int, int, const View<2>&,
                                                const ZVec<2>*, long);
template std::optional<ZVec<3>> smallest_inside(const ExactScene<3>&, int, int, const View<3>&,
                                                const ZVec<3>*, long);

}  // namespace lorentz::oracle
