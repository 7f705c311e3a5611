// The families, each defined in a file of its own or with related ones.
#pragma once

#include "fuzz/families/family.hpp"

namespace lorentz::cases {

Family generic_2d();
Family generic_3d();
Family near_rational();
Family corridor_edge();
Family grazing();
Family large_radius();
Family tiny_radius();
Family long_flight();
Family boundary_starts();
Family axis_and_diagonal();
Family ties();
Family tricylinder();
Family published_faults();
Family crystal_lattices();
Family superpositions();
Family ellipsoids();
Family never();
Family ball_2d();
Family ball_3d();
Family ellipsoid_alone();
Family rows_and_layers();

// Families of campaigns only: golden sets are made of families(), which does not contain these.
Family leaving();
Family scale();
Family mixture();
Family rounding();
Family dense_layers();
Family slender();
Family early();
Family nearly_parallel();
Family ellipsoid_edges();
Family drift();
Family vast_ellipsoids();
Family nearby();
Family unequal_radii();
Family dense_rows();
Family far_starts();
Family skewed_cells();
Family specks();
Family skin();
Family sizes();

}  // namespace lorentz::cases
