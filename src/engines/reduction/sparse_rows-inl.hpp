// Which obstacles of a row, and which rows of a plane, a line can meet.
//
// All vectors are seen in a frame in which the obstacles are balls of radius r. Seen along v, the row d + n b
// has the heights v x d + n c across the line, where c = v x b. The line passes the row at
// n = -(v x d).c / |c|^2 and at the distance p = |d.c| / |c| (in the plane 0), so it meets the balls within
// |v| sqrt(r^2 - p^2) / |c| of that n. The rows d + k e of a plane have the distances (d.c + k e.c) / |c|;
// the line meets those within r |c| / |e.c| of k = -d.c / e.c.
//
// Errors (docs/bounds.md): v, b, d and e err by at most kSparse u of their size. So c errs by at most
// gamma |c|, where gamma = kSparse u |v| |b| / |c|.

/// A range of candidate integers: where `known`, no integer outside [first, last] is a candidate.
template <class Numbers>
struct SparseRange {
  using Number = typename Numbers::Number;

  Number first, last;
  typename Numbers::Mask known;

  /// The integers within `within` of `middle`, where the two together err by at most `unsure`.
  LORENTZ_INLINE SparseRange(Number middle, Number within, Number unsure)
      : first(Ceil(middle - within - unsure)),
        last(Floor(middle + within + unsure)),
        known(Abs(middle) + within + unsure < all(kMaxCoefficient)) {}
};

/// A vector, and the size of its terms, which is at least its length.
template <class Numbers, int D>
struct SparseVector {
  using Number = typename Numbers::Number;

  Number a[D], size;

  /// Adds k times another vector.
  LORENTZ_INLINE void add(Number k, const SparseVector& other) {
    for (int i = 0; i < D; ++i) a[i] = a[i] + k * other.a[i];
    size = size + Abs(k) * other.size;
  }
};

/// A row along b, and a line along v.
template <class Numbers, int D>
class SparseRow {
  using Number = typename Numbers::Number;
  using Range = SparseRange<Numbers>;
  using Vector = SparseVector<Numbers, D>;

 public:
  /// `unit`: kSparse u. `error`: the additional error of each component of a start d.
  LORENTZ_INLINE SparseRow(const Number (&v)[D], double unit, const Vector& b, double radius, Number error)
      : radius_(all(radius)), speed_(sqrt(square_of(v))), error_(2 * error) {
    for (int k = 0; k < D; ++k) v_[k] = v[k];
    cross_of(v, b.a, c_);
    length_ = sqrt(square_of(c_));
    s_ = product_of(v, b.a);
    of_unit_ = all(unit) * speed_;
    s_error_ = of_unit_ * b.size;
    gamma_ = s_error_ / length_;
  }

  /// Is the row nearly parallel to the line, so that the ranges below are of no use?
  LORENTZ_INLINE typename Numbers::Mask is_level() const { return Not(gamma_ < all(kMaxGamma)); }

  /// The balls that the line can meet.
  LORENTZ_INLINE Range balls(const Vector& d) const {
    Number h[D == 2 ? 1 : 3];
    cross_of(v_, d.a, h);
    const Number r2 = radius_ * radius_, p_error = 8 * gamma_ * d.size + 2 * error_;
    Number room = r2 + 8 * kRoundoff * r2;
    if constexpr (D == 3) {
      const Number p = product_of(d.a, c_) / length_, p2 = p * p;
      room = (r2 - p2) + (2 * Abs(p) + p_error) * p_error + 8 * kRoundoff * (r2 + p2);
    }
    const auto missed = room < all(0);
    const Number within = speed_ * sqrt(Max(room, all(0))) / length_,
                 unsure =
                     (8 * gamma_ * sqrt(square_of(h)) + 2 * (of_unit_ * d.size + speed_ * error_)) / length_ +
                     4 * gamma_ * within;
    Range range(Neg(product_of(h, c_)) / (length_ * length_), within, unsure);
    range.last = select(missed, range.first - all(1), range.last);
    range.known = Or(range.known, missed);
    return range;
  }

  /// The balls that are not behind the start, for a row that points forward.
  LORENTZ_INLINE Range ahead(const Vector& d) const {
    const Number n = Neg(product_of(v_, d.a)) / s_;
    Range range(n, all(0), 2 * (of_unit_ * d.size + speed_ * error_ + Abs(n) * s_error_) / s_);
    range.last = all(kMaxCoefficient);
    return range;
  }

  /// The rows d + k e, parallel to this one, that the line can meet. Only in space.
  LORENTZ_INLINE Range rows(const Vector& d, const Vector& e) const {
    const Number lift = product_of(e.a, c_), steep = Abs(lift), lift_error = 4 * gamma_ * e.size * length_;
    const Number middle = Neg(product_of(d.a, c_)) / lift, within = radius_ * length_ / steep;
    Range range(middle, within,
                (4 * gamma_ * d.size + 2 * error_) * length_ / steep +
                    4 * (Abs(middle) + within) * lift_error / steep);
    range.known = And(range.known, lift_error < all(kMaxGamma) * steep);
    return range;
  }

 private:
  Number v_[D], radius_, speed_, error_;  // of d as a whole
  Number c_[D == 2 ? 1 : 3], length_, gamma_, s_, s_error_, of_unit_;
};

/// A vector of a plane, t_0 B_0 + t_1 B_1.
template <class Numbers, int D>
struct SparseCombination {
  typename Numbers::Number t[2];
  SparseVector<Numbers, D> seen;

  LORENTZ_INLINE void add(typename Numbers::Number k, const SparseCombination& other) {
    for (int i = 0; i < 2; ++i) t[i] = t[i] + k * other.t[i];
    seen.add(k, other.seen);
  }
};
template <class Numbers, int D>
LORENTZ_INLINE void exchange(typename Numbers::Mask m, SparseCombination<Numbers, D>& a,
                             SparseCombination<Numbers, D>& b) {
  for (int i = 0; i < 2; ++i) exchange(m, a.t[i], b.t[i]);
  for (int i = 0; i < D; ++i) exchange(m, a.seen.a[i], b.seen.a[i]);
  exchange(m, a.seen.size, b.seen.size);
}

/// Makes two vectors of a plane short across the line, so that few rows along the first one come near the
/// line. Any two vectors that span the plane would be correct.
template <class Numbers>
LORENTZ_INLINE void shorten_across(const typename Numbers::Number (&v)[3],
                                   SparseCombination<Numbers, 3> (&rows)[2]) {
  using Number = typename Numbers::Number;
  auto going = everywhere(true);
  for (int pass = 0; pass < kMaxPlaneReductionSteps && any(going); ++pass) {
    Number c[3], e[3];
    cross_of(v, rows[0].seen.a, c), cross_of(v, rows[1].seen.a, e);
    const auto longer = And(going, square_of(e) < square_of(c));
    exchange(longer, rows[0], rows[1]);
    for (int k = 0; k < 3; ++k) exchange(longer, c[k], e[k]);
    const Number m = Round(product_of(c, e) / square_of(c));
    going = And(going, And(Abs(m) > all(0), Abs(m) < all(kMaxTransform)));
    auto shorter = rows[1];
    shorter.add(Neg(m), rows[0]);
    Number there[3];
    cross_of(v, shorter.seen.a, there);
    going = And(going, square_of(there) < square_of(e));
    for (int i = 0; i < 2; ++i) rows[1].t[i] = select(going, shorter.t[i], rows[1].t[i]);
    for (int k = 0; k < 3; ++k) rows[1].seen.a[k] = select(going, shorter.seen.a[k], rows[1].seen.a[k]);
    rows[1].seen.size = select(going, shorter.seen.size, rows[1].seen.size);
  }
}

/// Turns the row so that it points forward.
template <class Numbers, int D>
LORENTZ_INLINE void turn_forward(const typename Numbers::Number (&v)[D], SparseCombination<Numbers, D>& row) {
  const auto backward = product_of(v, row.seen.a) < all(0);
  for (int i = 0; i < 2; ++i) row.t[i] = select(backward, Neg(row.t[i]), row.t[i]);
  for (int k = 0; k < D; ++k) row.seen.a[k] = select(backward, Neg(row.seen.a[k]), row.seen.a[k]);
}
