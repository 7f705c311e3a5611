#include "src/engines/reduction/overlap.hpp"

#include "src/engines/base/expansion.hpp"

namespace lorentz {
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
  if (!gap.is_exact()) return std::nullopt;
  return gap.value() < 0;
}

}  // namespace lorentz
