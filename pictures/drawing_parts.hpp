// What pictures in 2D and 3D share: which obstacles stand in a box, flights cut to a length, colours, the
// legend. Private to scene_drawing*.cpp.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "pictures/scene_drawing.hpp"
#include "pictures/svg.hpp"
#include "src/problem/scene_geometry.hpp"

namespace lorentz::pictures {

inline constexpr std::size_t kMostDrawn = 5000;  ///< obstacles in one picture
inline constexpr double kLongestFlight = 40;     ///< in lengths of a cell; the rest is an arrow

struct Box {
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
std::vector<Placed> obstacles_in(const Scene& scene, const Box& box, bool& cut);

/// Leaves the kMostDrawn nearest to a point, and remarks it.
void thin_out(std::vector<Placed>& obstacles, const Vec& centre, std::vector<std::string>& remarks);

/// A flight as a line: to the hit, or cut.
struct Line {
  Vec from{}, to{};
  bool ends = true;  ///< `to` is the hit (or, inside, the start), else it goes on: an arrow
  const Flight* flight = nullptr;
};

/// Flights with their ends; those whose start is too far from the others to share a picture are left out.
std::vector<Line> lines_of(const Scene& scene, const std::vector<Flight>& flights,
                           std::vector<std::string>& remarks);

/// The obstacles that the flights hit or start in, each once.
std::vector<Placed> hits_of(const Scene& scene, const std::vector<Line>& lines);

/// The size of a cell of the first lattice: the d-th root of its volume.
double cell_size(const Scene& scene);

/// The lower corner of the first lattice's cell that holds the point.
Vec cell_at(const Scene& scene, const Vec& point);

/// Number of an atom among all of the scene, which chooses its colour.
std::size_t colour_index(const Scene& scene, const Placed& obstacle);

struct Colour {
  const char *fill, *dark, *light;
};
const Colour& colour(std::size_t index);

inline constexpr const char* kFlightColour = "#c0182b";

/// What an obstacle is called, e.g. "lattice 0, atom 1: radius 0.28".
std::string name_of(const Scene& scene, const Placed& obstacle);

/// The legend from `top` downwards; returns its lower end.
double add_legend(Svg& svg, const Scene& scene, double top, bool flights,
                  const std::vector<std::string>& notes);

/// { M y : |y| <= 1 } for the matrix with rows m1, m2, as an ellipse (a projection of an ellipsoid is one).
EllipseShape ellipse_of(const Vec& m1, const Vec& m2);

inline constexpr double kPictureWidth = 800, kMargin = 24, kTitleHeight = 40;

/// Pictures by dimension.
Drawing draw_scene_2d(const Scene& scene, const std::string& title, const std::vector<Flight>& flights);
Drawing draw_scene_3d(const Scene& scene, const std::string& title, const std::vector<Flight>& flights);

}  // namespace lorentz::pictures
