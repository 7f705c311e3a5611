// The search for the first obstacles in 3D, in lanes: src/engines/reduction/search_3d.hpp, window_3d.hpp,
// planes_3d.hpp, lines_3d.hpp, candidates_3d.hpp. Private to the batch engine.
#if defined(LORENTZ_BATCH_SEARCH_3D_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef LORENTZ_BATCH_SEARCH_3D_INL_HPP
#undef LORENTZ_BATCH_SEARCH_3D_INL_HPP
#else
#define LORENTZ_BATCH_SEARCH_3D_INL_HPP
#endif

#include "src/engines/batch/basis_3d-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace lorentz {
namespace HWY_NAMESPACE {
namespace {

/// A lattice point relative to the anchor: Point3.
struct Point3 {
  V n[3], p[2], z, size, extent;

  HWY_INLINE Point3 step(V k, const Arm3& arm) const {
    Point3 to;
    for (int i = 0; i < 3; ++i) to.n[i] = n[i] + k * arm.n[i];
    const V u = k * arm.p[0], w = k * arm.p[1], along = k * arm.z;
    to.p[0] = p[0] + u, to.p[1] = p[1] + w, to.z = z + along;
    to.size = size + Abs(u) + Abs(w) + Abs(k) * arm.cancellation;
    to.extent = extent + Abs(along);
    return to;
  }

  HWY_INLINE void take(M m, const Point3& other) {
    for (int i = 0; i < 3; ++i) n[i] = select(m, other.n[i], n[i]);
    p[0] = select(m, other.p[0], p[0]), p[1] = select(m, other.p[1], p[1]);
    z = select(m, other.z, z), size = select(m, other.size, size), extent = select(m, other.extent, extent);
  }
};

/// A stretch of the flights, and the lattice points near their middles from which all others are counted:
/// Window3.
template <bool kUnit, bool kBall>
struct Window3 {
  using Direction = Direction3<kUnit, kBall>;

  const Direction& to;
  const Basis3* basis;
  V begin, anchor[3];
  Point3 anchor_point;
  V p_error, s_error, z_error, z_first;

  HWY_INLINE Window3(const Direction& direction, const Bravais& lattice, const Offset<LaneFma, 3>& start)
      : to(direction), basis(&direction.basis), begin(none()), lattice_(lattice), error_(start.error) {
    const Pair(&d)[3] = start.d;
    to.template forms_of<LaneFma>(d, start_);
    start_size_ = (Abs(d[0].hi) + Abs(d[1].hi)) + Abs(d[2].hi);
  }

  HWY_INLINE void set_anchor(bool at_start, Lanes& lanes) {
    find_anchor(at_start, lanes);
    V terms = start_size_;
    for (int j = 0; j < 3; ++j) terms = terms + Abs(anchor[j]) * all(to.size_of[j]);
    V error = all(kAnchorTerms) * terms;
    if constexpr (!kUnit) error = error + error_;
    error = all(kForm) * error + all(kFlushed);
    p_error = error * all(to.inverse_r);
    if constexpr (kBall)
      s_error = error + all(kRoundoff) * begin;
    else
      s_error = all(to.along_size) * error + all(kRoundoff) * begin +
                all(kForm * lattice_.shape.metric_error) * terms;
    z_error = s_error / basis->length;
    z_first = Neg(all(2) * z_error + all(kWindowStart));
    lanes.leave_unless(p_error < all(kSlop3d / 2));
  }

  /// The window from here on, by a basis that suits its length.
  HWY_INLINE void lengthen(Lanes& lanes) {
    if (basis != &longer_) longer_ = *basis;
    to.template lengthen<LaneFma>(longer_, select(lanes.active, all(kLonger), all(1)), lanes.active);
    lanes.leave_unless(longer_.usable);
    basis = &longer_;
  }

  HWY_INLINE V plane_of(const Point3& point) const {
    const V(&g)[3] = basis->dual[2];
    return (g[0] * point.p[0] + g[1] * point.p[1]) + g[2] * point.z;
  }

 private:
  HWY_INLINE void find_anchor(bool at_start, Lanes& lanes) {
    const V zero = none();
    for (V& n : anchor) n = zero;
    for (int i = 0; i < 2; ++i) anchor_point.p[i] = to.scale[i] * start_[i].hi;
    anchor_point.z = (start_[2].hi - begin) / basis->length;
    const Pair from = at_start ? start_[2] : start_[2] - Pair(begin);
    M moving = lanes.active;
    for (int pass = 0; pass < kMaxAnchorPasses; ++pass) {
      V k[3];
      for (int i = 0; i < 3; ++i) {
        const V(&g)[3] = basis->dual[i];
        const V here =
            (g[0] * anchor_point.p[0] + g[1] * anchor_point.p[1]) + g[2] * (anchor_point.z - all(kMiddle));
        k[i] = where(moving, Neg(Round(here)));
      }
      const V most = largest(Abs(k[0]), Abs(k[1]), Abs(k[2]));
      lanes.leave_unless(most < all(kMaxAnchorStep));
      move_anchor(k, moving, lanes);
      const auto& form = to.form();
      anchor_point.p[0] =
          to.scale[0] * compensated_sum_from<Pair, Direction::kFirstTerms>(start_[0], form[0], anchor);
      anchor_point.p[1] = to.scale[1] * compensated_sum_from<Pair>(start_[1], form[1], anchor);
      anchor_point.z =
          compensated_sum_from<Pair, 3, Direction::kLowParts>(from, form[2], anchor) / basis->length;
      moving = And(moving, Not(most < all(kNearAnchor)));
      if (HWY_LIKELY(nowhere(moving))) break;
    }
    lanes.leave(moving);
    for (int i = 0; i < 3; ++i) anchor_point.n[i] = zero;
    anchor_point.size = Abs(anchor_point.p[0]) + Abs(anchor_point.p[1]);
    anchor_point.extent = Abs(anchor_point.z);
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

  // Large terms that cancel, among tiny balls; of what does not cancel a single flight keeps the low parts
  // too.
  HWY_INLINE void move_exactly(const V (&k)[3], const V (&before)[3], M wide, Lanes& lanes) {
    for (int j = 0; j < 3; ++j) {
      Pair sum = Pair(before[j]);
      for (int i = 0; i < 3; ++i) sum = sum + Pair::product(k[i], basis->b[i].n[j]);
      lanes.leave(And(wide, Not(Abs(sum.hi) < all(kMaxCoefficient))));  // below, an integer has no low part
      anchor[j] = select(wide, sum.hi, anchor[j]);
    }
  }

  const Bravais& lattice_;
  Basis3 longer_;
  Pair start_[3];
  V error_, start_size_;
};

/// The first obstacles of one atom, one start a lane.
template <bool kUnit, bool kBall>
class Search3 {
 public:
  using Direction = Direction3<kUnit, kBall>;

  /// As of Search2.
  HWY_INLINE Search3(const Direction& to, const Bravais& lattice, const Offset<LaneFma, 3>& start,
                     const Leaving<3>* leaving, V s_limit)
      : to_(to), window_(to, lattice, start), leaving_(leaving), s_limit_(s_limit) {}

  LaneEntry<3, kBall> found;  ///< of the lanes in which something is met: found.s is finite

  /// Of the lanes that are active.
  HWY_INLINE void run(Lanes& lanes) {
    found.s = infinite();
    found.s_error = found.slack = found.slack_error = none();
    for (V& n : found.n) n = none();
    found.v2 = to_.v2;
    if constexpr (!kBall)
      for (int k = 0; k < 3; ++k) found.along[k] = to_.along[k];
    M done = no_lane();  // with a hit, or at the end
    for (int window = 0; any(lanes.active); ++window) {
      window_.set_anchor(window == 0, lanes);
      scan_window(lanes);
      const M met = And(found.s < infinite(), lanes.active);
      done = Or(done, met);
      lanes.leave(met);
      if (nowhere(lanes.active) || window == kMaxWindowsInLanes) break;
      const M at_end = advance(lanes);
      done = Or(done, at_end);
      lanes.leave(at_end);
      if (window >= 1) window_.lengthen(lanes);
    }
    lanes.active = done;
  }

 private:
  // From here on few lanes are left with something to find.
  static constexpr int kMaxWindowsInLanes = 4;

  // The planes k b_2 + (b_0, b_1) that meet the window, and their lines; each turn looks at one line a lane.
  HWY_INLINE void scan_window(Lanes& lanes) {
    const Basis3& basis = *window_.basis;
    const V zero = none(), one = all(1), slop = all(kSlop3d), tilt = basis.tilt();
    kappa_ = window_.plane_of(window_.anchor_point);
    none_met_ = lanes.active;
    const V low = Min(zero, tilt) - basis.slope - kappa_ - slop,
            high = Max(zero, tilt) + basis.slope - kappa_ + slop;
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

  // The next plane of these lanes: which of its lines meet the flight's cylinder.
  HWY_INLINE void begin_plane(M next, Lanes& lanes) {
    const Basis3& basis = *window_.basis;
    const V zero = none(), one = all(1), slop = all(kSlop3d), tilt = basis.tilt();
    const Point3 point = window_.anchor_point.step(plane_k_, basis.b[2]);
    const V kappa = kappa_ + plane_k_;
    plane_k_ = select(next, plane_k_ + one, plane_k_);
    V z_first = window_.z_first, z_last = end();
    const M met = AndNot(misses(kappa, z_first, z_last), next);
    none_met_ = AndNot(met, none_met_);
    const V xi_first = (kappa - tilt * z_first) * basis.inverse_slope,
            xi_last = (kappa - tilt * z_last) * basis.inverse_slope;
    const V nearest = where(xi_first * xi_last > zero, Min(Abs(xi_first), Abs(xi_last)));
    const V eta = Sqrt(Max(zero, one - nearest * nearest) + all(2) * xi_error(point)) + slop;
    const V(&g1)[3] = basis.dual[1];
    const V a = basis.dual1_normal * xi_first + g1[2] * z_first;
    const V b = basis.dual1_normal * xi_last + g1[2] * z_last;
    const V here = (g1[0] * point.p[0] + g1[1] * point.p[1]) + g1[2] * point.z;
    const V half = Abs(basis.dual1_level) * eta;
    const V spread = slop * (one + Abs(basis.dual1_normal) + Abs(g1[2]));
    const V low = Ceil(Min(a, b) - half - here - spread), high = Max(a, b) + half - here + spread;
    lanes.leave(
        And(met, Not(And(Max(Abs(low), Abs(high)) < all(kMaxCoefficient), high - low <= all(kManyLines)))));
    line_k_ = select(met, low, select(next, one, line_k_));
    line_end_ = select(met, high, select(next, zero, line_end_));
    part_first_ = select(met, z_first, part_first_), part_last_ = select(met, z_last, part_last_);
    plane_.take(met, point);
  }

  // Where in the window nothing is wanted any more.
  HWY_INLINE V end() const {
    return Min(all(1), (found.s - window_.begin) / window_.basis->length) + all(kSlop3d) +
           all(2) * window_.z_error;
  }

  // Cuts the part of the window in which the plane is within r of the line; lanes in which there is none.
  HWY_INLINE M misses(V kappa, V& z_first, V& z_last) const {
    const Basis3& basis = *window_.basis;
    const V tilt = basis.tilt(), at_first = kappa - tilt * z_first, at_last = kappa - tilt * z_last;
    const V slope = basis.slope * all(1 + kSlop3d), below = Neg(slope), slop = all(kSlop3d);
    const M cut = Or(Abs(at_first) > slope, Abs(at_last) > slope);
    const M beside = Or(And(at_first > slope, at_last > slope), And(at_first < below, at_last < below));
    const V one = (kappa - slope) / tilt, other = (kappa + slope) / tilt;
    z_first = select(cut, Max(z_first, Min(one, other) - slop), z_first);
    z_last = select(cut, Min(z_last, Max(one, other) + slop), z_last);
    return And(cut, Or(beside, z_first > z_last));
  }

  HWY_INLINE V xi_error(const Point3& point) const {
    const Basis3& basis = *window_.basis;
    const V(&g)[3] = basis.dual[2];
    const V terms = all(1) + Max(Abs(g[0]), Abs(g[1])) * point.size + Abs(g[2]) * point.extent;
    return window_.p_error + all(to_.scale_error) +
           basis.inverse_slope * (basis.tilt_error + Abs(g[2]) * window_.s_error / basis.length +
                                  all(kPlane * kRoundoff) * terms);
  }

  // Line line_k_ of the plane: |q + k p| < 1 is a quadratic in k.
  HWY_INLINE void scan_line(M line, Lanes& lanes) {
    const Basis3& basis = *window_.basis;
    const Arm3& arm = basis.b[0];
    const V one = all(1), slop = all(kSlop3d);
    const Point3 q = plane_.step(line_k_, basis.b[1]);
    const V a = arm.p[0] * arm.p[0] + arm.p[1] * arm.p[1], b = q.p[0] * arm.p[0] + q.p[1] * arm.p[1];
    const V moment = q.p[0] * arm.p[1] - q.p[1] * arm.p[0];
    V unsure = all(kLine * kRoundoff) * (one + q.size) + window_.p_error;
    if constexpr (!kBall) unsure = unsure + all(to_.scale_error);
    const V discriminant = a * (one + all(kDiscriminant) * unsure) - moment * moment;
    const M meets = AndNot(discriminant < none(), line);
    if (nowhere(meets)) return;
    const V inverse = one / a, half = Sqrt(discriminant) * inverse;
    const V slack = slop + all(kLineEnd) * unsure * Sqrt(inverse);
    lanes.leave(And(meets, Not(slack < all(kMaxUnsure))));
    V first = Neg(b) * inverse - half - slack, last = Neg(b) * inverse + half + slack;
    const M ahead = arm.z > none();
    const V inverse_z = one / arm.z;
    first = select(ahead, Max(first, (part_first_ - q.z) * inverse_z - slop), first);
    last = select(ahead, Min(last, (part_last_ - q.z) * inverse_z + slop), last);
    V k = Ceil(first);
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

  // Is this ball met, and the first so far? Lanes for which nothing more on its line is wanted.
  HWY_INLINE M look_at(const Point3& point, M looking, Lanes& lanes) {
    const V one = all(1), length = window_.basis->length;
    const V square = point.p[0] * point.p[0] + point.p[1] * point.p[1];
    const V error = all(kAcross * kRoundoff) * point.size + window_.p_error;
    const V spread = (one + square) * (all(2) * error + all(to_.scale_error));
    const V margin = one - square;
    const M missed = margin<Neg(spread), yes = margin> spread;
    const V s = window_.begin + point.z * length;
    const V s_error = window_.s_error + all(kAlong * kRoundoff) * point.extent * length;
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

  // To the next window: right behind this one, or where the next lattice plane comes within r of the line.
  // Returns the lanes that are at the end, with nothing found. On the lines of some lattices what is met
  // repeats itself, which a single flight knows.
  HWY_INLINE M advance(Lanes& lanes) {
    const Basis3& basis = *window_.basis;
    const V one = all(1), zero = none();
    const V stride = select(none_met_, windows_to_next_plane(), one);
    const V next = window_.begin + stride * all(1 - kSlop3d) * basis.length;
    window_.begin = Max(window_.begin, next - all(kNextWindow * kRoundoff) * next);
    const M at_end = And(window_.begin > s_limit_, lanes.active);
    M beyond = Not(window_.begin < all(kFarthest));
    for (const Arm3& arm : basis.b) beyond = Or(beyond, And(arm.p[0] == zero, arm.p[1] == zero));
    lanes.leave(AndNot(at_end, beyond));
    return at_end;
  }

  HWY_INLINE V windows_to_next_plane() const {
    const Basis3& basis = *window_.basis;
    const V tilt = basis.tilt(), steepest = Abs(tilt) + basis.tilt_error;
    const V above = tilt - kappa_, below = kappa_ - tilt, slope = basis.slope;
    const V up = Ceil(above + slope) - above - slope, down = Ceil(below + slope) - below - slope;
    const V gap = select(Abs(tilt) <= basis.tilt_error, Min(up, down), select(tilt > none(), up, down));
    return Min(Max(all(1), all(1) + (gap - all(kSlop3d)) / steepest), all(kMaxJump));
  }

  const Direction& to_;
  Window3<kUnit, kBall> window_;
  const Leaving<3>* leaving_;
  V s_limit_;
  V kappa_, plane_k_, line_k_, line_end_, part_first_, part_last_;
  Point3 plane_;
  M none_met_;
};

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace lorentz
HWY_AFTER_NAMESPACE();

#endif
