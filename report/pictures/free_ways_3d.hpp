// Layers and cylinders that are free forever, cut to a block of cells. Private to report/pictures/.
#pragma once

#include <optional>
#include <vector>

#include <lorentz/geometry.hpp>
#include "report/pictures/drawing_parts.hpp"

namespace lorentz::pictures {

/// A parallelepiped.
struct DrawnBlock {
  Vec corner{};
  std::array<Vec, 3> edges{};

  Vec centre() const;
  Vec vertex(int number) const {  ///< 0 to 7
    Vec p = corner;
    for (int i = 0; i < 3; ++i)
      if (number >> i & 1) p = sum(p, edges[i]);
    return p;
  }
};

/// A flat piece of { x : normal.x = level }.
struct Facet {
  std::vector<Vec> corners;
  Vec normal{};
  double level = 0;
  std::size_t way = 0;  ///< number of its free way
};

/// The two faces of a layer in the block, for the translate nearest to the block's middle; fewer if they miss
/// the block.
std::vector<Facet> faces_of(const Scene& scene, const FreeWay& layer, std::size_t number,
                            const DrawnBlock& block);

/// The part of the facet where sign * (normal.x - level) >= 0.
Facet part_beside(const Facet& facet, const Vec& normal, double level, int sign);

/// The part of a cylinder's middle line in the block, for the translate with the longest part.
struct Axis {
  Vec from{}, to{};

  double length() const { return lorentz::length(plus(to, -1, from)); }
};
std::optional<Axis> axis_of(const Scene& scene, const FreeWay& cylinder, const DrawnBlock& block);

}  // namespace lorentz::pictures
