// Scenes whose lengths are near the ends of binary64's range are drawn in another unit, so that squares and
// cubes of lengths stay in range.
#include <cmath>

#include "pictures/finding_parts.hpp"

namespace lorentz::pictures {
namespace {

// Multiplies by 2^exponent; fails if that changes a bit.
class Scaling {
 public:
  explicit Scaling(int exponent) : exponent_(exponent) {}
  void operator()(double& number) {
    const double before = number;
    number = std::ldexp(number, exponent_);
    if (std::ldexp(number, -exponent_) != before) exact_ = false;
  }
  void operator()(Vec& a) {
    for (double& component : a) (*this)(component);
  }
  bool is_exact() const { return exact_; }

 private:
  int exponent_;
  bool exact_ = true;
};

}  // namespace

int length_exponent(const Scene& scene) {
  double largest = 0;
  const auto see = [&](const Vec& vector) {
    for (const double component : vector) largest = std::max(largest, std::fabs(component));
  };
  const Lattice& lattice = scene.lattices[0];
  for (const Vec& u : lattice.vectors) see(u);
  if (largest == 0)  // a single obstacle is as large as its scene
    for (const Atom& atom : lattice.atoms) {
      see({atom.radius, 0, 0});
      for (const Vec& axis : atom.semiaxes) see(axis);
    }
  constexpr int kOrdinary = 100;
  const int exponent = largest > 0 ? std::ilogb(largest) : 0;
  return std::abs(exponent) <= kOrdinary ? 0 : exponent;
}

bool scale_lengths(int exponent, Scene& scene, Query& query) {
  Scaling scale(-exponent);
  for (Lattice& lattice : scene.lattices)
    for (Vec& u : lattice.vectors) scale(u);
  for_each_atom(scene, [&](Atom& atom) {
    scale(atom.position);
    scale(atom.radius);
    for (Vec& axis : atom.semiaxes) scale(axis);
  });
  scale(query.x);
  return scale.is_exact();
}

}  // namespace lorentz::pictures
