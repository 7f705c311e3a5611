// The first ball of a 2D Bravais lattice that a line meets, in O(log 1/r). Private to the reduction engine.
//
// In coordinates (s, h), along the line and across it, the lattice points of the strip |h| < rho are wanted,
// and of these the first with s > 0. Euclid's algorithm on the heights of two basis vectors on either side of
// the line (the continued fraction of the slope) gives a basis R, L with heights D_R >= 0 >= -D_L and D_L < 2
// rho; then every row { n R - m L : m } meets the strip, in one interval of m, and few rows come near the
// start.
#pragma once

#include <algorithm>
#include <limits>

#include "encounter.hpp"
#include "offset.hpp"

namespace lorentz {

/// A lattice vector: integer coefficients in the lattice's short basis.
struct Arm2 {
  double n[2]{};
  double D = 0, D_low = 0;  ///< |v x vector| as a sum; the first part is kept exact by Euclid's algorithm
  double S = 0;             ///< v . vector >= 0

  double D_error = 0;

  template <class Arch>
  void subtract(double k, const Arm2& other) {
    D = Arch::remainder(D, k, other.D);
    D_low -= k * other.D_low;
    n[0] += k * other.n[0];
    n[1] += k * other.n[1];
  }
};

/// A lattice seen along one direction: all that does not depend on the start.
template <bool kUnit>
struct Direction2 {
  Vec v;  ///< turned, components below kTinyComponent taken as zero
  double v2 = 0, rho = 0;
  Wide H[2];      ///< heights v x B_i
  double M[2]{};  ///< the size of the terms of H_i
  double S[2]{};  ///< v . B_i
  Arm2 R, L;      ///< h = sigma D_R for R and -sigma D_L for L
  double sigma = 1;
  double inverse_A = 0, inverse_D_L = 0, inverse_S_L = 0;  ///< A = |v|^2 times the cell's area
  bool usable = true;

  template <class Arch>
  Direction2(Arch, const Bravais& lattice, const Octant& octant, const Vec& velocity) {
    octant.turn<kUnit>(velocity, v);
    v2 = speed_squared(v[0], v[1], 0.0);
    rho = lattice.radius * std::sqrt(v2);
    set_forms<Arch>(lattice);
    set_first_arms();
    euclid<Arch>();
    if constexpr (!kUnit)
      for (int round = 0; round < 8 && usable && renormalise(); ++round) euclid<Arch>();
    finish(lattice);
  }

 private:
  template <class Arch>
  void set_forms(const Bravais& lattice) {
    using DD = DoubleDouble<Arch>;
    if constexpr (kUnit) {
      H[0] = Wide(-v[1]), H[1] = Wide(v[0]);
      M[0] = std::fabs(v[1]), M[1] = std::fabs(v[0]);
      S[0] = v[0], S[1] = v[1];
    } else {
      for (int i = 0; i < 2; ++i) {
        const DD x(lattice.basis[i][0]), y(lattice.basis[i][1]);
        H[i] = Wide(y * v[0] - x * v[1]);
        M[i] = std::fabs(v[0] * y.hi) + std::fabs(v[1] * x.hi) + 0x1p106 * 4 * lattice.basis_error;
        S[i] = v[0] * x.hi + v[1] * y.hi;
      }
    }
  }

  // Two neighbours of the shortest lattice vectors with the line between them, both pointing forward.
  void set_first_arms() {
    if constexpr (kUnit) {  // v lies in the first octant
      R.n[1] = L.n[0] = 1;
      R.D = v[0], L.D = v[1];
      return;
    }
    const double p = std::copysign(1, S[0]), q = std::copysign(1, S[1]);
    double first = p * H[0].hi, second = q * H[1].hi;
    R.n[0] = p, L.n[1] = q;
    R.D_low = p * H[0].lo, L.D_low = q * H[1].lo;
    if (first * second > 0) {  // the line lies outside their cone: the one farther off goes to the other side
      Arm2& far = std::fabs(first) > std::fabs(second) ? R : L;
      const Arm2& near = std::fabs(first) > std::fabs(second) ? L : R;
      double& far_height = std::fabs(first) > std::fabs(second) ? first : second;
      const double near_height = std::fabs(first) > std::fabs(second) ? second : first;
      // near - far: forward, since the angle between the two is 60 to 90 degrees.
      const Wide height = Wide(near_height, near.D_low) - Wide(far_height, far.D_low);
      far_height = height.hi, far.D_low = height.lo;
      far.n[0] = near.n[0] - far.n[0], far.n[1] = near.n[1] - far.n[1];
    }
    sigma = first > 0 || second < 0 ? 1 : -1;
    R.D = sigma * first, R.D_low *= sigma;
    L.D = -sigma * second, L.D_low *= -sigma;
    usable = R.D >= 0 && L.D >= 0;
    if (R.D < L.D) swap_arms();
  }

  void swap_arms() {
    std::swap(R, L);
    sigma = -sigma;
  }

  // The quotients are those of the continued fraction; on the unit lattices D_R and D_L are exact throughout.
  // Two steps at a time, so that the arms need not change places at each.
  template <class Arch>
  void euclid() {
    Arm2 larger = R, smaller = L;
    while (goes_on(smaller)) {
      larger.template subtract<Arch>(std::floor(larger.D / smaller.D), smaller);
      if (!goes_on(larger)) {
        R = smaller, L = larger, sigma = -sigma;
        return;
      }
      smaller.template subtract<Arch>(std::floor(smaller.D / larger.D), larger);
    }
    R = larger, L = smaller;
  }

  bool goes_on(const Arm2& smaller) const {
    return smaller.D >= 2 * rho && (kUnit || std::fabs(smaller.D_low) <= 0x1p-8 * smaller.D);
  }

  // Adds the low parts to the high ones; true if Euclid's algorithm has to go on from there.
  bool renormalise() {
    for (Arm2* arm : {&R, &L}) {
      const Wide height = Wide::sum(arm->D, arm->D_low);
      arm->D = height.hi, arm->D_low = height.lo;
    }
    if (L.D < 0) {  // the last quotient was one too large
      const Wide height = Wide(L.D, L.D_low) + Wide(R.D, R.D_low);
      L.D = height.hi, L.D_low = height.lo;
      L.n[0] -= R.n[0], L.n[1] -= R.n[1];
    }
    usable = R.D >= 0 && L.D >= 0;
    if (R.D < L.D) swap_arms();
    return L.D >= 2 * rho;
  }

  void finish(const Bravais& lattice) {
    for (Arm2* arm : {&R, &L}) {
      arm->S = arm->n[0] * S[0] + arm->n[1] * S[1];
      if (!kUnit) arm->D_error = kAnchorTerms * (std::fabs(arm->n[0]) * M[0] + std::fabs(arm->n[1]) * M[1]);
      usable = usable && arm->S >= 0 && L.D < 2 * rho && std::fabs(arm->n[0]) < kMaxCoefficient &&
               std::fabs(arm->n[1]) < kMaxCoefficient;
    }
    inverse_A = 1 / (kUnit ? v2 : v2 * lattice.volume);
    inverse_D_L = 1 / L.D;
    inverse_S_L = 1 / L.S;
  }
};

/// The search for one start.
template <class Arch, bool kUnit>
class Search2 {
  using DD = DoubleDouble<Arch>;

 public:
  Search2(const Bravais& lattice, const Direction2<kUnit>& direction, const Offset<2>& offset)
      : lattice_(lattice), to_(direction), offset_(offset) {}

  Stage stage = Stage::binary64;
  Wide best[2];  ///< coefficients of the ball found, from the home cell, in the short basis
  double best_s = std::numeric_limits<double>::infinity(), best_slack = 0, best_s_error = 0,
         best_slack_error = 0;

  /// `from`: coefficients of the ball that is being left, or null. Entered after s_limit: need not be found.
  Outcome run(const Wide* from, double s_limit) {
    from_ = from;
    s_limit_ = s_limit;
    if (!to_.usable || !set_anchor()) return give_up();
    const Arm2 &R = to_.R, &L = to_.L;
    const double nu = -(L.S * y_ + L.D * s_) * to_.inverse_A, reach = L.S * to_.rho * to_.inverse_A;
    for (double n = std::ceil(nu - reach - kSlop);; ++n) {
      const double farthest = std::min(best_s, s_limit);
      const double last =
          L.D > 0 ? nu + reach + kSlop + farthest * (L.D * to_.inverse_A) : nu + reach + kSlop;
      if (!(n <= last)) break;
      if (!look_in_row(n)) return give_up();
      if (best_s < std::numeric_limits<double>::infinity() && R.D > 2 * to_.rho * (1 + kSlop))
        break;  // rows come one after the other
    }
    if (best_s < std::numeric_limits<double>::infinity()) return Outcome::hit;
    // Rows parallel to the line were all passed: with exact heights that is a proof.
    if (L.D > 0 || is_parallel(lattice_, to_.v, L.n)) return Outcome::never;
    return give_up();
  }

 private:
  static constexpr double kSlop = 0x1p-30;

  Outcome give_up() {
    stage = Stage::undecided;
    return Outcome::undecided;
  }

  // Heights and positions are counted from the ball of the home cell; but among tiny balls from the lattice
  // point nearest to the start in the coordinates of R and L, since the home cell's are so large that their
  // products leave the exact integers, and multiply what errors D_R and D_L have.
  bool set_anchor() {
    const Arm2 &R = to_.R, &L = to_.L;
    const DD h = DD(offset_.d[1]) * to_.v[0] - DD(offset_.d[0]) * to_.v[1];
    const double size = std::fabs(offset_.d[0].hi) + std::fabs(offset_.d[1].hi);
    y_ = to_.sigma * h.hi;
    y_error_ = kRoundoff * std::fabs(y_) + 4 * offset_.error + kAnchorTerms * size + kFlushed;
    s_ = to_.v[0] * offset_.d[0].hi + to_.v[1] * offset_.d[1].hi;
    s_error_ = kAlong * kRoundoff * size + 4 * offset_.error;
    if (to_.rho > 0x1p-20) return true;
    const double n = std::nearbyint(-(L.S * y_ + L.D * s_) * to_.inverse_A);
    const double m = std::nearbyint((R.S * y_ - R.D * s_) * to_.inverse_A);
    double terms = 0, along = 0;
    for (int i = 0; i < 2; ++i) {
      const DD sum =
          DD::product(n, R.n[i]) + DD::product(m, L.n[i]);  // large terms, but what they leave is not
      if (!(std::fabs(sum.hi) < kMaxCoefficient && std::fabs(n) < kMaxCoefficient &&
            std::fabs(m) < kMaxCoefficient))
        return false;
      anchor_[i] = sum.hi;
      terms += std::fabs(anchor_[i]) * to_.M[i];
      along += std::fabs(anchor_[i] * to_.S[i]);
    }
    y_ = to_.sigma * compensated(h);
    y_error_ += kAnchor * kRoundoff * std::fabs(y_) + kAnchorTerms * terms;
    s_ += anchor_[0] * to_.S[0] + anchor_[1] * to_.S[1];
    s_error_ += kAlong * kRoundoff * along;
    return true;
  }

  // h + anchor_0 H_0 + anchor_1 H_1, its large terms cancelling exactly.
  double compensated(DD h) const {
    const DD a = DD::product(anchor_[0], to_.H[0].hi), b = DD::product(anchor_[1], to_.H[1].hi);
    const DD ab = DD::sum(a.hi, b.hi), all = DD::sum(ab.hi, h.hi);
    double low = (a.lo + b.lo) + (ab.lo + all.lo) + h.lo;
    if constexpr (!kUnit) low += anchor_[0] * to_.H[0].lo + anchor_[1] * to_.H[1].lo;
    return all.hi + low;
  }

  // The first ball of row n that is met ahead, if it comes before the best so far. False: undecided.
  bool look_in_row(double n) {
    const Arm2 &R = to_.R, &L = to_.L;
    const double y = y_ + n * R.D, rho = to_.rho;
    const double behind = -(s_ + n * R.S) * to_.inverse_S_L;
    double m = behind;
    double unsure = kSlop;
    if (L.D > 0) {
      m = std::max(m, (y - rho) * to_.inverse_D_L);
      unsure += (16 * kRoundoff * (std::fabs(y) + std::fabs(n * R.D) + rho) + y_error_) * to_.inverse_D_L;
    }
    if (unsure > 0.25) return look_closely_in_row(n);
    return look_from(n, std::ceil(m - unsure));
  }

  // The balls of row n from m on, until one is met or the row has left the strip.
  bool look_from(double n, double m) {
    for (int step = 0; step < 16; ++step) {
      const Look look = look_at(n, m + step);
      if (look == Look::doubtful) return false;
      if (look != Look::before) return true;
    }
    return false;
  }

  enum class Look { before, taken, beyond, doubtful };

  // The ball at n R + m L: before the strip or behind the start, met, or beyond the strip.
  Look look_at(double n, double m) {
    const Arm2 &R = to_.R, &L = to_.L;
    const double h = height_in_row(y_, n, R.D, m, L.D);
    const double error = kHeight * kRoundoff * (std::fabs(y_) + std::fabs(n * R.D) + std::fabs(m * L.D)) +
                         y_error_ + std::fabs(n) * R.D_error + std::fabs(m) * L.D_error;
    const double s = sum_along(s_, n, R.S, m, L.S);
    const double s_error = s_error_ + kAlong * kRoundoff * (std::fabs(n * R.S) + std::fabs(m * L.S));
    const Decision meets = is_below(h, to_.rho, error);
    if (meets == Decision::no) return h < 0 || L.D == 0 ? Look::beyond : Look::before;
    if (s < -s_error) return Look::before;
    if (s - s_error > std::min(best_s + best_s_error, s_limit_)) return Look::beyond;
    double N[2] = {anchor_[0] + n * R.n[0] + m * L.n[0], anchor_[1] + n * R.n[1] + m * L.n[1]};
    for (int i = 0; i < 2; ++i)
      if (!(std::fabs(N[i]) < kMaxCoefficient && std::fabs(n * R.n[i]) < kMaxCoefficient &&
            std::fabs(m * L.n[i]) < kMaxCoefficient))
        return Look::doubtful;
    if (from_ && N[0] == from_[0].hi && N[1] == from_[1].hi && from_[0].lo == 0 && from_[1].lo == 0)
      return Look::before;
    if (meets == Decision::yes && s > s_error)
      return offer(N, s, s_error, (to_.rho - h) * (to_.rho + h),
                   4 * to_.rho * (error + kRho * kRoundoff * to_.rho));
    return look_closely(N, h);
  }

  Look offer(const double* N, double s, double s_error, double slack, double slack_error) {
    if (!(s + s_error < best_s - best_s_error)) return Look::doubtful;
    best[0] = Wide(N[0]), best[1] = Wide(N[1]);
    best_s = s, best_s_error = s_error, best_slack = slack, best_slack_error = slack_error;
    return Look::taken;
  }

  // The same decisions in double-double.
  [[gnu::noinline]] Look look_closely(const double* N, double h) {
    stage = std::max(stage, Stage::double_double);
    const Wide wide_N[2] = {N[0], N[1]};
    Wide d[2];
    const double error = place_of<SplitProduct, kUnit, 2>(lattice_, offset_, wide_N, d);
    const Encounter<SplitProduct, 2> encounter(to_.v, d, error, lattice_.radius);
    const Decision meets = encounter.meets();
    if (meets == Decision::doubtful) return Look::doubtful;
    if (meets == Decision::no) return h < 0 || to_.L.D == 0 ? Look::beyond : Look::before;
    const Decision ahead = encounter.is_ahead();
    if (ahead == Decision::doubtful) return Look::doubtful;
    if (ahead == Decision::no) return Look::before;
    return offer(N, encounter.s.hi, encounter.s_error + kRoundoff * encounter.s.hi, encounter.slack.hi,
                 encounter.slack_error + kRoundoff * encounter.slack.hi);
  }

  // A row nearly parallel to the line, where binary64 cannot tell at which m it enters the strip.
  [[gnu::noinline]] bool look_closely_in_row(double n) {
    const Arm2 &R = to_.R, &L = to_.L;
    stage = std::max(stage, Stage::double_double);
    double N[2];
    for (int i = 0; i < 2; ++i) {
      N[i] = anchor_[i] + n * R.n[i];
      if (!(std::fabs(n * R.n[i]) < kMaxCoefficient && std::fabs(N[i]) < kMaxCoefficient)) return false;
    }
    const Wide wide_N[2] = {N[0], N[1]};
    Wide d[2];
    const double error = place_of<SplitProduct, kUnit, 2>(lattice_, offset_, wide_N, d);
    const Encounter<SplitProduct, 2> start(to_.v, d, error, lattice_.radius);
    const Wide h = (d[1] * to_.v[0] - d[0] * to_.v[1]) * to_.sigma,
               rho = Wide(lattice_.radius) * sqrt(start.v2);
    const Wide m = (h - rho) / Wide(L.D, L.D_low);
    const double unsure =
        (start.s_error + kStable * (std::fabs(h.hi) + rho.hi) + std::fabs(m.hi) * L.D_error) / L.D +
        kStable * std::fabs(m.hi) + kSlop;
    if (!(unsure < 0.25)) return false;
    const double first =
        std::max(std::ceil(m.value() - unsure), std::ceil(-(s_ + n * R.S) * to_.inverse_S_L - kSlop));
    return std::fabs(first) < kMaxCoefficient && look_from(n, first);
  }

  const Bravais& lattice_;
  const Direction2<kUnit>& to_;
  const Offset<2>& offset_;
  const Wide* from_ = nullptr;
  double s_limit_ = 0;
  double anchor_[2]{}, y_ = 0, y_error_ = 0, s_ = 0, s_error_ = 0;
};

}  // namespace lorentz
