#include "pictures/finding_case.hpp"

#include <fmt/format.h>

#include <cmath>

namespace lorentz::pictures {

using oracle::Approach;
using oracle::PlaceOnLine;

std::array<Vec, 3> to_ball(const Atom& atom, int dimension) {
  return dual_of(semiaxes_of(atom, dimension), dimension);
}

Vec unit(const Vec& a) {
  const double largest = std::max({std::fabs(a[0]), std::fabs(a[1]), std::fabs(a[2])});
  if (!(largest > 0) || !std::isfinite(largest)) return {1, 0, 0};
  const Vec b{a[0] / largest, a[1] / largest, a[2] / largest};
  return scaled(b, 1 / length(b));
}

FindingCase::FindingCase(const Scene& its_scene, const Query& its_query, const Answer* its_given,
                         const Answer& its_exact, const std::optional<ObstacleId>& decisive, int its_exponent)
    : scene(its_scene),
      query(its_query),
      given(its_given),
      exact(its_exact),
      exponent(its_exponent),
      margins(its_scene),
      surroundings(its_scene),
      along(unit(its_query.v)) {
  if (given) compare_answers(decisive);
  if (issue == Issue::none) take_hardest_decision();
}

bool FindingCase::names_obstacle(const Answer& answer) const {
  return (answer.outcome == Outcome::hit || answer.outcome == Outcome::inside) &&
         !flaw_of(Query{query.x, query.v, answer.obstacle}, scene);
}

std::optional<PlaceOnLine> FindingCase::end_of(const Answer& answer) const {
  if (answer.outcome == Outcome::inside) return PlaceOnLine::start();
  if (answer.outcome != Outcome::hit || !names_obstacle(answer)) return std::nullopt;
  const bool same = answer.obstacle == exact.obstacle && exact.outcome == Outcome::hit;
  if (same && answer.time && std::isfinite(*answer.time) && issue == Issue::time)
    return PlaceOnLine::after(*answer.time);
  return PlaceOnLine::at(answer.obstacle);
}

std::string FindingCase::name_of(const ObstacleId& id) const {
  std::string name = "cell (";
  for (int i = 0; i < Components(scene).of_cells(id.lattice); ++i)
    name += (i ? ", " : "") + id.cell[i].decimal();
  name += ')';
  if (scene.lattices[id.lattice].atoms.size() > 1) name = fmt::format("atom {}, {}", id.atom, name);
  if (scene.lattices.size() > 1) name = fmt::format("lattice {}, {}", id.lattice, name);
  return name;
}

double FindingCase::in_radii(double way) const {
  return way * length(coordinates(to_ball(atom_of(obstacle), scene.dimension), along));
}

void FindingCase::compare_answers(const std::optional<ObstacleId>& decisive) {
  const bool given_names = names_obstacle(*given), exact_names = names_obstacle(exact);
  if (given_names && exact_names && given->obstacle == exact.obstacle && given->outcome == exact.outcome) {
    if (exact.outcome == Outcome::hit && given->time && std::isfinite(*given->time) &&
        given->time != exact.time)
      about_time(*given->time);
    return;
  }
  if (given_names && decisive.value_or(given->obstacle) == given->obstacle && compare_named()) return;
  if (!exact_names || given->outcome == Outcome::undecided || given->outcome == Outcome::error ||
      given->outcome == Outcome::later)
    return;
  const ObstacleId& passed = decisive ? *decisive : exact.obstacle;
  const Approach approach = margins.approach(query, passed);
  if (exact.outcome == Outcome::inside && approach.start_gap < 0) return about_start(passed, approach);
  if (given->outcome == Outcome::hit && given_names) {
    about_order(passed, given->obstacle);
    if (distance < std::fabs(approach.gap)) return;  // the order matters more than whether it is met
  }
  about_line(passed, approach);
}

// True if the obstacle that the answer names makes it wrong.
bool FindingCase::compare_named() {
  const Approach approach = margins.approach(query, given->obstacle);
  const bool is_hit = given->outcome == Outcome::hit;
  const bool is_left = is_hit && query.from == given->obstacle;
  const bool is_behind = is_hit && approach.start_gap >= 0 && !approach.ahead;
  if (is_left || is_behind || (!is_hit && approach.start_gap >= 0)) {
    about_start(given->obstacle, approach);
    if (is_left || is_behind)
      words = name_of(obstacle) +
              (is_left ? " is the obstacle that the flight leaves" : " lies behind the start");
    return true;
  }
  if (!is_hit || approach.gap < 0) return false;
  about_line(given->obstacle, approach);
  return true;
}

void FindingCase::take_hardest_decision() {
  const auto decision = margins.hardest_decision(query, exact);
  if (!decision) return;
  if (decision->margin >= oracle::kLargestMargin) {  // no decision is hard
    const Approach approach = margins.approach(query, exact.obstacle);
    return exact.outcome == Outcome::inside ? about_start(exact.obstacle, approach)
                                            : about_line(exact.obstacle, approach);
  }
  const Approach approach = margins.approach(query, decision->obstacle);
  switch (decision->kind) {
    case oracle::DecisionKind::containing:
      about_start(decision->obstacle, approach);
      break;
    case oracle::DecisionKind::meeting:
      about_line(decision->obstacle, approach);
      break;
    case oracle::DecisionKind::order:
      about_order(exact.obstacle, decision->obstacle);
      break;
  }
  margin = fmt::format("The hardest decision of this flight: {:.3g} ulps in each input change it.",
                       decision->margin);
}

void FindingCase::about_line(const ObstacleId& id, const Approach& approach) {
  issue = Issue::line;
  obstacle = id;
  second.reset();
  distance = approach.gap;
  const std::string name = name_of(id);
  words = distance == 0 ? "the line touches " + name
                        : fmt::format("the line {} {} by {:.4g} of its radii",
                                      distance < 0 ? "meets" : "misses", name, std::fabs(distance));
}

void FindingCase::about_start(const ObstacleId& id, const Approach& approach) {
  issue = Issue::start;
  obstacle = id;
  distance = approach.start_gap;
  const std::string name = name_of(id);
  words = distance == 0 ? "x lies on the surface of " + name
                        : fmt::format("x lies {} {} by {:.4g} of its radii",
                                      distance < 0 ? "inside" : "outside of", name, std::fabs(distance));
}

void FindingCase::about_order(const ObstacleId& first, const ObstacleId& later) {
  issue = Issue::order;
  obstacle = first;
  second = later;
  distance = in_radii(surroundings.way(query, PlaceOnLine::at(first), PlaceOnLine::at(later)));
  words = distance == 0
              ? fmt::format("{} and {} are entered at the same time; the answer is the first of them",
                            name_of(first), name_of(later))
              : fmt::format("{} is entered {:.4g} of its radii before {}", name_of(first), distance,
                            name_of(later));
}

void FindingCase::about_time(double time) {
  obstacle = exact.obstacle;
  distance = in_radii(surroundings.way(query, PlaceOnLine::at(obstacle), PlaceOnLine::after(time)));
  if (distance == 0) return;
  issue = Issue::time;
  words = fmt::format("at the time given the flight is {:.4g} radii {} where it enters {}",
                      std::fabs(distance), distance > 0 ? "beyond" : "before", name_of(obstacle));
}

}  // namespace lorentz::pictures
