// Greedy reduction of three vectors to a short basis. Private to the reduction engine.
#pragma once

#include <algorithm>
#include <utility>

#include "src/engines/reduction/one_flight.hpp"

namespace lorentz {

/// Four numbers, of which three are used, in one register if the processor has such registers. Then an
/// operation on a lattice vector takes two instructions, and none of the three vectors leaves the registers.
/// (An extension of GCC and Clang; without such registers it is compiled to others.)
using FourNumbers [[gnu::vector_size(32)]] = double;

/// Works on running coordinates until these have to be computed anew from the coefficients.
class GreedyReduction {
 public:
  explicit GreedyReduction(Basis3& basis) : basis_(basis) {}

  /// The largest coefficient that ever occurred. If it is below 2^52, all steps were exact.
  double largest() const { return largest_of(largest_); }

  /// Are the coordinates those of the coefficients, or accurate enough?
  bool is_accurate(double inverse_r) const { return fresh_ || largest() * inverse_r < kGoodRunning; }

  /// To be called when the coordinates have been computed anew.
  void refresh() {
    fresh_ = true;
    limit_ = kNoLimit;
  }

  /// Reduces to the coefficients of short vectors, the shortest first. False if it was interrupted because
  /// the coordinates have to be computed anew.
  bool run() {
    Vector a(basis_.b[0]), b(basis_.b[1]), c(basis_.b[2]);
    const bool done = reduce(a, b, c);
    for (int k = 0; k < 3; ++k)
      basis_.b[0].n[k] = a.n[k], basis_.b[1].n[k] = b.n[k], basis_.b[2].n[k] = c.n[k];
    return done;
  }

 private:
  struct Vector {
    FourNumbers n, place;  ///< coefficients; across, along

    explicit Vector(const Arm3& arm)
        : n{arm.n[0], arm.n[1], arm.n[2], 0}, place{arm.p[0], arm.p[1], arm.z, 0} {}
  };

  // Shortens the two shorter vectors by Lagrange's step, then the longest by the nearest point of their
  // plane.
  bool reduce(Vector& a, Vector& b, Vector& c) {
    double aa = product(a, a), bb = product(b, b), cc = product(c, c);
    if (bb < aa) exchange(a, b, aa, bb);
    if (cc < bb) exchange(b, c, bb, cc);
    if (bb < aa) exchange(a, b, aa, bb);
    for (int step = 0; step < kMaxReductionSteps; ++step) {
      double ab = product(a, b);
      const double k = std::nearbyint(ab / aa);
      if (k != 0) {
        if (std::fabs(k) > kRunningQuotient && !fresh_) return false;
        subtract(b, k, a);
        bb = product(b, b);
        if (bb < aa) {
          exchange(a, b, aa, bb);
          continue;
        }
        ab = product(a, b);
      }
      const double ac = product(a, c), bc = product(b, c);
      const double inverse = 1 / (aa * bb - ab * ab);
      const double k0 = std::nearbyint((ac * bb - bc * ab) * inverse);
      const double k1 = std::nearbyint((bc * aa - ac * ab) * inverse);
      if (k0 == 0 && k1 == 0) return true;
      if (std::max(std::fabs(k0), std::fabs(k1)) > kRunningQuotient && !fresh_) return false;
      subtract(c, k0, a);
      subtract(c, k1, b);
      const double before = cc;
      cc = product(c, c);
      if (!(cc < before) || cc >= bb) return true;
      if (largest() > limit_) return false;
      exchange(b, c, bb, cc);
      if (bb < aa) exchange(a, b, aa, bb);
    }
    return false;
  }

  static double product(const Vector& a, const Vector& b) {
    const FourNumbers terms = a.place * b.place;
    return (terms[0] + terms[1]) + terms[2];
  }

  static void exchange(Vector& a, Vector& b, double& aa, double& bb) {
    std::swap(a, b);
    std::swap(aa, bb);
  }

  void subtract(Vector& a, double k, const Vector& b) {
    a.n -= k * b.n, a.place -= k * b.place;
    const FourNumbers size = a.n > -a.n ? a.n : -a.n;
    largest_ = size > largest_ ? size : largest_;
    fresh_ = false;
  }

  static double largest_of(const FourNumbers& a) { return std::max({a[0], a[1], a[2]}); }

  Basis3& basis_;
  FourNumbers largest_{};  // of each of the three coefficients
  double limit_ = kRunningCoefficient;
  bool fresh_ = true;  // the coordinates are those of the coefficients, not sums of rounded ones
};

/// Reduces the basis to short vectors, then once more from exact coefficients. False if this does not
/// succeed.
template <class Arch, class Frame>
bool reduce_basis(const Frame& frame, Basis3& basis, bool) {
  GreedyReduction reduction(basis);
  bool done = false;
  for (int round = 0; round < kMaxReductionRounds && !done; ++round) {
    done = reduction.run() && reduction.is_accurate(frame.inverse_r);
    for (Arm3& arm : basis.b) frame.template recompute<Arch>(arm, basis.length);
    reduction.refresh();
  }
  return done && reduction.largest() < kMaxCoefficient / 2;
}

}  // namespace lorentz
