// Drawn cases for the tests: scenes and queries that aim at the boundary. Everything follows from the seed.
#pragma once

#include <unistd.h>

#include <bit>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <random>
#include <string>

#include <lorentz/answer.hpp>
#include <lorentz/exchange.hpp>
#include <lorentz/query.hpp>
#include <lorentz/scene.hpp>

namespace lorentz::test {

/// A file name of its own in the folder for temporary files.
inline std::string temporary_file() {
  char name[] = "/tmp/lorentz-test-XXXXXX";
  close(mkstemp(name));
  return name;
}

/// The catalogue, by name.
inline std::map<std::string, Scene> all_scenes() {
  std::map<std::string, Scene> scenes;
  for (const auto& file : std::filesystem::directory_iterator(LORENTZ_SOURCE_DIR "/data/scenes"))
    scenes[file.path().stem()] = read_scene_file(file.path());
  return scenes;
}

class Draw {
 public:
  explicit Draw(std::uint64_t seed) : bits_(seed) {}
  std::uint64_t below(std::uint64_t n) { return bits_() % n; }
  bool one_in(std::uint64_t n) { return below(n) == 0; }
  double uniform() { return static_cast<double>(bits_() >> 11) * 0x1p-53; }
  double between(double low, double high) { return low + (high - low) * uniform(); }
  double finite() {  ///< any
    for (;;)
      if (const auto value = std::bit_cast<double>(below(1ull << 32) << 32 | below(1ull << 32));
          std::isfinite(value))
        return value;
  }
  double sign() { return one_in(2) ? 1 : -1; }
  /// Log-uniform in size from 2^low to 2^high, either sign.
  double tiny(double low, double high) { return sign() * std::exp2(between(low, high)); }
  /// A multiple of 1/denominator in [-range, range].
  double fraction(int denominator, int range) {
    const auto steps = static_cast<std::uint64_t>(2 * range * denominator + 1);
    return (static_cast<double>(below(steps)) - range * denominator) / denominator;
  }
  Vec vec(int dimension, double low, double high) {
    Vec a{};
    for (int i = 0; i < dimension; ++i) a[i] = between(low, high);
    return a;
  }

 private:
  std::mt19937_64 bits_;
};

inline double determinant(const Lattice& lattice, int dimension) {
  const auto& u = lattice.vectors;
  if (dimension == 2) return u[0][0] * u[1][1] - u[0][1] * u[1][0];
  return u[0][0] * (u[1][1] * u[2][2] - u[1][2] * u[2][1]) -
         u[0][1] * (u[1][0] * u[2][2] - u[1][2] * u[2][0]) +
         u[0][2] * (u[1][0] * u[2][1] - u[1][1] * u[2][0]);
}

/// In no obstacle of a scene with some at the corners of unit cells: in the middle.
inline Query start_between(Draw& draw, int dimension) {
  Query start;
  for (int i = 0; i < dimension; ++i) start.x[i] = draw.between(0.42, 0.58);
  start.v = draw.vec(dimension, -1, 1);
  return start;
}

/// How the numbers of a drawn case look: generic, on a coarse grid (ties, tangents, rational slopes), or on
/// the grid and a little off it (near-rational slopes, nearly touching, nearly parallel).
enum class Style { generic, grid, near_grid };

inline double number(Draw& draw, Style style, double range) {
  if (style == Style::generic) return draw.between(-range, range);
  const double on_grid = draw.fraction(4, static_cast<int>(range));
  return style == Style::grid || draw.one_in(2) ? on_grid : on_grid + draw.tiny(-50, -8);
}

inline Vec vec_of(Draw& draw, Style style, int dimension, double range) {
  Vec a{};
  for (int i = 0; i < dimension; ++i) a[i] = number(draw, style, range);
  return a;
}

inline double radius_of(Draw& draw, Style style) {
  constexpr double kGrid[] = {0.125, 0.25, 0.3125, 0.375, 0.5, 0.625, 0.75, 1};
  if (style == Style::generic) return draw.between(0.03, 0.7);
  const double r = kGrid[draw.below(8)];
  return style == Style::grid || draw.one_in(2) ? r : r * (1 + draw.tiny(-50, -8));
}

inline Lattice lattice_of(Draw& draw, Style style, int dimension) {
  Lattice lattice;
  if (draw.one_in(2)) {
    lattice = unit_scene(dimension, 1).lattices[0];
  } else {
    do
      for (int i = 0; i < dimension; ++i) lattice.vectors[i] = vec_of(draw, style, dimension, 1.5);
    while (std::fabs(determinant(lattice, dimension)) < 0.05);
  }
  lattice.atoms.resize(draw.one_in(4) ? 1 + draw.below(3) : 1);
  for (Atom& atom : lattice.atoms) {
    atom.radius = radius_of(draw, style);
    atom.position = draw.one_in(3) ? vec_of(draw, style, dimension, 1) : Vec{};
  }
  return lattice;
}

inline Scene scene_of(Draw& draw, Style style, int dimension) {
  Scene scene;
  scene.dimension = dimension;
  for (std::uint64_t lattices = draw.one_in(5) ? 2 : 1; lattices > 0; --lattices)
    scene.lattices.push_back(lattice_of(draw, style, dimension));
  return scene;
}

/// Independent vectors of the obstacle's size: an ellipsoid in any position.
inline std::vector<Vec> semiaxes_of(Draw& draw, Style style, int dimension) {
  Lattice axes;
  do
    for (int i = 0; i < dimension; ++i) {
      axes.vectors[i] = vec_of(draw, style, dimension, 1);
      for (double& component : axes.vectors[i]) component /= 2;
    }
  while (std::fabs(determinant(axes, dimension)) < (dimension == 2 ? 0.02 : 0.004));
  return {axes.vectors.begin(), axes.vectors.begin() + dimension};
}

/// The scene with ellipsoids in place of its balls: of all of them, or of some.
inline Scene with_ellipsoids(Draw& draw, Style style, Scene scene) {
  const bool all = draw.one_in(2);
  for_each_atom(scene, [&](Atom& atom) {
    if (all || draw.one_in(2)) atom = {atom.position, 0, semiaxes_of(draw, style, scene.dimension)};
  });
  return scene;
}

/// A point about on the surface of the atom's obstacle, seen from its centre, for a unit vector y.
inline Vec surface_point(const Atom& atom, const Vec& y) {
  Vec point{};
  for (std::size_t k = 0; k < 3; ++k) {
    if (atom.is_ball()) point[k] = atom.radius * y[k];
    for (std::size_t i = 0; i < atom.semiaxes.size(); ++i) point[k] += atom.semiaxes[i][k] * y[i];
  }
  return point;
}

/// The centre of an obstacle in a small cell, in binary64.
inline Vec centre_of(const Scene& scene, const ObstacleId& id) {
  const Lattice& lattice = scene.lattices[id.lattice];
  Vec centre = lattice.atoms[id.atom].position;
  for (int i = 0; i < scene.dimension; ++i)
    for (int k = 0; k < scene.dimension; ++k)
      centre[k] += static_cast<double>(id.cell[i].int64()) * lattice.vectors[i][k];
  return centre;
}

inline ObstacleId obstacle_of(Draw& draw, const Scene& scene) {
  ObstacleId id;
  id.lattice = static_cast<int>(draw.below(scene.lattices.size()));
  id.atom = static_cast<int>(draw.below(scene.lattices[id.lattice].atoms.size()));
  for (int i = 0; i < scene.lattices[id.lattice].rank_in(scene.dimension); ++i)
    id.cell[i] = Integer(static_cast<std::int64_t>(draw.below(3)) - 1);
  return id;
}

/// A start anywhere, or on (or ulps from) an obstacle's surface, with or without `from`.
inline Query query_of(Draw& draw, Style style, const Scene& scene) {
  const int d = scene.dimension;
  Query query;
  query.x = draw.one_in(2) ? vec_of(draw, style, d, 1) : draw.vec(d, 0, 1);
  do query.v = vec_of(draw, style, d, 2);
  while (query.v == Vec{});
  if (draw.one_in(3)) {
    const ObstacleId id = obstacle_of(draw, scene);
    if (draw.one_in(2)) query.from = id;
    if (draw.one_in(2)) {
      const Vec centre = centre_of(scene, id);
      Vec arm = vec_of(draw, style, d, 1);
      const double length = std::hypot(arm[0], arm[1], arm[2]);
      for (double& component : arm) component /= length;
      const Vec place = surface_point(scene.lattices[id.lattice].atoms[id.atom], arm);
      if (length > 0)
        for (int k = 0; k < d; ++k) query.x[k] = centre[k] + place[k];
    }
  }
  return query;
}

inline Query reversed(Query query) {
  for (double& component : query.v) component = -component;
  return query;
}

/// For failure messages: a query stream that reproduces the case.
inline std::string stream(const Scene& scene, const Query& query) {
  std::string out;
  append_scene_line(out, scene);
  append_query_line(out, "1", query, scene);
  return out;
}

inline std::string line(const Answer& answer, const Components& count) {
  std::string out;
  append_answer_line(out, "1", answer, count);
  return out;
}

/// Same outcome and obstacle.
inline bool same_obstacle(const Answer& a, const Answer& b) {
  const bool named = a.outcome == Outcome::hit || a.outcome == Outcome::inside;
  return a.outcome == b.outcome && (!named || a.obstacle == b.obstacle);
}

/// Same outcome, obstacle and time, to the bit.
inline bool same(const Answer& a, const Answer& b) {
  return same_obstacle(a, b) && (a.outcome != Outcome::hit || a.time == b.time);
}

}  // namespace lorentz::test
