// Reads our own pictures (SVG) back, and measures: every shape at its place on the paper, with all transforms
// of the groups that hold it, and where a picture has a scale, in the units of the data.
#pragma once

#include <array>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace lorentz::test {

struct Spot {
  double x = 0, y = 0;
};

inline Spot operator-(Spot a, Spot b) {
  return {a.x - b.x, a.y - b.y};
}
double distance(Spot a, Spot b);

struct Rectangle {
  Spot low, high;
  bool holds(Spot spot, double slack = 0) const;
  double width() const { return high.x - low.x; }
  double height() const { return high.y - low.y; }
};

/// { M y : |y| = 1 } by M M^T = [[xx, xy], [xy, yy]]: size and tilt of an ellipse, whichever axis comes
/// first.
struct Oval {
  double xx = 0, xy = 0, yy = 0;
};

struct Ink {
  std::string kind;                          ///< ellipse (circles too), line, polygon, text
  Spot centre;                               ///< of an ellipse; where a text stands
  Oval oval;                                 ///< of an ellipse
  std::vector<Spot> points;                  ///< of a line or a polygon (rectangles are polygons)
  std::map<std::string, std::string> style;  ///< attributes, its own or those of a group that holds it
  std::string words;                         ///< of a text
  std::string hint;                          ///< its title, or the innermost group's that has one
  Spot direction;                            ///< along a text, of length 1
  std::optional<Rectangle> clip;             ///< it is seen in there only

  bool is(const std::string& attribute, const std::string& value) const;
  std::string operator[](const std::string& attribute) const;  ///< empty if it has none
  double number(const std::string& attribute) const;
  double radius() const;  ///< of a circle; -1 if it is not round
};

using Inks = std::vector<Ink>;

/// A map from the paper to the data: x = (X - origin.x) / scale, y upwards.
struct Plane {
  Spot origin;
  double scale = 1;

  Spot operator()(Spot paper) const { return {(paper.x - origin.x) / scale, (origin.y - paper.y) / scale}; }
  Oval operator()(const Oval& oval) const {
    return {oval.xx / scale / scale, -oval.xy / scale / scale, oval.yy / scale / scale};
  }
};

struct SvgPicture {
  Rectangle page;
  std::string title;
  Inks inks;                                               ///< in the order in which they are drawn
  std::map<std::string, std::vector<std::string>> shades;  ///< gradients: the colours of their stops

  /// Fails on text that is not XML, or has parts that this does not know.
  explicit SvgPicture(const std::string& svg);

  Inks all(const std::string& kind, const std::function<bool(const Ink&)>& which = {}) const;
  Inks all(const std::string& kind, const std::string& attribute, const std::string& value) const;
  /// The only text with these words; fails if there are none or two.
  Ink text(const std::string& words) const;
  bool says(const std::string& part) const;  ///< some text has it
  /// What marks the entry of a legend: the last shape drawn before this text.
  Ink mark_of(const std::string& words) const;
  /// The first thing that is not on the page; empty: all is.
  std::string beyond_page() const;
};

}  // namespace lorentz::test
