// Greedy reduction of three vectors to a short basis. Private to the reduction engine.
#pragma once

#include <algorithm>
#include <array>
#include <utility>

#include "src/engines/reduction/unrounded.hpp"

namespace lorentz {

/// Four numbers, of which three are used, in one register if the processor has such registers. Then an
/// operation on a lattice vector takes two instructions, and none of the three vectors leaves the registers.
/// (An extension of GCC and Clang; without such registers it is compiled to others.)
using FourNumbers [[gnu::vector_size(32)]] = double;

/// Works on running coordinates until these have to be computed anew from the coefficients.
template <class Integer>
class GreedyReduction {
  using Basis = BasisOf3<SplitProduct, Integer>;

 public:
  explicit GreedyReduction(Basis& basis) : basis_(basis) {}

  /// The largest coefficient that ever occurred. If it is below kLargest / 2, all steps were exact.
  double largest() const { return largest_of(largest_); }

  /// Are the coordinates those of the coefficients, or accurate enough?
  bool is_accurate(double inverse_r) const {
    if constexpr (std::is_same_v<Integer, Wide>) return fresh_ || error_ < kGoodPlace;
    return fresh_ || largest() * inverse_r < kGoodRunning;
  }

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
    error_ = std::max({a.place[3], b.place[3], c.place[3]});
    for (int k = 0; k < 3; ++k)
      basis_.b[0].n[k] = a.n[k], basis_.b[1].n[k] = b.n[k], basis_.b[2].n[k] = c.n[k];
    return done;
  }

 private:
  struct Vector {
    std::conditional_t<std::is_same_v<Integer, Wide>, std::array<Wide, 3>, FourNumbers> n;  ///< coefficients
    FourNumbers place;  ///< across, along; beside integers in double-double their error

    explicit Vector(const ArmOf3<SplitProduct, Integer>& arm)
        : n{arm.n[0], arm.n[1], arm.n[2]}, place{arm.p[0], arm.p[1], arm.z, 0} {
      if constexpr (std::is_same_v<Integer, Wide>) place[3] = kRoundoff * (arm.cancellation + reach());
    }
    double reach() const { return std::fabs(place[0]) + std::fabs(place[1]); }
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
        if (is_too_far(k, a)) return false;
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
      if (is_too_far(k0, a) || is_too_far(k1, b)) return false;
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

  // Would k times this vector err too much, because its running coordinates do?
  bool is_too_far(double k, const Vector& b) const {
    if constexpr (std::is_same_v<Integer, Wide>) return !fresh_ && std::fabs(k) * b.place[3] > kGoodPlace;
    return !fresh_ && std::fabs(k) > kRunningQuotient;
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
    const double error = a.place[3];
    a.place -= k * b.place;
    fresh_ = false;
    if constexpr (std::is_same_v<Integer, Wide>) {
      a.place[3] = error + std::fabs(k) * (b.place[3] + 2 * kRoundoff * b.reach());
      for (int i = 0; i < 3; ++i)
        a.n[i] = a.n[i] - k * b.n[i], largest_[i] = std::max(largest_[i], std::fabs(a.n[i].hi));
    } else {
      a.n -= k * b.n;
      const FourNumbers size = a.n > -a.n ? a.n : -a.n;
      largest_ = size > largest_ ? size : largest_;
    }
  }

  static double largest_of(const FourNumbers& a) { return std::max({a[0], a[1], a[2]}); }

  Basis& basis_;
  FourNumbers largest_{};  // of each of the three coefficients
  double limit_ = std::is_same_v<Integer, Wide> ? kNoLimit : kRunningCoefficient, error_ = 0;
  bool fresh_ = true;  // the coordinates are those of the coefficients, not sums of rounded ones
};

/// Recomputes a vector's across and along from its coefficients; from set_cross, where these are in double-double
/// and the large terms cancel so far that it matters.
template <class Arch, class Frame, class Integer>
void recompute(const Frame& frame, ArmOf3<SplitProduct, Integer>& arm, double length) {
  frame.template recompute<Arch>(arm, length);
  if constexpr (std::is_same_v<Integer, Wide>) {
    const auto reach = [&] { return std::fabs(arm.p[0]) + std::fabs(arm.p[1]); };
    if (arm.cancellation < kFewCancel * reach()) return;
    Vec place;
    unrounded_place(frame.v, arm.n, {}, 0, place);
    for (int i = 0; i < 2; ++i) arm.p[i] = frame.scale[i] * place[i];
    arm.z = place[2] / length;
    arm.cancellation = kUnroundedPlace * reach() + 16 * kCross * kRoundoff * frame.inverse_r;
  }
}

/// Reduces the basis to short vectors, then once more from exact coefficients. False if this does not
/// succeed.
template <class Arch, class Frame, class Integer>
bool reduce_basis(const Frame& frame, BasisOf3<SplitProduct, Integer>& basis, bool) {
  GreedyReduction reduction(basis);
  bool done = false;
  for (int round = 0; round < kMaxReductionRounds && !done; ++round) {
    done = reduction.run() && reduction.is_accurate(frame.inverse_r);
    for (auto& arm : basis.b) recompute<Arch>(frame, arm, basis.length);
    reduction.refresh();
  }
  return done && reduction.largest() < kLargest<Integer> / 2;
}

}  // namespace lorentz
