// Where a lattice lies as seen from a start x: the offset of the obstacle in x's home cell, and whether x
// lies in an obstacle.

/// The obstacle of the home cell, relative to x: d = B home + p - x.
template <class Numbers, int D>
struct Offset {
  using Number = typename Numbers::Number;

  DoubleDouble<Numbers> d[D];
  Number home[D];
  Number error;  ///< of each component of d, at most
};

/// Sets d and its error for a given home cell. `place` is x relative to the atom's origin, and `size` is its
/// size.
template <class Arch, class Numbers, int D>
LORENTZ_INLINE void set_offset_from_home(const Bravais& lattice, const DoubleDouble<Arch> (&place)[D],
                                         typename Arch::Number size, Offset<Numbers, D>& offset) {
  using DD = DoubleDouble<Arch>;
  DD d[D];
  for (int k = 0; k < D; ++k) d[k] = -place[k];
  offset.error = all(kFlushed);
  for (int i = 0; i < D; ++i) {
    if constexpr (Arch::kOne)
      if (offset.home[i] == 0) continue;
    for (int k = 0; k < D; ++k) {
      const DD step(lattice.basis[i][k]);
      d[k] = add_product(d[k], step, offset.home[i]);
      size = size + Abs(step.hi * offset.home[i]);
    }
    offset.error = offset.error + Abs(offset.home[i]) * all(lattice.basis_error);
  }
  for (int k = 0; k < D; ++k) offset.d[k] = {d[k].hi, d[k].lo};
  offset.error = offset.error + kPlace * size;
}

/// Coordinate i of x relative to the obstacle of the home cell.
template <class Numbers, int D>
LORENTZ_INLINE typename Numbers::Number coordinate_from_home(const Bravais& lattice,
                                                             const Offset<Numbers, D>& offset, int i) {
  typename Numbers::Number coordinate = all(0);
  for (int k = 0; k < D; ++k) coordinate = coordinate - all(lattice.dual[i][k]) * offset.d[k].hi;
  return coordinate;
}

/// Far out a coordinate errs by so large a part of a cell that the home cell found is a neighbour of the
/// right one, or even farther away. The rest of x in that cell is small, and tells the remaining steps.
/// Returns true where this does not settle.
template <class Arch, class Numbers, int D>
LORENTZ_RARE typename Arch::Mask refine_home(const Bravais& lattice, const DoubleDouble<Arch> (&place)[D],
                                             typename Arch::Number size, typename Arch::Mask far,
                                             Offset<Numbers, D>& offset) {
  for (int pass = 0; pass < kMaxHomePasses; ++pass) {
    typename Arch::Mask moves = everywhere(false);
    for (int i = 0; i < D; ++i) {
      const typename Arch::Number step = where(far, Round(coordinate_from_home(lattice, offset, i)));
      offset.home[i] = offset.home[i] + step;
      moves = Or(moves, step != all(0));
    }
    far = And(far, moves);
    if (nowhere(far)) return far;
    set_offset_from_home(lattice, place, size, offset);
  }
  return far;
}

/// Reduces x to its home cell, whose coordinates differ from those of x by at most 1/2 and kMaxHomeError.
/// Returns those of the `wanted` in which x is not too far away for that. On the unit lattices d is exact.
/// (Beside a row or a layer x may be so far away that another cell is taken for its home. Then x lies in no
/// obstacle, and nothing else depends on the home cell.)
template <class Arch, bool kUnit, int D, class Vector, class Numbers>
LORENTZ_INLINE typename Arch::Mask set_offset(const Bravais& lattice, const Vector& x,
                                              typename Arch::Mask wanted, Offset<Numbers, D>& offset) {
  using DD = DoubleDouble<Arch>;
  using Number = typename Arch::Number;
  if constexpr (kUnit) {
    for (int k = 0; k < D; ++k) {
      wanted = And(wanted, Abs(x[k]) < all(kMaxStart));
      offset.home[k] = Floor(x[k] + all(kBelowHalf));
      const Number here = offset.home[k] - x[k];
      offset.d[k] = IfThenZeroElse(Abs(here) < all(kTinyComponent), here);
    }
    offset.error = all(0);
    return wanted;
  } else {
    DD place[D];
    Number size = all(0);
    for (int k = 0; k < D; ++k) {
      place[k] = DD::sum(x[k], all(-lattice.position[k]));
      size = size + Abs(place[k].hi);
    }
    if (lattice.rank == 0) {
      for (int k = 0; k < D; ++k) offset.home[k] = all(0), offset.d[k] = {Neg(place[k].hi), Neg(place[k].lo)};
      offset.error = all(kFlushed);
      return wanted;
    }
    for (int i = 0; i < D; ++i) {
      Number coordinate = all(0);
      for (int k = 0; k < D; ++k) coordinate = coordinate + all(lattice.dual[i][k]) * place[k].hi;
      wanted = And(wanted, Abs(coordinate) < all(kMaxGeneralStart));
      offset.home[i] = Round(coordinate);
      if constexpr (Arch::kOne)
        if (lattice.shift[i] != 0) offset.home[i] = Round(coordinate - lattice.shift[i]) + lattice.shift[i];
    }
    set_offset_from_home(lattice, place, size, offset);
    const auto far = AndNot(size * all(lattice.coordinate_error) < all(kMaxHomeError), wanted);
    if (nowhere(far)) return wanted;
    const auto lost = refine_home(lattice, place, size, far, offset);
    return lattice.rank < D ? wanted : AndNot(lost, wanted);
  }
}

/// The place, relative to x, of the obstacle N cells from the home cell in the short basis. Returns the error
/// of each component. N: integers, in binary64 or in double-double.
template <bool kUnit, class Arch, class Numbers, int D, class Coefficient>
LORENTZ_INLINE typename Arch::Number place_of(const Bravais& lattice, const Offset<Numbers, D>& offset,
                                              const Coefficient (&N)[D], DoubleDouble<Arch> (&d)[D]) {
  using DD = DoubleDouble<Arch>;
  using Number = typename Arch::Number;
  constexpr bool kWide = !std::is_same_v<Coefficient, Number>;
  Number size = all(0), error = offset.error;
  if constexpr (!kUnit)
    if (lattice.rank == 0) {
      for (int k = 0; k < D; ++k) d[k] = DD(offset.d[k].hi, offset.d[k].lo);
      return error;
    }
  for (int k = 0; k < D; ++k) {
    const DD there(offset.d[k].hi, offset.d[k].lo);
    if constexpr (kUnit && kWide) {
      d[k] = DD::sum(N[k].hi, there.hi);
      if (N[k].lo == 0) continue;  // exact
      d[k] = DD::ordered_sum(d[k].hi, d[k].lo + N[k].lo);
      size = size + Abs(N[k].hi);
    } else if constexpr (kUnit) {
      d[k] = DD::sum(N[k], there.hi);
    } else {
      DD step[D];
      for (int i = 0; i < D; ++i) {
        step[i] = DD(lattice.basis[i][k]) * DD(N[i]);
        size = size + Abs(step[i].hi);
      }
      d[k] = place_after(step, there);
      size = size + Abs(there.hi);
    }
  }
  if constexpr (kUnit && !kWide) return error;
  if constexpr (!kUnit)
    for (int i = 0; i < D; ++i) error = error + Abs(DD(N[i]).hi) * all(lattice.basis_error);
  return error + kPlace * size;
}

/// Is the lattice vector n (in the short basis) exactly parallel to v? False also where binary64 cannot tell.
template <class Arch, int D, class Vector>
LORENTZ_NOINLINE typename Arch::Mask is_parallel(const Bravais& lattice, const Vector& v,
                                                 const typename Arch::Number (&n)[D]) {
  using DD = DoubleDouble<Arch>;
  typename Arch::Mask yes = everywhere(lattice.exact);
  typename Arch::Number w[D];
  for (int k = 0; k < D; ++k) {
    w[k] = all(0);
    for (int i = 0; i < D; ++i) {
      const DD step = DD::product(n[i], all(lattice.basis[i][k].hi)), sum = DD::sum(w[k], step.hi);
      yes = And(yes, And(step.lo == all(0), sum.lo == all(0)));
      w[k] = sum.hi;
    }
  }
  for (int i = D == 2 ? 1 : 0; i < D; ++i) {
    const int j = (i + 1) % D;
    const DD a = DD::product(v[i], w[j]), b = DD::product(v[j], w[i]);
    yes = And(yes, And(a.hi == b.hi, a.lo == b.lo));
  }
  return yes;
}

/// r^2 - |d|^2, in the metric of the shape, and a bound on its error, in binary64.
template <bool kUnit, bool kBall, class Numbers, int D>
LORENTZ_INLINE void set_gap(const Bravais& lattice, const DoubleDouble<Numbers> (&d)[D],
                            typename Numbers::Number error, typename Numbers::Number& gap,
                            typename Numbers::Number& spread) {
  using Number = typename Numbers::Number;
  const Number r = all(lattice.radius), limit = r * r;
  Number high[D], size = all(0);
  for (int k = 0; k < D; ++k) high[k] = d[k].hi, size = size + Abs(d[k].hi);
  const Number square = square_of(high);
  if constexpr (kBall) {
    gap = limit - square;
    spread = kInside * kRoundoff * (square + limit);
    if constexpr (!kUnit) spread = spread + 2 * kDiagonal * error * (r + error);
  } else {
    const Shape& shape = lattice.shape;
    gap = limit - form_of(shape.metric, high);
    spread = kInsideEllipsoid * kRoundoff * (shape.metric_size * square + limit) +
             2 * kDiagonal * shape.metric_size * error * (size + error);
  }
}
