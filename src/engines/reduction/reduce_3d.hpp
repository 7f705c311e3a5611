// Greedy reduction of three vectors to a short basis. Private to the reduction engine.
#pragma once

#include <algorithm>
#include <utility>

#include "src/engines/reduction/basis_3d.hpp"

namespace lorentz {

/// Works on running coordinates, until these have to be computed anew from the coefficients.
class GreedyReduction {
 public:
  explicit GreedyReduction(Basis3& basis) : b_{&basis.b[0], &basis.b[1], &basis.b[2]} {}

  double largest = 0;  ///< of the coefficients, ever; below 2^52 all steps were exact

  /// Are the coordinates those of the coefficients, or good enough?
  bool is_accurate(double inverse_r) const { return fresh_ || largest * inverse_r < kGoodRunning; }

  /// The coordinates have been computed anew.
  void refresh() {
    fresh_ = true;
    limit_ = kNoLimit;
  }

  /// The vectors, shortest first.
  void copy_sorted(Arm3 (&sorted)[3]) const {
    for (int i = 0; i < 3; ++i) sorted[i] = *b_[i];
  }

  /// The two shorter vectors by Lagrange's step, then the longest by the nearest point of their plane. False
  /// if it was interrupted, because the coordinates have to be computed anew.
  bool run() {
    for (int i = 0; i < 3; ++i) size_[i] = product(*b_[i], *b_[i]);
    sort();
    for (int step = 0; step < kMaxReductionSteps; ++step) {
      double c01 = product(*b_[0], *b_[1]);
      const double k = std::nearbyint(c01 / size_[0]);
      if (k != 0) {
        if (std::fabs(k) > kRunningQuotient && !fresh_) return false;
        subtract(*b_[1], k, *b_[0]);
        fresh_ = false;
        size_[1] = product(*b_[1], *b_[1]);
        if (size_[1] < size_[0]) {
          std::swap(b_[0], b_[1]);
          std::swap(size_[0], size_[1]);
          continue;
        }
        c01 = product(*b_[0], *b_[1]);
      }
      const double c02 = product(*b_[0], *b_[2]), c12 = product(*b_[1], *b_[2]);
      const double inverse = 1 / (size_[0] * size_[1] - c01 * c01);
      const double k0 = std::nearbyint((c02 * size_[1] - c12 * c01) * inverse);
      const double k1 = std::nearbyint((c12 * size_[0] - c02 * c01) * inverse);
      if (k0 == 0 && k1 == 0) return true;
      if (std::max(std::fabs(k0), std::fabs(k1)) > kRunningQuotient && !fresh_) return false;
      subtract(*b_[2], k0, *b_[0]);
      subtract(*b_[2], k1, *b_[1]);
      const double before = size_[2];
      size_[2] = product(*b_[2], *b_[2]);
      fresh_ = false;
      if (!(size_[2] < before)) return true;
      if (size_[2] >= size_[1]) return true;
      if (largest > limit_) return false;
      sort();
    }
    return false;
  }

 private:
  void subtract(Arm3& arm, double k, const Arm3& other) {
    arm.subtract(k, other);
    largest = std::max({largest, std::fabs(arm.n[0]), std::fabs(arm.n[1]), std::fabs(arm.n[2])});
  }

  void sort() {
    order(0, 1);
    order(1, 2);
    order(0, 1);
  }

  void order(int i, int j) {  // without a branch
    const bool swap = size_[j] < size_[i];
    Arm3* const first = swap ? b_[j] : b_[i];
    b_[j] = swap ? b_[i] : b_[j], b_[i] = first;
    const double smaller = swap ? size_[j] : size_[i];
    size_[j] = swap ? size_[i] : size_[j], size_[i] = smaller;
  }

  Arm3* b_[3];
  double size_[3];
  double limit_ = kRunningCoefficient;
  bool fresh_ = true;  // the coordinates are those of the coefficients, not sums of rounded ones
};

}  // namespace lorentz
