#include "question/question.hpp"

#include <cmath>

#include "src/problem/scene_geometry.hpp"

namespace lorentz::question {

double smallest_semiaxis(const Atom& atom, int dimension) {
  return atom.is_ball() ? atom.radius
                        : principal_semiaxes(atom, dimension)[static_cast<std::size_t>(dimension) - 1];
}

std::optional<double> radii_off(const Question& question, const Answer& given) {
  const Answer& exact = question.exact;
  if (!exact.time || !given.time || !std::isfinite(*exact.time) || !std::isfinite(*given.time))
    return std::nullopt;
  const Scene& scene = question.place->scene();
  const Atom& atom = scene.lattices[static_cast<std::size_t>(exact.obstacle.lattice)]
                         .atoms[static_cast<std::size_t>(exact.obstacle.atom)];
  const Vec& v = question.query.v;
  return std::fabs(*given.time - *exact.time) / smallest_semiaxis(atom, scene.dimension) *
         std::hypot(v[0], v[1], v[2]);
}

}  // namespace lorentz::question
