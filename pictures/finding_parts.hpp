// The parts of a finding's drawing: colours, axes, panels. Private to finding_*.cpp.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "pictures/finding_case.hpp"
#include "pictures/svg.hpp"

namespace lorentz::pictures {

/// A colour that a page may set.
struct Ink {
  const char *variable, *otherwise;
};

// Told apart by the colour-blind: after Okabe and Ito.
inline constexpr Ink kExactInk{"--exact", "#0072b2"}, kGivenInk{"--given", "#d55e00"},
    kInk{"--ink", "#222222"}, kFaintInk{"--faint", "#8c8c8c"}, kPaper{"--paper", "#ffffff"};
inline constexpr const char* kGivenDashes = " stroke-dasharray=\"7 5\"";

/// Attributes: what is filled and stroked with which ink. As a property for browsers, and for programs that
/// know no variables as a plain attribute.
std::string paint(Ink fill);
std::string paint(Ink fill, Ink stroke, double width);
std::string outline(Ink stroke, double width);  ///< fills nothing, and does not say so

struct Panel {
  double left, top, width, height;

  double right() const { return left + width; }
  double bottom() const { return top + height; }
  double middle() const { return top + height / 2; }
};

/// What is drawn until close_clip() is seen in the panel only.
void open_clip(Svg& svg, const Panel& panel);
void close_clip(Svg& svg);
void frame(Svg& svg, const Panel& panel, const std::string& style);

/// The following shapes until close() have this text under the mouse.
void open_hint(Svg& svg, const std::string& words);

/// Within reach of any picture: no infinity, no nonsense.
double on_paper(double pixels);

/// The flight from left to right, the obstacle in question (in space) above it.
struct Axes {
  Vec along, across, depth;
};
Axes axes_of(const FindingCase& finding);

/// What an obstacle looks like from afar, in lengths; angles towards +up.
EllipseShape shadow_of(const Atom& atom, int dimension, const Vec& right, const Vec& up);

/// What a plane cuts out of an obstacle: seen from the foot of its centre there.
struct ShapeSection {
  Point centre;
  EllipseShape shape;
};

/// The plane of `along` and `across`, which the centre stands `depth` in front of, in space; nothing if it
/// misses the obstacle.
std::optional<ShapeSection> section_of(const Atom& atom, const Axes& axes, double depth);

/// The ink of an obstacle: exact, given, or in question for another reason; nothing for its neighbours.
std::optional<Ink> ink_of(const FindingCase& finding, const ObstacleId& id);

/// The obstacles that have an ink, each once.
std::vector<ObstacleId> marked_obstacles(const FindingCase& finding);

/// The same decision, place and distances in words, for the mouse.
std::string hint_of(const FindingCase& finding, const ObstacleId& id);

/// The exponent of the unit of length in which a scene is of ordinary size; mostly 0.
int length_exponent(const Scene& scene);

/// Divides all lengths by 2^exponent; false if that cannot be done without a rounding.
bool scale_lengths(int exponent, Scene& scene, Query& query);

/// What the panel of the flight leaves to be said and pointed at.
struct FlightPanel {
  std::vector<std::string> notes;
  std::optional<Point> at;  ///< where the inset looks
  double scale = 0;         ///< pixels per unit of length
};

/// The place that the inset is about.
oracle::PlaceOnLine place_in_question(const FindingCase& finding);

FlightPanel draw_flight(Svg& svg, const FindingCase& finding, const Panel& panel);

/// Returns the pixels per radius of the obstacle in question, along the flight.
double draw_inset(Svg& svg, const FindingCase& finding, const Axes& axes, const Panel& panel);

/// Along the flight: how the obstacles stand beside it.
void draw_side_view(Svg& svg, const FindingCase& finding, const Axes& axes, const Panel& panel);

}  // namespace lorentz::pictures
