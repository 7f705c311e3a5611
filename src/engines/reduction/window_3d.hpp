// A stretch of the flight in 3D, and the lattice point near its middle from which all others are counted, so
// that numbers are small; for one flight. Private to the reduction engine.
#pragma once

#include "src/engines/reduction/reduce_3d.hpp"

namespace lorentz {

/// Can one count from low to high by ones?
inline bool are_countable(double low, double high) {
  return std::fabs(low) < kMaxCoefficient && std::fabs(high) < kMaxCoefficient;
}

template <class Arch, bool kUnit, bool kBall, class Integer>
class Window3 : public WindowOf3<Arch, SplitProduct, kUnit, kBall, Integer> {
  using Base = WindowOf3<Arch, SplitProduct, kUnit, kBall, Integer>;
  using typename Base::DD;

 public:
  using Base::anchor_point, Base::basis, Base::begin, Base::lengthen, Base::to;
  using Base::p_error, Base::s_error, Base::z_error, Base::z_first;
  using typename Base::Basis, typename Base::Point, typename Base::Arm;

  const Offset<SplitProduct, 3>& offset;
  Wide anchor[3];  ///< from the home cell, in the short basis

  Window3(const Bravais& of_lattice, const typename Base::Direction& direction,
          const Offset<SplitProduct, 3>& from_offset)
      : Base(of_lattice, direction, from_offset), offset(from_offset) {}

  /// False if no anchor is found that is known well enough.
  bool set_anchor() {
    if (!find_anchor()) return false;
    if constexpr (std::is_same_v<Integer, Wide>) return set_errors_without_rounding();
    double n[3];
    for (int j = 0; j < 3; ++j) {
      n[j] = anchor[j].hi;
      if (!(std::fabs(n[j]) < kMaxCell)) return false;
    }
    return this->set_errors(n);
  }

  /// The ball of the home cell, of a unit lattice.
  Vec home() const { return {offset.d[0].hi, offset.d[1].hi, offset.d[2].hi}; }

  /// The same point, with its coordinates recomputed from the integers.
  Point recomputed(const Point& point) const {
    Wide N[3];
    cell_of(point, N);
    Point same = at(N);
    for (int i = 0; i < 3; ++i) same.n[i] = point.n[i];
    return same;
  }

  /// The point's coefficients, counted from the home cell; false if they are not exact.
  bool cell_of(const Point& point, Wide (&N)[3]) const {
    bool is_exact = true;
    for (int i = 0; i < 3; ++i) {
      is_exact &= std::fabs(high_of(point.n[i])) < kLargest<Integer>;
      N[i] = anchor[i] + Wide(point.n[i]);
    }
    return is_exact;
  }

  /// Is this lattice vector exactly parallel to the line?
  bool is_parallel(const Arm& arm) const {
    const double n[3] = {high_of(arm.n[0]), high_of(arm.n[1]), high_of(arm.n[2])};
    return arm.p[0] == 0 && arm.p[1] == 0 && lorentz::is_parallel<SplitProduct, 3>(this->lattice, to.v, n);
  }

 private:
  // Finds an anchor near the middle of the window, in a few steps from the home cell.
  bool find_anchor() {
    for (Wide& n : anchor) n = Wide();
    this->set_point_of_home();
    for (int pass = 0; pass < kMaxAnchorPasses; ++pass) {
      double k[3];
      const double largest = this->steps_to_middle(true, k);
      if (!(largest < kMaxAnchorStep)) return false;
      move_anchor(k);
      anchor_point = at(anchor);
      if (largest < kNearAnchor) return true;
    }
    return false;
  }

  // Moves the anchor by integers, exactly if they are below 2^53. Beyond that, the rounded integers are a
  // lattice point, too.
  void move_anchor(const double (&k)[3]) {
    for (int j = 0; j < 3; ++j) {
      double sum = anchor[j].hi, size = std::fabs(sum);
      for (int i = 0; i < 3; ++i) {
        const double step = k[i] * high_of(basis->b[i].n[j]);
        sum += step, size += std::fabs(step);
      }
      if (size < kMaxCoefficient && anchor[j].lo == 0) {
        anchor[j] = Wide(sum);
        continue;
      }
      for (int i = 0; i < 3; ++i) anchor[j] = anchor[j] + k[i] * Wide(basis->b[i].n[j]);
    }
  }

  bool set_errors_without_rounding() {
    const double of_home = 16 * kCross * kRoundoff * kRoundoff + kForm * kFlushed;
    p_error = kUnroundedPlace * kRoundoff * anchor_point.size + of_home * to.inverse_r;
    s_error = kUnroundedPlace * kRoundoff * anchor_point.extent * basis->length + kRoundoff * begin +
              of_home * std::sqrt(to.v2);
    z_error = s_error / basis->length;
    z_first = -(2 * z_error + kWindowStart);
    return std::ranges::all_of(anchor, [](const Wide& n) { return std::fabs(n.hi) < kMaxWideCell; }) &&
           p_error < kSlop3d / 2;
  }

  // The point errs by less than what its doubled sizes and p_error grant it.
  Point place_without_rounding(const Wide (&N)[3]) const {
    Vec place;
    unrounded_place(to.v, N, home(), begin, place);
    Point point;
    for (int i = 0; i < 2; ++i) point.p[i] = to.scale[i] * place[i];
    point.z = place[2] / basis->length;
    this->set_zero(point);
    point.size *= 2, point.extent *= 2;
    return point;
  }

  Point at(const Wide (&N)[3]) const {
    if constexpr (std::is_same_v<Integer, Wide>) return place_without_rounding(N);
    const Wide from = begin == 0 ? this->start_[2] : this->start_[2] - Wide(begin);
    Point point;
    if (N[0].lo == 0 && N[1].lo == 0 && N[2].lo == 0) {  // nearly always; both ways give the same bits
      const double n[3] = {N[0].hi, N[1].hi, N[2].hi};
      this->set_place(n, from, point);
    } else {
      const auto& form = to.form();
      for (int i = 0; i < 2; ++i) point.p[i] = to.scale[i] * compensated_sum<DD>(form[i], N, this->start_[i]);
      point.z = compensated_sum<DD>(form[2], N, from) / basis->length;
    }
    this->set_zero(point);
    return point;
  }
};

}  // namespace lorentz
