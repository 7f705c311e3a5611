#include "report/pictures/svg.hpp"

#include <cmath>
#include <numbers>

#include "src/problem/safe_text.hpp"

namespace lorentz::pictures {
namespace {

// 0 for numbers that would be printed as -0.00.
double plain(double value) {
  return std::fabs(value) < 0.005 ? 0 : value;
}

// Two decimals are a hundredth of a pixel.
std::string path_of(const std::vector<Point>& points) {
  std::string out;
  for (const Point& p : points)
    out += fmt::format("{}{:.2f},{:.2f}", out.empty() ? "" : " ", plain(p.x), plain(p.y));
  return out;
}

}  // namespace

std::string xml_escaped(const std::string& text) {
  std::string out;
  for (const char c : printable(text))
    out += c == '&'   ? "&amp;"
           : c == '<' ? "&lt;"
           : c == '>' ? "&gt;"
           : c == '"' ? "&quot;"
                      : std::string(1, c);
  return out;
}

void Svg::ellipse(Point centre, const EllipseShape& shape, const std::string& style,
                  const std::string& hint) {
  const bool round = std::fabs(shape.rx - shape.ry) < 1e-9 * shape.rx;
  if (round) {
    body_ += fmt::format("<circle cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"{:.2f}\" {}", centre.x, centre.y, shape.rx,
                         style);
  } else {
    body_ += fmt::format(
        "<ellipse rx=\"{:.2f}\" ry=\"{:.2f}\" transform=\"translate({:.2f} {:.2f}) rotate({:.2f})\" {}",
        shape.rx, shape.ry, centre.x, centre.y, plain(shape.angle * 180 / std::numbers::pi), style);
  }
  body_ += hint.empty()
               ? "/>\n"
               : fmt::format("><title>{}</title></{}>\n", xml_escaped(hint), round ? "circle" : "ellipse");
}

void Svg::polyline(const std::vector<Point>& points, const std::string& style) {
  body_ += fmt::format("<polyline points=\"{}\" fill=\"none\" {}/>\n", path_of(points), style);
}

void Svg::polygon(const std::vector<Point>& points, const std::string& style) {
  body_ += fmt::format("<polygon points=\"{}\" {}/>\n", path_of(points), style);
}

void Svg::text(Point at, const std::string& words, const std::string& style) {
  body_ +=
      fmt::format("<text x=\"{:.2f}\" y=\"{:.2f}\" {}>{}</text>\n", at.x, at.y, style, xml_escaped(words));
}

void Svg::arrow(Point from, Point to, double head, const std::string& colour, double width) {
  const double length = std::hypot(to.x - from.x, to.y - from.y);
  if (!(length > 0)) return;
  const Point along{(to.x - from.x) / length, (to.y - from.y) / length};
  const Point neck{to.x - head * along.x, to.y - head * along.y};
  const double half = 0.38 * head;
  polyline({from, length > head ? neck : from},
           fmt::format("stroke=\"{}\" stroke-width=\"{}\"", colour, width));
  polygon({to,
           {neck.x - half * along.y, neck.y + half * along.x},
           {neck.x + half * along.y, neck.y - half * along.x}},
          fmt::format("fill=\"{}\"", colour));
}

std::string Svg::document(double width, double height, const std::string& title) const {
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:.0f} {1:.0f}\" width=\"{0:.0f}\" "
      "height=\"{1:.0f}\" font-family=\"Helvetica, Arial, sans-serif\" font-size=\"13\">\n"
      "<title>{2}</title>\n<rect width=\"{0:.0f}\" height=\"{1:.0f}\" fill=\"white\"/>\n{3}</svg>\n",
      width, height, xml_escaped(title), body_);
}

}  // namespace lorentz::pictures
