// First hit in 2D. Choose a basis (u, w) of the lattice such that rows along w are sparse across the strip
// |h| < rho, and yet each row that crosses the whole strip has an obstacle in it:
//
//   |h_w| < 2 rho <= |h_u|   by Euclid's algorithm on |h_u|, |h_w| (the continued fraction of the slope);
//   or w is the shortest vector, if it already has |h_w| < 2 rho.
//
// Then walk the rows a u + b w in the order in which they leave the strip. At most 2 rho / |h_u| + 1 of them
// overlap at any s (in the second case, a number bounded by the ratio of the radius to the distance between
// rows). The first row that lies entirely in s > 0 ends the walk, because it holds an obstacle: an open
// interval of length 2 rho / |h_w| > 1 holds an integer. Each row is solved exactly (RowsInPlane), so nothing
// depends on obstacles being disjoint.
#include "oracle/first_hit/first_hit.hpp"

namespace lorentz::oracle {
namespace {

std::pair<FlightPoint, FlightPoint> choose_steps(const Search<2>& search) {
  const Z width = 2 * search.rho;
  const auto resolved = [&](const Z& h) { return compare_sizes(h, width) <= 0; };
  FlightPoint w(search.velocity, search.view.basis[0]), u(search.velocity, search.view.basis[1]);
  if (resolved(w.h)) return {std::move(u), std::move(w)};
  std::swap(u, w);
  if (w.h < 0) w.negate();
  if (u.h < 0) u.negate();
  while (!resolved(w.h)) {
    u.add_multiple(-(u.h / w.h), w);
    std::swap(u, w);
  }
  return {std::move(u), std::move(w)};
}

}  // namespace

void search_first_hit(const Search<2>& search) {
  auto [u, w] = choose_steps(search);
  const Z rho_above = search.rho + 1;

  // A point of the strip at (h, s) has the row number a = (h s_w - s h_w) / det - a_0, where a_0 is the row
  // number of the offset. Orient the basis so that det > 0 and h_w <= 0; then a grows with s.
  if (w.h > 0) w.negate();
  Z det = minor_of(u.h, u.s, w.h, w.s);
  if (det < 0) {
    u.negate();
    det = -det;
  }
  const Z D_w = -w.h;
  const Z spread = search.rho * abs(w.s);
  FlightPoint row(search.velocity, search.view.offset);
  const Z home = row.h * w.s + row.s * D_w;

  const RowsInPlane rows(search, w);
  const Z first = ceil_div(D_w - spread - home, det);  // s >= 1
  row.add_multiple(first, u);
  if (D_w == 0) {
    // The direction is rational: rows run along v, and only those in the strip matter.
    const Z last = floor_div(spread - home, det);
    for (Z a = first; a <= last; ++a) {
      rows.offer_first(row);
      row.add_multiple(1, u);
    }
    return;
  }
  for (Z level = first * det;; level += det) {
    if (search.earliest.found()) {
      const Z reach = search.earliest.reach(rho_above, search.velocity.v2);
      if (level > spread + reach * D_w - home) return;
    }
    rows.offer_first(row);
    row.add_multiple(1, u);
  }
}

}  // namespace lorentz::oracle
