#include "oracle/horizon/shadow_hole.hpp"

#include <algorithm>
#include <cmath>

#include <lorentz/geometry.hpp>
#include "oracle/exact/quadratic.hpp"
#include "oracle/horizon/hole_centre.hpp"
#include "oracle/integers/dyadic.hpp"

namespace lorentz::oracle {
namespace {

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

}  // namespace

std::optional<HolePoint> hole_of(Shadow& shadow, const ObstacleLattice<3>& lattice, std::size_t& work) {
  std::optional<HolePoint> hole = hole_of_largest(shadow);
  // If there are many balls, the first few nearly always cover everything already.
  for (std::size_t count = 4; hole && shadow.discs.size() < lattice.obstacles.size(); count *= 4) {
    shadow.see(lattice, std::min(count, lattice.obstacles.size()));
    hole = hole_of_all(shadow, work);
  }
  return hole;
}

Cylinder cylinder_in(const HolePoint& hole, const Shadow& shadow, const BallScene& balls, long exponent,
                     std::size_t& work) {
  Cylinder cylinder;
  place(cylinder, balls, balls.given[hole.disc], room_in(shadow, hole, work), exponent);
  cylinder.inside = is_inside(shadow, balls, cylinder.point, exponent);
  return cylinder;
}

}  // namespace lorentz::oracle
