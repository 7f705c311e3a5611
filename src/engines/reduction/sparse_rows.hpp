// Which obstacles of a row, and which rows of a plane, a line can meet. Private to the reduction engine.
//
// All vectors are seen in a frame in which the obstacles are balls of radius r. Seen along v, the row d + n b
// has the heights v x d + n c across the line, where c = v x b. The line passes the row at
// n = -(v x d).c / |c|^2 and at the distance p = |d.c| / |c| (in the plane 0), so it meets the balls within
// |v| sqrt(r^2 - p^2) / |c| of that n. The rows d + k e of a plane have the distances (d.c + k e.c) / |c|;
// the line meets those within r |c| / |e.c| of k = -d.c / e.c.
//
// Errors (docs/bounds.md): v, b, d and e err by at most kSparse u of their size. So c errs by at most
// gamma |c|, where gamma = kSparse u |v| |b| / |c|.
#pragma once

#include <utility>

#include "src/engines/reduction/one_flight.hpp"

namespace lorentz {

/// A range of candidate integers: where `known`, no integer outside [first, last] is a candidate.
struct SparseRange {
  double first, last;
  bool known;

  /// The integers within `within` of `middle`, where the two together err by at most `unsure`.
  SparseRange(double middle, double within, double unsure)
      : first(Ceil(middle - within - unsure)),
        last(Floor(middle + within + unsure)),
        known(Abs(middle) + within + unsure < kMaxCoefficient) {}
};

/// A vector, and the size of its terms, which is at least its length.
template <int D>
struct SparseVector {
  double a[D], size;

  /// Adds k times another vector.
  void add(double k, const SparseVector& other) {
    for (int i = 0; i < D; ++i) a[i] = a[i] + k * other.a[i];
    size = size + Abs(k) * other.size;
  }
};

/// A row along b, and a line along v.
template <int D>
class SparseRow {
  using Vector = SparseVector<D>;

 public:
  /// `unit`: kSparse u. `error`: the additional error of each component of a start d.
  SparseRow(const double (&v)[D], double unit, const Vector& b, double radius, double error)
      : radius_(radius), speed_(sqrt(square_of(v))), error_(2 * error) {
    for (int k = 0; k < D; ++k) v_[k] = v[k];
    cross_of(v, b.a, c_);
    length_ = sqrt(square_of(c_));
    s_ = product_of(v, b.a);
    of_unit_ = unit * speed_;
    s_error_ = of_unit_ * b.size;
    gamma_ = s_error_ / length_;
  }

  /// Is the row nearly parallel to the line, so that the ranges below are of no use?
  bool is_level() const { return !(gamma_ < kMaxGamma); }

  /// The balls that the line can meet.
  SparseRange balls(const Vector& d) const {
    double h[D == 2 ? 1 : 3];
    cross_of(v_, d.a, h);
    const double r2 = radius_ * radius_, p_error = 8 * gamma_ * d.size + 2 * error_;
    double room = r2 + 8 * kRoundoff * r2;
    if constexpr (D == 3) {
      const double p = product_of(d.a, c_) / length_, p2 = p * p;
      room = (r2 - p2) + (2 * Abs(p) + p_error) * p_error + 8 * kRoundoff * (r2 + p2);
    }
    const bool missed = room < 0;
    const double within = speed_ * sqrt(Max(room, 0)) / length_,
                 unsure =
                     (8 * gamma_ * sqrt(square_of(h)) + 2 * (of_unit_ * d.size + speed_ * error_)) / length_ +
                     4 * gamma_ * within;
    SparseRange range(-product_of(h, c_) / (length_ * length_), within, unsure);
    if (missed) range.last = range.first - 1, range.known = true;
    return range;
  }

  /// The balls that are not behind the start, for a row that points forward.
  SparseRange ahead(const Vector& d) const {
    const double n = -product_of(v_, d.a) / s_;
    SparseRange range(n, 0, 2 * (of_unit_ * d.size + speed_ * error_ + Abs(n) * s_error_) / s_);
    range.last = kMaxCoefficient;
    return range;
  }

  /// The rows d + k e, parallel to this one, that the line can meet. Only in space.
  SparseRange rows(const Vector& d, const Vector& e) const {
    const double lift = product_of(e.a, c_), steep = Abs(lift), lift_error = 4 * gamma_ * e.size * length_;
    const double middle = -product_of(d.a, c_) / lift, within = radius_ * length_ / steep;
    SparseRange range(middle, within,
                      (4 * gamma_ * d.size + 2 * error_) * length_ / steep +
                          4 * (Abs(middle) + within) * lift_error / steep);
    range.known = range.known && lift_error < kMaxGamma * steep;
    return range;
  }

 private:
  double v_[D], radius_, speed_, error_;  // of d as a whole
  double c_[D == 2 ? 1 : 3], length_, gamma_, s_, s_error_, of_unit_;
};

/// A vector of a plane, t_0 B_0 + t_1 B_1.
template <int D>
struct SparseCombination {
  double t[2];
  SparseVector<D> seen;

  void add(double k, const SparseCombination& other) {
    for (int i = 0; i < 2; ++i) t[i] = t[i] + k * other.t[i];
    seen.add(k, other.seen);
  }
};

/// Makes two vectors of a plane short across the line, so that few rows along the first one come near the
/// line. Any two vectors that span the plane would be correct.
inline void shorten_across(const double (&v)[3], SparseCombination<3> (&rows)[2]) {
  for (int pass = 0; pass < kMaxPlaneReductionSteps; ++pass) {
    double c[3], e[3];
    cross_of(v, rows[0].seen.a, c), cross_of(v, rows[1].seen.a, e);
    if (square_of(e) < square_of(c)) std::swap(rows[0], rows[1]), std::swap(c, e);
    const double m = Round(product_of(c, e) / square_of(c));
    if (!(Abs(m) > 0 && Abs(m) < kMaxTransform)) return;
    SparseCombination<3> shorter = rows[1];
    shorter.add(-m, rows[0]);
    double there[3];
    cross_of(v, shorter.seen.a, there);
    if (!(square_of(there) < square_of(e))) return;
    rows[1] = shorter;
  }
}

/// Turns the row so that it points forward.
template <int D>
void turn_forward(const double (&v)[D], SparseCombination<D>& row) {
  if (!(product_of(v, row.seen.a) < 0)) return;
  for (double& t : row.t) t = -t;
  for (double& a : row.seen.a) a = -a;
}

}  // namespace lorentz
