// What a finding's drawing is about, from where it is seen, and the obstacles that stand out.
#include <algorithm>
#include <cmath>

#include "report/pictures/finding_parts.hpp"

namespace lorentz::pictures {

using oracle::Approach;
using oracle::PlaceOnLine;

Vec unit(const Vec& a) {
  const double largest = std::max({std::fabs(a[0]), std::fabs(a[1]), std::fabs(a[2])});
  if (!(largest > 0) || !std::isfinite(largest)) return {1, 0, 0};
  const Vec b{a[0] / largest, a[1] / largest, a[2] / largest};
  return scaled(b, 1 / length(b));
}

FindingCase::FindingCase(const Scene& its_scene, const Query& its_query, const Answer* its_given,
                         const Answer& its_exact, const std::optional<ObstacleId>& decisive, int its_exponent,
                         NumberFormat precision)
    : scene(its_scene),
      query(its_query),
      given(its_given),
      exact(its_exact),
      exponent(its_exponent),
      margins(its_scene, precision),
      surroundings(its_scene),
      along(unit(its_query.v)) {
  if (given) compare_answers(decisive);
  if (issue == Issue::none) take_hardest_decision();
  set_axes();
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
  about(Issue::line, id, approach.gap, "the line touches", "the line meets", "the line misses");
}

void FindingCase::about_start(const ObstacleId& id, const Approach& approach) {
  about(Issue::start, id, approach.start_gap, "x lies on the surface of", "x lies inside",
        "x lies outside of");
}

void FindingCase::about(Issue its, const ObstacleId& id, double gap, const char* at, const char* within,
                        const char* beyond) {
  issue = its, obstacle = id, second.reset(), distance = gap;
  words = gap == 0 ? fmt::format("{} {}", at, name_of(id))
                   : fmt::format("{} {} by {:.4g} of its radii", gap < 0 ? within : beyond, name_of(id),
                                 std::fabs(gap));
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

// ---- how it is looked at

void FindingCase::set_axes() {
  across = {-along[1], along[0], 0};
  if (scene.dimension == 3) {
    // Any direction at right angles, unless an obstacle determines it.
    const int smallest =
        static_cast<int>(std::min_element(along.begin(), along.end(),
                                          [](double a, double b) { return std::fabs(a) < std::fabs(b); }) -
                         along.begin());
    Vec axis{};
    axis[smallest] = 1;
    across = unit(cross(along, axis));
    if (issue != Issue::none) {
      const Vec centre = surroundings.centre(query, place(), obstacle);
      const Vec rest = sum(centre, scaled(along, -dot(centre, along)));
      if (length(rest) > 1e-9 * length(centre)) across = unit(rest);
    }
  }
  depth = cross(along, across);
}

// y = B w + q, B the two columns of A^-1 for the axes: |w - w0|^2_S < 1, S = B^T B / k.
std::optional<ShapeSection> section_of(const FindingCase& finding, const Atom& atom, double depth) {
  const auto rows = to_ball(atom, 3);
  const Vec a = coordinates(rows, finding.along), b = coordinates(rows, finding.across),
            q = coordinates(rows, scaled(finding.depth, -depth));
  const double aa = dot(a, a), ab = dot(a, b), bb = dot(b, b), det = aa * bb - ab * ab;
  const double aq = dot(a, q), bq = dot(b, q);
  const Point w0{(ab * bq - bb * aq) / det, (ab * aq - aa * bq) / det};
  const Vec nearest = sum(q, sum(scaled(a, w0.x), scaled(b, w0.y)));
  const double k = 1 - dot(nearest, nearest);
  if (!(k > 0)) return std::nullopt;
  // w - w0 = L^-T u for S = L L^T, |u| < 1.
  const double l11 = std::sqrt(aa / k), l21 = ab / k / l11, l22 = std::sqrt(det / aa / k);
  return ShapeSection{w0, ellipse_of({1 / l11, -l21 / (l11 * l22), 0}, {0, 1 / l22, 0})};
}

std::optional<Ink> ink_of(const FindingCase& finding, const ObstacleId& id) {
  if (finding.names_obstacle(finding.exact) && finding.exact.obstacle == id) return kExactInk;
  if (finding.given && finding.names_obstacle(*finding.given) && finding.given->obstacle == id)
    return kGivenInk;
  if (finding.issue != Issue::none && (finding.obstacle == id || finding.second == id)) return kInk;
  return std::nullopt;
}

std::vector<ObstacleId> marked_obstacles(const FindingCase& finding) {
  std::vector<ObstacleId> marked;
  const auto add = [&](const ObstacleId& id) {
    if (std::find(marked.begin(), marked.end(), id) == marked.end()) marked.push_back(id);
  };
  if (finding.issue != Issue::none) add(finding.obstacle);
  if (finding.second) add(*finding.second);
  if (finding.given && finding.names_obstacle(*finding.given)) add(finding.given->obstacle);
  if (finding.names_obstacle(finding.exact)) add(finding.exact.obstacle);
  return marked;
}

std::string hint_of(const FindingCase& finding, const ObstacleId& id) {
  const Approach approach = finding.margins.approach(finding.query, id);
  const double way = finding.surroundings.way(finding.query, PlaceOnLine::start(), PlaceOnLine::at(id));
  return fmt::format(
      "{}: the line {} it by {:.6g} of its radii, {:.9g} of length from the start; x lies {} it by {:.6g}",
      finding.name_of(id), approach.gap < 0 ? "meets" : "misses", std::fabs(approach.gap),
      std::ldexp(way, finding.exponent), approach.start_gap < 0 ? "inside" : "outside of",
      std::fabs(approach.start_gap));
}

}  // namespace lorentz::pictures
