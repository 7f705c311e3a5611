// The common parts of pictures in 2D and 3D: the obstacles in a box, flights cut to a length, colours, the
// legend. Private to scene_drawing*.cpp.
#pragma once

#include <array>
#include <cmath>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <lorentz/geometry.hpp>
#include "report/pictures/scene_drawing.hpp"
#include "report/pictures/svg.hpp"
#include "src/problem/scene_geometry.hpp"

namespace lorentz::pictures {

inline constexpr std::size_t kMostDrawn = 5000;  ///< obstacles in one picture
inline constexpr double kLongestFlight = 40;  ///< in cell sizes; a longer flight is cut here or earlier, and
                                              ///< drawn as an arrow

struct Extent {
  Vec low{}, high{};

  void include(const Vec& point, double margin = 0);
  bool contains(const Vec& point, double margin) const;
  Vec centre() const { return {(low[0] + high[0]) / 2, (low[1] + high[1]) / 2, (low[2] + high[2]) / 2}; }
  double width() const { return high[0] - low[0]; }
  double height() const { return high[1] - low[1]; }
  double diagonal() const { return std::hypot(width(), height()); }
};

/// An obstacle in the picture.
struct Placed {
  int lattice = 0, atom = 0;
  Vec centre{};
};

/// Obstacles that reach into the box, lattice by lattice. There are at most a few times kMostDrawn; `cut` is
/// set if others were left out.
std::vector<Placed> obstacles_in(const Scene& scene, const Extent& box, bool& cut);

/// Keeps the kMostDrawn obstacles nearest to a point, and adds a remark.
void thin_out(std::vector<Placed>& obstacles, const Vec& centre, std::vector<std::string>& remarks);

/// A flight as a line, to the hit or cut.
struct DrawnLine {
  Vec from{}, to{};
  bool ends = true;  ///< `to` is the hit (or, if inside, the start); else the flight goes on: an arrow
  const DrawnFlight* flight = nullptr;
};

/// Flights with their ends. A flight is left out if it starts too far away to share a picture with the
/// others. A flight much longer than nearly all others is cut, because it would shrink the rest to a corner.
std::vector<DrawnLine> lines_of(const Scene& scene, const std::vector<DrawnFlight>& flights,
                                std::vector<std::string>& remarks);

/// The same for a given window: no flight is left out, and none that may end there is cut.
std::vector<DrawnLine> lines_in_window(const Scene& scene, const std::vector<DrawnFlight>& flights);

/// The obstacles that the flights hit or start in, each once.
std::vector<Placed> hits_of(const Scene& scene, const std::vector<DrawnLine>& lines);

/// For a picture, completes a lattice with too few vectors by vectors at right angles, which are half as long
/// again as its obstacles need there. `rank` is kept: nothing is repeated along these vectors.
Scene with_cells(Scene scene);

/// The size of a cell of the first lattice: the d-th root of its volume.
double cell_size(const Scene& scene);

/// The lower corner of the first lattice's cell with these vectors that holds the point. In directions in which
/// the lattice does not repeat, a block of `cells` cells has the first obstacle in its middle.
Vec cell_at(const Scene& scene, const std::array<Vec, 3>& vectors, const Vec& point, double cells = 1);

/// The number of an atom among all atoms of the scene; it determines the colour.
std::size_t colour_index(const Scene& scene, const Placed& obstacle);

struct Colour {
  const char *fill, *dark, *light;
};
const Colour& colour(std::size_t index);

inline constexpr const char* kFlightColour = "#c0182b";

/// The name of an obstacle, e.g. "lattice 0, atom 1: radius 0.28".
std::string name_of(const Scene& scene, const Placed& obstacle);

/// The parts of a picture that its legend explains.
struct Legend {
  std::set<std::pair<int, int>> atoms;  ///< by lattice and number
  std::string cell;                     ///< the cell's name; empty: no cell is drawn
  bool hits = false, inside = false, goes_on = false, never = false;  ///< of flights
  std::vector<std::size_t> ways;                                      ///< by number
  std::vector<std::string> notes;
};

/// The space on the paper for the picture itself.
struct Page {
  double top = 0, width = 0, height = 0;

  /// `legend` is the legend of the final picture; its space is reserved.
  Page(const Scene& scene, const DrawOptions& options, const Legend& legend, double tallest);
};

/// The title, the drawing so far, and the legend from `bottom` on.
std::string finished(Svg& svg, const Scene& scene, const DrawOptions& options, const Legend& legend,
                     double bottom);

/// The colour of a free way.
const char* way_colour(std::size_t number);

/// { M y : |y| <= 1 } for the matrix with rows m1, m2, as an ellipse (a projection of an ellipsoid is one).
EllipseShape ellipse_of(const Vec& m1, const Vec& m2);

/// The outline of an obstacle seen from afar, in the unit of length; angles towards +up.
EllipseShape shadow_of(const Atom& atom, int dimension, const Vec& right, const Vec& up);

/// The same on paper, where y points down: a dot of radius `smallest` if it is smaller.
EllipseShape to_scale(const EllipseShape& shape, double scale, double smallest = 0);

inline constexpr double kMargin = 24;

/// A window on the plane, on paper, with y upwards.
struct PaperWindow {
  Extent box;
  double scale = 1;  ///< pixels per unit of length
  double left = kMargin, top = kMargin;

  Point operator()(const Vec& p) const {
    return {left + scale * (p[0] - box.low[0]), top + scale * (box.high[1] - p[1])};
  }
  double width() const { return scale * box.width(); }
  double height() const { return scale * box.height(); }
};

// ---- in space

/// The cell that is drawn for a lattice.
struct ShownCell {
  std::array<Vec, 3> vectors{};
  int primitive_cells = 1;  ///< contained in it: 1, or in a cube 2 (bcc) or 4 (fcc)
};

/// The cube of a body-centred or face-centred cubic lattice (rounded vectors are recognised), or the primitive
/// cell.
ShownCell shown_cell(const Lattice& lattice);

/// Pictures by dimension.
Drawing draw_scene_2d(const Scene& scene, const DrawOptions& options,
                      const std::vector<DrawnFlight>& flights);
Drawing draw_scene_3d(const Scene& scene, const DrawOptions& options,
                      const std::vector<DrawnFlight>& flights);

}  // namespace lorentz::pictures
