// Pictures of scenes and of flights in them.
#pragma once

#include <string>
#include <vector>

#include <lorentz/problem.hpp>

namespace lorentz::pictures {

struct Flight {
  Query query;
  Answer answer;  ///< hit, never or inside
};

struct Drawing {
  std::string svg;
  std::vector<std::string> remarks;  ///< what is not in the picture, and why
};

/// Some cells around the first, or around the first flight's start, of a scene without flaws; a 3D one in
/// orthographic projection.
Drawing draw_scene(const Scene& scene, const std::string& title, const std::vector<Flight>& flights);

}  // namespace lorentz::pictures
