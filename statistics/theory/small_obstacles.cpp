#include "statistics/theory/small_obstacles.hpp"

#include <cmath>
#include <numbers>
#include <numeric>

#include <lorentz/geometry.hpp>
#include "src/problem/scene_geometry.hpp"
#include "statistics/theory/incommensurate.hpp"

namespace lorentz::flights {
namespace {

// The number of directions per half turn for ellipses. The law in one direction has corners, so the error
// falls only like the third power; and slender ellipses need more directions.
constexpr int kDirections = 512;

double width_across(const Atom& atom, double angle) {
  const Vec normal{-std::sin(angle), std::cos(angle), 0};
  double half2 = 0;
  for (const Vec& axis : semiaxes_of(atom, 2)) half2 += dot(axis, normal) * dot(axis, normal);
  return 2 * std::sqrt(half2);
}

std::string reason_against(const Scene& scene) {
  if (scene.dimension != 2) return "no closed form is known in 3D";
  for (const Lattice& lattice : scene.lattices)
    if (lattice.atoms.size() != 1) return "several obstacles in a cell: the limit law is for one";
  for (std::size_t i = 0; i < scene.lattices.size(); ++i)
    for (std::size_t k = i + 1; k < scene.lattices.size(); ++k)
      if (commensurable(scene.lattices[i], scene.lattices[k], 2))
        return "the lattices " + std::to_string(i) + " and " + std::to_string(k) +
               " are commensurable: multiples of them share a sublattice";
  return {};
}

}  // namespace

const Atom* only_ball(const Scene& scene, int dimension) {
  const bool one =
      scene.dimension == dimension && scene.lattices.size() == 1 && scene.lattices[0].atoms.size() == 1;
  return one && scene.lattices[0].atoms[0].is_ball() ? &scene.lattices[0].atoms[0] : nullptr;
}

double SmallObstacles::mean_rate() const {
  double sum = 0;
  for (const Rates& rates : directions)
    for (const double rate : rates) sum += rate;
  return sum / static_cast<double>(directions.size());
}

std::optional<SmallObstacles> small_obstacles_of(const Scene& scene, std::string& why_not) {
  why_not = reason_against(scene);
  if (!why_not.empty()) return std::nullopt;
  SmallObstacles small;
  for (const Lattice& lattice : scene.lattices) small.discs &= lattice.atoms[0].is_ball();
  const int directions = small.discs ? 1 : kDirections;
  for (int i = 0; i < directions; ++i) {
    Rates rates;
    for (const Lattice& lattice : scene.lattices)
      rates.push_back(width_across(lattice.atoms[0], std::numbers::pi * i / directions) /
                      cell_volume(lattice, 2));
    small.directions.push_back(rates);
  }
  return small;
}

namespace {

// The most lattice points to examine; more take longer than a second. With this many points, the sum is as
// good as an integral if the points lie in many rows.
constexpr double kMostPoints = 1e7, kManyRows = 1000;

}  // namespace

// A corridor along the primitive vector g has the width area / |g| - 2 r. C = sum of |g| width^2 / (pi free
// area), where g and -g count once.
std::optional<double> corridor_tail_constant(const Lattice& lattice, bool* of_limit) {
  const double area = cell_volume(lattice, 2), r = lattice.atoms[0].radius, longest = area / (2 * r),
               free = area - volume_of(lattice.atoms[0], 2);
  const Lattice same = with_short_vectors(lattice, 2);
  const Vec &a = same.vectors[0], &b = same.vectors[1];
  const double a2 = dot(a, a), along = dot(a, b) / a2, row = area / std::sqrt(a2);
  if (std::numbers::pi / 2 * longest / (2 * r) > kMostPoints) {
    if (longest < kManyRows * row) return std::nullopt;
    if (of_limit) *of_limit = true;
    return area / (std::numbers::pi * std::numbers::pi * r);
  }
  double total = 0;
  for (std::int64_t n = 0; static_cast<double>(n) * row < longest; ++n) {
    const double height = static_cast<double>(n) * row, middle = -along * static_cast<double>(n),
                 half = std::sqrt((longest * longest - height * height) / a2);
    auto m = static_cast<std::int64_t>(std::ceil(middle - half));
    if (n == 0) m = 1;  // a and -a count once
    for (; static_cast<double>(m) <= middle + half; ++m) {
      if (std::gcd(m, n) != 1) continue;
      const double length = std::hypot(height, (static_cast<double>(m) - middle) * std::sqrt(a2)),
                   width = area / length - 2 * r;
      if (width > 0) total += length * width * width;
    }
  }
  return total / (std::numbers::pi * free);
}

}  // namespace lorentz::flights
