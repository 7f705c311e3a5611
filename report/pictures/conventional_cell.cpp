// The cube that shows the structure of a centred cubic lattice, which its primitive cell does not.
#include <cmath>
#include <vector>

#include <lorentz/geometry.hpp>
#include "report/pictures/drawing_parts.hpp"
#include "src/problem/scene_geometry.hpp"

namespace lorentz::pictures {
namespace {

constexpr double kRounding = 1e-9;

// Lattice vectors of the wanted length, one of each pair +-u, from short combinations of a short basis.
std::vector<Vec> vectors_of_length(const std::array<Vec, 3>& u, double wanted) {
  std::vector<Vec> found;
  for (int i = -2; i <= 2; ++i)
    for (int k = -2; k <= 2; ++k)
      for (int m = -2; m <= 2; ++m) {
        if (i < 0 || (i == 0 && (k < 0 || (k == 0 && m <= 0)))) continue;
        const Vec v = sum(sum(scaled(u[0], i), scaled(u[1], k)), scaled(u[2], m));
        if (std::fabs(length(v) - wanted) < kRounding * wanted) found.push_back(v);
      }
  return found;
}

bool are_square(const Vec& a, const Vec& b) {
  return std::fabs(dot(a, b)) < kRounding * dot(a, a);
}

// Sorts the vectors by their nearest axes, all pointing in the positive direction: the usual way to draw a
// cube.
std::array<Vec, 3> upright(std::array<Vec, 3> cube) {
  for (int i = 0; i < 3; ++i) {
    for (int k = i + 1; k < 3; ++k)
      if (std::fabs(cube[k][i]) > std::fabs(cube[i][i])) std::swap(cube[i], cube[k]);
    if (cube[i][i] < 0) cube[i] = scaled(cube[i], -1);
  }
  return cube;
}

}  // namespace

ShownCell shown_cell(const Lattice& lattice, const std::array<Vec, 3>& short_vectors) {
  const double volume = cell_volume(lattice, 3);
  for (const int cells : {2, 4}) {
    const std::vector<Vec> edges = vectors_of_length(short_vectors, std::cbrt(cells * volume));
    for (std::size_t i = 0; i < edges.size(); ++i)
      for (std::size_t k = i + 1; k < edges.size(); ++k)
        for (std::size_t m = k + 1; m < edges.size(); ++m)
          if (are_square(edges[i], edges[k]) && are_square(edges[k], edges[m]) &&
              are_square(edges[m], edges[i]))
            return {upright({edges[i], edges[k], edges[m]}), cells};
  }
  return {lattice.vectors, 1};
}

}  // namespace lorentz::pictures
