// The parts of a finding's drawing: which obstacle is in question and by how much, colours, axes, panels.
// Private to finding_*.cpp.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <lorentz/geometry.hpp>
#include <lorentz/margin.hpp>
#include <lorentz/surroundings.hpp>
#include "report/pictures/drawing_parts.hpp"
#include "report/pictures/svg.hpp"
#include "src/problem/same_answer.hpp"

namespace lorentz::pictures {

enum class Issue {
  none,   ///< nothing
  line,   ///< does the line meet `obstacle`?
  start,  ///< does `obstacle` contain x?
  order,  ///< `obstacle` is entered, and `second` after it
  time    ///< where is `obstacle` entered?
};

/// One question with its exact answer, and possibly a given one.
class FindingCase {
 public:
  /// `given` may be null. `decisive` is the obstacle by which it is judged, if known. The arguments must
  /// outlive this object. Lengths and times are in units of 2^exponent, ulps those of the precision.
  FindingCase(const Scene& scene, const Query& query, const Answer* given, const Answer& exact,
              const std::optional<ObstacleId>& decisive = {}, int exponent = 0,
              NumberFormat precision = NumberFormat::binary64);

  const Scene& scene;
  const Query& query;
  const Answer* const given;
  const Answer& exact;
  const int exponent;
  const oracle::Margins margins;
  const oracle::Surroundings surroundings;
  const Vec along;        ///< the flight's direction, of length 1: from left to right
  Vec across{}, depth{};  ///< upwards, in 3D towards the obstacle in question; and towards the reader

  Issue issue = Issue::none;
  ObstacleId obstacle;
  std::optional<ObstacleId> second;
  /// In radii of `obstacle`, in the coordinates in which it is a ball. For Issue::line the distance of the
  /// line from its surface, for Issue::start that of x, both below 0 inside. Else the way along the flight
  /// from its entry to the entry of `second` (Issue::order), or to the place at the given time (Issue::time).
  double distance = 0;
  std::string words;   ///< the same in a sentence
  std::string margin;  ///< how hard the decision is, if it is shown for that reason

  /// The place where the flight ends according to an answer; nothing if it does not end, or the place is
  /// unknown.
  std::optional<oracle::PlaceOnLine> end_of(const Answer& answer) const;

  /// True if the answer names an obstacle of the scene.
  bool names_obstacle(const Answer& answer) const { return lorentz::names_obstacle(answer, query, scene); }

  const Atom& atom_of(const ObstacleId& id) const { return scene.lattices[id.lattice].atoms[id.atom]; }

  /// The place that the inset shows.
  oracle::PlaceOnLine place() const {
    return issue == Issue::start ? oracle::PlaceOnLine::start() : oracle::PlaceOnLine::at(obstacle);
  }

  /// A way along the flight in radii of the obstacle in question.
  double in_radii(double way) const;

  /// "cell (2, -1)", with atom and lattice if there are several.
  std::string name_of(const ObstacleId& id) const;

 private:
  void compare_answers(const std::optional<ObstacleId>& decisive);
  bool compare_named();
  void take_hardest_decision();
  void set_axes();
  void about_line(const ObstacleId& id, const oracle::Approach& approach);
  void about_start(const ObstacleId& id, const oracle::Approach& approach);
  void about(Issue its, const ObstacleId& id, double gap, const char* at, const char* within,
             const char* beyond);
  void about_order(const ObstacleId& first, const ObstacleId& later);
  void about_time(double time);
};

/// The rows of A^-1 of an obstacle { position + A y : |y| < 1 }.
inline std::array<Vec, 3> to_ball(const Atom& atom, int dimension) {
  return dual_of(semiaxes_of(atom, dimension), dimension);
}

/// a / |a|, for any size; the first axis for 0.
Vec unit(const Vec& a);

/// A colour that a page may set.
struct Ink {
  const char *variable, *otherwise;
};

// Colours of Okabe and Ito, which colour-blind people can tell apart.
inline constexpr Ink kExactInk{"--exact", "#0072b2"}, kGivenInk{"--given", "#d55e00"},
    kInk{"--ink", "#222222"}, kFaintInk{"--faint", "#8c8c8c"}, kPaper{"--paper", "#ffffff"};
inline constexpr const char* kGivenDashes = " stroke-dasharray=\"7 5\"";

/// Attributes that fill and stroke with these inks: as a property for browsers, and as a plain attribute for
/// programs that do not know variables.
std::string paint(Ink fill);
std::string paint(Ink fill, Ink stroke, double width);
std::string outline(Ink stroke, double width);  ///< sets no fill attribute, not even "none"

struct Panel {
  double left, top, width, height;

  double right() const { return left + width; }
  double bottom() const { return top + height; }
  double middle() const { return top + height / 2; }
};

/// Everything drawn until close_clip() is visible only inside the panel.
void open_clip(Svg& svg, const Panel& panel);
inline void close_clip(Svg& svg) {
  svg.raw("</svg>\n");
}
void frame(Svg& svg, const Panel& panel, const std::string& style);

/// The following shapes until close() have this text under the mouse.
inline void open_hint(Svg& svg, const std::string& words) {
  svg.raw("<g><title>" + xml_escaped(words) + "</title>\n");
}

/// Limits a coordinate to the range of any picture; no infinity or NaN.
double on_paper(double pixels);

/// The section of an obstacle by a plane, relative to the foot of its centre there.
struct ShapeSection {
  Point centre;
  EllipseShape shape;
};

/// The section by the plane of `along` and `across`, in 3D, with the centre `depth` in front of it; nothing
/// if the plane misses the obstacle.
std::optional<ShapeSection> section_of(const FindingCase& finding, const Atom& atom, double depth);

/// The ink of an obstacle that is exact, given, or in question for another reason; nothing for neighbours.
std::optional<Ink> ink_of(const FindingCase& finding, const ObstacleId& id);

/// The obstacles that have an ink, each once.
std::vector<ObstacleId> marked_obstacles(const FindingCase& finding);

/// The same decision, place and distances in words, shown under the mouse.
std::string hint_of(const FindingCase& finding, const ObstacleId& id);

/// Notes and positions that the panel of the flight passes on.
struct FlightPanel {
  std::vector<std::string> notes;
  std::optional<Point> at;  ///< the place that the inset shows
  double scale = 0;         ///< pixels per unit of length
};

FlightPanel draw_flight(Svg& svg, const FindingCase& finding, const Panel& panel);

/// Returns the pixels per radius of the obstacle in question, along the flight.
double draw_inset(Svg& svg, const FindingCase& finding, const Panel& panel);

/// The view along the flight, with the obstacles beside it.
void draw_side_view(Svg& svg, const FindingCase& finding, const Panel& panel);

}  // namespace lorentz::pictures
