// Pictures of scenes, and of flights and paths in them.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include <lorentz/answer.hpp>
#include <lorentz/query.hpp>
#include <lorentz/scene.hpp>

namespace lorentz::pictures {

struct DrawnFlight {
  Query query;
  Answer answer;  ///< hit, never or inside
};

/// A corridor, to be shown.
struct FreeWay {
  Vec point{};   ///< on its middle line
  Vec vector{};  ///< along it
  double width = 0;
  std::string name;  ///< for the legend
};

struct DrawOptions {
  std::string title;                            ///< none if empty
  double width = 800;                           ///< of the picture, in pixels
  double height = 0;                            ///< maximum, legend included; 0: no limit
  std::optional<std::array<double, 4>> window;  ///< 2D: x0, y0, x1, y1, with x0 < x1 and y0 < y1
  std::vector<FreeWay> ways;                    ///< 2D
};

struct Drawing {
  std::string svg;
  std::vector<std::string> remarks;  ///< what the picture leaves out, and why
};

/// A few cells of a valid scene around the first cell or the first flight's start, or a window on it; a 3D
/// scene in orthographic projection. A cubic lattice with centred cells is shown in a cube.
Drawing draw_scene(const Scene& scene, const DrawOptions& options, const std::vector<DrawnFlight>& flights);

/// A picture of a particle's path among the obstacles of a 2D scene, and of another path from where they part.
struct PathDrawing {
  Scene scene;  ///< in two dimensions
  std::size_t collisions = 0;
  std::vector<Vec> path;      ///< the start, the places of collisions, possibly an end
  std::optional<Vec> escape;  ///< the velocity with which it goes on forever, if it does
  std::vector<Vec> other;     ///< another path beside it, or empty
  std::size_t parting = 0;    ///< index in `other` of the first place in which they differ
  std::string other_words;    ///< what the legend says of it
};

/// The picture as SVG, at most 800 pixels wide. Obstacles are left out if there are too many to be seen.
std::string draw_path(const PathDrawing& drawing);

}  // namespace lorentz::pictures
