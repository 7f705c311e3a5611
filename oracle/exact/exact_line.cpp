#include "oracle/exact/exact_line.hpp"

namespace lorentz::oracle {
namespace {

// An integer k such that every earliest entry at t >= 0 has its index in k - 1 .. k + 2 (or there is none).
//
// In the plane of (k, t) the balls at real k fill a convex region E: {|x + t v - c(k)| < r}. At each k its
// lower end is the entry t(k), convex in k.
// - If E meets the axis t = 0 it does so in an open interval that holds no integer but `from`, so it is
// shorter
//   than 2, and E lies on one side of the axis to the left of it and on one side to the right: the earliest
//   entries are those next to the interval, within 2 of its middle.
// - Otherwise E lies on one side of the axis, and t(k) is least next to its real minimum.
// - A row along v is a strip of constant width: the entries increase along the flight, and the first is the
// one
//   next to t = 0.
template <std::size_t D>
std::optional<Z> index_near_first(const Search<D>& search, const Row<D>& row) {
  if (row.A == 0) {
    const Z d = search.rho2 - row.C;
    if (d <= 0) return std::nullopt;
    // s0 + k sg = sqrt(d), so k = (-s0 + sqrt(d)) / sg.
    return row.sg > 0 ? floor_surd(-row.s0, +1, d, row.sg) : floor_surd(row.s0, -1, d, -row.sg);
  }
  const Z strip = row.B * row.B - row.A * (row.C - search.rho2);
  if (strip <= 0) return std::nullopt;
  const Z inside = row.cg * row.cg - row.gg * (row.cc - search.view.radius2);
  if (inside > 0) return floor_div(-row.cg, row.gg);
  // dt/dk = 0: A k + B = -sign(sg) sqrt(sg^2 strip / M), M = v^2 gg.
  const Z M = search.velocity.v2 * row.gg;
  return floor_surd(-row.B * M, -sgn(row.sg), row.sg * row.sg * strip * M, row.A * M);
}

}  // namespace

template <std::size_t D>
void offer_first_on_row(const Search<D>& search, const LatticePoint<D>& start, const LatticePoint<D>& step) {
  const Row<D> row(search.velocity, start, step);
  const std::optional<Z> near = index_near_first(search, row);
  if (!near) return;
  for (int i = -1; i <= 2; ++i) {
    const Z k = *near + i;
    const Z s = row.s0 + k * row.sg;
    if (s <= 0) continue;
    const Z d = search.rho2 - (row.C + k * (2 * row.B + k * row.A));
    if (d <= 0) continue;
    if (row.cc + k * (2 * row.cg + k * row.gg) < search.view.radius2) continue;
    if (search.earliest.beats(s, d, search.velocity.v2)) continue;
    LatticePoint<D> centre = start;
    centre.add_multiple(k, step);
    if (search.from && centre.n == *search.from) continue;
    search.earliest.offer({s, d, search.velocity.v2, std::move(centre.n), search.lattice, search.atom});
  }
}

template void offer_first_on_row(const Search<2>&, const LatticePoint<2>&, const LatticePoint<2>&);
template void offer_first_on_row(const Search<3>&, const LatticePoint<3>&, const LatticePoint<3>&);

}  // namespace lorentz::oracle
