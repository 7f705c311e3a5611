// Which obstacles of a row, and which rows of a plane, a line can meet. Private to the reduction engine.
//
// All vectors are seen in a frame in which the obstacles are balls of radius r, in 2D with a third component
// of zero. The row d + n b, seen along v, has the heights v x d + n c across the line, c = v x b. The line
// passes the row at n = -(v x d).c / |c|^2 and at the distance p = |d.c| / |c|, so that it meets the balls
// within |v| sqrt(r^2 - p^2) / |c| of that n. The rows d + k e of a plane have the distances (d.c + k e.c) /
// |c|: of these it meets what is within r |c| / |e.c| of k = -d.c / e.c.
//
// Errors (docs/bounds.md): v, b, d and e err by at most kSparse u of their size; so c errs by at most gamma
// |c|, where gamma = kSparse u |v| |b| / |c|.
#pragma once

#include <cmath>

#include <lorentz/geometry.hpp>
#include "src/engines/reduction/bounds.hpp"

namespace lorentz {

/// The integers that come into question: none outside [first, last] does.
struct SparseRange {
  double first, last;

  /// `within` of the middle, where both together err by at most `unsure`.
  SparseRange(double middle, double within, double unsure)
      : first(std::ceil(middle - within - unsure)),
        last(std::floor(middle + within + unsure)),
        known_(unsure < kMaxUnsure && std::fabs(middle) + within < kMaxCoefficient) {}

  bool is_known() const { return known_; }

 private:
  bool known_;
};

/// A vector, and what its terms come to: at least its length.
struct SparseVector {
  Vec a{};
  double size = 0;
  double error = 0;  ///< of each component, besides kSparse u of the size

  /// This and k times another one.
  SparseVector plus(double k, const SparseVector& other) const {
    SparseVector sum{a, size + std::fabs(k) * other.size, error};
    for (int i = 0; i < 3; ++i) sum.a[i] += k * other.a[i];
    return sum;
  }
};

/// A row along b, and a line along v.
class SparseRow {
 public:
  SparseRow(const Vec& v, double unit, const SparseVector& b, double radius)
      : v_(v),
        unit_(unit),
        radius_(radius),
        speed_(length(v)),
        c_(cross(v, b.a)),
        length_(length(c_)),
        gamma_(unit * speed_ * b.size / length_),
        s_(dot(v, b.a)),
        s_error_(unit * speed_ * b.size) {}

  /// Is the row nearly parallel to the line, so that the rest is of no use?
  bool is_level() const { return !(gamma_ < kMaxGamma); }

  /// The balls that the line can meet.
  SparseRange balls(const SparseVector& d) const {
    const Vec h = cross(v_, d.a);
    const double across = length(h), p = dot(d.a, c_) / length_, p_error = 8 * gamma_ * d.size + 4 * d.error,
                 room = radius_ * radius_ - p * p + (2 * std::fabs(p) + p_error) * p_error +
                        8 * kRoundoff * (radius_ * radius_ + p * p);
    if (room < 0) return {0, -1, 0};
    const double within = speed_ * std::sqrt(room) / length_,
                 unsure =
                     (8 * gamma_ * across + 2 * (unit_ * speed_ * d.size + 2 * speed_ * d.error)) / length_ +
                     4 * gamma_ * within;
    return {-dot(h, c_) / (length_ * length_), within, unsure};
  }

  /// The balls that are not behind the start, of a row that goes forward.
  SparseRange ahead(const SparseVector& d) const {
    const double n = -dot(v_, d.a) / s_,
                 unsure = 2 * (unit_ * speed_ * d.size + 2 * speed_ * d.error + std::fabs(n) * s_error_) / s_;
    SparseRange range(n, 0, unsure);
    range.last = kMaxCoefficient;
    return range;
  }

  /// The rows d + k e of this kind that the line can meet.
  SparseRange rows(const SparseVector& d, const SparseVector& e) const {
    const double lift = dot(e.a, c_), lift_error = 4 * gamma_ * e.size * length_, steep = std::fabs(lift);
    const double middle = -dot(d.a, c_) / lift, within = radius_ * length_ / steep;
    if (!(lift_error < kMaxGamma * steep)) return {0, 0, kMaxUnsure};
    const double unsure = (4 * gamma_ * d.size + 4 * d.error) * length_ / steep +
                          4 * (std::fabs(middle) + within) * lift_error / steep;
    return {middle, within, unsure};
  }

 private:
  Vec v_;
  double unit_, radius_, speed_;
  Vec c_;
  double length_, gamma_, s_, s_error_;
};

}  // namespace lorentz
