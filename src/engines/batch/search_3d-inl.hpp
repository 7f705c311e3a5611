// The search for the first obstacles in 3D, in lanes, as in src/engines/reduction/search_3d.hpp,
// lines_3d.hpp and candidates_3d.hpp. Private to the batch engine.

using Point3 = PointOf3<LaneFma>;

HWY_INLINE void take(M m, const Point3& other, Point3& point) {
  for (int i = 0; i < 3; ++i) point.n[i] = select(m, other.n[i], point.n[i]);
  for (int i = 0; i < 2; ++i) point.p[i] = select(m, other.p[i], point.p[i]);
  point.z = select(m, other.z, point.z);
  point.size = select(m, other.size, point.size), point.extent = select(m, other.extent, point.extent);
}

/// A stretch of each flight, and the lattice point near its middle from which all others are counted.
template <bool kUnit, bool kBall>
class LaneWindow3 : public WindowOf3<LaneFma, LaneFma, kUnit, kBall> {
  using Base = WindowOf3<LaneFma, LaneFma, kUnit, kBall>;
  using Base::start_;

 public:
  using Base::anchor_point, Base::basis, Base::begin, Base::lengthen, Base::shorten;

  V anchor[3];

  HWY_INLINE LaneWindow3(const Bravais& lattice, const Direction3<kUnit, kBall>& to,
                         const Offset<LaneFma, 3>& start)
      : Base(lattice, to, start) {}

  HWY_INLINE void set_anchor(bool at_start, Lanes& lanes) {
    find_anchor(at_start, lanes);
    lanes.leave_unless(this->set_errors(anchor));
  }

 private:
  HWY_INLINE void find_anchor(bool at_start, Lanes& lanes) {
    for (V& n : anchor) n = none();
    this->set_point_of_home();
    const Pair from = at_start ? start_[2] : start_[2] - Pair(begin);
    M moving = lanes.active;
    for (int pass = 0; pass < kMaxAnchorPasses; ++pass) {
      V k[3];
      const V most = this->steps_to_middle(moving, k);
      lanes.leave_unless(most < all(kMaxAnchorStep));
      move_anchor(k, moving, lanes);
      this->set_place(anchor, from, anchor_point);
      moving = And(moving, Not(most < all(kNearAnchor)));
      if (HWY_LIKELY(nowhere(moving))) break;
    }
    lanes.leave(moving);
    this->set_zero(anchor_point);
  }

  HWY_INLINE void move_anchor(const V (&k)[3], M moving, Lanes& lanes) {
    M wide = no_lane();
    V before[3];
    for (int j = 0; j < 3; ++j) {
      V size = Abs(anchor[j]);
      before[j] = anchor[j];
      for (int i = 0; i < 3; ++i) {
        const V step = k[i] * basis->b[i].n[j];
        anchor[j] = anchor[j] + step, size = size + Abs(step);
      }
      wide = Or(wide, And(moving, Not(size < all(kMaxCoefficient))));
    }
    if (any(wide)) move_exactly(k, before, wide, lanes);
  }

  // For large terms that cancel, among tiny balls. Lanes in which they do not cancel are left over; there a
  // single flight keeps the low parts, too.
  HWY_INLINE void move_exactly(const V (&k)[3], const V (&before)[3], M wide, Lanes& lanes) {
    for (int j = 0; j < 3; ++j) {
      Pair sum = Pair(before[j]);
      for (int i = 0; i < 3; ++i) sum = sum + Pair::product(k[i], basis->b[i].n[j]);
      lanes.leave(And(wide, Not(Abs(sum.hi) < all(kMaxCoefficient))));  // below, an integer has no low part
      anchor[j] = select(wide, sum.hi, anchor[j]);
    }
  }
};

/// The first obstacles of one atom, one start a lane.
template <bool kUnit, bool kBall>
class LaneSearch3 {
 public:
  using Direction = Direction3<kUnit, kBall>;

  /// Parameters as for LaneSearch2.
  HWY_INLINE LaneSearch3(const Direction& to, const Bravais& lattice, const Offset<LaneFma, 3>& start,
                         const Leaving<3>* leaving, V s_limit)
      : to_(to), window_(lattice, to, start), leaving_(leaving), s_limit_(s_limit) {}

  LaneEntry<3, kBall> found;  ///< for the lanes that meet an obstacle: there found.s is finite

  /// Searches in the active lanes.
  HWY_INLINE void run(Lanes& lanes) {
    found.s = infinite();
    found.s_error = found.slack = found.slack_error = none();
    for (V& n : found.n) n = none();
    found.v2 = to_.v2;
    if constexpr (!kBall)
      for (int k = 0; k < 3; ++k) found.along[k] = to_.along[k];
    M done = no_lane();  // with a hit, or at the end
    for (int window = 0; any(lanes.active); ++window) {
      if constexpr (LaneFma::kInRegisters)
        if (window != 1) {
          window_.shorten(lanes.active);
          lanes.leave_unless(window_.basis->usable);
        }
      window_.set_anchor(window == 0, lanes);
      scan_window(lanes);
      const M met = And(found.s < infinite(), lanes.active);
      done = Or(done, met);
      lanes.leave(met);
      if (nowhere(lanes.active) || window == kMaxWindowsInLanes) break;
      if constexpr (kUnit && kBall)  // most of them need what only single flights can
        if (window == 0) lanes.leave(window_.is_nearly_parallel());
      window_.advance(none_met_, kappa_);
      const M at_end = ends(lanes);
      done = Or(done, at_end);
      lanes.leave(at_end);
      if (window == 0) continue;
      window_.lengthen(lanes.active);
      lanes.leave_unless(window_.basis->usable);
    }
    lanes.active = done;
  }

 private:
  // After this number of windows few lanes still have something to find.
  static constexpr int kMaxWindowsInLanes = 4;

  // Scans the planes that meet the window, and their lines. Each turn looks at one line per lane.
  HWY_INLINE void scan_window(Lanes& lanes) {
    const V zero = none(), one = all(1);
    V low, high;
    kappa_ = window_.plane_of(window_.anchor_point);
    none_met_ = lanes.active;
    window_.set_planes(kappa_, low, high);
    lanes.leave_unless(Max(Abs(low), Abs(high)) < all(kMaxCoefficient));
    plane_k_ = Ceil(low);
    line_k_ = one, line_end_ = zero;
    plane_ = window_.anchor_point;
    part_first_ = part_last_ = zero;
    M scanning = lanes.active;
    while (any(scanning)) {
      const M next = And(scanning, Not(line_k_ <= line_end_));
      if (any(next)) {
        scanning = AndNot(And(next, Not(plane_k_ <= high)), scanning);
        if (nowhere(scanning)) break;
        begin_plane(And(next, scanning), lanes);
        scanning = And(scanning, lanes.active);
      }
      const M line = And(scanning, line_k_ <= line_end_);
      if (nowhere(line)) continue;
      scan_line(line, lanes);
      line_k_ = select(line, line_k_ + one, line_k_);
      scanning = And(scanning, lanes.active);
    }
  }

  // Begins the next plane of these lanes: finds which of its lines meet the flight's cylinder.
  HWY_INLINE void begin_plane(M next, Lanes& lanes) {
    const V one = all(1);
    const Point3 point = window_.anchor_point.step(plane_k_, window_.basis->b[2]);
    const V kappa = kappa_ + plane_k_;
    plane_k_ = select(next, plane_k_ + one, plane_k_);
    typename LaneWindow3<kUnit, kBall>::Section section;
    const M met = And(window_.set_section(point, kappa, window_.end_before(found.s), section), next);
    none_met_ = AndNot(met, none_met_);
    const V low = section.low, high = section.high;
    lanes.leave(
        And(met, Not(And(Max(Abs(low), Abs(high)) < all(kMaxCoefficient), high - low <= all(kManyLines)))));
    line_k_ = select(met, low, select(next, one, line_k_));
    line_end_ = select(met, high, select(next, none(), line_end_));
    part_first_ = select(met, section.z_first, part_first_);
    part_last_ = select(met, section.z_last, part_last_);
    take(met, point, plane_);
  }

  // Scans line line_k_ of the plane.
  HWY_INLINE void scan_line(M line_is_wanted, Lanes& lanes) {
    const V one = all(1);
    const Arm3& arm = window_.basis->b[0];
    const Point3 q = plane_.step(line_k_, window_.basis->b[1]);
    LineOf3<LaneFma> line;
    const M meets = And(line.set(q, arm, window_.line_error(q)), line_is_wanted);
    if (nowhere(meets)) return;
    line.set_ends();
    lanes.leave(And(meets, Not(line.slack < all(kMaxUnsure))));
    line.cut(q, arm, part_first_, part_last_);
    const V last = line.last;
    V k = Ceil(line.first);
    M looking = And(And(meets, k <= last), lanes.active);
    lanes.leave(And(looking, Not(Max(Abs(k), Abs(last)) < all(kMaxCoefficient))));
    looking = And(looking, lanes.active);
    for (int step = 0; any(looking); ++step) {
      if (step == kMaxCandidatesOnLine) return lanes.leave(looking);
      const M ends = look_at(q.step(k, arm), looking, lanes);
      k = k + one;
      looking = And(And(AndNot(ends, looking), k <= last), lanes.active);
    }
  }

  // Is this ball met, and is it the first so far? Returns the lanes that need nothing more on this line.
  HWY_INLINE M look_at(const Point3& point, M looking, Lanes& lanes) {
    V margin, spread, s, s_error;
    window_.set_across(point, margin, spread);
    const M missed = margin<Neg(spread), yes = margin> spread;
    window_.set_along(point, s, s_error);
    const M behind = s < Neg(s_error);
    M candidate = AndNot(Or(missed, behind), looking);
    const M beyond = And(candidate, s - s_error > Min(found.s + found.s_error, s_limit_));
    candidate = AndNot(beyond, candidate);
    if (nowhere(candidate)) return beyond;
    V N[3];
    M same = Not(no_lane()), left = candidate;
    for (int i = 0; i < 3; ++i) {
      N[i] = window_.anchor[i] + point.n[i];
      same = And(same, N[i] == found.n[i]);
      if (leaving_ != nullptr) left = And(left, N[i] == leaving_->n[i]);
    }
    if (leaving_ != nullptr) candidate = AndNot(And(left, leaving_->any), candidate);
    const M sure = And(yes, s > s_error), sooner = s + s_error < found.s - found.s_error;
    lanes.leave(And(candidate, Not(And(sure, Or(sooner, same)))));
    const M take = And(And(candidate, lanes.active), sooner);
    const V rho2 = to_.rho * to_.rho;
    for (int i = 0; i < 3; ++i) found.n[i] = select(take, N[i], found.n[i]);
    found.s = select(take, s, found.s), found.s_error = select(take, s_error, found.s_error);
    found.slack = select(take, margin * rho2, found.slack);
    found.slack_error = select(take, all(2) * spread * rho2, found.slack_error);
    return Or(beyond, take);
  }

  // Returns the lanes that are at the end with nothing found. Where a lattice vector is parallel to the
  // flight, the obstacles on the line repeat; such lanes are left over, because a single flight can tell.
  HWY_INLINE M ends(Lanes& lanes) const {
    const M at_end = And(window_.begin > s_limit_, lanes.active);
    M beyond = Not(window_.begin < all(kMaxCell));
    for (const Arm3& arm : window_.basis->b) beyond = Or(beyond, And(arm.p[0] == none(), arm.p[1] == none()));
    lanes.leave(AndNot(at_end, beyond));
    return at_end;
  }

  const Direction& to_;
  LaneWindow3<kUnit, kBall> window_;
  const Leaving<3>* leaving_;
  V s_limit_;
  V kappa_, plane_k_, line_k_, line_end_, part_first_, part_last_;
  Point3 plane_;
  M none_met_;
};
