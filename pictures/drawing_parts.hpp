// What pictures in 2D and 3D share: which obstacles stand in a box, flights cut to a length, colours, the
// legend. Private to scene_drawing*.cpp.
#pragma once

#include <array>
#include <cstdint>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "pictures/scene_drawing.hpp"
#include "pictures/svg.hpp"
#include "src/problem/scene_geometry.hpp"

namespace lorentz::pictures {

inline constexpr std::size_t kMostDrawn = 5000;  ///< obstacles in one picture
inline constexpr double kLongestFlight = 40;  ///< in lengths of a cell; the rest is an arrow, if not before

struct Extent {
  Vec low{}, high{};

  void include(const Vec& point, double margin = 0);
  bool contains(const Vec& point, double margin) const;
  Vec centre() const;
};

/// An obstacle in the picture.
struct Placed {
  int lattice = 0, atom = 0;
  Vec centre{};
};

/// Obstacles that reach into the box, of lattice after lattice; at most a few times kMostDrawn, `cut` says
/// whether that was all.
std::vector<Placed> obstacles_in(const Scene& scene, const Extent& box, bool& cut);

/// Leaves the kMostDrawn nearest to a point, and remarks it.
void thin_out(std::vector<Placed>& obstacles, const Vec& centre, std::vector<std::string>& remarks);

/// A flight as a line: to the hit, or cut.
struct DrawnLine {
  Vec from{}, to{};
  bool ends = true;  ///< `to` is the hit (or, inside, the start), else it goes on: an arrow
  const DrawnFlight* flight = nullptr;
};

/// Flights with their ends. Those whose start is too far from the others to share a picture are left out;
/// those much longer than nearly all others are cut, for one of them would shrink the rest to a corner.
std::vector<DrawnLine> lines_of(const Scene& scene, const std::vector<DrawnFlight>& flights,
                                std::vector<std::string>& remarks);

/// The same for a given window: none is left out, and none is cut that may end there.
std::vector<DrawnLine> lines_in_window(const Scene& scene, const std::vector<DrawnFlight>& flights);

/// The obstacles that the flights hit or start in, each once.
std::vector<Placed> hits_of(const Scene& scene, const std::vector<DrawnLine>& lines);

/// For a picture, a lattice of fewer vectors is completed at right angles, by half as much again as its
/// obstacles take there. `missing` stays: nothing is repeated along these.
Scene with_cells(Scene scene);

/// The size of a cell of the first lattice: the d-th root of its volume.
double cell_size(const Scene& scene);

/// The lower corner of the first lattice's cell that holds the point; in directions in which the lattice does
/// not repeat, so that its first obstacle is in the middle.
Vec cell_at(const Scene& scene, const Vec& point);
/// The lower corner of a block of `cells` cells in each direction, with these vectors.
Vec cell_at(const Scene& scene, const std::array<Vec, 3>& vectors, const Vec& point, double cells);

/// A short basis of the lattice.
std::array<Vec, 3> short_vectors(const Lattice& lattice, int dimension);

/// Number of an atom among all of the scene, which chooses its colour.
std::size_t colour_index(const Scene& scene, const Placed& obstacle);

struct Colour {
  const char *fill, *dark, *light;
};
const Colour& colour(std::size_t index);

inline constexpr const char* kFlightColour = "#c0182b";

/// What an obstacle is called, e.g. "lattice 0, atom 1: radius 0.28".
std::string name_of(const Scene& scene, const Placed& obstacle);

/// What a picture shows, and its legend explains.
struct Legend {
  std::set<std::pair<int, int>> atoms;  ///< by lattice and number
  std::string cell;                     ///< what the cell is called; empty: none is drawn
  bool hits = false, inside = false, goes_on = false, never = false;  ///< of flights
  std::vector<std::size_t> ways;                                      ///< by number
  std::vector<std::string> notes;
};

/// The legend from `top` downwards; returns its lower end.
double add_legend(Svg& svg, const Scene& scene, const DrawOptions& options, const Legend& legend, double top);

/// Where on the paper there is room for the picture itself.
struct Page {
  double top = 0, width = 0, height = 0;

  /// `legend` is about what will be drawn: it takes its room.
  Page(const Scene& scene, const DrawOptions& options, const Legend& legend, double tallest);
};

/// The title, what was drawn on the page until now, and the legend from `bottom` on.
std::string finished(Svg& svg, const Scene& scene, const DrawOptions& options, const Legend& legend,
                     double bottom);

/// The colour of a free way.
const char* way_colour(std::size_t number);

/// { M y : |y| <= 1 } for the matrix with rows m1, m2, as an ellipse (a projection of an ellipsoid is one).
EllipseShape ellipse_of(const Vec& m1, const Vec& m2);

inline constexpr double kMargin = 24;

/// Pictures by dimension.
Drawing draw_scene_2d(const Scene& scene, const DrawOptions& options,
                      const std::vector<DrawnFlight>& flights);
Drawing draw_scene_3d(const Scene& scene, const DrawOptions& options,
                      const std::vector<DrawnFlight>& flights);

}  // namespace lorentz::pictures
