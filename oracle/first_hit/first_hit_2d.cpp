// First hit in 2D. Choose a basis (u, w) of the lattice such that rows along w are sparse across the strip
// |h| < rho, and yet each row that crosses the whole strip has an obstacle in it:
//
//   |h_w| < 2 rho <= |h_u|   by Euclid's algorithm on |h_u|, |h_w| (which is the continued fraction of the
//   slope), or w the shortest vector, if already |h_w| < 2 rho for it.
//
// Then walk the rows a u + b w in the order in which they leave the strip. At most 2 rho / |h_u| + 1 of them
// (in the second case: a number bounded by the ratio of the radius to the distance of the rows) overlap at
// any s, and the first that lies in s > 0 as a whole ends the walk: an open interval of length 2 rho / |h_w|
// > 1 holds an integer. Each row is solved exactly (offer_first_on_row), so nothing depends on obstacles
// being disjoint.
#include "oracle/first_hit/first_hit.hpp"

namespace lorentz::oracle {
namespace {

struct Across {
  LatticePoint<2> vector;
  Z h;  // v x vector

  void negate() {
    vector.negate();
    h = -h;
  }
};

struct Rows {
  Across u, w;
};

Rows choose_rows(const Search<2>& search) {
  const auto across = [&](const LatticePoint<2>& b) { return Across{b, cross(search.velocity.v, b.p)}; };
  const Z width2 = 4 * search.rho2;
  const auto resolved = [&](const Z& h) { return h * h < width2; };
  Across w = across(search.view.basis[0]), u = across(search.view.basis[1]);
  if (resolved(w.h)) return {u, w};
  std::swap(u, w);
  if (w.h < 0) w.negate();
  if (u.h < 0) u.negate();
  while (!resolved(w.h)) {
    const Z quotient = u.h / w.h;
    u.vector.add_multiple(-quotient, w.vector);
    u.h -= quotient * w.h;
    std::swap(u, w);
  }
  return {u, w};
}

}  // namespace

void search_first_hit(const Search<2>& search) {
  auto [u, w] = choose_rows(search);
  const Z rho_above = search.rho + 1;
  const ZVec<2>& v = search.velocity.v;
  const LatticePoint<2>& offset = search.view.offset;

  // A point of the strip at (h, s) has the row number a = (h s_w - s h_w) / det - a_0, where a_0 is that of
  // the offset. Orient the basis so that det > 0 and h_w <= 0: then a grows with s.
  Z s_w = dot(v, w.vector.p);
  Z det = u.h * s_w - dot(v, u.vector.p) * w.h;
  if (w.h > 0) {
    w.negate();
    s_w = -s_w;
    det = -det;
  }
  if (det < 0) {
    u.negate();
    det = -det;
  }
  const Z D_w = -w.h;
  const Z spread = search.rho * abs(s_w);
  const Z home = cross(v, offset.p) * s_w + dot(v, offset.p) * D_w;

  const Z first = ceil_div(D_w - spread - home, det);  // s >= 1
  if (D_w == 0) {
    // The direction is rational: rows run along v, and only those in the strip count.
    const Z last = floor_div(spread - home, det);
    for (Z a = first; a <= last; ++a) {
      LatticePoint<2> row = offset;
      row.add_multiple(a, u.vector);
      offer_first_on_row(search, row, w.vector);
    }
    return;
  }
  LatticePoint<2> row = offset;
  row.add_multiple(first, u.vector);
  for (Z a = first;; ++a) {
    if (search.earliest.found()) {
      const Z reach = search.earliest.reach(rho_above, search.velocity.v2);
      if (a * det > spread + reach * D_w - home) return;
    }
    offer_first_on_row(search, row, w.vector);
    row.add_multiple(1, u.vector);
  }
}

}  // namespace lorentz::oracle
