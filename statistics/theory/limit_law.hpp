// The law of free paths among small discs: Boca & Zaharescu, "The distribution of the free path lengths in
// the periodic two-dimensional Lorentz gas in the small-scatterer limit" (Commun. Math. Phys. 269, 2007).
// docs/free_paths.md has the formulas.
#pragma once

namespace lorentz::flights {

// One disc of radius r in each cell, of area A, of any 2D lattice; unit speed; r -> 0. A path t is measured
// as s = 2 r t / A, of which the mean from collision to collision is 1. Good to 1e-12 of the value for every
// s > 0; survivals are 1 for s <= 0. A microsecond each.

/// Density of s from collision to collision, (6 / pi^2) g(s): constant up to s = 1, 6 / pi^2.
double limit_density_from_surface(double s);

/// P(a path from a collision is longer than s). Also the density of s from a uniform start.
double limit_survival_from_surface(double s);

/// P(a path from a uniform start is longer than s).
double limit_survival_from_uniform(double s);

}  // namespace lorentz::flights
