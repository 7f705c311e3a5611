// Sums of binary64 numbers without rounding, for what double-double cannot decide.
#pragma once

#include <cmath>

#include "src/engines/base/double_double.hpp"

namespace lorentz {

/// A sum of binary64 numbers without rounding: the smaller parts of it, each below half of the next one's last
/// bit, come first (Shewchuk, "Adaptive precision floating-point arithmetic", 1997, grow-expansion).
class Expansion {
 public:
  Expansion() = default;
  explicit Expansion(double a) { add(a); }

  /// False if parts were too many, or a product so small that its error is not a binary64.
  bool is_exact() const { return exact_; }
  bool is_zero() const { return count_ == 0; }

  /// The sum, to 4 u of it, so that the sign is right. (All parts but the last p are together below |p| / 2, so
  /// that the sum is at least |p| / 2; the partial sums before it, whose roundings count, are together below |p|.)
  double value() const {
    double sum = 0;
    for (int i = 0; i < count_; ++i) sum += parts_[i];
    return sum;
  }

  void add(double a) {
    int kept = 0;
    for (int i = 0; i < count_; ++i) {
      const Wide sum = Wide::sum(a, parts_[i]);
      a = sum.hi;
      if (sum.lo != 0) parts_[kept++] = sum.lo;
    }
    if (kept == kMost)
      exact_ = false;
    else if (a != 0)
      parts_[kept++] = a;
    count_ = kept;
  }

  void add_product(const Expansion& a, const Expansion& b, double factor_of_two = 1) {
    exact_ &= a.exact_ && b.exact_;
    for (int i = 0; i < a.count_; ++i)
      for (int j = 0; j < b.count_; ++j) {
        const Wide product = Wide::product(factor_of_two * a.parts_[i], b.parts_[j]);
        exact_ &= std::fabs(product.hi) > 0x1p-960;
        add(product.lo);
        add(product.hi);
      }
  }

 private:
  static constexpr int kMost = 40;

  double parts_[kMost];  // set up to count_
  int count_ = 0;
  bool exact_ = true;
};

}  // namespace lorentz
