#include "bravais.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "ball.hpp"

namespace lorentz {
namespace {

constexpr double kMaxTransform = 0x1p20;  // cells more skewed than that are not done

Vec cross(const Vec& a, const Vec& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Vec rounded(const WideVec& a) {
  return {a[0].hi, a[1].hi, a[2].hi};
}

double length(const Vec& a) {
  return std::sqrt(dot(a, a));
}

// A basis while it is made shorter: integer combinations of the primitive vectors, recomputed from these at
// each step, so that no error accumulates.
struct Shortening {
  int dimension;
  std::array<Vec, 3> primitive;
  double T[3][3]{};
  WideVec B[3];

  Shortening(const Lattice& lattice, int d, double scale) : dimension(d), primitive(lattice.vectors) {
    for (int i = 0; i < d; ++i)
      for (double& component : primitive[i]) component *= scale;
    for (int i = d; i < 3; ++i) primitive[i] = Vec{double(i == 0), double(i == 1), double(i == 2)};
    for (int i = 0; i < 3; ++i) {
      T[i][i] = 1;
      recompute(i);
    }
  }

  void recompute(int i) {
    for (int k = 0; k < 3; ++k) {
      B[i][k] = Wide(0);
      for (int j = 0; j < 3; ++j) B[i][k] = B[i][k] + Wide::product(T[i][j], primitive[j][k]);
    }
  }

  // Are all components of B sums without rounding?
  bool is_exact() const {
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < 3; ++k) {
        double sum = 0;
        for (int j = 0; j < 3; ++j) {
          const Wide step = Wide::product(T[i][j], primitive[j][k]), next = Wide::sum(sum, step.hi);
          if (step.lo != 0 || next.lo != 0) return false;
          sum = next.hi;
        }
      }
    return true;
  }

  // B_i minus the nearest integer combination of the shorter ones; true if that shortens it.
  bool shorten(int i) {
    bool changed = false;
    for (int j = 0; j < dimension; ++j) {
      if (j == i) continue;
      const Vec a = rounded(B[i]), b = rounded(B[j]);
      if (dot(b, b) > dot(a, a)) continue;
      const double k = std::nearbyint(dot(a, b) / dot(b, b));
      if (k == 0) continue;
      const auto before = std::to_array(T[i]);
      const WideVec old = B[i];
      for (int c = 0; c < 3; ++c) T[i][c] -= k * T[j][c];
      recompute(i);
      if (dot(rounded(B[i]), rounded(B[i])) < dot(a, a)) {
        changed = true;
      } else {
        std::copy(before.begin(), before.end(), T[i]);
        B[i] = old;
      }
    }
    return changed;
  }

  void run() {
    for (int pass = 0; pass < 1000; ++pass) {
      bool changed = false;
      for (int i = 0; i < dimension; ++i) changed |= shorten(i);
      if (!changed) break;
    }
    for (int i = 0; i < dimension; ++i)  // shortest first
      for (int j = i + 1; j < dimension; ++j)
        if (length(rounded(B[j])) < length(rounded(B[i]))) {
          std::swap(B[i], B[j]);
          std::swap(T[i], T[j]);
        }
  }
};

void set_dual(Bravais& bravais) {
  const Vec b[3] = {rounded(bravais.basis[0]), rounded(bravais.basis[1]), rounded(bravais.basis[2])};
  const double volume = dot(b[0], cross(b[1], b[2]));
  for (int i = 0; i < 3; ++i) {
    bravais.dual[i] = cross(b[(i + 1) % 3], b[(i + 2) % 3]);
    for (double& component : bravais.dual[i]) component /= volume;
  }
  bravais.volume = std::fabs(volume);
}

// The adjugate: the determinant is 1 or -1. Entries are below 2^20, or the scene is not done.
void set_inverse(Bravais& bravais) {
  const auto& t = bravais.transform;
  const auto minor = [&](int i, int j) {
    const int a = (i + 1) % 3, b = (i + 2) % 3, c = (j + 1) % 3, d = (j + 2) % 3;
    return t[a][c] * t[b][d] - t[a][d] * t[b][c];
  };
  const std::int64_t determinant = t[0][0] * minor(0, 0) + t[0][1] * minor(0, 1) + t[0][2] * minor(0, 2);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) bravais.inverse[i][j] = determinant * minor(j, i);
}

// A lower bound of the shortest lattice vector: a vector with a coefficient of 2 or more in absolute value is
// at least 2/|dual_i| long; the others are tried.
double shortest_vector(const Bravais& bravais) {
  const int d = bravais.dimension;
  double shortest = 0x1p1000;
  for (int i = 0; i < d; ++i) shortest = std::min(shortest, 2 / length(bravais.dual[i]));
  for (int a = 0; a <= 1; ++a)
    for (int b = -1; b <= 1; ++b)
      for (int c = d == 3 ? -1 : 0; c <= (d == 3 ? 1 : 0); ++c) {
        if (a == 0 && b == 0 && c == 0) continue;
        Vec sum{};
        for (int k = 0; k < 3; ++k)
          sum[k] = a * bravais.basis[0][k].hi + b * bravais.basis[1][k].hi + c * bravais.basis[2][k].hi;
        shortest = std::min(shortest, length(sum));
      }
  return shortest;
}

bool is_too_skewed(const Shortening& shortening) {
  for (const auto& row : shortening.T)
    for (const double t : row)
      if (!(std::fabs(t) < kMaxTransform)) return true;
  return false;
}

// Why this atom is beyond the engine, or nothing.
std::string beyond(const Bravais& bravais) {
  const double smallest = bravais.dimension == 2 ? kSmallestRadius2d : kSmallestRadius3d;
  const double shortest = bravais.unit ? 1 : shortest_vector(bravais) * (1 - 0x1p-40);
  if (!(shortest > 0x1p-60 && shortest < 0x1p60))
    return "does not do lattices of so different spacings, or so flat a cell";
  if (!(2 * bravais.radius <= shortest)) return "does radii up to half the shortest lattice vector only";
  if (!(bravais.radius >= smallest * shortest))
    return "does radii from " + std::string(bravais.dimension == 2 ? "1e-12" : "1e-7") +
           " of the shortest lattice vector only";
  return "";
}

Bravais bravais_of(const Scene& scene, int l, int a, const Shortening& shortening, double scale) {
  const Lattice& lattice = scene.lattices[l];
  Bravais bravais;
  bravais.dimension = scene.dimension;
  bravais.lattice = l;
  bravais.atom = a;
  bravais.unit = lattice.vectors == unit_scene(scene.dimension, 1).lattices[0].vectors &&
                 lattice.atoms[a].position == Vec{} && scale == 1;
  bravais.radius = lattice.atoms[a].radius * scale;
  for (int k = 0; k < 3; ++k) bravais.position[k] = lattice.atoms[a].position[k] * scale;
  double largest = 0;
  for (int i = 0; i < 3; ++i) {
    bravais.basis[i] = shortening.B[i];
    for (int k = 0; k < 3; ++k) {
      bravais.transform[i][k] = std::llround(shortening.T[i][k]);
      for (int j = 0; j < 3; ++j)
        largest = std::max(largest, std::fabs(shortening.T[i][j] * shortening.primitive[j][k]));
    }
  }
  bravais.exact = shortening.is_exact();
  bravais.basis_error = bravais.exact ? 0 : 32 * 0x1p-106 * largest;  // three sums of 3 u^2 each, generously
  set_inverse(bravais);
  set_dual(bravais);
  for (int i = 0; i < 3; ++i) bravais.reach[i] = bravais.radius * length(bravais.dual[i]) * (1 + 0x1p-40);
  return bravais;
}

}  // namespace

PreparedScene prepare(const Scene& scene) {
  PreparedScene prepared;
  double scale = 1;
  for (int l = 0; l < static_cast<int>(scene.lattices.size()); ++l) {
    if (l == 0) {
      Shortening unscaled(scene.lattices[0], scene.dimension, 1);
      unscaled.run();
      const double first = length(rounded(unscaled.B[0]));
      if (!(first > 0x1p-400 && first < 0x1p400)) {
        prepared.beyond = "does lattice vectors between 2^-400 and 2^400 only";
        return prepared;
      }
      prepared.exponent = std::ilogb(first);
      scale = std::ldexp(1, -prepared.exponent);
    }
    Shortening shortening(scene.lattices[l], scene.dimension, scale);
    shortening.run();
    if (is_too_skewed(shortening)) {
      prepared.beyond = "does not do cells as skewed as this one";
      return prepared;
    }
    for (int a = 0; a < static_cast<int>(scene.lattices[l].atoms.size()); ++a) {
      if (!scene.lattices[l].atoms[a].is_ball()) {
        prepared.beyond = "does balls only, no semiaxes";
        return prepared;
      }
      const Bravais bravais = bravais_of(scene, l, a, shortening, scale);
      prepared.beyond = beyond(bravais);
      if (!prepared.beyond.empty()) return prepared;
      prepared.atoms.push_back(bravais);
    }
  }
  return prepared;
}

}  // namespace lorentz
