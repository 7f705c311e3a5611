#include "question/question.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "src/problem/scene_geometry.hpp"

namespace lorentz::question {

double smallest_semiaxis(const Atom& atom, int dimension) {
  return atom.is_ball() ? atom.radius
                        : principal_semiaxes(atom, dimension)[static_cast<std::size_t>(dimension) - 1];
}

// Turned round, the line meets its exit first.
double exit_time(const Question& question) {
  const Query& query = question.query;
  const Query turned{query.x, {-query.v[0], -query.v[1], -query.v[2]}, {}};
  const std::string time = question.place->margins().crossing(turned, question.exact.obstacle).time_decimal;
  return -std::strtod(time.c_str(), nullptr);
}

std::optional<double> radii_off(const Question& question, const Answer& given) {
  const Answer& exact = question.exact;
  const StartInside rule = question.place->claim().inside;
  // By these rules, exits are not judged.
  const bool has_exit = given.exit_time && rule != StartInside::zero && rule != StartInside::exit;
  const auto is_told = [](std::optional<double> time) { return time && std::isfinite(*time); };
  if (!is_told(exact.time) || !is_told(given.time) || (has_exit && !is_told(given.exit_time)))
    return std::nullopt;
  const Scene& scene = question.place->scene();
  const Atom& atom = scene.lattices[exact.obstacle.lattice].atoms[exact.obstacle.atom];
  const Vec& v = question.query.v;
  double off = std::fabs(*given.time - *exact.time);
  if (has_exit) off = std::max(off, std::fabs(*given.exit_time - exit_time(question)));
  return off / smallest_semiaxis(atom, scene.dimension) * std::hypot(v[0], v[1], v[2]);
}

}  // namespace lorentz::question
