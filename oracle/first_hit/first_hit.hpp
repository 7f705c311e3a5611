// The search for the first obstacle of one atom on one flight. Private to oracle/.
//
// The search offers entries at t >= 0 to `search.earliest`; obstacles that contain x have none. The atom's earliest entry is among them, unless an earlier one (of another atom) was
// there before. If the search offers nothing, and nothing was there before, the flight never enters an
// obstacle of this atom.
#pragma once

#include "oracle/exact/exact_line.hpp"

namespace lorentz::oracle {

/// 2D, any lattice: by the continued fraction of the direction in lattice coordinates.
void search_first_hit(const Search<2>& search);

/// 3D, any lattice: by exact lattice reduction in windows along the flight.
void search_first_hit(const Search<3>& search);

/// The only row of a lattice of one vector. (RowsInPlane and RowsInSpace solve a whole row.)
inline void search_only_row(const Search<2>& search) {
  const FlightPoint step(search.velocity, search.view.basis[0]);
  RowsInPlane(search, step).offer_first(FlightPoint(search.velocity, search.view.offset));
}
inline void search_only_row(const Search<3>& search) {
  RowsInSpace(search, search.view.basis[0]).offer_first(search.view.offset);
}

/// The same for a view, whose lattice may have fewer than D vectors. If the search finds a copy, the flight
/// enters no obstacle: it would have entered any obstacle of the lattice before the copy.
template <std::size_t D>
void search_first_hit(const View<D>& view, int lattice, int atom, const ZVec<D>* from,
                      Earliest<D>& earliest) {
  earliest.tighten();
  const Z rho2 = view.radius2 * view.velocity.v2;
  if (view.rank == D)
    return search_first_hit(
        Search<D>{view, view.velocity, lattice, atom, from, rho2, root_below(rho2), earliest});
  Earliest<D> found = earliest;
  const Search<D> search{view, view.velocity, lattice, atom, from, rho2, root_below(rho2), found};
  view.rank < 2 ? search_only_row(search) : search_first_hit(search);
  const bool is_new = found.found() && found.entry().lattice == lattice && found.entry().atom == atom;
  if (is_new && !is_copy(found.entry().n, view.rank)) earliest = std::move(found);
}

}  // namespace lorentz::oracle
