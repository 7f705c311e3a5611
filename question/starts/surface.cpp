#include "question/starts/surface.hpp"

#include <lorentz/geometry.hpp>
#include "src/problem/scene_geometry.hpp"

namespace lorentz::starts {

using cases::Random;

namespace {

// A slightly smaller number with kBits significant bits. The lengths of semiaxes come from functions that
// libraries round differently, but starts must have the same bits everywhere.
double rounded_down(double positive) {
  constexpr int kBits = 20;
  int exponent = 0;
  const double mantissa = std::frexp(positive, &exponent);
  return std::scalbn(std::floor(std::scalbn(mantissa, kBits)) - 1, exponent - kBits);
}

}  // namespace

Surface::Surface(const Atom& atom, int dimension)
    : dimension_(dimension),
      is_ball_(atom.is_ball()),
      radius_(atom.radius),
      axes_(semiaxes_of(atom, dimension)) {
  if (is_ball_) return;
  const double least = rounded_down(principal_semiaxes(atom, dimension)[dimension - 1]);
  normals_ = dual_of(axes_, dimension);
  for (int i = 0; i < dimension; ++i) normals_[i] = scaled(normals_[i], least);
}

// y is uniform on the unit sphere. A maps its surface element to one that is |A^-T y| det A times as large
// and has the normal A^-T y. Points are therefore kept with the probability |A^-T y| over its bound 1 /
// (least semiaxis). This keeps at least half of them, however slender the ellipsoid is.
SurfacePoint Surface::point_of_ellipsoid(Random& random) const {
  for (;;) {
    const Vec y = direction(random, dimension_);
    Vec offset{}, normal{};
    for (int i = 0; i < dimension_; ++i)
      for (int k = 0; k < 3; ++k) {
        offset[k] += y[i] * axes_[i][k];
        normal[k] += y[i] * normals_[i][k];
      }
    const double share = length(normal);
    if (share > random.uniform()) return {offset, scaled(normal, 1 / share)};
  }
}

// In 2D the sine of the angle with the normal is uniform. In 3D, take a sphere that touches the surface from
// outside. If points are uniform on it, their directions from the point of contact follow the law (Lambert).
Vec cosine_law(Random& random, const Vec& n, int dimension) {
  if (dimension == 2) {
    const double sine = 2 * random.uniform() - 1, cosine = std::sqrt((1 - sine) * (1 + sine));
    return {cosine * n[0] - sine * n[1], cosine * n[1] + sine * n[0], 0};
  }
  for (;;) {
    const Vec v = sum(n, on_sphere(random));
    if (const double size = length(v); size > 0) return scaled(v, 1 / size);
  }
}

}  // namespace lorentz::starts
