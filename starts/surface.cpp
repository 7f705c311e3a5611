#include "starts/surface.hpp"

#include <cmath>

#include <lorentz/geometry.hpp>
#include "src/problem/scene_geometry.hpp"

namespace lorentz::starts {

using cases::Random;

namespace {

// A little less, by a few significant bits: lengths of semiaxes come from functions that libraries round
// differently, and starts must have the same bits everywhere.
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

// y is uniform on the unit sphere. A maps its surface element to one that is |A^-T y| det A times as large,
// with the normal A^-T y, so that share of the points is kept: |A^-T y| of its bound 1 / (least semiaxis).
// That is half of them or more, however slender the ellipsoid.
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

namespace {

// In the plane the sine of the angle with the normal is uniform.
Vec cosine_law_2d(Random& random, const Vec& n) {
  const double sine = 2 * random.uniform() - 1, cosine = std::sqrt((1 - sine) * (1 + sine));
  return {cosine * n[0] - sine * n[1], cosine * n[1] + sine * n[0], 0};
}

// Points of the sphere that touches the surface from outside, seen from where it touches, stand in directions
// by the cosine law (Lambert) if they are uniform on it.
Vec cosine_law_3d(Random& random, const Vec& n) {
  for (;;) {
    const Vec v = sum(n, on_sphere(random));
    if (const double size = length(v); size > 0) return scaled(v, 1 / size);
  }
}

}  // namespace

Vec cosine_law(Random& random, const Vec& normal, int dimension) {
  return dimension == 2 ? cosine_law_2d(random, normal) : cosine_law_3d(random, normal);
}

}  // namespace lorentz::starts
