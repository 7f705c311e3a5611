#include "fuzz/campaign/tie.hpp"

#include "fuzz/campaign/exact_sums.hpp"

namespace lorentz::fuzz {
namespace {

// Does x lie in the open obstacle? With d = x - p - U n and the semiaxes A, d in units of A is adj(A) d /
// det(A); x is inside if its length is below 1.
bool contains(const Scene& scene, const ObstacleId& obstacle, const Vec& x) {
  const Lattice& lattice = scene.lattices[obstacle.lattice];
  const Atom& atom = lattice.atoms[obstacle.atom];
  oracle::CommonExponent common;
  const auto see = [&](const Vec& a) {
    for (const double component : a) common.see(component);
  };
  see(x);
  see(atom.position);
  for (int k = 0; k < scene.dimension; ++k) see(lattice.vectors[k]);
  common.see(atom.radius);
  for (const Vec& axis : atom.semiaxes) see(axis);
  const long unit = common.get();
  IntegerVec d = to_integers(lattice.vectors, scene.dimension, unit) * to_integers(obstacle.cell);
  for (std::size_t i = 0; i < 3; ++i)
    d[i] = oracle::scaled(x[i], unit) - oracle::scaled(atom.position[i], unit) - d[i];
  Z radius = oracle::scaled(atom.radius, unit);
  if (!atom.is_ball()) {
    std::array<Vec, 3> axes{};
    std::copy(atom.semiaxes.begin(), atom.semiaxes.end(), axes.begin());
    const IntegerMatrix a = to_integers(axes, scene.dimension, unit);
    d = adjugate(a) * d;
    radius = determinant(a);
  }
  return oracle::dot(d, d) < radius * radius;
}

}  // namespace

bool is_tie(const Scene& scene, const oracle::Judge& judge, const Query& query, const Answer& exact,
            const Answer& other) {
  if (exact.outcome != other.outcome) return false;
  if (exact.outcome == Outcome::inside)
    return contains(scene, exact.obstacle, query.x) && contains(scene, other.obstacle, query.x) &&
           query.from != other.obstacle;
  if (exact.outcome != Outcome::hit || exact.time != other.time) return false;
  if (exact.obstacle == other.obstacle) return true;
  return judge.judge(query, exact, other, 0).departs == 0;
}

}  // namespace lorentz::fuzz
