#include "statistics/theory/small_obstacles.hpp"

#include <cmath>
#include <numbers>

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

}  // namespace lorentz::flights
