// A picture of a particle's path among the obstacles of a 2D scene, and of another path from where they part.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <lorentz/scene.hpp>

namespace lorentz::pictures {

struct PathDrawing {
  Scene scene;  ///< in two dimensions
  std::size_t collisions = 0;
  std::vector<Vec> path;      ///< the start, the places of collisions, possibly an end
  std::optional<Vec> escape;  ///< the velocity with which it goes on forever, if it does
  std::vector<Vec> other;     ///< another path beside it, or empty
  std::size_t parting = 0;    ///< index in `other` of the first place in which they differ
  std::string other_name;     ///< the name of the other path
};

/// The picture as SVG, at most 800 pixels wide. Obstacles are left out if there are too many to be seen.
std::string draw_path(const PathDrawing& drawing);

}  // namespace lorentz::pictures
