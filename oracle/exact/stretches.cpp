#include "oracle/exact/stretches.hpp"

#include <vector>

#include "oracle/exact/short_basis.hpp"

namespace lorentz::oracle {
namespace {

constexpr long kFewRowsOfStretch = 24;
constexpr long kManyRows = 1000;  // more than expected in a stretch that is no longer than it is wide

// The rows k2 of the window's rectangle, |h| <= reach and low <= s <= high. Let v' be v turned by a right
// angle. Then v^2 w = s v + h v', so v^2 cross(b1, w) = h s_1 - s h_1 for every point w.
Range rows_of_strip(const View<2>& view, const Z& reach, const Basis<2>& basis, const Z& low, const Z& high) {
  const Z& v2 = view.velocity.v2;
  const Z h1 = cross(view.velocity.v, basis[0].p), s1 = dot(view.velocity.v, basis[0].p);
  const auto [least, most] = ordered(-low * h1, -high * h1);
  const Z spread = reach * abs(s1), home = v2 * cross(basis[0].p, view.offset.p);
  return multiples_between(least - spread - home, most + spread - home, v2 * cross(basis[0].p, basis[1].p));
}

// Visits the rows of each plane that comes near, as (the plane's section, its rows), until `take` returns
// true.
template <class Take>
bool for_each_section(const View<3>& view, const Planes& planes, const Basis<3>& basis, const Z& low,
                      const Z& high, const Take& take) {
  const Range levels = planes.levels(view.offset, low, high);
  const PlanePoint g1 = planes.in_plane(basis[0]), g2 = planes.in_plane(basis[1]);
  for (Z k3 = levels.first; k3 <= levels.last; ++k3) {
    PlaneSection section = planes.section(view.offset, k3, low, high);
    if (section.empty) continue;
    // A checker of certificates may bound the rows by the whole window, so stretches must be cut with that
    // bound.
    if (!planes.head_on) {
      section.z_low = low;
      section.z_high = high;
    }
    if (take(section, planes.rows(section, g1, g2))) return true;
  }
  return false;
}

struct Count {
  Z rows;
  std::optional<PlaneSection> widest;  // the section with the most rows
};

Count count_rows(const View<3>& view, const Planes& planes, const Basis<3>& basis, const Z& low,
                 const Z& high) {
  const Z levels = planes.levels(view.offset, low, high).count();
  if (levels > kFewRowsOfStretch) return {levels, {}};
  Count count{0, {}};
  Z most = 0;
  for_each_section(view, planes, basis, low, high, [&](const PlaneSection& section, const Range& rows) {
    count.rows += rows.count();
    if (rows.count() > most) {
      most = rows.count();
      count.widest = section;
    }
    return false;
  });
  return count;
}

}  // namespace

template <>
Z Stretches<2>::shorten(Basis<2>& basis, const Z& low, const Z& high) const {
  const ZVec<2>& v = view_.velocity.v;
  const long across = bit_length(high - low), along = bit_length(2 * reach_);
  reduce(basis, [&](const LatticePoint<2>& a, const LatticePoint<2>& b) {  // 4^across |h|^2 + 4^along s^2
    return Z(shifted_left(cross(v, a.p) * cross(v, b.p), 2 * across) +
             shifted_left(dot(v, a.p) * dot(v, b.p), 2 * along));
  });
  return rows_of_strip(view_, reach_, basis, low, high).count();
}

template <>
Z Stretches<3>::shorten_in_planes(Basis<3>& basis, const Z& low, const Z& high) const {
  const Planes planes(view_.velocity, reach2_, basis[0], basis[1], basis[2]);
  const Count count = count_rows(view_, planes, basis, low, high);
  if (count.rows <= kFewRowsOfStretch || !count.widest) return count.rows;
  // The section is slender: find a basis of the plane that is short for it.
  std::array<PlanePoint, 2> pair{planes.in_plane(basis[0]), planes.in_plane(basis[1])};
  reduce(pair, count.widest->form());
  basis[0] = std::move(pair[0].point);
  basis[1] = std::move(pair[1].point);
  return count_rows(view_, planes, basis, low, high).rows;
}

template <>
Z Stretches<3>::shorten(Basis<3>& basis, const Z& low, const Z& high) const {
  const long j = std::max(0L, bit_length(high - low) - bit_length(reach_) - 1);
  std::array<WindowVector, 3> vectors;
  for (int i = 0; i < 3; ++i) vectors[i] = {basis[i], dot(view_.velocity.v, basis[i].p)};
  reduce(vectors, window_form(view_.velocity, j));
  for (int i = 0; i < 3; ++i) basis[i] = std::move(vectors[i].point);
  // If v is normal to the planes of b1 and b2, it is not normal to those of b1 and b3, so these can be used
  // instead.
  const auto is_head_on = [this](const Basis<3>& b) {
    return cross(view_.velocity.v, cross(b[0].p, b[1].p)) == ZVec<3>{};
  };
  if (is_head_on(basis)) std::swap(basis[1], basis[2]);
  const Basis<3> reduced = basis;
  Z fewest = shorten_in_planes(basis, low, high);
  // If v is nearly normal to the planes, s hardly changes within them, so the ends of the stretch bound
  // nothing there. But v is not nearly normal to all of three families of planes.
  for (int i = 1; i >= 0 && fewest > kManyRows && !is_long(low, high); --i) {
    Basis<3> other = reduced;
    std::swap(other[i], other[2]);
    if (is_head_on(other)) continue;
    const Z rows = shorten_in_planes(other, low, high);
    if (rows >= fewest) continue;
    basis = std::move(other);
    fewest = rows;
  }
  return fewest;
}

// Along a vector w that completes the lattice, all centres are at offset.w, and the particle is at t v.w.
template <std::size_t D>
std::optional<Z> last_s(const View<D>& view) {
  std::optional<Z> last;
  for (std::size_t i = view.rank; i < D; ++i) {
    const ZVec<D>& w = view.basis[i].p;
    const Z speed = abs(dot(view.velocity.v, w));
    if (speed == 0) continue;
    const Z reach = abs(dot(view.offset.p, w)) + 4 * view.radius * ceil_sqrt(dot(w, w));
    const Z s = ceil_div(view.velocity.v2 * reach, speed);
    if (!last || s < *last) last = s;
  }
  return last;
}

template <std::size_t D>
bool Stretches<D>::cut(const Z& low, const Z& whole_high,
                       const std::function<bool(const RowStretch<D>&)>& take) const {
  const std::optional<Z> end = last_s(view_);
  const Z high = end ? std::min(whole_high, *end) : whole_high;
  if (low > high) return false;
  // The stretches still to do, the first one at the back. The bounds may have thousands of bits, so a
  // recursion that halves the stretches would be deep.
  std::vector<RowStretch<D>> left{{low, high, view_.basis}};
  while (!left.empty()) {
    RowStretch<D> stretch = std::move(left.back());
    left.pop_back();
    stretch.rows = shorten(stretch.basis, stretch.low, stretch.high);
    if (stretch.rows <= kFewRowsOfStretch || !is_long(stretch.low, stretch.high)) {
      if (take(stretch)) return true;
      continue;
    }
    const Z middle = floor_div(stretch.low + stretch.high, 2);
    left.push_back({middle, stretch.high, stretch.basis});
    left.push_back({std::move(stretch.low), middle, std::move(stretch.basis)});
  }
  return false;
}

template <std::size_t D>
bool Stretches<D>::visit_row(const LatticePoint<D>& start, const RowStretch<D>& stretch, ExactRow<D>& row,
                             const RowVisitor<D>& visit) const {
  row.begin_at(view_.velocity, start, stretch.basis[0]);
  Range k;
  if (row.A == 0) {
    if (row.C >= reach2_) return false;
  } else {
    const Z disc = row.B * row.B - row.A * (row.C - reach2_);
    if (disc <= 0) return false;
    // The ends (-B -+ sqrt(disc)) / A themselves are excluded.
    const Z root = ceil_sqrt(disc);
    k = {floor_div(-row.B - root, row.A) + 1, -floor_div(row.B - root, row.A) - 1};
    if (k.empty()) return false;
  }
  if (row.sg == 0) {
    if (row.s0 < stretch.low || row.s0 > stretch.high) return false;
  } else {
    const Range within = multiples_between(stretch.low - row.s0, stretch.high - row.s0, row.sg);
    k = row.A == 0 ? within : Range{std::max(k.first, within.first), std::min(k.last, within.last)};
  }
  if (k.empty()) return false;
  LatticePoint<D> first = start;
  first.add_multiple(k.first, stretch.basis[0]);
  return visit(first, stretch.basis[0], k.last - k.first);
}

template <>
bool Stretches<2>::visit(const RowStretch<2>& stretch, const RowVisitor<2>& visit, long most) const {
  const Range rows = rows_of_strip(view_, reach_, stretch.basis, stretch.low, stretch.high);
  LatticePoint<2> row = view_.offset;
  row.add_multiple(rows.first, stretch.basis[1]);
  ExactRow<2> its(view_.velocity, stretch.basis[0]);
  for (Z k2 = rows.first; k2 <= rows.last && most-- > 0; ++k2, row.add_multiple(1, stretch.basis[1]))
    if (visit_row(row, stretch, its, visit)) return true;
  return false;
}

template <>
bool Stretches<3>::visit(const RowStretch<3>& stretch, const RowVisitor<3>& visit, long most) const {
  const LatticePoint<3>& b2 = stretch.basis[1];
  const Planes planes(view_.velocity, reach2_, stretch.basis[0], b2, stretch.basis[2]);
  ExactRow<3> its(view_.velocity, stretch.basis[0]);
  return for_each_section(view_, planes, stretch.basis, stretch.low, stretch.high,
                          [&](const PlaneSection& section, const Range& rows) {
                            LatticePoint<3> row = section.origin;
                            row.add_multiple(rows.first, b2);
                            for (Z k2 = rows.first; k2 <= rows.last && most-- > 0;
                                 ++k2, row.add_multiple(1, b2))
                              if (visit_row(row, stretch, its, visit)) return true;
                            return most < 0;
                          }) &&
         most >= 0;
}

template std::optional<Z> last_s(const View<2>&);
template std::optional<Z> last_s(const View<3>&);
template class Stretches<2>;
template class Stretches<3>;

}  // namespace lorentz::oracle
