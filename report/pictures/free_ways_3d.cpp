// Layers and cylinders that are free forever, cut to a block of cells.
#include <algorithm>
#include <cmath>

#include <lorentz/geometry.hpp>
#include "report/pictures/drawing_parts.hpp"

namespace lorentz::pictures {
namespace {

// A square in the plane, large enough to contain the whole block.
Facet square_on(const Vec& normal, double level, const DrawnBlock& block) {
  const Vec unit = scaled(normal, 1 / length(normal));
  const Vec side = std::fabs(unit[0]) < 0.7 ? Vec{1, 0, 0} : Vec{0, 1, 0};
  Vec a = cross(unit, side);
  a = scaled(a, 1 / length(a));
  const Vec b = cross(unit, a), middle = block.centre();
  const Vec foot = sum(middle, scaled(unit, (level - dot(normal, middle)) / length(normal)));
  double reach = 0;
  for (const Vec& edge : block.edges) reach += length(edge);
  Facet facet{{}, normal, level, 0};
  for (const auto& [p, q] : {std::pair{1, 1}, {-1, 1}, {-1, -1}, {1, -1}})
    facet.corners.push_back(sum(foot, sum(scaled(a, p * reach), scaled(b, q * reach))));
  return facet;
}

// The range of t for which the line p + t v is in the block.
bool part_in_block(const DrawnBlock& block, const Vec& p, const Vec& v, double& first, double& last) {
  first = -1e300, last = 1e300;
  for (const Vec& row : dual_of(block.edges, 3)) {
    const double at = dot(row, plus(p, -1, block.corner)), step = dot(row, v);
    if (std::fabs(step) * length(block.edges[0]) < 1e-12 * length(v)) {
      if (at < 0 || at > 1) return false;
      continue;
    }
    first = std::max(first, std::min(-at / step, (1 - at) / step));
    last = std::min(last, std::max(-at / step, (1 - at) / step));
  }
  return first < last;
}

}  // namespace

Vec DrawnBlock::centre() const {
  return sum(corner, scaled(sum(sum(edges[0], edges[1]), edges[2]), 0.5));
}

// Sutherland and Hodgman's algorithm.
Facet part_beside(const Facet& facet, const Vec& normal, double level, int sign) {
  Facet part{{}, facet.normal, facet.level, facet.way};
  const std::size_t count = facet.corners.size();
  for (std::size_t i = 0; i < count; ++i) {
    const Vec &a = facet.corners[i], &b = facet.corners[(i + 1) % count];
    const double at_a = sign * (dot(normal, a) - level), at_b = sign * (dot(normal, b) - level);
    if (at_a >= 0) part.corners.push_back(a);
    if ((at_a >= 0) != (at_b >= 0))
      part.corners.push_back(sum(a, scaled(plus(b, -1, a), at_a / (at_a - at_b))));
  }
  return part;
}

std::vector<Facet> faces_of(const Scene& scene, const FreeWay& layer, std::size_t number,
                            const DrawnBlock& block) {
  // The planes of a single lattice are 1 apart in normal.x.
  double middle = dot(layer.vector, layer.point);
  if (scene.lattices.size() == 1) middle += std::round(dot(layer.vector, block.centre()) - middle);
  std::vector<Facet> faces;
  for (const int side : {-1, 1}) {
    Facet face = square_on(layer.vector, middle + side * layer.width / 2 * length(layer.vector), block);
    face.way = number;
    for (const Vec& row : dual_of(block.edges, 3)) {
      const double base = dot(row, block.corner);
      face = part_beside(part_beside(face, row, base, 1), row, base + 1, -1);
    }
    if (face.corners.size() > 2) faces.push_back(face);
  }
  return faces;
}

std::optional<std::array<Vec, 2>> axis_of(const Scene& scene, const FreeWay& cylinder,
                                          const DrawnBlock& block) {
  const auto& u = scene.lattices[0].vectors;
  const auto rows = dual_of(u, 3);
  Vec near = cylinder.point;
  for (int i = 0; i < 3; ++i)
    near = sum(near, scaled(u[i], std::round(dot(rows[i], plus(block.centre(), -1, cylinder.point)))));
  std::optional<std::array<Vec, 2>> longest;
  double most = 0;
  for (int n = 0; n < 27; ++n) {
    const Vec p =
        sum(near, sum(scaled(u[0], n % 3 - 1), sum(scaled(u[1], n / 3 % 3 - 1), scaled(u[2], n / 9 - 1))));
    double first = 0, last = 0;
    if (!part_in_block(block, p, cylinder.vector, first, last)) continue;
    const Vec from = sum(p, scaled(cylinder.vector, first)), to = sum(p, scaled(cylinder.vector, last));
    const double reach = length(plus(to, -1, from));
    if (longest && !(reach > 1.001 * most)) continue;
    longest = {from, to};
    most = reach;
  }
  return longest;
}

}  // namespace lorentz::pictures
