#include "cases/parts.hpp"

#include <bit>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include <lorentz/certified.hpp>
#include <lorentz/geometry.hpp>

namespace lorentz::cases {
namespace {

// Binary64 values in order, as integers: -0 and +0 both 0.
std::int64_t rank_of(double x) {
  const auto bits = std::bit_cast<std::int64_t>(x);
  return bits < 0 ? std::numeric_limits<std::int64_t>::min() - bits : bits;
}

double of_rank(std::int64_t rank) {
  return std::bit_cast<double>(rank < 0 ? std::numeric_limits<std::int64_t>::min() - rank : rank);
}

}  // namespace

bool same(const Scene& a, const Scene& b) {
  if (a.dimension != b.dimension || a.lattices.size() != b.lattices.size()) return false;
  for (std::size_t l = 0; l < a.lattices.size(); ++l) {
    const Lattice &one = a.lattices[l], &other = b.lattices[l];
    if (one.vectors != other.vectors || one.atoms.size() != other.atoms.size()) return false;
    for (std::size_t i = 0; i < one.atoms.size(); ++i)
      if (one.atoms[i].position != other.atoms[i].position || one.atoms[i].radius != other.atoms[i].radius ||
          one.atoms[i].semiaxes != other.atoms[i].semiaxes)
        return false;
  }
  return true;
}

double moved(double x, std::int64_t ulps) {
  constexpr double kLargest = std::numeric_limits<double>::max();
  const double there = of_rank(rank_of(x) + ulps);
  return std::isfinite(there) ? there : std::copysign(kLargest, x);
}

double middle(double a, double b) {
  const std::int64_t one = rank_of(a), other = rank_of(b);
  return of_rank((one >> 1) + (other >> 1) + (one & other & 1));
}

void jitter(Random& random, Vec& a, int dimension, std::int64_t most) {
  for (int i = 0; i < dimension; ++i)
    if (a[i] != 0) a[i] = moved(a[i], random.integer(-most, most));
}

std::int64_t drawn_ulps(Random& random) {
  const std::int64_t most = std::int64_t{1} << random.integer(0, 10);
  return random.integer(1, most) * (random.one_in(2) ? 1 : -1);
}

Vec sum(const Vec& a, const Vec& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}

Vec scaled(const Vec& a, double factor) {
  return {a[0] * factor, a[1] * factor, a[2] * factor};
}

Vec cross(const Vec& a, const Vec& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

double length(const Vec& a) {
  return std::sqrt(lorentz::dot(a, a));
}

Scene lattice_scene(int dimension, const std::array<Vec, 3>& vectors, double radius) {
  Scene scene = unit_scene(dimension, radius);
  scene.lattices[0].vectors = vectors;
  return scene;
}

void set_radius(Scene& scene, double radius) {
  for (Lattice& lattice : scene.lattices)
    for (Atom& atom : lattice.atoms)
      if (atom.is_ball()) atom.radius = radius;
}

void scale_obstacles(Scene& scene, double factor) {
  for (Lattice& lattice : scene.lattices)
    for (Atom& atom : lattice.atoms) {
      atom.radius *= factor;
      for (Vec& axis : atom.semiaxes) axis = scaled(axis, factor);
    }
}

double volume(const Lattice& lattice, int dimension) {
  const auto& u = lattice.vectors;
  const double plane = u[0][0] * u[1][1] - u[0][1] * u[1][0];
  if (dimension == 2) return std::fabs(plane);
  return std::fabs(u[2][0] * (u[0][1] * u[1][2] - u[0][2] * u[1][1]) +
                   u[2][1] * (u[0][2] * u[1][0] - u[0][0] * u[1][2]) + u[2][2] * plane);
}

double half_width(const Lattice& lattice, int dimension, const IntVec& indices) {
  if (dimension == 2) return volume(lattice, 2) / (2 * length(cartesian(lattice, indices)));
  const auto dual = dual_of(lattice.vectors, 3);
  Vec normal{};
  for (int i = 0; i < 3; ++i) normal = sum(normal, scaled(dual[i], static_cast<double>(indices[i])));
  return 1 / (2 * length(normal));
}

const oracle::Oracle& oracle_of(const Scene& scene) {
  thread_local std::optional<std::pair<Scene, oracle::Oracle>> last;
  if (!last || !same(last->first, scene)) last.emplace(scene, oracle::Oracle(scene));
  return last->second;
}

Vec point_in_cell(Random& random, const Scene& scene) {
  Vec x{};
  for (int i = 0; i < scene.dimension; ++i)
    x = sum(x, scaled(scene.lattices[0].vectors[i], random.uniform()));
  return x;
}

namespace {

// Exact, by certified: for most points a few comparisons in binary64.
bool is_free(const Scene& scene, const Vec& x) {
  struct Latest {
    explicit Latest(const Scene& scene) : scene(scene), engine(scene) {}
    Scene scene;
    oracle::Certified engine;
  };
  thread_local std::optional<Latest> last;
  if (!last || !same(last->scene, scene)) last.emplace(scene);
  const Vec any = scene.dimension == 2 ? Vec{1, 0.625, 0} : Vec{1, 0.625, 0.4375};
  oracle::Request at_once;
  at_once.max_time = 0;
  return last->engine.first_hit({x, any, {}}, at_once).outcome != Outcome::inside;
}

}  // namespace

Vec free_point(Random& random, const Scene& scene) {
  constexpr int kTries = 20;
  for (int tries = 1;; ++tries) {
    const Vec x = point_in_cell(random, scene);
    if (tries == kTries || is_free(scene, x)) return x;
  }
}

Symmetry::Symmetry(Random& random, int dimension) {
  for (int i = dimension - 1; i > 0; --i)
    std::swap(from_[i], from_[random.below(static_cast<std::uint64_t>(i) + 1)]);
  for (int i = 0; i < dimension; ++i) sign_[i] = random.one_in(2) ? 1 : -1;
}

Vec Symmetry::operator()(const Vec& a) const {
  Vec image{};
  for (int i = 0; i < 3; ++i) image[i] = a[from_[i]] == 0 ? 0.0 : sign_[i] * a[from_[i]];
  return image;
}

ObstacleId Symmetry::operator()(const ObstacleId& id) const {
  ObstacleId image = id;
  for (int i = 0; i < 3; ++i) image.cell[i] = Integer(sign_[i] * id.cell[from_[i]].int64());
  return image;
}

ObstacleId obstacle(std::int64_t a, std::int64_t b, std::int64_t c, int atom) {
  return {0, atom, {Integer(a), Integer(b), Integer(c)}};
}

}  // namespace lorentz::cases
