// The viewpoint of a case, sections of obstacles, and the obstacles that stand out.
#include <algorithm>
#include <cmath>

#include "pictures/finding_parts.hpp"

namespace lorentz::pictures {

Axes axes_of(const FindingCase& finding) {
  const Vec& along = finding.along;
  Vec across{-along[1], along[0], 0};
  if (finding.scene.dimension == 3) {
    // Any direction at right angles, unless an obstacle determines it.
    const int smallest =
        static_cast<int>(std::min_element(along.begin(), along.end(),
                                          [](double a, double b) { return std::fabs(a) < std::fabs(b); }) -
                         along.begin());
    Vec axis{};
    axis[smallest] = 1;
    across = unit(cross(along, axis));
    if (finding.issue != Issue::none) {
      const Vec centre =
          finding.surroundings.centre(finding.query, place_in_question(finding), finding.obstacle);
      const Vec rest = sum(centre, scaled(along, -dot(centre, along)));
      if (length(rest) > 1e-9 * length(centre)) across = unit(rest);
    }
  }
  return {along, across, cross(along, across)};
}

// y = B w + q, B the two columns of A^-1 for the axes: |w - w0|^2_S < 1, S = B^T B / k.
std::optional<ShapeSection> section_of(const Atom& atom, const Axes& axes, double depth) {
  const auto rows = to_ball(atom, 3);
  const Vec a = coordinates(rows, axes.along), b = coordinates(rows, axes.across),
            q = coordinates(rows, scaled(axes.depth, -depth));
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
  const oracle::Approach approach = finding.margins.approach(finding.query, id);
  const double way =
      finding.surroundings.way(finding.query, oracle::PlaceOnLine::start(), oracle::PlaceOnLine::at(id));
  return fmt::format(
      "{}: the line {} it by {:.6g} of its radii, {:.9g} of length from the start; x lies {} it by {:.6g}",
      finding.name_of(id), approach.gap < 0 ? "meets" : "misses", std::fabs(approach.gap),
      std::ldexp(way, finding.exponent), approach.start_gap < 0 ? "inside" : "outside of",
      std::fabs(approach.start_gap));
}

}  // namespace lorentz::pictures
