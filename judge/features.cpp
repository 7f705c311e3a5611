#include "judge/features.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

#include <lorentz/geometry.hpp>
#include "judge/diagnosis.hpp"
#include "question/radii.hpp"

namespace lorentz::judge {

using question::smallest_semiaxis;

namespace {

double shortest_vector(const Scene& scene) {
  double shortest = length(scene.lattices[0].vectors[0]);
  for (const Lattice& lattice : scene.lattices)
    for (int i = 0; i < scene.dimension; ++i) shortest = std::min(shortest, length(lattice.vectors[i]));
  return shortest;
}

double smallest_radius(const Scene& scene) {
  double smallest = std::numeric_limits<double>::infinity();
  for_each_atom(scene, [&](const Atom& atom) {
    smallest = std::min(smallest, smallest_semiaxis(atom, scene.dimension));
  });
  return smallest;
}

double as_double(const Integer& number) {
  const std::string digits = number.decimal();
  double value = std::numeric_limits<double>::infinity();
  std::from_chars(digits.data(), digits.data() + digits.size(), value);
  return value;
}

// The largest number in the cells that a question is about; kNone if there are none, as for `never`.
double largest_number(const Question& question) {
  double largest = Features::kNone;
  const auto see = [&](const ObstacleId& obstacle) {
    for (const Integer& number : obstacle.cell) largest = std::fmax(largest, std::fabs(as_double(number)));
  };
  if (names_obstacle(question.exact)) see(question.exact.obstacle);
  if (question.query.from) see(*question.query.from);
  return largest;
}

// The only obstacle of a scene; nothing if there are several.
std::optional<ObstacleId> lone_obstacle(const Scene& scene) {
  const Lattice& first = scene.lattices[0];
  const bool is_lone =
      scene.lattices.size() == 1 && first.atoms.size() == 1 && first.rank(scene.dimension) == 0;
  return is_lone ? std::optional(ObstacleId{}) : std::nullopt;
}

// Sets the distance from x to the obstacle's centre, in its radii (for an ellipsoid, the smallest semiaxis).
void measure_from(const Question& question, const ObstacleId& obstacle, Features& its) {
  const Scene& scene = question.place->scene();
  const Lattice& lattice = scene.lattices[static_cast<std::size_t>(obstacle.lattice)];
  const Atom& atom = lattice.atoms[static_cast<std::size_t>(obstacle.atom)];
  Vec centre = atom.position;
  for (int i = 0; i < lattice.rank(scene.dimension); ++i)
    centre = plus(centre, as_double(obstacle.cell[i]), lattice.vectors[i]);
  const Vec away = plus(centre, -1, question.query.x);
  its.distance = std::hypot(away[0], away[1], away[2]) / smallest_semiaxis(atom, scene.dimension);
}

}  // namespace

Features features_of(const Question& question, const std::optional<ObstacleId>& in_question) {
  const Scene& scene = question.place->scene();
  const Query& query = question.query;
  const double unit = shortest_vector(scene);
  Features its;
  its.in_space = scene.dimension == 3;
  for (int i = 0; i < scene.dimension; ++i) its.zero_component |= query.v[i] == 0;
  its.leaving = query.from.has_value();
  its.several_lattices = scene.lattices.size() > 1;
  for (const Lattice& lattice : scene.lattices) its.several_atoms |= lattice.atoms.size() > 1;
  for_each_atom(scene, [&](const Atom& atom) { its.ellipsoids |= !atom.is_ball(); });
  its.other_cell = !is_unit_scene(scene);
  its.never = question.exact.outcome == Outcome::never;
  its.radius = smallest_radius(scene) / unit;
  its.start = length(query.x) / unit;
  its.cell = largest_number(question);
  its.speed = length(query.v);
  if (const auto obstacle = in_question ? in_question : lone_obstacle(scene))
    measure_from(question, *obstacle, its);
  if (question.exact.outcome != Outcome::hit) return its;
  const double flown = question.exact.time.value_or(Features::kNone) * its.speed;
  its.flight = flown / unit;
  const ObstacleId& hit = question.exact.obstacle;
  const Atom& atom =
      scene.lattices[static_cast<std::size_t>(hit.lattice)].atoms[static_cast<std::size_t>(hit.atom)];
  its.flight_in_radii = flown / smallest_semiaxis(atom, scene.dimension);
  its.depth = -question.place->margins().approach(query, question.exact.obstacle).gap;
  return its;
}

}  // namespace lorentz::judge
