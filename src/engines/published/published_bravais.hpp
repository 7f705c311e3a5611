// The published algorithm for one ball or ellipsoid on any Bravais lattice. The lattice is transformed to the
// square or cubic one. There each obstacle is an ellipse, and the search uses its circumscribed ball. Private
// to published*.cpp.
#pragma once

#include "src/engines/published/published.hpp"

namespace lorentz {

class PublishedBravais {
 public:
  /// Atom a of lattice l of the scene. Requires an atom that the algorithm supports (beyond).
  PublishedBravais(const Scene& scene, int l, int a);

  /// Why the algorithm does not support this atom, or nothing.
  static std::optional<std::string> beyond(const Scene& scene, int l, int a);

  /// `inside`, or the reason why no flight can start there, or nothing.
  std::optional<Answer> start(const Ray& ray) const;

  /// The flight among this atom's obstacles alone. Hits after `limit` are not searched for, but may be
  /// returned.
  Answer flight_of(const Ray& ray, double limit, Proposals& proposals) const;

 private:
  Answer flight_2d(const Ray& ray, double limit, Proposals& proposals) const;
  Answer flight_3d(const Ray& ray, double limit, Proposals& proposals) const;
  Vec transformed_place(const Vec& x) const;
  Vec relative(const Vec& x, const Vec& n) const;
  bool leaves(const Ray& ray, Vec& n) const;
  ObstacleId obstacle_of(const Vec& n) const;

  int dimension_, lattice_, atom_;
  double radius_;  // of the ball in the scene, or of the unit ball that A^-1 makes of the ellipsoid
  Vec position_;
  std::array<Vec, 3> shape_{Vec{1, 0, 0}, Vec{0, 1, 0},
                            Vec{0, 0, 1}};  // the rows of A^-1, or of 1 for a ball
  std::array<Vec, 3> vectors_{};            // the columns of M_so
  std::array<Vec, 3> dual_{};               // the rows of M_os, its inverse
  double circumscribed_ = 0;                // the first singular value of M_os A; for a ball A is its radius
};

}  // namespace lorentz
