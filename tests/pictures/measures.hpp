// What the pictures of scenes are measured by: which obstacles have to be there, as ovals in the scene's
// units.
#pragma once

#include <catch2/catch.hpp>
#include <cmath>

#include <lorentz/geometry.hpp>
#include "tests/support/support.hpp"
#include "tests/support/svg_reader.hpp"

namespace lorentz::test {

/// What has to be drawn, and what the legend calls it.
struct Wanted {
  Spot centre;
  Oval oval;
  std::string name;
  Vec place{};  ///< its centre, in space
};

/// The shadow of an obstacle on the plane of two directions of length 1.
inline Oval shadow(const Atom& atom, int dimension, const Vec& right, const Vec& up) {
  Oval oval;
  for (const Vec& axis : semiaxes_of(atom, dimension)) {
    const double x = dot(right, axis), y = dot(up, axis);
    oval.xx += x * x;
    oval.xy += x * y;
    oval.yy += y * y;
  }
  return oval;
}

/// All obstacles in cells up to `most`, by lattice and atom; `names` are what the legend calls the atoms.
inline std::vector<Wanted> obstacles_of(const Scene& scene, int most, const std::vector<std::string>& names,
                                        const Vec& right = {1, 0, 0}, const Vec& up = {0, 1, 0}) {
  std::vector<Wanted> all;
  std::size_t index = 0;
  for (const Lattice& lattice : scene.lattices)
    for (const Atom& atom : lattice.atoms) {
      const std::string name = names.at(index++);
      const int deep = scene.dimension == 3 ? most : 0;
      for (int i = -most; i <= most; ++i)
        for (int k = -most; k <= most; ++k)
          for (int m = -deep; m <= deep; ++m) {
            const auto& u = lattice.vectors;
            const Vec c = sum(sum(atom.position, scaled(u[0], i)), sum(scaled(u[1], k), scaled(u[2], m)));
            all.push_back({{dot(right, c), dot(up, c)}, shadow(atom, scene.dimension, right, up), name, c});
          }
    }
  return all;
}

/// To about the hundredth of a pixel that is written.
inline bool same_place(Spot paper, Spot data, const Plane& plane) {
  return distance(plane(paper), data) * plane.scale < 0.02;
}

inline bool same_oval(const Oval& paper, const Oval& data, const Plane& plane) {
  const Oval seen = plane(paper);
  const double slack = 0.03 * std::sqrt(data.xx + data.yy) / plane.scale;
  return std::fabs(seen.xx - data.xx) < slack && std::fabs(seen.xy - data.xy) < slack &&
         std::fabs(seen.yy - data.yy) < slack;
}

/// Each is drawn once, at its place, of its size and tilt, in the colours of its legend's entry; and nothing
/// else is.
inline void check_drawn(const SvgPicture& picture, const Inks& drawn, const Plane& plane,
                        const std::vector<Wanted>& wanted) {
  CHECK(drawn.size() == wanted.size());
  for (const Wanted& one : wanted) {
    INFO(one.name << " at " << one.centre.x << ", " << one.centre.y);
    std::size_t times = 0;
    for (const Ink& ink : drawn) {
      if (!same_place(ink.centre, one.centre, plane) || !same_oval(ink.oval, one.oval, plane)) continue;
      const Ink mark = picture.mark_of(one.name);
      const auto shade = picture.shades.find(ink["fill"]);
      const std::string fill = shade == picture.shades.end() ? ink["fill"] : shade->second.at(1);
      times += fill == mark["fill"] && ink.is("stroke", mark["stroke"]);
    }
    CHECK(times == 1);
  }
}

/// The plane of a window that is seen in this rectangle.
inline Plane plane_of(const Rectangle& seen, const std::array<double, 4>& window) {
  const double scale = seen.width() / (window[2] - window[0]);
  return {{seen.low.x - scale * window[0], seen.high.y + scale * window[1]}, scale};
}

}  // namespace lorentz::test
