#include "flights/theory/incommensurate.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <lorentz/geometry.hpp>

namespace lorentz::flights {
namespace {

double from_integer(double x) {
  return std::fabs(x - std::round(x));
}

// Is a vector one of the reciprocal lattice, and not zero?
bool is_reciprocal(const Vec& k, const Lattice& lattice, int dimension) {
  double far = 0, largest = 0;
  for (int i = 0; i < dimension; ++i) {
    const double index = dot(k, lattice.vectors[i]);
    far = std::max(far, from_integer(index));
    largest = std::max(largest, std::fabs(index));
  }
  return largest > 0.5 && far <= kCoincidence * largest;
}

// The reciprocal vectors with indices up to `most`, zero included.
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

}  // namespace

bool commensurable(const Lattice& a, const Lattice& b, int dimension) {
  // The vectors of b in the basis of a, up to the factor that makes the largest coordinate 1: all rational?
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

}  // namespace lorentz::flights
