#include <lorentz/collision.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <lorentz/errors.hpp>
#include <lorentz/geometry.hpp>

namespace lorentz {
namespace {

double as_binary64(const Integer& n) {
  return n.fits_int64() ? static_cast<double>(n.int64()) : std::strtod(n.decimal().c_str(), nullptr);
}

Vec centre_of(const Scene& scene, const ObstacleId& id) {
  const Lattice& lattice = scene.lattices[id.lattice];
  Vec centre = lattice.atoms[id.atom].position;
  for (int i = 0; i < scene.dimension; ++i)
    for (int k = 0; k < scene.dimension; ++k) centre[k] += as_binary64(id.cell[i]) * lattice.vectors[i][k];
  return centre;
}

Vec divided(const Vec& a, double by) {
  return {a[0] / by, a[1] / by, a[2] / by};
}

// The gradient of |A^-1 a|^2 / 2 at a, which is A^-T A^-1 a; for a ball, a itself.
Vec gradient(const Atom& atom, int dimension, const Vec& a) {
  if (atom.is_ball()) return a;
  const std::array<Vec, 3> dual = dual_of(semiaxes_of(atom, dimension), dimension);
  Vec sum{};
  for (int i = 0; i < dimension; ++i) sum = plus(sum, dot(dual[i], a), dual[i]);
  return sum;
}

// The length of a vector of any size. The hypot of standard libraries differs in the last bit; this one is
// GCC's.
double length_of_any(const Vec& a) {
  const double largest = std::max({std::fabs(a[0]), std::fabs(a[1]), std::fabs(a[2])});
  return largest > 0 ? largest * length(divided(a, largest)) : largest;
}

}  // namespace

Detail collision_detail(const Scene& scene, const Query& query, const Answer& answer) {
  if (!answer.time) throw InputError("answer: needs a hit with a time");
  checked(answer.obstacle, checked(scene));
  const Vec centre = centre_of(scene, answer.obstacle);
  const Vec point = plus(query.x, *answer.time, query.v), arm = plus(point, -1, centre);
  const Vec direction = divided(query.v, length_of_any(query.v));
  const Vec across = plus(arm, -dot(arm, direction), direction);
  const Atom& atom = scene.lattices[answer.obstacle.lattice].atoms[answer.obstacle.atom];
  const Vec outward = gradient(atom, scene.dimension, arm);
  return {point, divided(outward, length_of_any(outward)), length_of_any(across)};
}

Vec reflected(const Vec& v, const Vec& normal) {
  return plus(v, -2 * dot(v, normal), normal);
}

}  // namespace lorentz
