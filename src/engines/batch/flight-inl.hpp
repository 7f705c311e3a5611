// One vector of flights from start to end, in lanes, as in src/engines/reduction/scene_flight.hpp and
// flight_kernel.hpp. Private to the batch engine and the one on graphics cards.

/// kSingle: the scene's obstacles are single balls. Atoms: the atoms of the scene. Asked: which times are
/// wanted, and each lane's limit and the obstacle that it leaves, if there are any; and whether a time may be
/// put off.
template <int D, bool kUnit, bool kBall, bool kSingle, class Atoms, class Asked>
class LaneFlight {
  using SearchInCrystal = std::conditional_t<D == 2, LaneSearch2<kUnit, kBall>, LaneSearch3<kUnit, kBall>>;
  using Search = std::conditional_t<kSingle, SingleBall<D>, SearchInCrystal>;
  using AtomStart = Start<D, kUnit, kBall>;
  static constexpr bool kTurned = kUnit && kBall;
  static constexpr std::size_t kKept = kUnit || kSingle || Atoms::kOne ? 1 : 6;
  // For discs on the unit lattice a copy, which stays in registers: a reference costs 4 %. Elsewhere copies
  // cost more, up to a third.
  static constexpr bool kCopied = (kUnit && D == 2) || Atoms::kOne;
  using StartOrReference = std::conditional_t<kCopied, AtomStart, const AtomStart&>;

 public:
  M found, inside, stage2;
  Lanes lanes;  ///< active in the end: those that are not left over, nor inside
  M rounded;    ///< found, with a time that is known to be correctly rounded
  V time, cell[D], atom;

  HWY_INLINE LaneFlight(const Atoms& atoms, const Asked& asked, M wanted, const V (&x)[D], const V (&v)[D])
      : lanes(wanted), atoms_(atoms), asked_(asked), x_(x), velocity_(v, lanes), turn_(velocity_.scaled) {}

  HWY_INLINE void run() {
    found = inside = stage2 = rounded = no_lane();
    time = none();
    for (V& component : cell) component = none();
    atom = none();
    look_inside();
    if (any(lanes.active)) fly();
    found = And(found, lanes.active);
  }

 private:
  // Finds the smallest obstacle that contains each start.
  HWY_INLINE void look_inside() {
    for (std::size_t a = 0; a < atoms_.size(); ++a) {
      AtomStart made;
      AtomStart& start = !kCopied && a < kKept ? starts_[a] : made;
      start.set(atoms_.inverse_unit, atoms_[a], x_, lanes);
      if (kCopied) starts_[0] = start;
      Leaving<D> leaving;
      const M here = start.inside(find_leaving(start, leaving), lanes, stage2);
      if (nowhere(here)) continue;
      V zero[D];
      for (V& n : zero) n = none();
      name(here, a, start, zero);
      const M named = And(here, lanes.active);
      inside = Or(inside, named);
      lanes.leave(named);
    }
  }

  HWY_INLINE void fly() {
    V velocity[D];
    turn_.apply(velocity_.scaled, velocity);
    V limit = infinite();
    if (asked_.is_limited()) limit = velocity_.template limit_of<kUnit>(asked_.limit(), atoms_.inverse_unit);
    V max_time = limit;
    typename Search::Direction to;
    LaneEntry<D, kBall> best;
    V best_atom = none();
    for (std::size_t a = 0; a < atoms_.size(); ++a) {
      if constexpr (kSingle)
        to.set(atoms_[a], velocity);
      else
        set_direction(a, velocity, to);
      AtomStart made;
      StartOrReference start = start_of(a, made);
      Leaving<D> leaving;
      const Leaving<D>* left = find_leaving(start, leaving);
      const V s_limit = (max_time * to.v2 + to.s_rho) * all(1 + kAmple);
      Offset<LaneFma, D> seen;
      turn_start(start, seen);
      if (left != nullptr && kTurned) turn_leaving(leaving);
      Search search(to, atoms_[a], seen, left, s_limit);
      search.run(lanes);
      if constexpr (D == 2 || kSingle) stage2 = Or(stage2, search.stage2);
      M next = And(lanes.active, search.found.s < infinite());
      set_cell(search.found);
      if (a == 0) {
        best = search.found;
        found = next;
      } else {
        V error;
        const V time = best.rough_time(error);
        next = And(sooner(search.found, time, error, next), lanes.active);
        best.take(next, search.found);
        found = And(Or(found, next), lanes.active);
      }
      best_atom = select(next, all(static_cast<double>(a)), best_atom);
      if (a + 1 < atoms_.size()) {
        V error;
        const V time = search.found.rough_time(error);
        max_time = select(next, Min(max_time, time + error), max_time);
      }
      if (nowhere(lanes.active)) break;
    }
    found = And(found, lanes.active);
    if (asked_.is_limited()) found = sooner(best, limit, none(), found);
    for (std::size_t a = 0; a < atoms_.size(); ++a) {
      const M here = And(found, best_atom == all(static_cast<double>(a)));
      if (any(here)) finish(here, a, best);
    }
  }

  // Sets the direction for an atom of a crystal.
  HWY_INLINE void set_direction(std::size_t a, const V (&velocity)[D], typename Search::Direction& to) {
    const Bravais& lattice = atoms_[a];
    if (a > 0) {
      const Bravais& before = atoms_[a - 1];
      const bool same_lattice = before.lattice == lattice.lattice;
      if (same_lattice && before.radius == lattice.radius && (kBall || before.shape == lattice.shape)) return;
      if constexpr (D == 3 && kBall && !kUnit)
        if (same_lattice) {
          to.template retarget<LaneFma>(lattice, lanes.active);
          return lanes.leave_unless(to.basis.usable);
        }
    }
    to.template set<LaneFma>(lattice, velocity, lanes.active);
    if constexpr (D == 2)
      lanes.leave_unless(
          And(to.usable, to.L.S > none()));  // a single flight knows what to do with an infinity
    else
      lanes.leave_unless(to.basis.usable);
  }

  // The start as it was kept, or made again.
  HWY_INLINE StartOrReference start_of(std::size_t a, AtomStart& made) {
    if (kUnit) return starts_[0];
    if (a < kKept) return starts_[a];
    made.set(atoms_.inverse_unit, atoms_[a], x_, lanes);
    return made;
  }

  // The obstacle of this atom that each lane leaves; null if no lane leaves one.
  HWY_INLINE const Leaving<D>* find_leaving(const AtomStart& start, Leaving<D>& leaving) const {
    return asked_.find_leaving(start, leaving) ? &leaving : nullptr;
  }

  HWY_INLINE void turn_start(const AtomStart& start, Offset<LaneFma, D>& seen) const {
    seen.error = start.error;
    if constexpr (kTurned) {
      V here[D], there[D];
      for (int k = 0; k < D; ++k) here[k] = start.d[k].hi;
      turn_.apply(here, there);
      for (int k = 0; k < D; ++k) seen.d[k] = Pair(there[k]);
    } else {
      for (int k = 0; k < D; ++k) seen.d[k] = start.d[k];
    }
  }

  HWY_INLINE void turn_leaving(Leaving<D>& leaving) const {
    V there[D];
    turn_.apply(leaving.n, there);
    for (int k = 0; k < D; ++k) leaving.n[k] = there[k];
  }

  // Turns the cell back to the scene's own axes.
  HWY_INLINE void set_cell(LaneEntry<D, kBall>& entry) const {
    V here[D];
    turn_.undo(entry.n, here);
    for (int k = 0; k < D; ++k) entry.n[k] = here[k];
  }

  // Returns the lanes of `next` in which `one` comes before another hit or a limit, whose time errs by
  // `other_error`. Lanes in which that is not certain are left over.
  HWY_INLINE M sooner(const LaneEntry<D, kBall>& one, V other_time, V other_error, M next) {
    const M both = And(next, found);
    V error;
    const V difference = other_time - one.rough_time(error);
    const V spread = error + other_error;
    const M yes = difference > spread, no = difference < Neg(spread);
    lanes.leave(AndNot(Or(yes, no), both));
    return And(next, Or(Not(found), yes));
  }

  // Sets the cell and the time of the obstacle found, one of atom a.
  HWY_INLINE void finish(M here, std::size_t a, const LaneEntry<D, kBall>& entry) {
    AtomStart made;
    StartOrReference start = start_of(a, made);
    name(here, a, start, entry.n);
    const Times<D, kUnit, kBall> times(start, entry, velocity_.scaled);
    M is_rounded = no_lane();
    const V scaled = asked_.wants_rounded() ? rounded_time(here, times, entry, is_rounded)
                                            : close_time(here, times, entry);
    time = select(here, velocity_.template time_of<kUnit>(scaled, atoms_.unit), time);
    rounded = Or(rounded, And(here, is_rounded));
  }

  HWY_INLINE V rounded_time(M here, const Times<D, kUnit, kBall>& times, const LaneEntry<D, kBall>& entry,
                            M& is_rounded) {
    if (!times.are_soon_rounded()) return times.rounded(is_rounded);
    const V soon = times.soon_rounded(is_rounded);
    const M late = AndNot(is_rounded, And(here, lanes.active));
    if (nowhere(late)) return soon;
    if (atoms_.size() == 1 && asked_.put_off(late, entry)) return select(is_rounded, soon, all(1));
    return times.rounded(is_rounded);
  }

  HWY_INLINE V close_time(M here, const Times<D, kUnit, kBall>& times, const LaneEntry<D, kBall>& entry) {
    if constexpr (kBall) {
      if (kUnit || atoms_.size() == 1) {
        const M late = And(times.is_grazed(), And(here, lanes.active));
        if (nowhere(late) || asked_.put_off(late, entry)) return select(late, all(1), times.plain_or_near());
      }
    }
    return times.close(here);
  }

  // Names an obstacle of atom a by its cell in the scene's primitive vectors, computed from its cell in the
  // short basis.
  HWY_INLINE void name(M here, std::size_t a, const AtomStart& start, const V (&n)[D]) {
    atom = select(here, all(static_cast<double>(a)), atom);
    if constexpr (kSingle) return;  // there is only the cell 0
    const Bravais& lattice = atoms_[a];
    const V limit = all(0x1p51);
    V m[D];
    for (int i = 0; i < D; ++i) {
      m[i] = n[i] + start.home[i];
      lanes.leave(And(here, Not(Max(Abs(n[i]), Abs(m[i])) < limit)));
    }
    for (int k = 0; k < D; ++k) {
      V c = m[k];
      if constexpr (!kUnit) {
        c = none();
        V size = none();
        for (int i = 0; i < D; ++i) {
          const V step = m[i] * all(static_cast<double>(lattice.transform[i][k]));
          c = c + step, size = size + Abs(step);
        }
        lanes.leave(And(here, Not(size < limit)));
      }
      cell[k] = select(here, c, cell[k]);
    }
  }

  const Atoms& atoms_;
  const Asked& asked_;
  const V (&x_)[D];
  Velocity<D> velocity_;
  Turn<D, kTurned> turn_;
  AtomStart starts_[kKept];
};
