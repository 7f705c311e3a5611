// Colours that a page may set, clips and frames.
#include <algorithm>
#include <cmath>

#include "pictures/finding_parts.hpp"

namespace lorentz::pictures {
namespace {

std::string fill_of(Ink ink) {
  return fmt::format("fill:var({},{})", ink.variable, ink.otherwise);
}
std::string stroke_of(Ink ink) {
  return fmt::format("stroke:var({},{})", ink.variable, ink.otherwise);
}

}  // namespace

std::string paint(Ink fill) {
  return fmt::format("fill=\"{}\" style=\"{}\"", fill.otherwise, fill_of(fill));
}

std::string paint(Ink fill, Ink stroke, double width) {
  return fmt::format("fill=\"{}\" stroke=\"{}\" stroke-width=\"{}\" style=\"{};{}\"", fill.otherwise,
                     stroke.otherwise, width, fill_of(fill), stroke_of(stroke));
}

std::string outline(Ink stroke, double width) {
  return fmt::format("stroke=\"{}\" stroke-width=\"{}\" style=\"{}\"", stroke.otherwise, width,
                     stroke_of(stroke));
}

// A nested <svg> cuts off everything beyond it, and needs no id.
void open_clip(Svg& svg, const Panel& panel) {
  svg.raw(
      fmt::format("<svg x=\"{0:.2f}\" y=\"{1:.2f}\" width=\"{2:.2f}\" height=\"{3:.2f}\" "
                  "viewBox=\"{0:.2f} {1:.2f} {2:.2f} {3:.2f}\" overflow=\"hidden\">\n",
                  panel.left, panel.top, panel.width, panel.height));
}

void close_clip(Svg& svg) {
  svg.raw("</svg>\n");
}

void frame(Svg& svg, const Panel& panel, const std::string& style) {
  svg.rectangle({panel.left, panel.top}, {panel.right(), panel.bottom()}, "fill=\"none\" " + style);
}

void open_hint(Svg& svg, const std::string& words) {
  svg.raw("<g><title>" + xml_escaped(words) + "</title>\n");
}

double on_paper(double pixels) {
  constexpr double kFar = 1e5;
  return std::isnan(pixels) ? kFar : std::clamp(pixels, -kFar, kFar);
}

}  // namespace lorentz::pictures
