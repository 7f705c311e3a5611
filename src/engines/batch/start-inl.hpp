// Where one atom's lattice lies as seen from the starts, in lanes: src/engines/reduction/offset.hpp and
// atom_start.hpp. Private to the batch engine.
#if defined(LORENTZ_BATCH_START_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef LORENTZ_BATCH_START_INL_HPP
#undef LORENTZ_BATCH_START_INL_HPP
#else
#define LORENTZ_BATCH_START_INL_HPP
#endif

#include <lorentz/engine_base.hpp>
#include "src/engines/batch/lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace lorentz {
namespace HWY_NAMESPACE {
namespace {

/// An obstacle's cell, from the home cell in the short basis, of the lanes that leave one.
template <int D>
struct Leaving {
  M any;
  V n[D];
};

/// The obstacle of the home cell, seen from x: d = B home + p - x.
template <int D, bool kUnit, bool kBall>
struct Start {
  const Bravais* lattice;
  V home[D];
  Pair d[D];
  V error;  ///< of each component of d, at most

  /// Of starts in the scene's own lengths.
  HWY_INLINE void set(const PreparedScene& scene, const Bravais& of_lattice, const V (&x)[D], Lanes& lanes) {
    lattice = &of_lattice;
    if constexpr (kUnit) return set_unit(x, lanes);
    const V scale = all(std::ldexp(1.0, -scene.exponent));
    V scaled[D];
    for (int k = 0; k < D; ++k) scaled[k] = x[k] * scale;
    set_general(scaled, lanes);
  }

  /// Lanes whose start lies in the obstacle of the home cell. Left over are those for which that is not
  /// certain, and those that may lie in an obstacle of another cell. `leaving` is ignored; if that takes a
  /// decision which is not certain, `stage2` has it.
  HWY_INLINE M inside(const Leaving<D>* leaving, Lanes& lanes, M& stage2) const {
    if constexpr (!(kUnit && kBall))
      if (lattice->reaches_out) lanes.leave(may_be_in_others(leaving, lanes.active));
    V gap, spread;
    set_gap(d, error, gap, spread);
    const M yes = gap > spread, doubtful = AndNot(yes, Not(gap < Neg(spread)));
    if (leaving == nullptr) {
      lanes.leave(doubtful);
      return And(yes, lanes.active);
    }
    M home_is_left = leaving->any;
    for (int i = 0; i < D; ++i) home_is_left = And(home_is_left, leaving->n[i] == none());
    lanes.leave(AndNot(home_is_left, doubtful));
    stage2 = Or(stage2, And(And(home_is_left, doubtful), lanes.active));
    return And(AndNot(home_is_left, yes), lanes.active);
  }

  /// place_of: the obstacle of the cell n, from the home cell in the short basis, as seen from x; returns the
  /// error of each component.
  HWY_INLINE V place(const V (&n)[D], Pair (&there)[D]) const {
    if constexpr (kUnit) {
      for (int k = 0; k < D; ++k) there[k] = Pair::sum(n[k], d[k].hi);
      return error;
    } else {
      V size = none(), its_error = error;
      for (int k = 0; k < D; ++k) {
        Pair step[D];
        for (int i = 0; i < D; ++i) {
          step[i] = Pair(lattice->basis[i][k]) * Pair(n[i]);
          size = size + Abs(step[i].hi);
        }
        Pair sum = step[0];
        for (int i = 1; i < D; ++i) sum = sum + step[i];
        there[k] = sum + d[k];
        size = size + Abs(d[k].hi);
      }
      for (int i = 0; i < D; ++i) its_error = its_error + Abs(n[i]) * all(lattice->basis_error);
      return its_error + all(kPlace) * size;
    }
  }

 private:
  HWY_INLINE void set_unit(const V (&x)[D], Lanes& lanes) {
    for (int k = 0; k < D; ++k) {
      lanes.leave_unless(Abs(x[k]) < all(kMaxStart));
      home[k] = Floor(x[k] + all(kBelowHalf));
      const V here = home[k] - x[k];
      d[k] = Pair(IfThenZeroElse(Abs(here) < all(kTinyComponent), here));
    }
    error = none();
  }

  HWY_INLINE void set_general(const V (&x)[D], Lanes& lanes) {
    Pair place[D];
    V size = none();
    for (int k = 0; k < D; ++k) {
      place[k] = Pair::sum(x[k], all(-lattice->position[k]));
      size = size + Abs(place[k].hi);
    }
    for (int i = 0; i < D; ++i) {
      V coordinate = none();
      for (int k = 0; k < D; ++k) coordinate = coordinate + all(lattice->dual[i][k]) * place[k].hi;
      lanes.leave_unless(Abs(coordinate) < all(kMaxGeneralStart));
      home[i] = Round(coordinate);
    }
    set_from_home(place, size);
    const M far = AndNot(size * all(lattice->coordinate_error) < all(kMaxHomeError), lanes.active);
    if (any(far)) refine_home(place, size, far, lanes);
  }

  HWY_INLINE void set_from_home(const Pair (&place)[D], V size) {
    for (int k = 0; k < D; ++k) d[k] = -place[k];
    error = all(kFlushed);
    for (int i = 0; i < D; ++i) {
      for (int k = 0; k < D; ++k) {
        const Pair step = Pair(lattice->basis[i][k]);
        d[k] = add_product(d[k], step, home[i]);
        size = size + Abs(step.hi * home[i]);
      }
      error = error + Abs(home[i]) * all(lattice->basis_error);
    }
    error = error + all(kPlace) * size;
  }

  // The coordinate i of x, seen from the obstacle of the home cell.
  HWY_INLINE V coordinate_from_home(int i) const {
    V coordinate = none();
    for (int k = 0; k < D; ++k) coordinate = coordinate - all(lattice->dual[i][k]) * d[k].hi;
    return coordinate;
  }

  // Far out, a coordinate is not known well enough to tell the home cell; what is left of x tells the rest.
  HWY_INLINE void refine_home(const Pair (&place)[D], V size, M far, Lanes& lanes) {
    for (int pass = 0; pass < kMaxHomePasses; ++pass) {
      M moves = no_lane();
      for (int i = 0; i < D; ++i) {
        const V step = where(far, Round(coordinate_from_home(i)));
        home[i] = home[i] + step;
        moves = Or(moves, step != none());
      }
      far = And(far, moves);
      if (nowhere(far)) return;
      set_from_home(place, size);
    }
    lanes.leave(far);
  }

  // Lanes in which an obstacle of another cell contains x, for all that binary64 knows: up to one step along
  // each basis vector. Where one is left, all that are near one: such starts are rare.
  HWY_INLINE M may_be_in_others(const Leaving<D>* leaving, M asked) const {
    M near[D], any_near = no_lane(), inside = no_lane();
    V other[D];
    for (int i = 0; i < D; ++i) {
      const V coordinate = coordinate_from_home(i);
      near[i] = AndNot(Abs(coordinate) + all(lattice->reach[i]) < all(1 - kMaxHomeError), asked);
      other[i] = CopySign(all(1), coordinate);
      any_near = Or(any_near, near[i]);
    }
    if (leaving != nullptr) return any_near;
    if (nowhere(any_near)) return inside;
    for (int which = 1; which < 1 << D; ++which) {
      M here = asked;
      V n[D], gap, spread;
      for (int i = 0; i < D; ++i) {
        n[i] = which >> i & 1 ? other[i] : none();
        if (which >> i & 1) here = And(here, near[i]);
      }
      if (nowhere(here)) continue;
      Pair there[D];
      const V its_error = place(n, there);
      set_gap(there, its_error, gap, spread);
      inside = Or(inside, AndNot(gap < Neg(spread), here));
    }
    return inside;
  }

  // r^2 - |d|^2, in the metric of the shape, and the bound of its error.
  HWY_INLINE void set_gap(const Pair (&d)[D], V error, V& gap, V& spread) const {
    const double r = lattice->radius;
    const V limit = all(r * r);
    V square = d[0].hi * d[0].hi, size = Abs(d[0].hi);
    for (int k = 1; k < D; ++k) square = square + d[k].hi * d[k].hi, size = size + Abs(d[k].hi);
    if constexpr (kBall) {
      spread = all(kInside * kRoundoff) * (square + limit);
      if constexpr (!kUnit) spread = spread + all(2 * kDiagonal) * error * (all(r) + error);
      gap = limit - square;
    } else {
      const Shape& shape = lattice->shape;
      V form = all(shape.metric[0][0].hi) * d[0].hi * d[0].hi;
      for (int i = 0; i < D; ++i)
        for (int k = i == 0; k < D; ++k) form = form + all(shape.metric[i][k].hi) * d[i].hi * d[k].hi;
      spread = all(kInsideEllipsoid * kRoundoff) * (all(shape.metric_size) * square + limit) +
               all(2 * kDiagonal * shape.metric_size) * error * (size + error);
      gap = limit - form;
    }
  }
};

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace lorentz
HWY_AFTER_NAMESPACE();

#endif
