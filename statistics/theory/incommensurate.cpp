#include "statistics/theory/incommensurate.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <lorentz/geometry.hpp>
#include "src/problem/scene_geometry.hpp"

namespace lorentz::flights {
namespace {

double from_integer(double x) {
  return std::fabs(x - std::round(x));
}

// Whether a vector is a non-zero vector of the reciprocal lattice.
bool is_reciprocal(const Vec& k, const Lattice& lattice, int dimension) {
  double far = 0, largest = 0;
  for (int i = 0; i < dimension; ++i) {
    const double index = dot(k, lattice.vectors[i]);
    far = std::max(far, from_integer(index));
    largest = std::max(largest, std::fabs(index));
  }
  return largest > 0.5 && far <= kCoincidence * largest;
}

// The reciprocal vectors with indices up to `most`, including zero.
std::vector<Vec> reciprocal_vectors(const Lattice& lattice, int dimension, int most) {
  const std::array<Vec, 3> dual = dual_of(lattice.vectors, dimension);
  const int third = dimension == 3 ? most : 0;
  std::vector<Vec> found;
  for (int h = -most; h <= most; ++h)
    for (int k = -most; k <= most; ++k)
      for (int l = -third; l <= third; ++l)
        found.push_back(sum(sum(scaled(dual[0], h), scaled(dual[1], k)), scaled(dual[2], l)));
  return found;
}

bool two_add_up(const Lattice& a, const Lattice& b, int dimension) {
  const std::vector<Vec> all = reciprocal_vectors(a, dimension, dimension == 2 ? 100 : 20);
  return std::any_of(all.begin(), all.end(), [&](const Vec& k) { return is_reciprocal(k, b, dimension); });
}

bool three_add_up(const Lattice& a, const Lattice& b, const Lattice& c, int dimension) {
  const int most = dimension == 2 ? 12 : 3;
  const std::vector<Vec> first = reciprocal_vectors(a, dimension, most),
                         second = reciprocal_vectors(b, dimension, most);
  for (const Vec& k : first)
    for (const Vec& m : second)
      if (is_reciprocal(sum(k, m), c, dimension)) return true;
  return false;
}

// The unit normals of the rows (2D) or planes (3D) between which a lattice leaves a channel open. For a
// reciprocal vector k they are 1/|k| apart, and the obstacles are 2 |A^T k| / |k| wide along k.
std::vector<Vec> normals_of_ways(const Lattice& lattice, int dimension) {
  std::vector<Vec> found;
  for (const Vec& k : reciprocal_vectors(lattice, dimension, dimension == 2 ? 16 : 4)) {
    double widest = 0;
    for (const Atom& atom : lattice.atoms) {
      double half2 = 0;
      for (const Vec& axis : semiaxes_of(atom, dimension)) half2 += dot(axis, k) * dot(axis, k);
      widest = std::max(widest, 2 * std::sqrt(half2));
    }
    if (widest > 0 && widest < 1) found.push_back(scaled(k, 1 / length(k)));
  }
  return found;
}

}  // namespace

bool commensurable(const Lattice& a, const Lattice& b, int dimension) {
  // Are all coordinates of the vectors of b in the basis of a rational, after scaling the largest to 1?
  const std::array<Vec, 3> dual = dual_of(a.vectors, dimension);
  std::vector<double> ratios;
  double largest = 0;
  for (int i = 0; i < dimension; ++i)
    for (int k = 0; k < dimension; ++k) {
      ratios.push_back(dot(dual[k], b.vectors[i]));
      if (std::fabs(ratios.back()) > std::fabs(largest)) largest = ratios.back();
    }
  for (int denominator = 1; denominator <= kMostDenominator; ++denominator)
    if (std::all_of(ratios.begin(), ratios.end(), [&](double ratio) {
          return from_integer(denominator * (ratio / largest)) <= denominator * kCoincidence;
        }))
      return true;
  return false;
}

bool independent(const Scene& scene) {
  const auto& all = scene.lattices;
  for (std::size_t i = 0; i < all.size(); ++i)
    for (std::size_t k = i + 1; k < all.size(); ++k) {
      if (two_add_up(all[i], all[k], scene.dimension)) return false;
      for (std::size_t m = k + 1; m < all.size(); ++m)
        if (three_add_up(all[i], all[k], all[m], scene.dimension)) return false;
    }
  return true;
}

std::optional<double> nearly_common_way(const Scene& scene) {
  std::vector<std::vector<Vec>> others;
  for (std::size_t i = 1; i < scene.lattices.size(); ++i)
    others.push_back(normals_of_ways(scene.lattices[i], scene.dimension));
  std::optional<double> least;
  for (const Vec& normal : normals_of_ways(scene.lattices[0], scene.dimension)) {
    double largest = 0;  // of the angles to the nearest normal of each other lattice
    for (const std::vector<Vec>& normals : others) {
      double nearest = 1;
      for (const Vec& other : normals) nearest = std::min(nearest, length(cross(normal, other)));
      largest = std::max(largest, nearest);
    }
    if (largest > 0 && largest <= kCoincidence) least = std::min(least.value_or(largest), largest);
  }
  return least;
}

}  // namespace lorentz::flights
