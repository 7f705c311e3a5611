// The flights of a stretch, vector by vector. Private to the batch engine.

/// The atoms of a scene.
struct LaneAtoms {
  static constexpr bool kOne = false;

  const std::vector<Bravais>& atoms;
  double unit, inverse_unit;

  HWY_INLINE std::size_t size() const { return atoms.size(); }
  HWY_INLINE const Bravais& operator[](std::size_t a) const { return atoms[a]; }
};

/// The queries [at, at + lanes) of a stretch.
template <int D, bool kUnit, bool kBall>
struct Block {
  Stretch& stretch;
  LateTimes<D, kUnit, kBall>& late;
  std::size_t at;

  HWY_INLINE M wanted() const { return first_lanes(stretch.count - at); }
  HWY_INLINE bool wants_rounded() const { return stretch.rounded; }
  HWY_INLINE bool is_limited() const { return stretch.max_time; }
  HWY_INLINE V limit() const { return load(stretch.max_time + at); }

  /// Finds the obstacle of this atom that each lane leaves. False if no lane leaves one.
  HWY_INLINE bool find_leaving(const Start<D, kUnit, kBall>& start, Leaving<D>& leaving) const {
    if (!stretch.from_lattice) return false;
    const Start<D, kUnit, kBall> copy = start;
    leaving = leaving_of(stretch, at, copy);
    return any(leaving.any);
  }

  HWY_INLINE bool put_off(M m, const LaneEntry<D, kBall>& entry) const {
    late.push(m, at, entry);
    return true;
  }

  /// Writes the results.
  template <class Flight>
  HWY_INLINE void tell(const Flight& flight) const {
    const M left = AndNot(Or(flight.lanes.active, flight.inside), wanted());
    store(where(flight.found, flight.time), stretch.time + at);
    const M named = Or(flight.found, flight.inside);
    for (int k = 0; k < D; ++k) store_integers(where(named, flight.cell[k]), stretch.cell[k] + at);
    V nothing = number(Outcome::never);
    if (stretch.max_time)
      nothing = select(load(stretch.max_time + at) < infinite(), number(Outcome::later), nothing);
    const V outcome =
        select(flight.found, number(Outcome::hit), select(flight.inside, number(Outcome::inside), nothing));
    static_assert(sizeof(Outcome) == sizeof(std::int32_t));
    store_small_integers(outcome, reinterpret_cast<std::int32_t*>(stretch.outcome) + at);
    if (!kUnit) store_small_integers(flight.atom, stretch.atom + at);
    static_assert(static_cast<int>(Stage::binary64) == 0 && static_cast<int>(Stage::double_double) == 1);
    store_twos(flight.stage2, no_lane(), stretch.stage + at);
    store_twos(And(flight.found, flight.rounded), no_lane(), stretch.time_is_rounded + at);
    for (unsigned rest = bits_of(left); rest != 0; rest &= rest - 1)
      stretch.left_over[stretch.left_count++] = static_cast<int>(at) + __builtin_ctz(rest);
  }

 private:
  // AtomStart::find_from, lane by lane.
  static HWY_NOINLINE Leaving<D> leaving_of(const Stretch& stretch, std::size_t at,
                                            const Start<D, kUnit, kBall>& start) {
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
};

template <int D, bool kUnit, bool kBall, bool kSingle = false>
HWY_NOINLINE void fly_stretch(const PreparedScene& scene, Stretch& stretch) {
  LateTimes<D, kUnit, kBall> late;
  const LaneAtoms atoms{scene.atoms, scene.unit, scene.inverse_unit};
  for (std::size_t at = 0; at < stretch.count; at += kLanes) {
    V x[D], v[D];
    for (int k = 0; k < D; ++k) x[k] = load(stretch.x[k] + at), v[k] = load(stretch.v[k] + at);
    using Asked = Block<D, kUnit, kBall>;
    const Asked asked{stretch, late, at};
    LaneFlight<D, kUnit, kBall, kSingle, LaneAtoms, Asked> flight(atoms, asked, asked.wanted(), x, v);
    flight.run();
    asked.tell(flight);
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
