// Isotropic directions, points on the surface of an obstacle, and directions away from it.
#pragma once

#include <cmath>
#include <numbers>

#include <lorentz/scene.hpp>
#include "question/cases/random.hpp"

namespace lorentz::starts {

using std::sqrt;

/// (cos a, sin a) of a number of quarter turns: the two lowest bits.
inline std::array<double, 2> quarter_turn(std::uint64_t bits) {
  constexpr double kCosine[] = {1, 0, -1, 0}, kSine[] = {0, 1, 0, -1};
  return {kCosine[bits & 3], kSine[bits & 3]};
}

#include "question/starts/direction-inl.hpp"

/// A point relative to the obstacle's centre, and the outward normal there, of unit length up to rounding.
struct SurfacePoint {
  Vec offset{}, normal{};
};

/// The surface of an obstacle { A y : |y| < 1 } around the origin.
class Surface {
 public:
  Surface(const Atom& atom, int dimension);

  /// Uniform by length (2D) or area (3D), up to rounding.
  SurfacePoint point(cases::Random& random) const {
    if (!is_ball_) return point_of_ellipsoid(random);
    const Vec normal = direction(random, dimension_);
    return {{radius_ * normal[0], radius_ * normal[1], radius_ * normal[2]}, normal};
  }

 private:
  SurfacePoint point_of_ellipsoid(cases::Random& random) const;

  int dimension_;
  bool is_ball_;
  double radius_;
  std::array<Vec, 3> axes_{};     ///< the columns of A
  std::array<Vec, 3> normals_{};  ///< columns of the transposed inverse of A, times its least semiaxis
};

/// A direction away from a surface with this unit normal, by the cosine law: the flux of a gas in
/// equilibrium. The density of its angle with the normal is proportional to the cosine of the angle (in 3D
/// per solid angle). The direction has unit length up to rounding.
Vec cosine_law(cases::Random& random, const Vec& normal, int dimension);

}  // namespace lorentz::starts
