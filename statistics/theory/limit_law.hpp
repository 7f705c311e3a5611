// The limit law of free paths among small discs: Boca & Zaharescu, "The distribution of the free path lengths
// in the periodic two-dimensional Lorentz gas in the small-scatterer limit" (Commun. Math. Phys. 269, 2007).
// docs/free_paths.md has the formulas.
#pragma once

namespace lorentz::flights {

// For one disc of radius r in each cell, of area A, of any 2D lattice; unit speed; r -> 0. A path t is
// measured as s = 2 r t / A, whose mean between collisions is 1. The relative error is below 1e-12 for every
// s > 0; survivals are 1 for s <= 0. An evaluation takes a microsecond.

/// P(a path from a collision is longer than s), whose density is (6 / pi^2) g(s), constant up to s = 1. Also the density of s from a uniform start.
double limit_survival_from_surface(double s);

/// P(a path from a uniform start is longer than s).
double limit_survival_from_uniform(double s);

}  // namespace lorentz::flights
