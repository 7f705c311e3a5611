// The view along the flight, which appears as a point, with the shadows of the obstacles around it.
#include <algorithm>
#include <cmath>

#include "pictures/finding_parts.hpp"

namespace lorentz::pictures {
namespace {

struct SeenFromAside {
  ObstacleId obstacle;
  double x, y;  // of its centre, in the unit of length
  EllipseShape shape;
};

SeenFromAside seen_along(const FindingCase& finding, const Axes& axes, const ObstacleId& id) {
  const Vec centre = finding.surroundings.centre(finding.query, oracle::PlaceOnLine::at(id), id);
  return {id, dot(centre, axes.depth), dot(centre, axes.across),
          shadow_of(finding.atom_of(id), 3, axes.depth, axes.across)};
}

}  // namespace

void draw_side_view(Svg& svg, const FindingCase& finding, const Axes& axes, const Panel& panel) {
  std::vector<SeenFromAside> shadows;
  double reach = 0;
  for (const ObstacleId& id : marked_obstacles(finding)) {
    shadows.push_back(seen_along(finding, axes, id));
    const SeenFromAside& one = shadows.back();
    reach = std::max(reach, std::max(std::fabs(one.x), std::fabs(one.y)) + one.shape.rx);
  }
  if (!(reach > 0) || !std::isfinite(reach)) return;
  const double scale = 0.95 * panel.height / 2 / reach;
  const Point middle{panel.left + panel.width / 2, panel.middle()};
  open_clip(svg, panel);
  for (const SeenFromAside& one : shadows) {
    const Ink ink = *ink_of(finding, one.obstacle);
    svg.ellipse({on_paper(middle.x + scale * one.x), on_paper(middle.y - scale * one.y)},
                {on_paper(std::max(1.0, scale * one.shape.rx)), on_paper(std::max(1.0, scale * one.shape.ry)),
                 -one.shape.angle},
                paint(ink, ink, 1.2) + " fill-opacity=\"0.2\"", hint_of(finding, one.obstacle));
  }
  svg.ellipse(middle, {2.5, 2.5, 0}, paint(kInk), "the line of the flight, seen along it");
  close_clip(svg);
  frame(svg, panel, outline(kFaintInk, 0.8));
  svg.text({panel.left, panel.top - 4}, "along the flight", paint(kInk) + " font-size=\"10\"");
}

}  // namespace lorentz::pictures
