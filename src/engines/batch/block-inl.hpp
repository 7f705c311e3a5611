// One vector of queries from start to end, in lanes, as in src/engines/reduction/scene_flight.hpp and
// flight_kernel.hpp. Private to the batch engine.

/// The queries [at, at + lanes) of a stretch. kSingle: the scene's obstacles are single balls.
template <int D, bool kUnit, bool kBall, bool kSingle>
class Block {
  using SearchInCrystal = std::conditional_t<D == 2, LaneSearch2<kUnit, kBall>, LaneSearch3<kUnit, kBall>>;
  using Search = std::conditional_t<kSingle, SingleBall<D>, SearchInCrystal>;
  using AtomStart = Start<D, kUnit, kBall>;
  static constexpr bool kTurned = kUnit && kBall;
  static constexpr std::size_t kKept = kUnit || kSingle ? 1 : 6;
  // For discs on the unit lattice a copy, which stays in registers: a reference costs 4 %. Elsewhere copies
  // cost more, up to a third.
  static constexpr bool kCopied = kUnit && D == 2;
  using StartOrReference = std::conditional_t<kCopied, AtomStart, const AtomStart&>;

 public:
  HWY_INLINE Block(const PreparedScene& scene, Stretch& stretch, LateTimes<D, kUnit, kBall>& late,
                   std::size_t at, const V (&x)[D], const V (&v)[D])
      : scene_(scene),
        stretch_(stretch),
        late_(late),
        at_(at),
        x_(x),
        asked_(first_lanes(stretch.count - at)),
        lanes_(asked_),
        velocity_(v, lanes_),
        turn_(velocity_.scaled) {}

  HWY_INLINE void run() {
    found_ = inside_ = stage2_ = rounded_ = no_lane();
    time_ = none();
    for (V& component : cell_) component = none();
    atom_ = none();
    look_inside();
    if (any(lanes_.active)) fly();
    tell();
  }

 private:
  // Finds the smallest obstacle that contains each start.
  HWY_INLINE void look_inside() {
    for (std::size_t a = 0; a < scene_.atoms.size(); ++a) {
      AtomStart made;
      AtomStart& start = !kCopied && a < kKept ? starts_[a] : made;
      start.set(scene_, scene_.atoms[a], x_, lanes_);
      if (kCopied) starts_[0] = start;
      Leaving<D> leaving;
      const M here = start.inside(find_leaving(start, leaving), lanes_, stage2_);
      if (nowhere(here)) continue;
      V zero[D];
      for (V& n : zero) n = none();
      name(here, a, start, zero);
      const M named = And(here, lanes_.active);
      inside_ = Or(inside_, named);
      lanes_.leave(named);
    }
  }

  HWY_INLINE void fly() {
    V velocity[D];
    turn_.apply(velocity_.scaled, velocity);
    V limit = infinite();
    if (stretch_.max_time) limit = velocity_.template limit_of<kUnit>(load(stretch_.max_time + at_), scene_);
    V max_time = limit;
    typename Search::Direction to;
    LaneEntry<D, kBall> best;
    V best_atom = none();
    for (std::size_t a = 0; a < scene_.atoms.size(); ++a) {
      if constexpr (kSingle)
        to.set(scene_.atoms[a], velocity);
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
      Search search(to, scene_.atoms[a], seen, left, s_limit);
      search.run(lanes_);
      if constexpr (D == 2 || kSingle) stage2_ = Or(stage2_, search.stage2);
      M next = And(lanes_.active, search.found.s < infinite());
      set_cell(search.found);
      if (a == 0) {
        best = search.found;
        found_ = next;
      } else {
        V error;
        const V time = best.rough_time(error);
        next = And(sooner(search.found, time, error, next), lanes_.active);
        best.take(next, search.found);
        found_ = And(Or(found_, next), lanes_.active);
      }
      best_atom = select(next, all(static_cast<double>(a)), best_atom);
      if (a + 1 < scene_.atoms.size()) {
        V error;
        const V time = search.found.rough_time(error);
        max_time = select(next, Min(max_time, time + error), max_time);
      }
      if (nowhere(lanes_.active)) break;
    }
    found_ = And(found_, lanes_.active);
    if (stretch_.max_time) found_ = sooner(best, limit, none(), found_);
    for (std::size_t a = 0; a < scene_.atoms.size(); ++a) {
      const M here = And(found_, best_atom == all(static_cast<double>(a)));
      if (any(here)) finish(here, a, best);
    }
  }

  // Sets the direction for an atom of a crystal.
  HWY_INLINE void set_direction(std::size_t a, const V (&velocity)[D], typename Search::Direction& to) {
    const Bravais& lattice = scene_.atoms[a];
    if (a > 0) {
      const Bravais& before = scene_.atoms[a - 1];
      const bool same_lattice = before.lattice == lattice.lattice;
      if (same_lattice && before.radius == lattice.radius && (kBall || before.shape == lattice.shape)) return;
      if constexpr (D == 3 && kBall && !kUnit)
        if (same_lattice) {
          to.template retarget<LaneFma>(lattice, lanes_.active);
          return lanes_.leave_unless(to.basis.usable);
        }
    }
    to.template set<LaneFma>(lattice, velocity, lanes_.active);
    if constexpr (D == 2)
      lanes_.leave_unless(
          And(to.usable, to.L.S > none()));  // a single flight knows what to do with an infinity
    else
      lanes_.leave_unless(to.basis.usable);
  }

  // The start as it was kept, or made again.
  HWY_INLINE StartOrReference start_of(std::size_t a, AtomStart& made) {
    if (kUnit) return starts_[0];
    if (a < kKept) return starts_[a];
    made.set(scene_, scene_.atoms[a], x_, lanes_);
    return made;
  }

  // The obstacle of this atom that each lane leaves; null if no lane leaves one.
  HWY_INLINE const Leaving<D>* find_leaving(const AtomStart& start, Leaving<D>& leaving) const {
    if (!stretch_.from_lattice) return nullptr;
    const AtomStart copy = start;
    leaving = leaving_of(stretch_, at_, copy);
    return any(leaving.any) ? &leaving : nullptr;
  }

  // AtomStart::find_from, lane by lane.
  static HWY_NOINLINE Leaving<D> leaving_of(const Stretch& stretch, std::size_t at, const AtomStart& start) {
    const Bravais& lattice = *start.lattice;
    HWY_ALIGN double home[D][kMaxLanes], n[D][kMaxLanes] = {}, leaves[kMaxLanes] = {};
    for (int i = 0; i < D; ++i) store(start.home[i], home[i]);
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      const std::size_t q = at + lane;
      if (stretch.from_lattice[q] != lattice.lattice || stretch.from_atom[q] != lattice.atom) continue;
      leaves[lane] = set_leaving(stretch, lattice, home, lane, q, n);
    }
    Leaving<D> leaving;
    leaving.any = load(leaves) != none();
    for (int i = 0; i < D; ++i) leaving.n[i] = load(n[i]);
    return leaving;
  }

  // False if the cell is beyond any that a lane can name.
  static HWY_INLINE bool set_leaving(const Stretch& stretch, const Bravais& lattice,
                                     const double (&home)[D][kMaxLanes], std::size_t lane, std::size_t q,
                                     double (&n)[D][kMaxLanes]) {
    constexpr WideInteger kFar = WideInteger{1} << 53;
    for (int i = 0; i < D; ++i) {
      WideInteger sum = -static_cast<WideInteger>(home[i][lane]);
      for (int k = 0; k < D; ++k)
        sum += static_cast<WideInteger>(stretch.from_cell[k][q]) * (kUnit ? k == i : lattice.inverse[k][i]);
      if (sum > kFar || sum < -kFar) return false;
      n[i][lane] = static_cast<double>(sum);
    }
    return true;
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
    const M both = And(next, found_);
    V error;
    const V difference = other_time - one.rough_time(error);
    const V spread = error + other_error;
    const M yes = difference > spread, no = difference < Neg(spread);
    lanes_.leave(AndNot(Or(yes, no), both));
    return And(next, Or(Not(found_), yes));
  }

  // Sets the cell and the time of the obstacle found, one of atom a.
  HWY_INLINE void finish(M here, std::size_t a, const LaneEntry<D, kBall>& entry) {
    AtomStart made;
    StartOrReference start = start_of(a, made);
    name(here, a, start, entry.n);
    const Times<D, kUnit, kBall> times(start, entry, velocity_.scaled);
    V time;
    M is_rounded = no_lane();
    if (stretch_.rounded)
      time = rounded(here, times, entry, is_rounded);
    else
      time = close(here, times, entry);
    time_ = select(here, velocity_.template time_of<kUnit>(time, scene_), time_);
    rounded_ = Or(rounded_, And(here, is_rounded));
  }

  HWY_INLINE V rounded(M here, const Times<D, kUnit, kBall>& times, const LaneEntry<D, kBall>& entry,
                       M& is_rounded) {
    if (!times.are_soon_rounded()) return times.rounded(is_rounded);
    V time = times.soon_rounded(is_rounded);
    const M late = AndNot(is_rounded, And(here, lanes_.active));
    if (nowhere(late)) return time;
    if (scene_.atoms.size() == 1) {
      late_.push(late, at_, entry);
      return select(is_rounded, time, all(1));
    }
    return times.rounded(is_rounded);
  }

  HWY_INLINE V close(M here, const Times<D, kUnit, kBall>& times, const LaneEntry<D, kBall>& entry) {
    if constexpr (kBall) {
      if (kUnit || scene_.atoms.size() == 1) {
        const M late = And(times.is_grazed(), And(here, lanes_.active));
        if (any(late)) late_.push(late, at_, entry);
        return select(late, all(1), times.plain_or_near());
      }
    }
    return times.close(here);
  }

  // Names an obstacle of atom a by its cell in the scene's primitive vectors, computed from its cell in the
  // short basis.
  HWY_INLINE void name(M here, std::size_t a, const AtomStart& start, const V (&n)[D]) {
    atom_ = select(here, all(static_cast<double>(a)), atom_);
    if constexpr (kSingle) return;  // there is only the cell 0
    const Bravais& lattice = scene_.atoms[a];
    const V limit = all(0x1p51);
    V m[D];
    for (int i = 0; i < D; ++i) {
      m[i] = n[i] + start.home[i];
      lanes_.leave(And(here, Not(Max(Abs(n[i]), Abs(m[i])) < limit)));
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
        lanes_.leave(And(here, Not(size < limit)));
      }
      cell_[k] = select(here, c, cell_[k]);
    }
  }

  HWY_INLINE void tell() {
    const M left = AndNot(Or(lanes_.active, inside_), asked_);
    found_ = And(found_, lanes_.active);
    store(where(found_, time_), stretch_.time + at_);
    const M named = Or(found_, inside_);
    for (int k = 0; k < D; ++k) store_integers(where(named, cell_[k]), stretch_.cell[k] + at_);
    V nothing = number(Outcome::never);
    if (stretch_.max_time)
      nothing = select(load(stretch_.max_time + at_) < infinite(), number(Outcome::later), nothing);
    const V outcome = select(found_, number(Outcome::hit), select(inside_, number(Outcome::inside), nothing));
    static_assert(sizeof(Outcome) == sizeof(std::int32_t));
    store_small_integers(outcome, reinterpret_cast<std::int32_t*>(stretch_.outcome) + at_);
    if (!kUnit) store_small_integers(atom_, stretch_.atom + at_);
    static_assert(static_cast<int>(Stage::binary64) == 0 && static_cast<int>(Stage::double_double) == 1);
    store_twos(stage2_, no_lane(), stretch_.stage + at_);
    store_twos(And(found_, rounded_), no_lane(), stretch_.time_is_rounded + at_);
    for (unsigned rest = bits_of(left); rest != 0; rest &= rest - 1)
      stretch_.left_over[stretch_.left_count++] = static_cast<int>(at_) + __builtin_ctz(rest);
  }

  template <class Name>
  static HWY_INLINE V number(Name name) {
    return all(static_cast<double>(name));
  }

  // Stores one byte per lane: 1, 2 or 0.
  template <class T>
  static HWY_INLINE void store_twos(M one, M two, T* to) {
    static_assert(sizeof(T) == 1);
    constexpr std::size_t kAtOnce = kLanes < 8 ? kLanes : 8;
    for (std::size_t at = 0; at < kLanes; at += kAtOnce) {
      const std::uint64_t bytes = bytes_of(bits_of(one) >> at) + 2 * bytes_of(bits_of(two) >> at);
      std::memcpy(to + at, &bytes, kAtOnce);
    }
  }

  // The first eight bits, each in its own byte.
  static HWY_INLINE std::uint64_t bytes_of(unsigned bits) {
    constexpr std::uint64_t kOnes = 0x0101010101010101, kEach = 0x8040201008040201;
    return ((bits & 0xff) * kOnes & kEach) + 0x7f7f7f7f7f7f7f7f >> 7 & kOnes;
  }

  const PreparedScene& scene_;
  Stretch& stretch_;
  LateTimes<D, kUnit, kBall>& late_;
  std::size_t at_;
  const V (&x_)[D];
  M asked_;
  Lanes lanes_;
  Velocity<D> velocity_;
  Turn<D, kTurned> turn_;
  AtomStart starts_[kKept];
  M found_, inside_, stage2_, rounded_;
  V time_, cell_[D], atom_;
};

template <int D, bool kUnit, bool kBall, bool kSingle = false>
HWY_NOINLINE void fly_stretch(const PreparedScene& scene, Stretch& stretch) {
  LateTimes<D, kUnit, kBall> late;
  for (std::size_t at = 0; at < stretch.count; at += kLanes) {
    V x[D], v[D];
    for (int k = 0; k < D; ++k) x[k] = load(stretch.x[k] + at), v[k] = load(stretch.v[k] + at);
    Block<D, kUnit, kBall, kSingle>(scene, stretch, late, at, x, v).run();
  }
  late.finish(scene, stretch);
}

template <int D, bool kBall>
inline void fly_any(const PreparedScene& scene, Stretch& stretch) {
  if constexpr (kBall)
    if (scene.most_rank == 0) return fly_stretch<D, false, true, true>(scene, stretch);
  if (scene.atoms.size() == 1 && scene.atoms[0].unit) return fly_stretch<D, true, kBall>(scene, stretch);
  return fly_stretch<D, false, kBall>(scene, stretch);
}
