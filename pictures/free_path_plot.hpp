// A picture of free paths: measured points and curves of theory over t, with both axes logarithmic or linear.
#pragma once

#include <string>
#include <vector>

#include "pictures/svg.hpp"

namespace lorentz::pictures {

/// A measured value with its standard error. Values that are not finite are left out; on logarithmic axes
/// also those that are not above 0. An error bar that reaches 0 extends to the edge of the picture.
struct MeasuredPoint {
  double t = 0, value = 0, error = 0;
};

/// Each series has a colour and a marker of its own: circle, square, triangle, diamond, ..
struct PlotSeries {
  std::string name;
  std::vector<MeasuredPoint> points;
};

/// A line through (t, value), in the colour of the series `series` (-1: grey), solid or dashed.
struct PlotCurve {
  std::string name;  ///< for the legend; empty: not in the legend
  std::vector<Point> points;
  int series = -1;
  bool dashed = false;
};

/// Linear axes begin at 0, and show nothing below it.
enum class AxisScale { logarithmic, linear };

struct FreePathPlot {
  std::string title, note;  ///< above and below the picture; none if empty
  AxisScale axes = AxisScale::logarithmic;
  std::string t_label = "t", value_label = "P(free path > t)";
  std::vector<PlotSeries> series;
  std::vector<PlotCurve> curves;
  double width = 800, height = 600;  ///< in pixels; legible at half of that
};

/// The picture as SVG. The axes contain all measured points; curves that reach further are cut where there is
/// nothing more worth showing. Throws std::invalid_argument if there is nothing to show.
std::string draw_free_paths(const FreePathPlot& plot);

}  // namespace lorentz::pictures
