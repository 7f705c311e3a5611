#include "src/engines/reduction/overlap.hpp"

#include <cmath>
#include <vector>

#include "src/engines/base/double_double.hpp"

namespace lorentz {
namespace {

// A sum of binary64 numbers without rounding: its parts do not overlap, and the last is the largest
// (Shewchuk, "Adaptive precision floating-point arithmetic", 1997, grow-expansion).
struct Expansion {
  std::vector<double> parts;
  bool exact = true;  // no product was so small that its error is not a binary64

  Expansion() = default;
  explicit Expansion(double a) { add(a); }

  void add(double a) {
    std::size_t kept = 0;
    for (const double part : parts) {
      const Wide sum = Wide::sum(a, part);
      a = sum.hi;
      if (sum.lo != 0) parts[kept++] = sum.lo;
    }
    parts.resize(kept);
    if (a != 0) parts.push_back(a);
  }

  void add_product(const Expansion& a, const Expansion& b, double factor_of_two = 1) {
    exact &= a.exact && b.exact;
    for (const double x : a.parts)
      for (const double y : b.parts) {
        const Wide product = Wide::product(factor_of_two * x, y);
        exact &= std::fabs(product.hi) > 0x1p-960;
        add(product.lo);
        add(product.hi);
      }
  }
};

}  // namespace

// With b the translation and y = A^-1 b they overlap iff |y| < 2, where y_i is the determinant of A with b
// for its column i, over that of A.
std::optional<bool> overlaps_translate(const Vec (&semiaxes)[3], const Vec (&u)[3], const Vec& t) {
  Expansion b[3], volume, gap;
  for (int k = 0; k < 3; ++k)
    for (int j = 0; j < 3; ++j) b[k].add_product(Expansion(t[j]), Expansion(u[j][k]));
  for (int i = 0; i < 3; ++i) {
    const Vec &a = semiaxes[i], &c = semiaxes[(i + 1) % 3], &d = semiaxes[(i + 2) % 3];
    Expansion coordinate;
    for (int k = 0; k < 3; ++k) {
      const int l = (k + 1) % 3, m = (k + 2) % 3;
      Expansion minor;
      minor.add_product(Expansion(c[l]), Expansion(d[m]));
      minor.add_product(Expansion(c[m]), Expansion(d[l]), -1);
      coordinate.add_product(minor, b[k]);
      if (i == 0) volume.add_product(minor, Expansion(a[k]));
    }
    gap.add_product(coordinate, coordinate);
  }
  gap.add_product(volume, volume, -4);
  if (!gap.exact) return std::nullopt;
  return !gap.parts.empty() && gap.parts.back() < 0;
}

}  // namespace lorentz
