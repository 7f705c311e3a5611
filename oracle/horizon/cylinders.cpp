#include "oracle/horizon/cylinders.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "oracle/exact/quadratic.hpp"
#include "oracle/exact/short_basis.hpp"
#include "oracle/horizon/shadow_hole.hpp"
#include "oracle/integers/dyadic.hpp"

namespace lorentz::oracle {
namespace {

constexpr std::size_t kMostPlanes = 20'000;
constexpr double kMostInPlane = 5'000;  // directions
constexpr std::size_t kMostCylinderWork =
    10'000'000;  // blocks placed, points and discs compared: a few microseconds each

// How the blocks of all balls cover. Starts with the first few balls, and stops early if they cover
// everything.
template <class BlockOf>
Cover cover_by_balls(const ObstacleLattice<3>& lattice, const Z& period, std::size_t& work,
                     BlockOf block_of) {
  std::vector<Blocked> blocks;
  std::size_t used = 0;
  for (std::size_t count = 8;; count *= 4) {
    count = std::min(count, lattice.obstacles.size());
    for (; used < count; ++used)
      if (std::optional<Blocked> block = block_of(lattice.obstacles[used])) blocks.push_back(*block);
    work += count;
    const Cover cover = cover_of(blocks, period);
    if (cover == Cover::full || count == lattice.obstacles.size()) return cover;
  }
}

// How the balls cover the space between the planes with this normal.
Cover cover_of_planes(const ObstacleLattice<3>& lattice, const ZVec<3>& normal, std::size_t& work) {
  return cover_by_balls(lattice, lattice.period(normal), work, [&](const Obstacle<3>& ball) {
    return std::optional<Blocked>(lattice.block(ball, normal));
  });
}

// The same with each ball shrunk from r to sqrt(r^2 - r_largest^2 / 2^m). (All lengths are multiplied by
// 2^bits.)
Cover shrunk_cover(const ObstacleLattice<3>& lattice, const ZVec<3>& normal, unsigned long m,
                   std::size_t& work) {
  const unsigned long bits = (m + 1) / 2;
  const Z largest = lattice.obstacles[0].axes[0][0], normal2 = dot(normal, normal);
  const Z less2 = shifted_left(largest * largest, 2 * bits - m);
  const auto block_of = [&](const Obstacle<3>& ball) -> std::optional<Blocked> {
    const Z half2 = shifted_left(ball.axes[0][0] * ball.axes[0][0], 2 * bits) - less2;
    if (half2 <= 0) return std::nullopt;
    const Z centre = shifted_left(dot(ball.position, normal), bits);
    return Blocked{centre, half2 * normal2, centre, half2 * normal2};
  };
  return cover_by_balls(lattice, shifted_left(lattice.period(normal), bits), work, block_of);
}

double length_of(const Vec& a) {
  return std::hypot(a[0], a[1], a[2]);
}

struct Plane {
  ZVec<3> indices, normal;
};

// A basis of the lattice vectors in a plane, shortest first, and a vector that leads to the next plane.
struct PlaneBasis {
  std::array<LatticePoint<3>, 2> in_plane;
  LatticePoint<3> out;
};

LatticePoint<3> lattice_vector(const ObstacleLattice<3>& lattice, const ZVec<3>& n) {
  LatticePoint<3> result;
  result.n = n;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 3; ++k) result.p[k] += n[i] * lattice.vectors[i][k];
  return result;
}

PlaneBasis plane_basis(const ObstacleLattice<3>& lattice, const ZVec<3>& k) {
  PlaneBasis result;
  const auto vector = [&](const Z& a, const Z& b, const Z& c) { return lattice_vector(lattice, {a, b, c}); };
  const auto [d, s, t] = bezout(k[0], k[1]);
  if (d == 0) {
    result = {{vector(1, 0, 0), vector(0, 1, 0)}, vector(0, 0, k[2])};
  } else {
    const auto [divisor, u, w] = bezout(d, k[2]);
    result.in_plane = {vector(k[1] / d, -k[0] / d, 0), vector(-s * k[2], -t * k[2], d)};
    result.out = vector(u * s, u * t, w);
  }
  reduce(result.in_plane, EuclideanForm<3>{});
  return result;
}

class CylinderSearch {
 public:
  CylinderSearch(const ChannelScene<3>& scene, const BallScene& balls, Horizon& horizon,
                 const SearchProgress& progress)
      : scene_(scene), balls_(balls), lattice_(balls.lattice), horizon_(horizon), progress_(progress) {}

  void run() {
    if (!find_planes()) return;
    for (; planes_done_ < closed_.size(); ++planes_done_) {
      look_in(closed_[planes_done_]);
      if (work_ <= kMostCylinderWork) continue;
      horizon_.no_cylinders = "the search was stopped, being too long; those listed are open";
      return;
    }
  }

 private:
  // Consider a hole in the shadow along g. The shadow's lattice has a shortest vector b1, and rows along it
  // that are 1/|k| apart, with k perpendicular to g. The largest ball alone leaves the hole, so
  // r^2 < (circumradius)^2 <= (b1^2 + 1/k^2) / 4. With b1 <= (2 / sqrt 3) / |k| this gives
  // 1/k^2 > (12/7) r^2, which leaves finitely many k.
  bool find_planes() {
    const Z r = lattice_.obstacles[0].axes[0][0], r2 = r * r, volume2 = lattice_.volume * lattice_.volume;
    const bool done = visit_primitive<3>(lattice_.cofactors, ceil_div(7 * volume2, 12 * r2), 2 * kMostPlanes,
                                         [&](const LatticePoint<3>& normal) {
                                           if (work_ <= kMostCylinderWork) sort_in({normal.n, normal.p});
                                         });
    if (done && work_ <= kMostCylinderWork) return true;
    horizon_.no_cylinders =
        "not searched: the obstacles are so small that too many planes come into question";
    horizon_.families.clear();
    return false;
  }

  void sort_in(const Plane& plane) {
    const Cover cover = cover_of_planes(lattice_, plane.normal, work_);
    if (cover == Cover::full) {
      closed_.push_back(plane);
      return;
    }
    taken_.push_back(plane.indices);
    // Between touching slabs of obstacles, the plane in the middle is free except for points, for every g in
    // it.
    if (cover == Cover::touching) horizon_.families.push_back({name_of_plane(plane.indices), true, 0});
  }

  // Along g the balls are lined up in rows of discs b1 = |normal| / |g| apart, and these cover slabs of
  // half-width sqrt(r^2 - b1^2 / 4). If the slabs cover everything for b1^2 = 4 r_largest^2 / 2^m, they do so
  // for all smaller b1, so only g^2 < 2^m normal^2 / (4 r_largest^2) remains.
  void look_in(const Plane& plane) {
    constexpr unsigned long kFinest = 256;
    unsigned long m = 1;
    while (m < kFinest && shrunk_cover(lattice_, plane.normal, m, work_) == Cover::gaps) ++m;
    const Z r = lattice_.obstacles[0].axes[0][0], normal2 = dot(plane.normal, plane.normal);
    Z bound = ceil_div(shifted_left(normal2, m), 4 * r * r);
    // The number of points in a disc of that area, one of each pair; 6 / pi^2 of them are primitive.
    const double count = std::exp2(log2_of(bound) - log2_of(normal2) / 2) * 0.955;
    if (count > kMostInPlane) {
      horizon_.families.push_back({name_of_plane(plane.indices), false, count});
      bound = bound >> static_cast<unsigned long>(std::ceil(std::log2(5 * count / kMostInPlane)));
    }
    visit_directions(plane_basis(lattice_, plane.indices), bound);
  }

  // All g = i b1 + j b2 with coprime i and j, one of each pair +-g, with g^2 < bound.
  void visit_directions(const PlaneBasis& basis, const Z& bound) {
    const auto& [b1, b2] = basis.in_plane;
    const Z g11 = dot(b1.p, b1.p), g12 = dot(b1.p, b2.p), g22 = dot(b2.p, b2.p), det = g11 * g22 - g12 * g12;
    if (g11 < bound) look_along(basis, 1, 0);
    for (Z j = 1; j * j * det < bound * g11; ++j) {
      const Z disc = j * j * g12 * g12 - g11 * (j * j * g22 - bound);
      if (disc <= 0) continue;
      const Z last = -floor_surd(j * g12, -1, disc, g11) - 1;
      for (Z i = floor_surd(-j * g12, -1, disc, g11) + 1; i <= last && work_ <= kMostCylinderWork; ++i)
        if (gcd(i, j) == 1) look_along(basis, i, j);
    }
  }

  void look_along(const PlaneBasis& basis, const Z& i, const Z& j) {
    work_ += 10;
    if (progress_) progress_("planes searched for cylinders", planes_done_, closed_.size());
    LatticePoint<3> g, next;
    g.add_multiple(i, basis.in_plane[0]);
    g.add_multiple(j, basis.in_plane[1]);
    const auto [divisor, s, t] = bezout(i, j);
    next.add_multiple(-t, basis.in_plane[0]);
    next.add_multiple(s, basis.in_plane[1]);
    Shadow shadow(lattice_, g.p, next.p, basis.out.p);
    if (!hole_of_largest(shadow)) return;
    for (const ZVec<3>& taken : taken_)
      if (dot(taken, g.n) == 0) return;
    if (name_of(g.n) < ZVec<3>{}) g.negate();
    if (!seen_.insert(g.n).second) return;
    if (const std::optional<HolePoint> hole = hole_of(shadow, lattice_, work_)) add(g, shadow, *hole);
  }

  void add(const LatticePoint<3>& g, const Shadow& shadow, const HolePoint& hole) {
    work_ += shadow.discs.size() > 1 ? 200 : 10;
    Cylinder cylinder = cylinder_in(hole, shadow, balls_, scene_.exponent, work_);
    cylinder.direction = integers(name_of(g.n));
    const LatticePoint<3> vector = lattice_vector(scene_.lattices[0], g.n);
    for (std::size_t k = 0; k < 3; ++k)
      cylinder.vector[k] = round_to_binary64({vector.p[k], 1, 0, 1, scene_.exponent});
    horizon_.cylinders.push_back(cylinder);
  }

  static std::array<Integer, 3> integers(const ZVec<3>& n) {
    return {to_integer(n[0]), to_integer(n[1]), to_integer(n[2])};
  }

  // The name of the lattice vector n_1 u_1 + .. in the scene's own vectors.
  ZVec<3> name_of(const ZVec<3>& n) const {
    ZVec<3> name;
    const auto& names = scene_.lattices[0].names;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t k = 0; k < 3; ++k) name[k] += n[i] * names[i][k];
    return name;
  }

  // The name of the planes u_i.k = n_i: the products of the scene's own vectors with k, with the sign that
  // makes the first nonzero product positive.
  std::array<Integer, 3> name_of_plane(const ZVec<3>& n) const {
    const auto& names = scene_.lattices[0].names;
    ZVec<3> name;  // names maps it to n, and its determinant is 1 or -1
    for (std::size_t i = 0; i < 3; ++i) {
      const ZVec<3> column = cross(names[(i + 1) % 3], names[(i + 2) % 3]);
      for (std::size_t k = 0; k < 3; ++k) name[k] += n[i] * column[k];
    }
    const bool turn = name < ZVec<3>{};
    for (Z& component : name)
      if (turn) component = -component;
    return integers(name);
  }

  const ChannelScene<3>& scene_;
  const BallScene& balls_;
  const ObstacleLattice<3>& lattice_;
  Horizon& horizon_;
  const SearchProgress& progress_;
  std::vector<Plane> closed_;
  std::size_t planes_done_ = 0;
  std::vector<ZVec<3>> taken_;  ///< planes that are open, or touch; cylinders in them are not listed
  std::set<ZVec<3>> seen_;
  std::size_t work_ = 0;
};

}  // namespace

void find_cylinders(const ChannelScene<3>& scene, Horizon& horizon, const SearchProgress& progress) {
  const BallScene balls = balls_of(scene);
  horizon.no_cylinders = balls.unsupported;
  if (balls.unsupported.empty()) CylinderSearch(scene, balls, horizon, progress).run();
  std::stable_sort(horizon.cylinders.begin(), horizon.cylinders.end(), [](const auto& a, const auto& b) {
    return std::tuple(-a.radius, length_of(a.vector), b.vector) <
           std::tuple(-b.radius, length_of(b.vector), a.vector);
  });
}

}  // namespace lorentz::oracle
