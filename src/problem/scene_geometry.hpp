// Volumes, surfaces and the mean free path of a scene, in binary64. In 2D a volume is an area and a surface a
// perimeter.
#pragma once

#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include <lorentz/scene.hpp>

namespace lorentz {

/// The lengths of an obstacle's principal semiaxes, longest first: the singular values of its matrix. In 2D
/// the third is zero. One that is 10^307 times shorter than the longest loses digits, then all.
std::array<double, 3> principal_semiaxes(const Atom& atom, int dimension);

/// True if the scene is a single obstacle.
inline bool is_one_obstacle(const Scene& scene) {
  const Lattice& first = scene.lattices[0];
  return scene.lattices.size() == 1 && first.atoms.size() == 1 && first.rank_in(scene.dimension) == 0;
}

inline bool all_finite(const Vec& a) {
  return std::isfinite(a[0]) && std::isfinite(a[1]) && std::isfinite(a[2]);
}

/// The length of the shortest of all primitive vectors; infinite if no lattice repeats.
double shortest_vector(const Scene& scene);

/// The lattice with short vectors, the shortest first: none gets shorter if it loses a multiple of another.
/// What is rounded is the result of each step, to an ulp.
Lattice with_short_vectors(Lattice lattice, int dimension);

/// The scene with all its lengths times 2^exponent.
Scene scaled(Scene scene, int exponent);

double cell_volume(const Lattice& lattice, int dimension);
double volume_of(const Atom& atom, int dimension);
double surface_of(const Atom& atom, int dimension);

/// For each atom, lattice by lattice: the fraction of space that its obstacles fill, if there are no
/// overlaps, and their surface per volume, times `unit`. `unit` is a power of two of about the size of the
/// first lattice's cell.
struct AtomShares {
  double unit = 1;
  std::vector<double> fractions, surfaces;
};

/// Nothing if a lattice has fewer vectors than dimensions, or if an obstacle is so large, small or slender
/// that it is outside the range of binary64.
std::optional<AtomShares> shares_of(const Scene& scene);

/// For a scene without overlaps: the fraction of space that the obstacles fill, their surface per volume, and
/// the mean free path between hits. Santalo's formula gives the last from the first two:
/// pi (1 - fraction) / surface in 2D, 4 (1 - fraction) / surface in 3D.
struct Filling {
  double fraction = 0, surface = 0, mean_free_path = 0;
};

/// Nothing where shares_of gives nothing, or if a result is outside the range of binary64.
std::optional<Filling> filling_of(const Scene& scene);

}  // namespace lorentz
