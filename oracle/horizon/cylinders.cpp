#include "oracle/horizon/channel_scene.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include <lorentz/geometry.hpp>
#include "oracle/exact/exact_query.hpp"
#include "oracle/exact/quadratic.hpp"
#include "oracle/exact/shape.hpp"
#include "oracle/exact/short_basis.hpp"
#include "oracle/horizon/shadow.hpp"
#include "oracle/integers/dyadic.hpp"

namespace lorentz::oracle {
namespace {

// ---- A scene of balls with equivalent shadows: a cylinder is open in both scenes or in neither

// The obstacles as balls. Balls stay as they are. If the obstacles are ellipsoids of one shape A, all points
// are mapped by |det A| A^-1.
struct BallScene {
  ObstacleLattice<3> lattice;
  ZMatrix<3> map;                  // the identity for balls
  std::vector<Obstacle<3>> given;  // the obstacles before the map, in the same order
  std::string unsupported;
};

// The obstacles of all lattices, if these have the same vectors; otherwise sets `unsupported`.
BallScene balls_of(const ChannelScene<3>& scene) {
  BallScene result{scene.lattices[0], multiple_of_identity<3>(1), {}, {}};
  ObstacleLattice<3>& lattice = result.lattice;
  std::vector<Obstacle<3>>& obstacles = lattice.obstacles;
  for (std::size_t l = 1; l < scene.lattices.size(); ++l) {
    const auto& other = scene.lattices[l];
    if (other.vectors != lattice.vectors) result.unsupported = "done for one lattice only, or equal ones";
    obstacles.insert(obstacles.end(), other.obstacles.begin(), other.obstacles.end());
  }
  lattice.sort_obstacles();
  result.given = obstacles;
  const ZMatrix<3> axes = obstacles[0].axes, shape = shape_of<3>(axes);
  if (std::ranges::all_of(obstacles, &Obstacle<3>::ball)) return result;
  if (!std::ranges::all_of(obstacles, [&](const auto& one) { return shape_of<3>(one.axes) == shape; })) {
    result.unsupported = "done for balls only, or ellipsoids of one shape and orientation";
    return result;
  }
  result.map = adjugate(axes);
  const Z det = dot(result.map[0], axes[0]);
  for (auto& row : result.map) row = Z(sgn(det)) * row;
  for (auto& u : lattice.vectors) u = result.map * u;
  for (auto& one : obstacles) one = {result.map * one.position, multiple_of_identity<3>(abs(det)), true};
  lattice.set_cofactors();
  return result;
}

// ---- A hole in the shadow of the scene, and the line through it that is reported

// A hole that exists has room, but not always within the bits of its point.
HoleCentre room_in(const Shadow& shadow, const HolePoint& hole, std::size_t& work) {
  constexpr unsigned long kMostBits = 1 << 14;
  HoleCentre centre = centre_of(shadow, hole);
  const auto none = [&] {
    return sign_of(centre.clearance.a, centre.clearance.sign, centre.clearance.d) <= 0;
  };
  for (unsigned long bits = 4 * hole.bits; none() && bits <= kMostBits; bits *= 4) {
    work += 100;
    const bool one = shadow.discs.size() == 1;
    centre = centre_of(shadow, *(one ? hole_of_largest(shadow, bits) : hole_of_all(shadow, work, bits)));
  }
  return centre;
}

// Maps a line from the scene of balls back to the scene, rounded. Offsets are in units of the largest ball's
// radius or, if the balls are ellipsoids in the scene, are mapped by A. A^-1 lengthens nothing by more than
// its norm.
void place(Cylinder& cylinder, const BallScene& balls, const Obstacle<3>& obstacle, const HoleCentre& centre,
           long exponent) {
  const auto real = [&](const ZVec<3>& a) { return rounded<3>(a, 1, exponent); };
  cylinder.point = real(obstacle.position);
  for (std::size_t i = 0; i < 3; ++i)
    cylinder.point = plus(cylinder.point, centre.offset[i], real(balls.given[0].axes[i]));
  Quadratic radius = centre.clearance;
  if (!obstacle.ball) {
    Z norm2 = 0;  // of the map |det A| A^-1, squared
    for (const ZVec<3>& row : balls.map) norm2 += dot(row, row);
    radius.q *= ceil_sqrt(norm2);
  }
  radius.exponent = exponent;
  cylinder.radius = round_to_binary64(radius);
}

bool is_inside(Shadow shadow, const BallScene& balls, const Vec& point, long exponent) {
  CommonExponent common;
  for (double component : point) {
    if (!std::isfinite(component)) return false;
    common.see(component);
  }
  const long fine = std::min(exponent, common.get());
  const Z times = shifted_left(1, static_cast<unsigned long>(exponent - fine));
  for (auto& b : shadow.basis) b.p = times * b.p;
  for (Disc& disc : shadow.discs) disc = {times * disc.centre, times * disc.radius};
  const ZVec<3> exact = scaled_vector<3>(point, fine);
  return shadow.discs_around(cross(balls.map * exact, shadow.along), 0, true).empty();
}

// A hole among all balls of the lattice, if there is one; `shadow` must hold the largest ball. Adds to
// `work` as hole_of_all does.
std::optional<HolePoint> hole_of(Shadow& shadow, const ObstacleLattice<3>& lattice, std::size_t& work) {
  std::optional<HolePoint> hole = hole_of_largest(shadow);
  // If there are many balls, the first few nearly always cover everything already.
  for (std::size_t count = 4; hole && shadow.discs.size() < lattice.obstacles.size(); count *= 4) {
    shadow.see(lattice, std::min(count, lattice.obstacles.size()));
    hole = hole_of_all(shadow, work);
  }
  return hole;
}

// A cylinder that fits into that hole: its point and radius, and whether the rounded point is inside.
// Lengths in the shadow are multiplied by 2^-exponent.
Cylinder cylinder_in(const HolePoint& hole, const Shadow& shadow, const BallScene& balls, long exponent,
                     std::size_t& work) {
  Cylinder cylinder;
  place(cylinder, balls, balls.given[hole.disc], room_in(shadow, hole, work), exponent);
  cylinder.inside = is_inside(shadow, balls, cylinder.point, exponent);
  return cylinder;
}

// ---- The search

constexpr std::size_t kMostPlanes = 20'000;
constexpr double kMostInPlane = 5'000;  // directions
constexpr std::size_t kMostCylinderWork =
    10'000'000;  // blocks placed, points and discs compared: a few microseconds each

// How the balls cover the space between the planes with this normal, each of them shrunk from r to
// sqrt(r^2 - less2 / 4^bits). (All lengths are multiplied by 2^bits.) Starts with the first few balls, and
// stops early if they cover everything.
Cover cover_of_planes(const ObstacleLattice<3>& lattice, const ZVec<3>& normal, const Z& less2,
                      unsigned long bits, std::size_t& work) {
  const Z normal2 = dot(normal, normal), period = shifted_left(lattice.period(normal), bits);
  std::vector<Blocked> blocks;
  std::size_t used = 0;
  for (std::size_t count = 8;; count *= 4) {
    count = std::min(count, lattice.obstacles.size());
    for (; used < count; ++used) {
      const Obstacle<3>& ball = lattice.obstacles[used];
      const Z r2 = shifted_left(ball.axes[0][0] * ball.axes[0][0], 2 * bits) - less2;
      const Z centre = shifted_left(dot(ball.position, normal), bits);
      if (r2 > 0) blocks.push_back({centre, r2 * normal2, centre, r2 * normal2});
    }
    work += count;
    const Cover cover = cover_of(blocks, period);
    if (cover == Cover::full || count == lattice.obstacles.size()) return cover;
  }
}

// A basis of the lattice vectors in a plane, shortest first, and a vector that leads to the next plane.
struct PlaneBasis {
  std::array<LatticePoint<3>, 2> in_plane;
  LatticePoint<3> out;
};

PlaneBasis plane_basis(const ObstacleLattice<3>& lattice, const ZVec<3>& k) {
  PlaneBasis result;
  const auto vector = [&](const Z& a, const Z& b, const Z& c) {
    return LatticePoint<3>{combination<3>({a, b, c}, lattice.vectors), {a, b, c}};
  };
  const auto [d, s, t] = bezout(k[0], k[1]);
  if (d == 0) {
    result = {{vector(1, 0, 0), vector(0, 1, 0)}, vector(0, 0, k[2])};
  } else {
    const auto [divisor, u, w] = bezout(d, k[2]);
    result.in_plane = {vector(k[1] / d, -k[0] / d, 0), vector(-s * k[2], -t * k[2], d)};
    result.out = vector(u * s, u * t, w);
  }
  reduce(result.in_plane, euclidean_form);
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
    const bool done = visit_primitive<3>(basis_of(lattice_.cofactors), ceil_div(7 * volume2, 12 * r2),
                                         2 * kMostPlanes, [&](const LatticePoint<3>& normal) {
                                           if (work_ <= kMostCylinderWork) sort_in(normal);
                                         });
    if (done && work_ <= kMostCylinderWork) return true;
    horizon_.no_cylinders =
        "not searched: the obstacles are so small that too many planes come into question";
    horizon_.families.clear();
    return false;
  }

  void sort_in(const LatticePoint<3>& normal) {
    const Cover cover = cover_of_planes(lattice_, normal.p, 0, 0, work_);
    if (cover == Cover::full) {
      closed_.push_back(normal);
      return;
    }
    taken_.push_back(normal.n);
    // Between touching slabs of obstacles, the plane in the middle is free except for points, for every g in
    // it.
    if (cover == Cover::touching) horizon_.families.push_back({name_of_plane(normal.n), true, 0});
  }

  // Along g the balls are lined up in rows of discs b1 = |normal| / |g| apart, and these cover slabs of
  // half-width sqrt(r^2 - b1^2 / 4). If the slabs cover everything for b1^2 = 4 r_largest^2 / 2^m, they do so
  // for all smaller b1, so only g^2 < 2^m normal^2 / (4 r_largest^2) remains.
  void look_in(const LatticePoint<3>& normal) {
    constexpr unsigned long kFinest = 256;
    const Z r = lattice_.obstacles[0].axes[0][0], normal2 = dot(normal.p, normal.p);
    const auto leaves_gaps = [&](unsigned long m) {
      const unsigned long bits = (m + 1) / 2;
      return cover_of_planes(lattice_, normal.p, shifted_left(r * r, 2 * bits - m), bits, work_) ==
             Cover::gaps;
    };
    unsigned long m = 1;
    while (m < kFinest && leaves_gaps(m)) ++m;
    Z bound = ceil_div(shifted_left(normal2, m), 4 * r * r);
    // The number of points in a disc of that area, one of each pair; 6 / pi^2 of them are primitive.
    const double count = std::exp2(log2_of(bound) - log2_of(normal2) / 2) * 0.955;
    if (count > kMostInPlane) {
      horizon_.families.push_back({name_of_plane(normal.n), false, count});
      bound = bound >> static_cast<unsigned long>(std::ceil(std::log2(5 * count / kMostInPlane)));
    }
    visit_directions(plane_basis(lattice_, normal.n), bound);
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
    cylinder.direction = to_cell(name_of(g.n));
    cylinder.vector = rounded<3>(combination(g.n, scene_.lattices[0].vectors), 1, scene_.exponent);
    horizon_.cylinders.push_back(cylinder);
  }

  // The name of the lattice vector n_1 u_1 + .. in the scene's own vectors.
  ZVec<3> name_of(const ZVec<3>& n) const { return combination(n, scene_.lattices[0].names); }

  // The name of the planes u_i.k = n_i: the products of the scene's own vectors with k, with the sign that
  // makes the first nonzero product positive.
  std::array<Integer, 3> name_of_plane(const ZVec<3>& n) const {
    // `names` maps it to n, and its determinant is 1 or -1.
    const ZVec<3> name = combination(n, adjugate(scene_.lattices[0].names));
    return to_cell(name < ZVec<3>{} ? -1 * name : name);
  }

  const ChannelScene<3>& scene_;
  const BallScene& balls_;
  const ObstacleLattice<3>& lattice_;
  Horizon& horizon_;
  const SearchProgress& progress_;
  std::vector<LatticePoint<3>> closed_;  ///< normals of planes, with their indices as n
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
}

}  // namespace lorentz::oracle
