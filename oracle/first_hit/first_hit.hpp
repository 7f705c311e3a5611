// The search for the first obstacle of one atom on one flight. Private to oracle/.
//
// x must lie in no obstacle of the atom but `from`. The search offers to `search.earliest` entries at t >= 0,
// the earliest of the atom among them unless an earlier one (of another atom) was there before. If it offers
// nothing and nothing was there, the flight enters no obstacle of this atom, ever.
#pragma once

#include "oracle/exact/exact_line.hpp"

namespace lorentz::oracle {

/// 2D, any lattice: by the continued fraction of the direction in lattice coordinates.
void search_first_hit(const Search<2>& search);

/// 3D, any lattice: by exact lattice reduction in windows along the flight.
void search_first_hit(const Search<3>& search);

}  // namespace lorentz::oracle
