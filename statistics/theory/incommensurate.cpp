#include "statistics/theory/incommensurate.hpp"

#include <algorithm>
#include <cmath>
#include <span>
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

// The reciprocal vectors with indices up to `most`, including zero, each as far from the begin as its opposite
// is from the end.
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

// One of each vector and its opposite, and zero.
std::span<const Vec> half_of(const std::vector<Vec>& vectors) {
  return std::span(vectors).first(vectors.size() / 2 + 1);
}

bool two_add_up(const Lattice& a, const Lattice& b, int dimension) {
  const std::vector<Vec> all = reciprocal_vectors(a, dimension, dimension == 2 ? 100 : 20);
  return std::ranges::any_of(half_of(all), [&](const Vec& k) { return is_reciprocal(k, b, dimension); });
}

// Whether k + m is a reciprocal vector of c. Then the fractional parts of k.u and m.u add up to an integer for
// its vector u: only the m whose parts fit are tried.
bool three_add_up(const std::vector<Vec>& first, const std::vector<Vec>& second, const Lattice& c,
                  int dimension) {
  const Vec& u = c.vectors[0];
  double largest = 0;  // of k, of m, of the lattice's vectors
  std::vector<std::pair<double, const Vec*>> parts;
  for (const Vec& m : second) {
    parts.emplace_back(dot(m, u) - std::floor(dot(m, u)), &m);
    largest = std::max(largest, length(m));
  }
  std::sort(parts.begin(), parts.end());
  for (const Vec& k : first) largest = std::max(largest, length(k));
  const double near = kCoincidence * 2 * largest * length(c.vectors[dimension - 1]);
  for (const Vec& k : half_of(first))
    for (const double whole : {0, 1, 2}) {
      const double part = whole - (dot(k, u) - std::floor(dot(k, u)));
      for (auto m = std::lower_bound(parts.begin(), parts.end(),
                                     std::pair<double, const Vec*>(part - near, nullptr));
           m != parts.end() && m->first <= part + near; ++m)
        if (is_reciprocal(sum(k, *m->second), c, dimension)) return true;
    }
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

// The lattices with short vectors, so that what small integers show does not depend on the basis.
std::vector<Lattice> short_lattices(const Scene& scene) {
  std::vector<Lattice> lattices;
  for (const Lattice& lattice : scene.lattices)
    lattices.push_back(with_short_vectors(lattice, scene.dimension));
  return lattices;
}

std::optional<double> least_angle_of_ways(const std::vector<Lattice>& all, int dimension) {
  std::vector<std::vector<Vec>> others;
  for (std::size_t i = 1; i < all.size(); ++i) others.push_back(normals_of_ways(all[i], dimension));
  std::optional<double> least;
  for (const Vec& normal : normals_of_ways(all[0], dimension)) {
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

// Are all coordinates of the vectors of b in the basis of a rational, after scaling the largest to 1?
bool fits_into(const Lattice& a, const Lattice& b, int dimension) {
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

}  // namespace

bool commensurable(const Lattice& a, const Lattice& b, int dimension) {
  const Lattice first = with_short_vectors(a, dimension), second = with_short_vectors(b, dimension);
  return fits_into(first, second, dimension) || fits_into(second, first, dimension);
}

bool independent(const Scene& scene) {
  const int dimension = scene.dimension;
  const std::vector<Lattice> all = short_lattices(scene);
  std::vector<std::vector<Vec>> few;
  for (const Lattice& lattice : all)
    few.push_back(reciprocal_vectors(lattice, dimension, dimension == 2 ? 12 : 3));
  for (std::size_t i = 0; i < all.size(); ++i)
    for (std::size_t k = 0; k < all.size(); ++k) {
      if (i == k) continue;
      if (two_add_up(all[i], all[k], dimension)) return false;
      for (std::size_t m = 0; m < i; ++m)
        if (m != k && three_add_up(few[i], few[m], all[k], dimension)) return false;
    }
  return true;
}

// In short vectors ways have small indices; but rounding these may make ways parallel that are not.
std::optional<double> nearly_common_way(const Scene& scene) {
  const auto of_short = least_angle_of_ways(short_lattices(scene), scene.dimension);
  return of_short ? of_short : least_angle_of_ways(scene.lattices, scene.dimension);
}

}  // namespace lorentz::flights
