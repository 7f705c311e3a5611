#include "question/cases/box.hpp"

#include <algorithm>
#include <cmath>

#include <lorentz/geometry.hpp>

namespace lorentz::cases {
namespace {

double reach_of(const Atom& atom) {
  double square = atom.radius * atom.radius;
  for (const Vec& axis : atom.semiaxes) square += dot(axis, axis);
  return std::sqrt(square);
}

Box around_fewest(const Scene& scene) {
  const auto fewest = std::max_element(scene.lattices.begin(), scene.lattices.end(),
                                       [](const Lattice& a, const Lattice& b) { return a.rank > b.rank; });
  const int d = scene.dimension, rank = fewest->rank_in(d);
  Box box{d, fewest->vectors, {1, 1, 1}, {}};
  complete_perpendicularly(box.vectors, rank, d);
  double beside = 0;
  for (const Lattice& lattice : scene.lattices) {
    for (const Vec& u : lattice.vectors) beside = std::max(beside, length(u));
    for (const Atom& atom : lattice.atoms) beside = std::max(beside, 2 * reach_of(atom));
  }
  for (int i = rank; i < d; ++i) {
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (const Lattice& lattice : scene.lattices)
      for (const Atom& atom : lattice.atoms) {
        if (lattice.rank >= d) continue;
        const double place = dot(atom.position, box.vectors[i]), reach = reach_of(atom);
        low = std::min(low, place - reach), high = std::max(high, place + reach);
      }
    box.corner = plus(box.corner, low - beside, box.vectors[i]);
    box.vectors[i] = scaled(box.vectors[i], high - low + 2 * beside);
  }
  return box;
}

}  // namespace

Box Box::of(const Scene& scene, std::uint64_t cells) {
  if (!is_crystal(scene)) return around_fewest(scene);
  Box box = cell_of(scene);
  if (scene.lattices.size() == 1) return box;
  const auto n = static_cast<double>(cells);
  const auto side = [](double length) { return std::max(1.0, std::round(length)); };
  if (scene.dimension == 2)
    box.cells = {side(std::sqrt(1.6 * n)), side(std::sqrt(n / 1.6)), 1};
  else
    box.cells.fill(side(std::cbrt(n)));
  return box;
}

}  // namespace lorentz::cases
