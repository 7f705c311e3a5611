// Scenes with one of everything, and where the parts of their pictures are.
#pragma once

#include <lorentz/scene.hpp>
#include "src/problem/scene_geometry.hpp"
#include "tests/pictures/measures.hpp"

namespace lorentz::test {

inline constexpr const char *kFlight = "#c0182b", *kCell = "#222222", *kGrid = "#dcdcdc";

// Two lattices, one turned, with two atoms each; ellipses by axes that are not at right angles.
inline Scene crowd() {
  Scene scene = unit_scene(2, 0.12);
  scene.lattices[0].vectors = {Vec{1, 0.2, 0}, Vec{-0.3, 0.9, 0}, Vec{}};
  scene.lattices[0].atoms = {{{0.1, 0.05, 0}, 0.12, {}},
                             {{0.55, 0.5, 0}, 0, {{0.2, 0.1, 0}, {-0.02, 0.07, 0}}}};
  scene.lattices.push_back(
      {{Vec{1.04, 0.78, 0}, Vec{-0.78, 1.04, 0}, Vec{}},
       {{{0.3, 0.4, 0}, 0, {{0.03, 0.15, 0}, {0.06, 0, 0}}}, {{-0.2, 0.1, 0}, 0.05, {}}}});
  return scene;
}
// Semiaxes by hand: the eigenvalues of A A^T.
inline const std::vector<std::string> kCrowd{
    "lattice 0, atom 0: radius 0.12", "lattice 0, atom 1: semiaxes 0.2241, 0.07141",
    "lattice 1, atom 0: semiaxes 0.1535, 0.05863", "lattice 1, atom 1: radius 0.05"};

// Those whose square (of the longest semiaxis) reaches into the window.
inline std::vector<Wanted> within(std::vector<Wanted> all, const std::array<double, 4>& window) {
  std::erase_if(all, [&](const Wanted& one) {
    const auto [xx, xy, yy] = one.oval;
    const double reach = std::sqrt((xx + yy) / 2 + std::hypot((xx - yy) / 2, xy));
    return !Rectangle{{window[0], window[1]}, {window[2], window[3]}}.holds(one.centre, reach);
  });
  return all;
}

inline Inks clipped(const SvgPicture& picture, const std::string& kind, const std::string& attribute = "",
                    const std::string& value = "") {
  return picture.all(
      kind, [&](const Ink& ink) { return ink.clip && (attribute.empty() || ink.is(attribute, value)); });
}

// Obstacles of a plane scene: they are see-through, unless they are hit.
inline Inks drawn_obstacles(const SvgPicture& picture) {
  return clipped(picture, "ellipse", "fill-opacity", "0.7");
}

inline Spot spot(const Vec& a) {
  return {a[0], a[1]};
}

// How far a spot is from an obstacle's surface, in its radii about.
inline double off_surface(const Atom& atom, const Vec& centre, const Vec& place, int dimension) {
  Vec y{};
  const auto rows = dual_of(semiaxes_of(atom, dimension), dimension);
  for (int i = 0; i < dimension; ++i) y[i] = dot(rows[i], sum(place, scaled(centre, -1)));
  return std::fabs(length(y) - 1);
}

inline bool has_ends(const Ink& line, Spot a, Spot b, const Plane& plane) {
  return same_place(line.points.front(), a, plane) && same_place(line.points.back(), b, plane);
}

// The only arrow whose tip is there; it points along v, its head is 11 long.
inline bool has_arrow(const SvgPicture& picture, Spot from, Spot to, const Plane& plane) {
  int heads = 0;
  for (const Ink& head : picture.all("polygon", "fill", kFlight)) {
    if (!same_place(head.points[0], to, plane)) continue;
    const Spot a = head.points[1], b = head.points[2], neck{(a.x + b.x) / 2, (a.y + b.y) / 2};
    const Spot way = to - from, back = plane(neck) - to;
    const double along = (way.x * back.x + way.y * back.y) / std::hypot(way.x, way.y) * plane.scale,
                 beside = (way.x * back.y - way.y * back.x) / std::hypot(way.x, way.y) * plane.scale;
    const Spot across = plane(a) - plane(b);
    const double skew = (across.x * way.x + across.y * way.y) / std::hypot(way.x, way.y) * plane.scale;
    int shafts = 0;
    for (const Ink& line : picture.all("line", "stroke", kFlight))
      shafts += has_ends(line, from, plane(neck), plane);
    heads += std::fabs(along + 11) < 0.03 && std::fabs(beside) < 0.03 && std::fabs(skew) < 0.03 &&
             std::fabs(distance(a, b) - 2 * 0.38 * 11) < 0.03 && shafts == 1;
  }
  return heads == 1;
}

}  // namespace lorentz::test
