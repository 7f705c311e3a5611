// Where one atom's lattice lies as seen from the starts, in lanes, as in src/engines/reduction/offset.hpp and
// atom_start.hpp. Private to the batch engine.

/// The cell of the obstacle that each lane of `any` leaves, relative to the home cell, in the short basis.
template <int D>
struct Leaving {
  M any;
  V n[D];
};

/// A start relative to one atom's lattice.
template <int D, bool kUnit, bool kBall>
struct Start : Offset<LaneFma, D> {
  using Offset<LaneFma, D>::d, Offset<LaneFma, D>::home, Offset<LaneFma, D>::error;

  const Bravais* lattice;

  /// Sets it for starts x in the scene's own lengths.
  HWY_INLINE void set(double inverse_unit, const Bravais& of_lattice, const V (&x)[D], Lanes& lanes) {
    lattice = &of_lattice;
    V scaled[D];
    for (int k = 0; k < D; ++k) scaled[k] = kUnit ? x[k] : x[k] * all(inverse_unit);
    lanes.active = set_offset<LaneFma, kUnit>(of_lattice, scaled, lanes.active, offset());
  }

  /// Returns the lanes whose start lies in the obstacle of the home cell. Lanes in which that is not certain
  /// are left over, and so are lanes whose start may lie in an obstacle of another cell. `leaving` is
  /// ignored; where that settles a decision that is not certain, `stage2` has it.
  HWY_INLINE M inside(const Leaving<D>* leaving, Lanes& lanes, M& stage2) const {
    if constexpr (!(kUnit && kBall))
      if (lattice->reaches_out) lanes.leave(may_be_in_others(leaving, lanes.active));
    V gap, spread;
    set_gap<kUnit, kBall>(*lattice, d, error, gap, spread);
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

  /// The place, relative to x, of the obstacle of cell n, which is counted from the home cell in the short
  /// basis. Returns the error of each component.
  HWY_INLINE V place(const V (&n)[D], Pair (&there)[D]) const {
    return place_of<kUnit>(*lattice, offset(), n, there);
  }

 private:
  HWY_INLINE Offset<LaneFma, D>& offset() { return *this; }
  HWY_INLINE const Offset<LaneFma, D>& offset() const { return *this; }

  struct Near {
    M m[D];
    V other[D];
  };

  // Returns the lanes in which, as far as binary64 knows, an obstacle of another cell may contain x: up to
  // one step along each basis vector. If any lane leaves an obstacle, returns all lanes that are near one of
  // another cell, because such starts are rare.
  HWY_INLINE M may_be_in_others(const Leaving<D>* leaving, M asked) const {
    M any_near = no_lane();
    Near near;
    for (int i = 0; i < D; ++i) {
      const V coordinate = coordinate_from_home(*lattice, offset(), i);
      near.m[i] = AndNot(Abs(coordinate) + all(lattice->reach[i]) < all(1 - kMaxHomeError), asked);
      near.other[i] = CopySign(all(1), coordinate);
      any_near = Or(any_near, near.m[i]);
    }
    if (leaving != nullptr) return any_near;
    return nowhere(any_near) ? any_near : in_others(*this, near, asked);
  }

  // Is x in an obstacle of a neighbouring cell? Rare, so it gets copies.
  static HWY_NOINLINE M in_others(Start start, Near near, M asked) {
    M inside = no_lane();
    for (int which = 1; which < 1 << D; ++which) {
      M here = asked;
      V n[D], gap, spread;
      for (int i = 0; i < D; ++i) {
        n[i] = which >> i & 1 ? near.other[i] : none();
        if (which >> i & 1) here = And(here, near.m[i]);
      }
      if (nowhere(here)) continue;
      Pair there[D];
      const V its_error = start.place(n, there);
      set_gap<kUnit, kBall>(*start.lattice, there, its_error, gap, spread);
      inside = Or(inside, AndNot(gap < Neg(spread), here));
    }
    return inside;
  }
};
