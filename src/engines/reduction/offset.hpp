// Offsets from a centre: tiny components, the octant of a velocity, and whether a start lies in a ball.
// Private to the reduction engine.
#pragma once

#include <cmath>

#include <lorentz/flight.hpp>
#include "src/engines/reduction/one_flight.hpp"
#include "src/engines/reduction/predicates.hpp"

namespace lorentz {

inline double flushed(double a) {
  return std::fabs(a) < kTinyComponent ? 0 : a;
}

template <int D>
inline bool same(const Wide (&a)[D], const Wide* b) {
  for (int i = 0; i < D; ++i)
    if (a[i].hi != b[i].hi || a[i].lo != b[i].lo) return false;
  return true;
}

/// The symmetry of the unit lattices of balls that brings a velocity into the first octant,
/// v_0 >= v_1 >= v_2 >= 0.
struct Octant {
  int axis[3]{0, 1, 2};  ///< the turned component i is component axis[i] times sign[i]
  double sign[3]{1, 1, 1};

  Octant() = default;
  Octant(int dimension, const Vec& v) {
    if (dimension == 2) {
      axis[1] = std::fabs(v[0]) >= std::fabs(v[1]);
      axis[0] = 1 - axis[1];
    } else {  // the place of each is the number of components before it, found without a branch
      const double a = std::fabs(v[0]), b = std::fabs(v[1]), c = std::fabs(v[2]);
      axis[(a < b) + (a < c)] = 0;
      axis[(b <= a) + (b < c)] = 1;
      axis[(c <= a) + (c <= b)] = 2;
    }
    for (int i = 0; i < dimension; ++i) sign[i] = std::copysign(1, v[axis[i]]);
  }

  /// Turns a velocity and drops its tiny components. (Component by component, because a copy as a whole would
  /// wait for them.)
  template <bool kTurned>
  void turn(const Vec& here, Vec& there) const {
    for (int i = 0; i < 3; ++i) there[i] = flushed(kTurned ? here[axis[i]] * sign[i] : here[i]);
  }
  template <int D>
  void apply(const Wide (&here)[D], Wide (&there)[D]) const {
    for (int i = 0; i < D; ++i) there[i] = Wide(here[axis[i]].hi * sign[i], here[axis[i]].lo * sign[i]);
  }
  template <int D>
  void undo(const Wide (&there)[D], Wide (&here)[D]) const {
    for (int i = 0; i < D; ++i) here[axis[i]] = Wide(there[i].hi * sign[i], there[i].lo * sign[i]);
  }
};

/// Is |d| < r, so that x lies in this ball (ellipsoid: in its metric)? In double-double.
template <bool kBall, int D>
[[gnu::noinline]] Decision is_inside_closely(const Wide (&d)[D], double error, const Bravais& lattice) {
  const double r = lattice.radius;
  Wide gap = -Wide::product(r, r);
  double spread = kStable * r * r + 2 * kDiagonal * error * (r + error) + kFlushed;
  if constexpr (kBall) {
    for (const Wide& component : d) gap = gap + component * component;
  } else {
    double square_error;
    gap = gap + square_in(lattice.shape, d, error, square_error);
    spread = kStableForm * r * r + square_error + kFlushed;
  }
  return is_positive(-gap.hi, spread);
}

/// The same, in binary64 if that is certain.
template <bool kUnit, bool kBall, int D>
inline Decision is_inside(const Wide (&d)[D], double error, const Bravais& lattice, Stage& stage) {
  double gap, spread;
  set_gap<kUnit, kBall>(lattice, d, error, gap, spread);
  const Decision decision = is_positive(gap, spread);
  if (decision != Decision::doubtful) return decision;
  stage = Stage::double_double;
  return is_inside_closely<kBall>(d, error, lattice);
}

}  // namespace lorentz
