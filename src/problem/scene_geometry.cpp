#include "src/problem/scene_geometry.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>

#include <lorentz/geometry.hpp>

namespace lorentz {

using std::numbers::pi;

// One-sided Jacobi (Hestenes 1958): rotates pairs of columns until all are perpendicular. Their lengths are
// then the singular values.
std::array<double, 3> principal_semiaxes(const Atom& atom, int dimension) {
  std::array<Vec, 3> a = semiaxes_of(atom, dimension);
  double size = 0;
  for (const Vec& column : a) size = std::max(size, largest_component(column));
  const int exponent = std::ilogb(size);
  for (Vec& column : a) column = times_power_of_two(column, -exponent);
  constexpr int kSweeps = 60;
  bool turned = true;
  for (int sweep = 0; sweep < kSweeps && turned; ++sweep) {
    turned = false;
    for (int i = 0; i < dimension; ++i)
      for (int k = i + 1; k < dimension; ++k) {
        const double aii = dot(a[i], a[i]), akk = dot(a[k], a[k]), aik = dot(a[i], a[k]);
        if (std::fabs(aik) <= 1e-17 * std::sqrt(aii * akk)) continue;
        turned = true;
        const double zeta = (akk - aii) / (2 * aik);
        const double t = std::copysign(1.0, zeta) / (std::fabs(zeta) + std::hypot(1.0, zeta));
        const double c = 1 / std::hypot(1.0, t), s = c * t;
        for (int m = 0; m < 3; ++m) {
          const double ai = a[i][m], ak = a[k][m];
          a[i][m] = c * ai - s * ak;
          a[k][m] = s * ai + c * ak;
        }
      }
  }
  std::array<double, 3> lengths{};
  for (int i = 0; i < dimension; ++i)
    lengths[i] = std::scalbn(std::hypot(a[i][0], a[i][1], a[i][2]), exponent);
  std::sort(lengths.rbegin(), lengths.rend());
  return lengths;
}

double shortest_vector(const Scene& scene) {
  double shortest = std::numeric_limits<double>::infinity();
  for (const Lattice& lattice : scene.lattices)
    for (int i = 0; i < lattice.rank_in(scene.dimension); ++i)
      shortest = std::min(shortest, length_of_any(lattice.vectors[i]));
  return shortest;
}

Lattice with_short_vectors(Lattice lattice, int dimension) {
  const auto vectors = std::span(lattice.vectors).first(lattice.rank_in(dimension));
  const auto is_shorter = [](const Vec& a, const Vec& b) { return dot(a, a) < dot(b, b); };
  for (bool done = false; !done;) {
    done = true;
    for (Vec& one : vectors)
      for (const Vec& other : vectors) {
        const double times = std::round(dot(one, other) / dot(other, other));
        Vec next = one;
        for (int i = 0; i < 3; ++i) next[i] = std::fma(-times, other[i], next[i]);
        if (&one == &other || !is_shorter(next, one)) continue;
        one = next;
        done = false;
      }
  }
  std::sort(vectors.begin(), vectors.end(), is_shorter);
  return lattice;
}

double cell_volume(const Lattice& lattice, int dimension) {
  const auto& u = lattice.vectors;
  return std::fabs(dimension == 2 ? cross(u[0], u[1])[2] : dot(cross(u[0], u[1]), u[2]));
}

double volume_of(const Atom& atom, int dimension) {
  const auto [a, b, c] = principal_semiaxes(atom, dimension);
  return dimension == 2 ? pi * a * b : 4 * pi / 3 * a * b * c;
}

namespace {

// Carlson's symmetric elliptic integrals, for x, y >= 0 (at most one of them zero), z > 0. Each step of his
// duplication (1995) brings the arguments closer to each other by a factor of 4, until a few terms of a series
// give the rest to 1e-16.
double carlson_rf(double x, double y, double z) {
  for (;;) {
    const double mean = (x + y + z) / 3;
    const double dx = 1 - x / mean, dy = 1 - y / mean, dz = 1 - z / mean;
    if (std::max({std::fabs(dx), std::fabs(dy), std::fabs(dz)}) < 1e-3) {
      const double e2 = dx * dy - dz * dz, e3 = dx * dy * dz;
      return (1 - e2 / 10 + e3 / 14 + e2 * e2 / 24 - 3 * e2 * e3 / 44) / std::sqrt(mean);
    }
    const double shift = std::sqrt(x * y) + std::sqrt(y * z) + std::sqrt(z * x);
    x = (x + shift) / 4, y = (y + shift) / 4, z = (z + shift) / 4;
  }
}

double carlson_rd(double x, double y, double z) {
  double sum = 0, factor = 1;
  for (;;) {
    const double mean = (x + y + 3 * z) / 5;
    const double dx = 1 - x / mean, dy = 1 - y / mean, dz = 1 - z / mean;
    if (std::max({std::fabs(dx), std::fabs(dy), std::fabs(dz)}) < 1e-3) {
      const double e2 = dx * dy - 6 * dz * dz, e3 = (3 * dx * dy - 8 * dz * dz) * dz,
                   e4 = 3 * (dx * dy - dz * dz) * dz * dz, e5 = dx * dy * dz * dz * dz;
      return 3 * sum + factor *
                           (1 - 3 * e2 / 14 + e3 / 6 + 9 * e2 * e2 / 88 - 3 * e4 / 22 - 9 * e2 * e3 / 52 +
                            3 * e5 / 26) /
                           (mean * std::sqrt(mean));
    }
    const double shift = std::sqrt(x * y) + std::sqrt(y * z) + std::sqrt(z * x);
    sum += factor / (std::sqrt(z) * (z + shift));
    factor /= 4;
    x = (x + shift) / 4, y = (y + shift) / 4, z = (z + shift) / 4;
  }
}

}  // namespace

// An ellipse has the perimeter 4 a E(e). An ellipsoid has the surface 4 pi RG(a^2 b^2, a^2 c^2, b^2 c^2)
// (DLMF 19.33.1). In 2 RG = z RF - (x - z)(y - z) RD / 3 + sqrt(x y / z) (19.21.10) every term is positive if
// z is between x and y.
double surface_of(const Atom& atom, int dimension) {
  const auto [a, b, c] = principal_semiaxes(atom, dimension);
  if (dimension == 2) return 4 * a * std::comp_ellint_2(std::sqrt((1 - b / a) * (1 + b / a)));
  const double p = b / a, q = c / a;  // 1 >= p >= q
  const double x = p * p, y = p * p * q * q, z = q * q;
  if (!(z > 1e-300)) return std::numeric_limits<double>::quiet_NaN();  // too slender for the integrals
  return 2 * pi * a * a *
         (z * carlson_rf(x, y, z) - (x - z) * (y - z) * carlson_rd(x, y, z) / 3 + std::sqrt(x * y / z));
}

Scene scaled(Scene scene, int exponent) {
  for (Lattice& lattice : scene.lattices)
    for (Vec& u : lattice.vectors) u = times_power_of_two(u, exponent);
  for_each_atom(scene, [&](Atom& atom) {
    atom.radius = std::scalbn(atom.radius, exponent);
    atom.position = times_power_of_two(atom.position, exponent);
    for (Vec& axis : atom.semiaxes) axis = times_power_of_two(axis, exponent);
  });
  return scene;
}

std::optional<AtomShares> shares_of(const Scene& given) {
  if (!is_crystal(given)) return std::nullopt;
  const int exponent = mean_exponent(given.lattices[0].vectors, given.dimension), d = given.dimension;
  AtomShares shares{std::scalbn(1.0, exponent), {}, {}};
  for (const Lattice& lattice : scaled(given, -exponent).lattices) {
    const double cell = cell_volume(lattice, d);
    for (const Atom& atom : lattice.atoms) {
      for (int i = 0; i < d; ++i)
        if (!std::isnormal(principal_semiaxes(atom, d)[i])) return std::nullopt;
      shares.fractions.push_back(volume_of(atom, d) / cell);
      shares.surfaces.push_back(surface_of(atom, d) / cell);
    }
  }
  return shares;
}

std::optional<Filling> filling_of(const Scene& scene) {
  const auto shares = shares_of(scene);
  if (!shares) return std::nullopt;
  Filling filling;
  for (const double fraction : shares->fractions) filling.fraction += fraction;
  for (const double surface : shares->surfaces) filling.surface += surface;
  filling.mean_free_path = (scene.dimension == 2 ? pi : 4) * (1 - filling.fraction) / filling.surface;
  filling.surface /= shares->unit;
  filling.mean_free_path *= shares->unit;
  const bool in_range = std::isnormal(filling.fraction) && std::isnormal(filling.surface) &&
                        std::isfinite(filling.mean_free_path);
  if (!in_range) return std::nullopt;
  return filling;
}

}  // namespace lorentz
