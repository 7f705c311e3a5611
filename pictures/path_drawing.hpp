// A picture of a particle's path among the obstacles of a plane scene, and of another from where they part.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <lorentz/scene.hpp>

namespace lorentz::pictures {

struct PathDrawing {
  Scene scene;  ///< in two dimensions
  std::size_t collisions = 0;
  std::vector<Vec> path;      ///< the start, places of collisions, perhaps an end
  std::optional<Vec> escape;  ///< the velocity with which it goes on for ever, if it does
  std::vector<Vec> other;     ///< another path beside it, or empty
  std::size_t parting = 0;    ///< the first place in which they differ, in `other`
  std::string other_name;     ///< whose it is
  double width = 800;         ///< in pixels, at most
};

/// As SVG. Obstacles are left out where there are too many of them to be seen.
std::string draw_path(const PathDrawing& drawing);

}  // namespace lorentz::pictures
