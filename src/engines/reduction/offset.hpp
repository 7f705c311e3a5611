// Where the lattice lies as seen from a start x: the offset of the ball in x's home cell, and whether x lies
// in a ball.
#pragma once

#include <cmath>

#include <lorentz/engine_base.hpp>
#include <lorentz/flight.hpp>
#include "src/engines/reduction/bravais.hpp"
#include "src/engines/reduction/formulas.hpp"
#include "src/engines/reduction/predicates.hpp"
#include "src/engines/reduction/stable_meeting.hpp"

namespace lorentz {

inline double flushed(double a) {
  return std::fabs(a) < kTinyComponent ? 0 : a;
}

/// The ball of the home cell, seen from x: d = B home + p - x.
template <int D>
struct Offset {
  Wide d[D];
  double home[D];
  double error = 0;  ///< of each component, at most
};

/// d, and its error, for a home cell that is chosen; `place` is x seen from the atom's origin, of this size.
template <class Arch, int D>
inline void set_offset_from_home(const Bravais& lattice, const DoubleDouble<Arch> (&place)[D], double size,
                                 Offset<D>& offset) {
  using DD = DoubleDouble<Arch>;
  DD d[D];
  for (int k = 0; k < D; ++k) d[k] = -place[k];
  offset.error = kFlushed;
  for (int i = 0; i < D; ++i) {
    if (offset.home[i] == 0) continue;
    for (int k = 0; k < D; ++k) {
      const DD step(lattice.basis[i][k].hi, lattice.basis[i][k].lo);
      d[k] = add_product(d[k], step, offset.home[i]);
      size += std::fabs(step.hi * offset.home[i]);
    }
    offset.error += std::fabs(offset.home[i]) * lattice.basis_error;
  }
  for (int k = 0; k < D; ++k) offset.d[k] = Wide(d[k]);
  offset.error += kPlace * size;
}

/// The coordinate i of x, seen from the ball of the home cell.
template <int D>
inline double coordinate_from_home(const Bravais& lattice, const Offset<D>& offset, int i) {
  double coordinate = 0;
  for (int k = 0; k < D; ++k) coordinate -= lattice.dual[i][k] * offset.d[k].hi;
  return coordinate;
}

/// Far out a coordinate errs by so much of a cell that the home cell is a neighbour's, or farther off. What
/// is left of x in it is small, and tells the rest of the way. False if that does not settle.
template <class Arch, int D>
[[gnu::noinline]] bool refine_home(const Bravais& lattice, const DoubleDouble<Arch> (&place)[D], double size,
                                   Offset<D>& offset) {
  for (int pass = 0; pass < kMaxHomePasses; ++pass) {
    bool at_home = true;
    for (int i = 0; i < D; ++i) {
      const double step = std::nearbyint(coordinate_from_home(lattice, offset, i));
      offset.home[i] += step;
      at_home &= step == 0;
    }
    if (at_home) return true;
    set_offset_from_home(lattice, place, size, offset);
  }
  return false;
}

/// Reduces x to its home cell, whose coordinates are within 1/2 of those of x, and kMaxHomeError; false if x
/// is too far away for that. On the unit lattices d is exact.
template <class Arch, bool kUnit, int D>
inline bool set_offset(const Bravais& lattice, const Vec& x, Offset<D>& offset) {
  using DD = DoubleDouble<Arch>;
  if constexpr (kUnit) {
    for (int k = 0; k < D; ++k) {
      if (!(std::fabs(x[k]) < kMaxStart)) return false;
      offset.home[k] = std::floor(x[k] + kBelowHalf);
      offset.d[k] = Wide(flushed(offset.home[k] - x[k]));
    }
    return true;
  }
  DD place[D];
  double size = 0;
  for (int k = 0; k < D; ++k) {
    place[k] = DD::sum(x[k], -lattice.position[k]);
    size += std::fabs(place[k].hi);
  }
  for (int i = 0; i < D; ++i) {
    double coordinate = 0;
    for (int k = 0; k < D; ++k) coordinate += lattice.dual[i][k] * place[k].hi;
    if (!(std::fabs(coordinate) < kMaxGeneralStart)) return false;
    offset.home[i] = std::nearbyint(coordinate);
  }
  set_offset_from_home(lattice, place, size, offset);
  return size * lattice.coordinate_error < kMaxHomeError || refine_home(lattice, place, size, offset);
}

/// The symmetry of the unit lattices of balls that brings a velocity into the first octant, v_0 >= v_1 >= v_2
/// >= 0.
struct Octant {
  int axis[3]{0, 1, 2};  ///< component i there is component axis[i] here, times sign[i]
  double sign[3]{1, 1, 1};

  Octant() = default;
  Octant(int dimension, const Vec& v) {
    if (dimension == 2) {
      axis[1] = std::fabs(v[0]) >= std::fabs(v[1]);
      axis[0] = 1 - axis[1];
    } else {  // the number of components that come before each one: its place, without a branch
      const double a = std::fabs(v[0]), b = std::fabs(v[1]), c = std::fabs(v[2]);
      axis[(a < b) + (a < c)] = 0;
      axis[(b <= a) + (b < c)] = 1;
      axis[(c <= a) + (c <= b)] = 2;
    }
    for (int i = 0; i < dimension; ++i) sign[i] = std::copysign(1, v[axis[i]]);
  }

  /// A velocity, without its tiny components. (Component by component: a copy as a whole would wait for
  /// them.)
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

/// The ball N cells on from the home cell, in the short basis, seen from x; returns the error of each
/// component.
template <class Arch, bool kUnit, int D>
inline double place_of(const Bravais& lattice, const Offset<D>& offset, const DoubleDouble<Arch> (&N)[D],
                       DoubleDouble<Arch> (&d)[D]) {
  using DD = DoubleDouble<Arch>;
  double size = 0, error = offset.error;
  for (int k = 0; k < D; ++k) {
    if constexpr (kUnit) {
      d[k] = DD::sum(N[k].hi, offset.d[k].hi);
      if (N[k].lo == 0) continue;  // exact
      d[k] = DD::ordered_sum(d[k].hi, d[k].lo + N[k].lo);
      size += std::fabs(N[k].hi);
    } else {
      DD step[D];
      for (int i = 0; i < D; ++i) {
        step[i] = DD(lattice.basis[i][k].hi, lattice.basis[i][k].lo) * N[i];
        size += std::fabs(step[i].hi);
      }
      d[k] = place_after(step, DD(offset.d[k]));
      size += std::fabs(offset.d[k].hi);
    }
  }
  if (!kUnit)
    for (int i = 0; i < D; ++i) error += std::fabs(N[i].hi) * lattice.basis_error;
  return error + kPlace * size;
}

/// Is the lattice vector n (in the short basis) exactly parallel to v? No also where binary64 cannot tell.
[[gnu::noinline]] inline bool is_parallel(const Bravais& lattice, const Vec& v, const double* n) {
  if (!lattice.exact) return false;
  Vec w{};
  for (int k = 0; k < lattice.dimension; ++k)
    for (int i = 0; i < lattice.dimension; ++i) {
      const Wide step = Wide::product(n[i], lattice.basis[i][k].hi), sum = Wide::sum(w[k], step.hi);
      if (step.lo != 0 || sum.lo != 0) return false;
      w[k] = sum.hi;
    }
  const auto equal = [](Wide a, Wide b) { return a.hi == b.hi && a.lo == b.lo; };
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    if (!equal(Wide::product(v[i], w[j]), Wide::product(v[j], w[i]))) return false;
  }
  return true;
}

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
template <bool kBall, int D>
inline Decision is_inside(const Wide (&d)[D], double error, const Bravais& lattice, Stage& stage) {
  const double r = lattice.radius, limit = r * r;
  double high[D], form = 0, size = 0;
  for (int k = 0; k < D; ++k) high[k] = d[k].hi, size += std::fabs(d[k].hi);
  const double square = square_of(high);
  double spread = kInside * kRoundoff * (square + limit) + 2 * kDiagonal * error * (r + error);
  if constexpr (!kBall) {
    const Shape& shape = lattice.shape;
    form = form_of(shape.metric, high);
    spread = kInsideEllipsoid * kRoundoff * (shape.metric_size * square + limit) +
             2 * kDiagonal * shape.metric_size * error * (size + error);
  }
  const Decision decision = is_positive(limit - (kBall ? square : form), spread);
  if (decision != Decision::doubtful) return decision;
  stage = Stage::double_double;
  return is_inside_closely<kBall>(d, error, lattice);
}

}  // namespace lorentz
