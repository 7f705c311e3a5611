// Makes small scenes, changes scenes and shapes their obstacles.
#pragma once

#include <array>
#include <vector>

#include <lorentz/scene.hpp>
#include "cases/random.hpp"

namespace lorentz::cases {

/// One lattice with one ball at the origin.
Scene lattice_scene(int dimension, const std::array<Vec, 3>& vectors, double radius);

/// Gives every ball this radius; ellipsoids stay.
void set_radius(Scene& scene, double radius);

/// Multiplies the size of every obstacle by the factor.
void scale_obstacles(Scene& scene, double factor);

/// Multiplies the lattice vectors and the positions of atoms by the factor.
void scale_places(Scene& scene, double factor);

/// A y, for the matrix A whose columns are the semiaxes.
Vec image(const std::vector<Vec>& semiaxes, const Vec& y);

/// A drawn unit vector at a right angle to v, which is not 0.
Vec drawn_across(Random& random, const Vec& v, int dimension);

/// The unit vector a, another at a right angle to it (in space drawn), and one at right angles to both.
std::array<Vec, 3> drawn_frame(Random& random, const Vec& a, int dimension);

}  // namespace lorentz::cases
