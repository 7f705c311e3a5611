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

// The gradient of |A^-1 a|^2 / 2 at a, which is A^-T A^-1 a; for a ball, a itself.
Vec gradient(const Atom& atom, int dimension, const Vec& a) {
  if (atom.is_ball()) return a;
  const std::array<Vec, 3> dual = dual_of(semiaxes_of(atom, dimension), dimension);
  Vec sum{};
  for (int i = 0; i < dimension; ++i)
    for (int k = 0; k < 3; ++k) sum[k] += dot(dual[i], a) * dual[i][k];
  return sum;
}

// The length of a vector of any size. The hypot of standard libraries differs in the last bit; this one is
// GCC's.
double length_of_any(const Vec& a) {
  const double largest = std::max({std::fabs(a[0]), std::fabs(a[1]), std::fabs(a[2])});
  return largest > 0 ? largest * length({a[0] / largest, a[1] / largest, a[2] / largest}) : largest;
}

}  // namespace

Detail collision_detail(const Scene& scene, const Query& query, const Answer& answer) {
  if (!answer.time) throw InputError("answer: needs a hit with a time");
  checked(answer.obstacle, checked(scene));
  const Vec centre = centre_of(scene, answer.obstacle);
  const double speed = length_of_any(query.v);
  Detail detail;
  double along = 0;
  Vec arm{};
  for (int k = 0; k < 3; ++k) {
    detail.point[k] = query.x[k] + *answer.time * query.v[k];
    arm[k] = detail.point[k] - centre[k];
    along += arm[k] * (query.v[k] / speed);
  }
  const Atom& atom = scene.lattices[answer.obstacle.lattice].atoms[answer.obstacle.atom];
  const Vec outward = gradient(atom, scene.dimension, arm);
  const double length = length_of_any(outward);
  Vec across{};
  for (int k = 0; k < 3; ++k) {
    detail.normal[k] = outward[k] / length;
    across[k] = arm[k] - along * (query.v[k] / speed);
  }
  detail.impact_parameter = length_of_any(across);
  return detail;
}

Vec reflected(const Vec& v, const Vec& normal) {
  const double twice = 2 * dot(v, normal);
  return {v[0] - twice * normal[0], v[1] - twice * normal[1], v[2] - twice * normal[2]};
}

}  // namespace lorentz
