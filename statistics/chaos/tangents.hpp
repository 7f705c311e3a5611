// Tangent vectors: the deviations of neighbouring particles, carried along a trajectory and kept orthonormal.
#pragma once

#include <array>
#include <vector>

#include <lorentz/scene.hpp>
#include <lorentz/trajectory.hpp>

namespace lorentz::chaos {

/// How the normal of each obstacle in a scene turns along its surface.
class Curvatures {
 public:
  explicit Curvatures(const Scene& scene);

  /// The change of the unit normal when the point moves by `along` on the surface, at this offset from the
  /// centre.
  Vec change_of_normal(const Particle& at, const Vec& normal, const Vec& along) const;

  /// The smallest radius or semiaxis length: the unit of length for offsets.
  double unit() const { return unit_; }

 private:
  struct Obstacle {
    double curvature;             ///< 1 / radius for a ball, 0 for an ellipsoid
    std::array<Vec, 3> gradient;  ///< of an ellipsoid, the matrix (A A^T)^-1: maps the offset to a normal
  };
  std::vector<std::vector<Obstacle>> obstacles_;
  double unit_;
};

/// Deviations (dq, dv) of position and velocity, with dq and dv orthogonal to v. There are 2 (d - 1) of them:
/// d - 1 grow and d - 1 shrink.
///
/// A flight of time t adds t dv to dq. At a collision the neighbour arrives later by -(dq.n) / (v.n), at a
/// point displaced by dx = dq - v (dq.n) / (v.n), where the normal is n + dn. Therefore
///   dq' = dq - 2 (dq.n) n,   dv' = dv - 2 (dv.n) n - 2 (v.dn) n - 2 (v.n) dn
/// (Dellago, Posch & Hoover, Phys. Rev. E 53, 1485 (1996)). The map is symplectic: the logarithms of the
/// growth of all lengths add up to 0 at every collision.
class Tangents {
 public:
  static constexpr int kMost = 4;

  /// `count`: 1 to 2 (d - 1), the growing ones first. They start with unit length, in directions orthogonal
  /// to v.
  Tangents(const Vec& v, int dimension, int count);

  /// Carries the vectors through a collision. `growth`: the logarithm of the growth of each vector's length,
  /// orthogonal to the vectors before it.
  void pass(const Particle& after, const Collision& collision, const Curvatures& curvatures,
            std::array<double, kMost>& growth);

  /// The current vector i. It has unit length if offsets are measured in Curvatures::unit().
  void deviation(int i, Vec& dq, Vec& dv) const { dq = deviations_[i].q, dv = deviations_[i].v; }

 private:
  struct Deviation {
    Vec q, v;
  };
  int count_;
  std::array<Deviation, kMost> deviations_;
};

}  // namespace lorentz::chaos
