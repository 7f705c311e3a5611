#include "oracle/exact/exact_problem.hpp"

#include <algorithm>

#include <lorentz/errors.hpp>

namespace lorentz::oracle {
namespace {

// Decides exactly whether the first `count` vectors are linearly dependent.
bool are_dependent(const std::array<Vec, 3>& vectors, int dimension, int count) {
  CommonExponent common;
  for (int i = 0; i < count; ++i)
    for (double component : vectors[i]) common.see(component);
  const auto z = [&](int i, int k) { return scaled(vectors[i][k], common.get()); };
  if (count == 0) return false;
  if (count == 1) return vectors[0] == Vec{};
  if (dimension == 2) return cross(ZVec<2>{z(0, 0), z(0, 1)}, ZVec<2>{z(1, 0), z(1, 1)}) == 0;
  const auto row = [&](int i) { return ZVec<3>{z(i, 0), z(i, 1), z(i, 2)}; };
  if (count == 2) return cross(row(0), row(1)) == ZVec<3>{};
  return dot(cross(row(0), row(1)), row(2)) == 0;
}

}  // namespace

std::optional<std::string> dependence_in(const Scene& scene) {
  for (std::size_t l = 0; l < scene.lattices.size(); ++l) {
    const Lattice& lattice = scene.lattices[l];
    const std::string where = "lattice " + std::to_string(l);
    const int rank = lattice.rank_in(scene.dimension);
    if (are_dependent(lattice.vectors, scene.dimension, rank))
      return where + ": the primitive vectors are linearly dependent; leave out those that the others make";
    for (std::size_t a = 0; a < lattice.atoms.size(); ++a) {
      if (lattice.atoms[a].is_ball()) continue;
      std::array<Vec, 3> axes{};
      std::copy(lattice.atoms[a].semiaxes.begin(), lattice.atoms[a].semiaxes.end(), axes.begin());
      if (are_dependent(axes, scene.dimension, scene.dimension))
        return where + ", atom " + std::to_string(a) + ": the semiaxes are linearly dependent";
    }
  }
  return std::nullopt;
}

const Scene& checked_exactly(const Scene& scene) {
  lorentz::checked(scene);
  if (const auto dependence = dependence_in(scene)) throw InputError("scene: " + *dependence);
  return scene;
}

}  // namespace lorentz::oracle
