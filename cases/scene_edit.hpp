// Makes small scenes, changes scenes, and names their obstacles.
#pragma once

#include <array>
#include <cstdint>

#include <lorentz/obstacle.hpp>
#include <lorentz/scene.hpp>

namespace lorentz::cases {

/// One lattice with one ball at the origin.
Scene lattice_scene(int dimension, const std::array<Vec, 3>& vectors, double radius);

/// Gives every ball this radius; ellipsoids stay.
void set_radius(Scene& scene, double radius);

/// Multiplies the size of every obstacle by the factor.
void scale_obstacles(Scene& scene, double factor);

/// The obstacle of lattice 0 with this atom in the cell (a, b, c).
ObstacleId obstacle(std::int64_t a, std::int64_t b, std::int64_t c = 0, int atom = 0);

}  // namespace lorentz::cases
