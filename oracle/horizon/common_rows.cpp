// A normal of the first lattice's rows is n_1 a_1 + n_2 a_2, and one of the second's is m_1 b_1 + m_2 b_2.
// They are parallel if X = n m^T, a matrix of rank one, satisfies sum C_ij X_ij = 0, where C_ij = a_i x b_j.
// All integer X that do so form a lattice of three dimensions; n and m, and so X, are bounded by a box. If
// the other vectors of a short basis are long enough, the points in the box are in the span of one or two
// basis vectors, and there det X = 0 has at most two solutions, up to a factor.
#include "oracle/horizon/channel_scene.hpp"

#include <algorithm>

#include "oracle/exact/short_basis.hpp"

namespace lorentz::oracle {
namespace {

// X_11, X_12, X_21, X_22.
struct Product {
  ZVec<4> x;

  void add_multiple(const Z& k, const Product& other) {
    for (std::size_t i = 0; i < 4; ++i) x[i].add_product(k, other.x[i]);
  }
  Z determinant() const { return minor_of(x[0], x[1], x[2], x[3]); }
};

// Normals of a lattice's rows, and bounds of the coefficients of those normals for which the largest obstacle
// leaves a gap: 2 |A^T N| < volume.
struct CommonRows {
  ZMatrix<2> normals;
  std::array<Z, 2> most;

  explicit CommonRows(const ObstacleLattice<2>& lattice) {
    Basis<2> images = basis_of(lattice.cofactors);
    for (auto& image : images) image.p = lattice.obstacles.front().axes * image.p;
    reduce(images, euclidean_form);
    const Z twice_area = 2 * abs(cross(images[0].p, images[1].p)), volume2 = lattice.volume * lattice.volume;
    for (std::size_t i = 0; i < 2; ++i) {
      const Z other2 = dot(images[1 - i].p, images[1 - i].p);
      most[i] = floor_sqrt(floor_div(volume2 * other2, twice_area * twice_area));
      normals[i] = combination(images[i].n, lattice.cofactors);
    }
  }
};

// All integer solutions of c.x = 0; c_0 and c_1 must not both be 0.
std::array<Product, 3> solutions_of(const ZVec<4>& c) {
  const auto [g, x, y] = bezout(c[0], c[1]);
  const auto [h, u, w] = bezout(g, c[2]);
  const Z all = gcd(h, c[3]);
  return {Product{{c[1] / g, -(c[0] / g), 0, 0}}, Product{{-x * (c[2] / h), -y * (c[2] / h), g / h, 0}},
          Product{{-u * x * (c[3] / all), -u * y * (c[3] / all), -w * (c[3] / all), h / all}}};
}

// The matrices of rank one among s a + t b: p s^2 + q s t + r t^2 = 0. Nothing if all are of rank one.
std::optional<std::vector<Product>> of_rank_one(const Product& a, const Product& b) {
  Product both = a;
  both.add_multiple(1, b);
  const Z p = a.determinant(), r = b.determinant(), q = both.determinant() - p - r,
          discriminant = q * q - 4 * p * r;
  if (p == 0 && q == 0 && r == 0) return std::nullopt;
  std::vector<Product> found;
  const auto add = [&](const Z& s, const Z& t) {
    Product product{};
    product.add_multiple(s, a);
    product.add_multiple(t, b);
    found.push_back(product);
  };
  if (p == 0) {
    add(1, 0);
    if (q != 0) add(-r, q);
    return found;
  }
  if (discriminant < 0) return found;
  const Z root = floor_sqrt(discriminant);
  if (root * root != discriminant) return found;
  add(root - q, 2 * p);
  if (root != 0) add(-root - q, 2 * p);
  return found;
}

}  // namespace

std::optional<std::vector<ZVec<2>>> common_normals(const ObstacleLattice<2>& a, const ObstacleLattice<2>& b) {
  const CommonRows first(a), second(b);
  ZVec<4> c, most;
  Z largest = 1;
  for (std::size_t i = 0; i < 4; ++i) {
    c[i] = cross(first.normals[i / 2], second.normals[i % 2]);
    most[i] = std::max(Z(1), Z(first.most[i / 2] * second.most[i % 2]));
    largest = std::max(largest, most[i]);
  }
  // Weights that make the box nearly a cube, and the square of half its diagonal.
  ZVec<4> weights;
  Z bound2 = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    const Z weight = ceil_div(16 * largest, most[i]);
    weights[i] = weight * weight;
    bound2 += weights[i] * most[i] * most[i];
  }
  const auto form = [&](const Product& a, const Product& b) {
    Z sum = 0;
    for (std::size_t i = 0; i < 4; ++i) sum += weights[i] * a.x[i] * b.x[i];
    return sum;
  };
  std::array<Product, 3> basis = solutions_of(c);
  reduce(basis, form);
  const auto& [u, v, w] = basis;
  const Z g11 = form(u, u), g12 = form(u, v), g22 = form(v, v), g13 = form(u, w), g23 = form(v, w),
          g33 = form(w, w), area2 = g11 * g22 - g12 * g12,
          volume2 = g33 * area2 - g13 * (g13 * g22 - g23 * g12) + g23 * (g13 * g12 - g23 * g11);
  // Compare the squared distance of each basis vector from the span of those before it with the bound.
  if (volume2 <= bound2 * area2) return std::nullopt;
  std::optional<std::vector<Product>> products = std::vector<Product>{};
  if (area2 <= bound2 * g11)
    products = of_rank_one(u, v);
  else if (g11 <= bound2 && u.determinant() == 0)
    products->push_back(u);
  if (!products) return std::nullopt;
  std::vector<ZVec<2>> normals;
  for (const Product& product : *products) {
    const std::size_t column = product.x[0] == 0 && product.x[2] == 0 ? 1 : 0;
    normals.push_back(combination({product.x[column], product.x[2 + column]}, first.normals));
  }
  return normals;
}

}  // namespace lorentz::oracle
