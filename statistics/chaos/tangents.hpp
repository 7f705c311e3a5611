// How nearby particles leave a particle: tangent vectors, carried along and kept orthonormal.
#pragma once

#include <array>
#include <vector>

#include <lorentz/scene.hpp>
#include <lorentz/trajectory.hpp>

namespace lorentz::chaos {

/// How the normal of each obstacle of a scene turns along its surface.
class Curvatures {
 public:
  explicit Curvatures(const Scene& scene);

  /// By what the unit normal changes where one moves by `along` on the surface, at this offset from the
  /// centre.
  Vec change_of_normal(const Particle& at, const Vec& normal, const Vec& along) const;

  /// The least radius, or semiaxis vector: a length that offsets are measured in.
  double unit() const { return unit_; }

 private:
  struct Obstacle {
    double curvature;             ///< of a ball, 1 / radius; of an ellipsoid 0, and
    std::array<Vec, 3> gradient;  ///< the matrix (A A^T)^-1: of the offset it makes a normal
  };
  std::vector<std::vector<Obstacle>> obstacles_;
  double unit_;
};

/// Deviations (dq, dv) of place and velocity, across the flight: dq, dv at right angles to v. There are
/// 2 (d - 1) of them, d - 1 that grow and as many that shrink.
///
/// A flight of time t adds t dv to dq. At a collision the neighbour arrives later by -(dq.n) / (v.n),
/// elsewhere by dx = dq - v (dq.n) / (v.n), where the normal is n + dn; so
///   dq' = dq - 2 (dq.n) n,   dv' = dv - 2 (dv.n) n - 2 (v.dn) n - 2 (v.n) dn
/// (Dellago, Posch & Hoover, Phys. Rev. E 53, 1485 (1996)). The whole is symplectic: the logarithms of all
/// lengths' growth add up to 0 at every collision.
class Tangents {
 public:
  static constexpr int kMost = 4;

  /// `count`: 1 to 2 (d - 1), the ones that grow first. In directions of unit length across v.
  Tangents(const Vec& v, int dimension, int count);

  /// Through a collision; the growth of each vector's length, orthogonal to those before, as a logarithm.
  void pass(const Particle& after, const Collision& collision, const Curvatures& curvatures,
            std::array<double, kMost>& growth);

  /// Vector i as it is now, of unit length where offsets are measured in Curvatures::unit().
  void deviation(int i, Vec& dq, Vec& dv) const { dq = deviations_[i].q, dv = deviations_[i].v; }

 private:
  struct Deviation {
    Vec q, v;
  };
  int count_;
  std::array<Deviation, kMost> deviations_;
};

}  // namespace lorentz::chaos
