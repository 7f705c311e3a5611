// A picture as SVG text: lengths in pixels, x to the right, y DOWN (callers must turn the y axis).
#pragma once

#include <fmt/format.h>

#include <string>
#include <vector>

namespace lorentz::pictures {

struct Point {
  double x = 0, y = 0;
};

/// An ellipse about a centre: its semiaxes, and the angle in radians from the x axis to the first, towards
/// +y.
struct EllipseShape {
  double rx = 0, ry = 0, angle = 0;
};

std::string xml_escaped(const std::string& text);

class Svg {
 public:
  /// `style` is a list of attributes, e.g. fill="none"; `hint`, if any, shows under the mouse.
  void ellipse(Point centre, const EllipseShape& shape, const std::string& style,
               const std::string& hint = "");
  void polyline(const std::vector<Point>& points, const std::string& style);
  void polygon(const std::vector<Point>& points, const std::string& style);
  void rectangle(Point corner, Point opposite, const std::string& style) {
    polygon({corner, {opposite.x, corner.y}, opposite, {corner.x, opposite.y}}, style);
  }
  void text(Point at, const std::string& words, const std::string& style = "");

  /// A line with a head of this size at its end.
  void arrow(Point from, Point to, double head, const std::string& colour, double width);

  /// Everything drawn until close() forms a group; `attributes` hold for all of it.
  void open(const std::string& attributes) { raw("<g " + attributes + ">\n"); }
  void close() { raw("</g>\n"); }

  /// Anything else, e.g. definitions.
  void raw(const std::string& xml) { body_ += xml; }

  const std::string& body() const { return body_; }
  std::string document(double width, double height, const std::string& title) const;

 private:
  std::string body_;
};

}  // namespace lorentz::pictures
