#include "judge/features.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

#include <lorentz/geometry.hpp>

namespace lorentz::judge {
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
    if (atom.is_ball()) smallest = std::min(smallest, atom.radius);
    for (const Vec& axis : atom.semiaxes) smallest = std::min(smallest, length(axis));
  });
  return smallest;
}

double as_double(const Integer& number) {
  const std::string digits = number.decimal();
  double value = std::numeric_limits<double>::infinity();
  std::from_chars(digits.data(), digits.data() + digits.size(), value);
  return value;
}

// Of the cells that a question is about. Nothing where there are none: of `never`.
double largest_number(const Question& question) {
  double largest = Features::kNone;
  const auto see = [&](const ObstacleId& obstacle) {
    for (const Integer& number : obstacle.cell) largest = std::fmax(largest, std::fabs(as_double(number)));
  };
  const Outcome outcome = question.exact.outcome;
  if (outcome == Outcome::hit || outcome == Outcome::inside) see(question.exact.obstacle);
  if (question.query.from) see(*question.query.from);
  return largest;
}

}  // namespace

Features features_of(const Question& question) {
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
  if (question.exact.outcome != Outcome::hit) return its;
  its.flight = question.exact.time.value_or(Features::kNone) * its.speed / unit;
  its.depth = -question.place->margins().approach(query, question.exact.obstacle).gap;
  return its;
}

}  // namespace lorentz::judge
