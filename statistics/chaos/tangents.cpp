#include "statistics/chaos/tangents.hpp"

#include <algorithm>
#include <cmath>

#include <lorentz/geometry.hpp>

namespace lorentz::chaos {
namespace {

Vec across(const Vec& a, const Vec& v) {
  return plus(a, -dot(a, v) / dot(v, v), v);
}

// (A A^T)^-1 = sum over i of dual_i dual_i^T.
std::array<Vec, 3> gradient_of(const Atom& atom, int dimension) {
  const std::array<Vec, 3> dual = dual_of(semiaxes_of(atom, dimension), dimension);
  std::array<Vec, 3> matrix{};
  for (int i = 0; i < dimension; ++i)
    for (int k = 0; k < 3; ++k) matrix[k] = plus(matrix[k], dual[i][k], dual[i]);
  return matrix;
}

// Unit vectors orthogonal to v: one in 2D, two in 3D.
std::array<Vec, 2> directions_across(const Vec& v, int dimension) {
  if (dimension == 2) return {scaled(Vec{-v[1], v[0], 0}, 1 / length(v)), Vec{}};
  const Vec first = cross(v, std::fabs(v[0]) < std::fabs(v[1]) ? Vec{1, 0, 0} : Vec{0, 1, 0});
  const Vec second = cross(v, first);
  return {scaled(first, 1 / length(first)), scaled(second, 1 / length(second))};
}

}  // namespace

Curvatures::Curvatures(const Scene& scene) : unit_(HUGE_VAL) {
  for (const Lattice& lattice : scene.lattices) {
    auto& obstacles = obstacles_.emplace_back();
    for (const Atom& atom : lattice.atoms) {
      for (int i = 0; i < scene.dimension; ++i)
        unit_ = std::min(unit_, length(semiaxes_of(atom, scene.dimension)[i]));
      if (atom.is_ball())
        obstacles.push_back({1 / atom.radius, {}});
      else
        obstacles.push_back({0, gradient_of(atom, scene.dimension)});
    }
  }
}

Vec Curvatures::change_of_normal(const Particle& at, const Vec& normal, const Vec& along) const {
  const Obstacle& obstacle = obstacles_[at.lattice][at.atom];
  if (obstacle.curvature > 0) return scaled(along, obstacle.curvature);
  const Vec turned = coordinates(obstacle.gradient, along);
  return scaled(plus(turned, -dot(turned, normal), normal),
                1 / length(coordinates(obstacle.gradient, at.offset)));
}

// Diverging pencils come first, because they lie among the growing directions.
Tangents::Tangents(const Vec& v, int dimension, int count) : count_(count) {
  const std::array<Vec, 2> e = directions_across(v, dimension);
  for (int i = 0; i < count; ++i) {
    const int half = dimension - 1;
    const Vec part = scaled(e[i % half], std::sqrt(0.5));
    deviations_[i] = {part, scaled(part, i < half ? 1 : -1)};
  }
}

void Tangents::pass(const Particle& after, const Collision& collision, const Curvatures& curvatures,
                    std::array<double, kMost>& growth) {
  const Vec &v = collision.arriving, &n = collision.normal;
  const double inward = -collision.cosine * std::sqrt(after.speed_squared), unit = curvatures.unit();
  for (int i = 0; i < count_; ++i) {
    auto& [q, p] = deviations_[i];
    q = plus(scaled(q, unit), collision.flight, p);  // dq in the scene's unit
    const double qn = dot(q, n);
    if (inward < 0) {
      const Vec dn = curvatures.change_of_normal(after, n, plus(q, -qn / inward, v));
      p = plus(plus(p, -2 * (dot(p, n) + dot(v, dn)), n), -2 * inward, dn);
      q = plus(q, -2 * qn, n);
    }
    q = scaled(across(q, after.velocity), 1 / unit), p = across(p, after.velocity);
    for (int k = 0; k < i; ++k) {
      const Deviation& before = deviations_[k];
      const double shared = dot(q, before.q) + dot(p, before.v);
      q = plus(q, -shared, before.q), p = plus(p, -shared, before.v);
    }
    const double size = std::sqrt(dot(q, q) + dot(p, p));
    growth[i] = std::log(size);
    q = scaled(q, 1 / size), p = scaled(p, 1 / size);
  }
}

}  // namespace lorentz::chaos
