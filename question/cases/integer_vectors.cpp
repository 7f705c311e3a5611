#include "question/cases/integer_vectors.hpp"

#include <cmath>
#include <numeric>

namespace lorentz::cases {
namespace {

struct Gcd {
  std::int64_t g, x, y;  // g = x a + y b
};

Gcd extended_gcd(std::int64_t a, std::int64_t b) {
  std::int64_t x0 = 1, y0 = 0, x1 = 0, y1 = 1;
  while (b != 0) {
    const std::int64_t q = a / b, rest = a % b;
    a = b, b = rest;
    const std::int64_t x2 = x0 - q * x1, y2 = y0 - q * y1;
    x0 = x1, x1 = x2, y0 = y1, y1 = y2;
  }
  return a < 0 ? Gcd{-a, -x0, -y0} : Gcd{a, x0, y0};
}

std::int64_t floor_root(std::int64_t a) {
  auto root = static_cast<std::int64_t>(std::sqrt(static_cast<double>(a)));
  while (root * root > a) --root;
  while ((root + 1) * (root + 1) <= a) ++root;
  return root;
}

Wide rounded_quotient(Wide a, Wide b) {  // b > 0
  const Wide doubled = 2 * a + b;
  const Wide q = doubled / (2 * b);
  return doubled % (2 * b) < 0 ? q - 1 : q;
}

}  // namespace

std::int64_t content_of(const IntVec& a) {
  return std::gcd(std::gcd(a[0], a[1]), a[2]);
}

IntVec bezout(const IntVec& a) {
  const Gcd first = extended_gcd(a[0], a[1]);
  if (a[2] == 0) return {first.x, first.y, 0};
  const Gcd both = extended_gcd(first.g, a[2]);
  return {both.x * first.x, both.x * first.y, both.y};
}

IntVec primitive(IntVec a) {
  const std::int64_t content = content_of(a);
  for (std::int64_t& component : a) component /= content;
  return a;
}

IntVec drawn_integers(Random& random, int dimension, std::int64_t range) {
  IntVec a{};
  for (int i = 0; i < dimension; ++i) a[i] = random.integer(-range, range);
  return a;
}

IntVec drawn_primitive(Random& random, int dimension, std::int64_t range) {
  IntVec a{};
  while (a == IntVec{}) a = drawn_integers(random, dimension, range);
  return primitive(a);
}

std::array<IntVec, 2> across_of(const IntVec& n) {
  std::array<IntVec, 2> found{};
  std::size_t count = 0;
  for (const IntVec& axis : {IntVec{1, 0, 0}, IntVec{0, 1, 0}, IntVec{0, 0, 1}}) {
    if (count == 2) break;
    const IntVec g = cross(n, axis);
    if (g != IntVec{} && (count == 0 || cross(found[0], g) != IntVec{})) found[count++] = primitive(g);
  }
  return found;
}

Vec to_vec(const IntVec& a) {
  return {static_cast<double>(a[0]), static_cast<double>(a[1]), static_cast<double>(a[2])};
}

Vec cartesian(const Lattice& lattice, const IntVec& a) {
  Vec sum{};
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) sum[k] += static_cast<double>(a[i]) * lattice.vectors[i][k];
  return sum;
}

double half_width(const Lattice& lattice, int dimension, const IntVec& indices) {
  const auto& u = lattice.vectors;
  if (dimension == 2) return std::fabs(cross(u[0], u[1])[2]) / (2 * length(cartesian(lattice, indices)));
  const auto dual = dual_of(u, 3);
  Vec normal{};
  for (int i = 0; i < 3; ++i) normal = sum(normal, scaled(dual[i], static_cast<double>(indices[i])));
  return 1 / (2 * length(normal));
}

Squared drawn_triple(Random& random, std::int64_t range) {
  const std::int64_t a = random.integer(2, range), b = random.integer(1, a - 1);
  IntVec v{a * a - b * b, 2 * a * b, 0};
  const std::int64_t content = content_of(v), w = (a * a + b * b) / content;
  return {primitive(v), {0, 0, w}, w};
}

std::array<IntVec, 3> rotation_of(std::int64_t a, std::int64_t b, std::int64_t c, std::int64_t d) {
  return {IntVec{a * a + b * b - c * c - d * d, 2 * (b * c + a * d), 2 * (b * d - a * c)},
          IntVec{2 * (b * c - a * d), a * a - b * b + c * c - d * d, 2 * (c * d + a * b)},
          IntVec{2 * (b * d + a * c), 2 * (c * d - a * b), a * a - b * b - c * c + d * d}};
}

Squared drawn_quadruple(Random& random, std::int64_t range) {
  for (int tries = 0; tries < 16; ++tries) {
    const std::int64_t a = random.integer(-range, range), b = random.integer(-range, range),
                       c = random.integer(-range, range), d = random.integer(-range, range);
    const auto [v, across, other] = rotation_of(a, b, c, d);
    if (content_of(v) == 1) return {v, across, a * a + b * b + c * c + d * d};
  }
  return {{1, 2, 2}, {2, 1, -2}, 3};
}

// (w - p)(w + p) = q^2 - 1 or q^2 + 1, so a factorisation of the right side into two factors of the same
// parity gives a near square. With q = 2ab + 1, q^2 - 1 = 2a 2b(ab + 1) and p^2 + q^2 = w^2 + 1. With
// ad + bc = 1 (Brahmagupta) and q = ac - bd, q^2 + 1 = (a^2 + b^2)(c^2 + d^2) and p^2 + q^2 = w^2 - 1.
NearSquare drawn_near_square(Random& random, std::int64_t below) {
  for (int tries = 0; tries < 16; ++tries) {
    const auto size = std::int64_t{1} << random.integer(1, 12);
    const std::int64_t a = random.integer(1, size), b = random.integer(1, size);
    NearSquare found{};
    if (random.one_in(2)) {
      const std::int64_t large = b * (a * b + 1);
      found = {{large - a, 2 * a * b + 1, 0}, large + a};
    } else {
      const auto [g, d, c] = extended_gcd(a, b);
      if (g != 1) continue;
      const std::int64_t small = a * a + b * b, large = c * c + d * d;
      if ((small + large) % 2 != 0) continue;
      found = {{(large - small) / 2, a * c - b * d, 0}, (large + small) / 2};
    }
    if (found.w > 20 && found.w < below && content_of(found.v) == 1) return found;
  }
  return {{8, 9, 0}, 12};  // 145 = 144 + 1
}

std::vector<IntegerRatio> convergents_of_root(std::int64_t n, std::int64_t h, int bits) {
  // Complete quotients are (p + sqrt(d)) / q, where q divides d - p^2.
  const std::int64_t d = n * h, root = floor_root(d);
  std::int64_t p = 0, q = h;
  Wide k1 = 1, k0 = 0, r1 = 0, r0 = 1;
  std::vector<IntegerRatio> all;
  while (q != 0) {
    const std::int64_t a = (p + root) / q;
    const Wide k = a * k1 + k0, r = a * r1 + r0;
    if (r > (Wide{1} << bits) || k > (Wide{1} << 62)) break;
    all.push_back({static_cast<std::int64_t>(k), static_cast<std::int64_t>(r)});
    k0 = k1, k1 = k, r0 = r1, r1 = r;
    p = a * q - p;
    q = (d - p * p) / q;
  }
  return all;
}

// Because u.v = 1, e = across x u satisfies v x e = across (v.u) - u (v.across) = across. So all solutions d
// of v x d = turns across are turns e + s v. s is free; it is chosen to bring d near the place wanted.
std::optional<Vec> start_beside(const IntVec& v, const IntVec& across, std::int64_t turns, int exponent,
                                double along, int bits) {
  const IntVec u = bezout(v);
  std::array<Wide, 3> e{};
  for (int i = 0; i < 3; ++i)
    e[i] = Wide{across[(i + 1) % 3]} * u[(i + 2) % 3] - Wide{across[(i + 2) % 3]} * u[(i + 1) % 3];
  const Wide v2 = dot(v, v), e_along = e[0] * v[0] + e[1] * v[1] + e[2] * v[2];
  const auto wanted =
      static_cast<Wide>(std::ldexp(along * std::sqrt(static_cast<double>(dot(v, v))), exponent));
  const Wide left = wanted - turns * e_along;
  Wide s = rounded_quotient(left, v2);
  if (s * v2 < left) ++s;  // rounds up: a long v has few solutions near the place, and none behind it is used
  Vec x{};
  for (int i = 0; i < 3; ++i) {
    const Wide d = turns * e[i] + s * v[i];
    if (d > (Wide{1} << bits) || d < -(Wide{1} << bits)) return std::nullopt;
    x[i] = d == 0 ? 0.0 : std::ldexp(-static_cast<double>(d), -exponent);
  }
  return x;
}

}  // namespace lorentz::cases
