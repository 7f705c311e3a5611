// The published algorithm for one ball on any Bravais lattice: in the square or cubic lattice that it is
// transformed to, each obstacle, an ellipse there, in a circumscribed ball. Private to published*.cpp.
#pragma once

#include "src/engines/published/published.hpp"

namespace lorentz {

class PublishedBravais {
 public:
  /// Atom a of lattice l, of a scene in which it is not beyond the algorithm.
  PublishedBravais(const Scene& scene, int l, int a);

  /// Why the algorithm does not do this atom, or nothing.
  static std::optional<std::string> beyond(const Scene& scene, int l, int a);

  /// `inside`, or why there is no flight from there, or nothing.
  std::optional<Answer> start(const Ray& ray) const;

  /// The flight among this atom's obstacles alone; nothing after `limit` is looked for, but may be found.
  Answer flight_of(const Ray& ray, double limit, Proposals& proposals) const;

 private:
  Answer flight_2d(const Ray& ray, double limit, Proposals& proposals) const;
  Answer flight_3d(const Ray& ray, double limit, Proposals& proposals) const;
  Vec transformed_place(const Vec& x) const;
  Vec relative(const Vec& x, const Vec& n) const;
  bool leaves(const Ray& ray, Vec& n) const;
  ObstacleId obstacle_of(const Vec& n) const;

  int dimension_, lattice_, atom_;
  double radius_;  // in the scene
  Vec position_;
  std::array<Vec, 3> vectors_{};  // the columns of M_so
  std::array<Vec, 3> dual_{};     // the rows of M_os, its inverse
  double circumscribed_ = 0;      // radius times the first singular value of M_os
};

}  // namespace lorentz
