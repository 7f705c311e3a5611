#include "cases/corridor.hpp"

#include <cmath>

#include <lorentz/geometry.hpp>

namespace lorentz::cases {

double volume(const Lattice& lattice, int dimension) {
  const auto& u = lattice.vectors;
  const double plane = u[0][0] * u[1][1] - u[0][1] * u[1][0];
  if (dimension == 2) return std::fabs(plane);
  return std::fabs(u[2][0] * (u[0][1] * u[1][2] - u[0][2] * u[1][1]) +
                   u[2][1] * (u[0][2] * u[1][0] - u[0][0] * u[1][2]) + u[2][2] * plane);
}

double half_width(const Lattice& lattice, int dimension, const IntVec& indices) {
  if (dimension == 2) return volume(lattice, 2) / (2 * length(cartesian(lattice, indices)));
  const auto dual = dual_of(lattice.vectors, 3);
  Vec normal{};
  for (int i = 0; i < 3; ++i) normal = sum(normal, scaled(dual[i], static_cast<double>(indices[i])));
  return 1 / (2 * length(normal));
}

}  // namespace lorentz::cases
