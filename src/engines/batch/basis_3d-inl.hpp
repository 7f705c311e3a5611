// Short bases of a 3D lattice as seen along the velocities, in lanes, as in
// src/engines/reduction/reduce_3d.hpp. Private to the batch engine.

using Arm3 = ArmOf3<LaneFma>;
using Basis3 = BasisOf3<LaneFma>;

/// Exchanges everything except what is computed anew after any exchange.
HWY_INLINE void exchange(M m, Arm3& a, Arm3& b) {
  for (int i = 0; i < 3; ++i) exchange(m, a.n[i], b.n[i]);
  exchange(m, a.p[0], b.p[0]), exchange(m, a.p[1], b.p[1]), exchange(m, a.z, b.z);
}

/// GreedyReduction of reduce_3d.hpp, in lanes: the two shorter vectors by Lagrange's step, then the longest
/// by the nearest point of their plane. Lanes that are done wait for the others.
class GreedyReduction {
 public:
  HWY_INLINE explicit GreedyReduction(const Basis3& basis)
      : b_{basis.b[0], basis.b[1], basis.b[2]}, largest_(none()) {}

  HWY_INLINE void copy_to(Basis3& basis) const {
    for (int i = 0; i < 3; ++i) basis.b[i] = b_[i];
  }

  template <class Frame>
  HWY_INLINE M run(const Frame& frame, V length, M wanted) {
    M todo = wanted, done = no_lane();
    double limit = kRunningCoefficient;
    M fresh = todo;
    for (int round = 0; round < kMaxRoundsInLanes; ++round) {
      const M good = pass(todo, fresh, limit);
      const M accurate = Or(fresh, largest_ * all(frame.inverse_r) < all(kGoodRunning));
      for (int i = 0; i < 3; ++i) frame.template recompute<LaneFma>(b_[i], length);
      done = Or(done, And(todo, And(good, accurate)));
      todo = AndNot(done, todo);
      if (nowhere(todo)) break;
      fresh = todo, limit = kNoLimit;
    }
    return And(done, largest_ < all(kMaxCoefficient / 2));
  }

 private:
  // Drawn directions need no more; what single flights do for others, they do alone.
  static constexpr int kMaxRoundsInLanes = 3;

  // Returns the lanes of `todo` that finish; the others need coordinates that are computed anew.
  HWY_INLINE M pass(M todo, M& fresh, double limit) {
    const V zero = none(), quotient = all(kRunningQuotient);
    for (int i = 0; i < 3; ++i) size_[i] = product(b_[i], b_[i]);
    order<0, 1>(And(todo, size_[1] < size_[0]));
    order<1, 2>(And(todo, size_[2] < size_[1]));
    order<0, 1>(And(todo, size_[1] < size_[0]));
    M open = todo, good = no_lane();
    for (int step = 0; step < kMaxReductionSteps; ++step) {
      V k = where(open, Round(product(b_[0], b_[1]) / size_[0]));
      M moves = k != zero;
      const M too_large = AndNot(fresh, Abs(k) > quotient);
      if (HWY_UNLIKELY(any(too_large))) {
        open = AndNot(too_large, open), moves = AndNot(too_large, moves);
        k = IfThenZeroElse(too_large, k);
      }
      b_[1].subtract(k, b_[0]);
      largest_ = Max(largest_, where(moves, b_[1].largest_coefficient()));
      fresh = AndNot(moves, fresh);
      size_[1] = product(b_[1], b_[1]);
      const M again = And(moves, size_[1] < size_[0]), goes_on = AndNot(again, open);
      const V c01 = product(b_[0], b_[1]), c02 = product(b_[0], b_[2]), c12 = product(b_[1], b_[2]);
      const V inverse = all(1) / (size_[0] * size_[1] - c01 * c01);
      V k0 = Round((c02 * size_[1] - c12 * c01) * inverse),
        k1 = Round((c12 * size_[0] - c02 * c01) * inverse);
      const M stop = And(goes_on, And(k0 == zero, k1 == zero));
      M go = AndNot(stop, goes_on);
      go = AndNot(AndNot(fresh, Max(Abs(k0), Abs(k1)) > quotient), go);
      k0 = where(go, k0), k1 = where(go, k1);
      b_[2].subtract(k0, b_[0]);
      largest_ = Max(largest_, where(go, b_[2].largest_coefficient()));
      b_[2].subtract(k1, b_[1]);
      largest_ = Max(largest_, where(go, b_[2].largest_coefficient()));
      const V before = size_[2];
      size_[2] = product(b_[2], b_[2]);
      fresh = AndNot(go, fresh);
      const M end = And(go, Or(Not(size_[2] < before), size_[2] >= size_[1]));
      good = Or(good, Or(stop, end));
      const M shorter = AndNot(Or(end, largest_ > all(limit)), go);
      order<1, 2>(shorter);
      order<0, 1>(Or(again, And(shorter, size_[1] < size_[0])));
      open = Or(again, shorter);
      if (nowhere(open)) break;
    }
    return good;
  }

  template <int i, int j>
  HWY_INLINE void order(M m) {
    exchange(m, b_[i], b_[j]), exchange(m, size_[i], size_[j]);
  }

  Arm3 b_[3];
  V size_[3], largest_;
};

/// Reduces the basis in the wanted lanes to short vectors, then once more from exact coefficients. Returns
/// the lanes in which this succeeds.
template <class Arch, class Frame>
HWY_INLINE M reduce_basis(const Frame& frame, Basis3& basis, M wanted) {
  GreedyReduction reduction(basis);
  const M is_short = reduction.run(frame, basis.length, wanted);
  reduction.copy_to(basis);
  return is_short;
}

template <bool kUnit, bool kBall>
using Direction3 = DirectionOf3<LaneFma, kUnit, kBall>;
