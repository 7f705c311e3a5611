// Pictures of scenes and of flights in them.
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

/// A way that is free for ever, to be shown.
struct FreeWay {
  enum class Kind { corridor, layer, cylinder };
  Kind kind = Kind::corridor;
  Vec point{};       ///< on its middle line or plane
  Vec vector{};      ///< along it; of a layer the normal, the reciprocal vector of its planes
  double width = 0;  ///< of a cylinder twice the radius
  std::string name;  ///< for the legend
};

struct DrawOptions {
  std::string title;                            ///< none if empty
  double width = 800;                           ///< of the picture, in pixels
  double height = 0;                            ///< at most so high, legend included; 0: as high as it gets
  bool legend = true;                           ///< with the notes beneath
  std::optional<std::array<double, 4>> window;  ///< 2D: x0, y0, x1, y1, with x0 < x1 and y0 < y1
  std::vector<FreeWay> ways;
};

struct Drawing {
  std::string svg;
  std::vector<std::string> remarks;  ///< what is not in the picture, and why
};

/// Some cells around the first, or around the first flight's start, of a scene without flaws, or a window on
/// it; a 3D one in orthographic projection. A cubic lattice with centred cells is shown in a cube.
Drawing draw_scene(const Scene& scene, const DrawOptions& options, const std::vector<DrawnFlight>& flights);

}  // namespace lorentz::pictures
