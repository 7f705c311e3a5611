#include "scene_check.hpp"

#include "exact_problem.hpp"
#include "inside.hpp"

namespace lorentz::oracle {
namespace {

// Determinant of d binary64 vectors, up to a positive factor.
bool are_dependent(const std::array<Vec, 3>& vectors, int dimension) {
  CommonExponent common;
  for (int i = 0; i < dimension; ++i)
    for (double component : vectors[i]) common.see(component);
  const auto z = [&](int i, int k) { return scaled(vectors[i][k], common.get()); };
  if (dimension == 2) return cross(ZVec<2>{z(0, 0), z(0, 1)}, ZVec<2>{z(1, 0), z(1, 1)}) == 0;
  const auto row = [&](int i) { return ZVec<3>{z(i, 0), z(i, 1), z(i, 2)}; };
  return dot(cross(row(0), row(1)), row(2)) == 0;
}

bool same_vectors(const Lattice& a, const Lattice& b) {
  return a.vectors == b.vectors;
}

// True if some translate of atom b, other than a itself, overlaps or touches atom a.
template <std::size_t D>
bool overlap(const ExactScene<D>& scene, int lattice_a, int a, int lattice_b, int b) {
  const auto& first = scene.lattices[lattice_a].atoms[a];
  const auto& second = scene.lattices[lattice_b].atoms[b];
  const bool itself = lattice_a == lattice_b && a == b;
  LatticePoint<D> offset;
  for (std::size_t i = 0; i < D; ++i) offset.p[i] = second.position[i] - first.position[i];
  const Z reach = first.radius + second.radius;
  // |c| <= reach, touching included: |c|^2 < reach^2 + 1 for integers.
  return visit_ball<D>(scene.lattices[lattice_a].reduced, offset, reach * reach + 1,
                       [&](const LatticePoint<D>& point, const LatticePoint<D>&, const Z& last) {
                         return !itself || last > 0 || point.n != ZVec<D>{};
                       });
}

template <std::size_t D>
std::optional<std::string> overlap_in_exact(const Scene& scene) {
  struct Ball {
    int lattice, atom;
  };
  std::vector<Ball> balls;
  for (int l = 0; l < static_cast<int>(scene.lattices.size()); ++l)
    for (int a = 0; a < static_cast<int>(scene.lattices[l].atoms.size()); ++a)
      if (scene.lattices[l].atoms[a].is_ball()) balls.push_back({l, a});
  if (balls.size() > 300) return std::nullopt;
  const ExactScene<D> exact(scene);
  const auto name = [](const Ball& ball) {
    return "lattice " + std::to_string(ball.lattice) + ", atom " + std::to_string(ball.atom);
  };
  for (std::size_t i = 0; i < balls.size(); ++i)
    for (std::size_t k = i; k < balls.size(); ++k) {
      if (!same_vectors(scene.lattices[balls[i].lattice], scene.lattices[balls[k].lattice])) continue;
      if (!overlap<D>(exact, balls[i].lattice, balls[i].atom, balls[k].lattice, balls[k].atom)) continue;
      if (i == k) return "the obstacles of " + name(balls[i]) + " overlap or touch their own translates";
      return "obstacles of " + name(balls[i]) + " and of " + name(balls[k]) + " overlap or touch";
    }
  return std::nullopt;
}

}  // namespace

std::optional<std::string> dependence_in(const Scene& scene) {
  for (std::size_t l = 0; l < scene.lattices.size(); ++l) {
    const Lattice& lattice = scene.lattices[l];
    const std::string where = "lattice " + std::to_string(l);
    if (are_dependent(lattice.vectors, scene.dimension))
      return where + ": the primitive vectors are linearly dependent; a lattice needs " +
             std::to_string(scene.dimension) + " independent ones";
    for (std::size_t a = 0; a < lattice.atoms.size(); ++a) {
      if (lattice.atoms[a].is_ball()) continue;
      std::array<Vec, 3> axes{};
      std::copy(lattice.atoms[a].semiaxes.begin(), lattice.atoms[a].semiaxes.end(), axes.begin());
      if (are_dependent(axes, scene.dimension))
        return where + ", atom " + std::to_string(a) + ": the semiaxes are linearly dependent";
    }
  }
  return std::nullopt;
}

std::optional<std::string> overlap_in(const Scene& scene) {
  return scene.dimension == 2 ? overlap_in_exact<2>(scene) : overlap_in_exact<3>(scene);
}

}  // namespace lorentz::oracle
