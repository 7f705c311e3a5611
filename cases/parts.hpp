// What the families have in common: scenes in a line, ulps, starts. Private to fuzz/.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <lorentz/oracle.hpp>
#include "cases/case.hpp"
#include "cases/hard_moves.hpp"
#include "cases/integer_vectors.hpp"

namespace lorentz::cases {

/// x moved by so many ulps, through 0 and the subnormals too; an infinity is not passed.
double moved(double x, std::int64_t ulps);

/// Midway between two binary64 in their order, through 0 and the subnormals too.
double middle(double a, double b);

/// Each of the first `dimension` components moved by -most to most ulps; a zero stays what it is.
void jitter(Random& random, Vec& a, int dimension, std::int64_t most);

/// A number of ulps up to 2^10 either way, small ones as often as large.
std::int64_t drawn_ulps(Random& random);

Vec sum(const Vec& a, const Vec& b);
Vec scaled(const Vec& a, double factor);
Vec cross(const Vec& a, const Vec& b);
double length(const Vec& a);

/// The same numbers (0 and -0 are), in the same order.
bool same(const Scene& a, const Scene& b);

/// One lattice with one ball at the origin.
Scene lattice_scene(int dimension, const std::array<Vec, 3>& vectors, double radius);

/// Every ball with this radius; ellipsoids stay.
void set_radius(Scene& scene, double radius);

/// Every obstacle multiplied by the factor.
void scale_obstacles(Scene& scene, double factor);

/// The cell's area or volume, and |u_1 x u_2| for integer coordinates of two vectors in 3D, or their length.
double volume(const Lattice& lattice, int dimension);

/// Half the width of the corridor along the primitive lattice vector (2D), or of the channel between the
/// lattice planes (3D) with these indices, were the obstacles points.
double half_width(const Lattice& lattice, int dimension, const IntVec& indices);

/// The oracle for a scene; the last one is kept for each thread.
const oracle::Oracle& oracle_of(const Scene& scene);

/// Uniform in the cell of the first lattice.
Vec point_in_cell(Random& random, const Scene& scene);

/// The same, in no obstacle; after some tries in vain as drawn.
Vec free_point(Random& random, const Scene& scene);

/// A vector with its components permuted and reflected: a symmetry of the square or cubic lattice.
class Symmetry {
 public:
  Symmetry(Random& random, int dimension);
  Vec operator()(const Vec& a) const;
  ObstacleId operator()(const ObstacleId& id) const;

 private:
  std::array<int, 3> from_{0, 1, 2};
  std::array<int, 3> sign_{1, 1, 1};
};

/// The obstacle of lattice 0 and this atom in a small cell.
ObstacleId obstacle(std::int64_t a, std::int64_t b, std::int64_t c = 0, int atom = 0);

}  // namespace lorentz::cases
