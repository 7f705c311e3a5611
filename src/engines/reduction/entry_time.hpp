// When an obstacle that was found is entered: roughly, within a few ulps, or in double-double with a bound of
// the error. Private to the reduction engine.
#pragma once

#include <algorithm>
#include <type_traits>

#include "src/engines/reduction/offset.hpp"
#include "src/engines/reduction/stable_meeting.hpp"

namespace lorentz {

/// What the search leaves for the time: s = v . d, and the slack, whose root is half the chord q.
template <int D, bool kBall>
struct Entry {
  double s, s_error, slack, slack_error, v2;
  // Of ellipsoids: in 2D v.v, h skew, and the relative error of v2; in 3D the form that s is.
  double euclidean_v2, across, v2_error;
  Wide along[kBall || D == 2 ? 1 : D];

  /// The time in binary64 and the bound of its error.
  double rough_time(double& error) const {
    const double q = std::sqrt(slack);
    double relative = kRoughTime * kRoundoff;
    if constexpr (!kBall && D == 2) relative += v2_error;
    error = 2 * (s_error + slack_error / q) / v2 + relative * s / v2;
    return rough_time_of(s, q, v2);
  }
};

/// The time at which the obstacle of cell N is entered with velocity v.
template <class Arch, int D, bool kUnit, bool kBall>
class EntryTime {
  using DD = DoubleDouble<Arch>;

 public:
  EntryTime(const Bravais& lattice, const Offset<SplitProduct, D>& offset, const Wide (&N)[D],
            const Entry<D, kBall>& entry, const Vec& v)
      : lattice_(lattice), offset_(offset), N_(N), entry_(entry), v_(v) {}

  /// Within a few ulps.
  double close() const {
    if constexpr (kBall)
      return close_of_ball();
    else
      return close_of_ellipsoid();
  }

  /// In double-double, and the bound of its error.
  DD wide(double& error) const { return wide_in<Arch>(error); }

  /// The same bits, for where it is rarely asked: no part of its caller, whose registers it would take.
  Wide rare(double& error) const {
    if constexpr (std::is_same_v<Arch, HardwareFma>)
      return rare_with_fma(error);
    else
      return rare_without_fma(error);
  }

 private:
  [[gnu::noinline, LORENTZ_WITH_FMA]] Wide rare_with_fma(double& error) const {
    return Wide(wide_in<HardwareFma>(error));
  }
  [[gnu::noinline]] Wide rare_without_fma(double& error) const { return wide_in<SplitProduct>(error); }

  template <class A>
  DoubleDouble<A> wide_in(double& error) const {
    DoubleDouble<A> d[D], N[D];
    for (int i = 0; i < D; ++i) N[i] = DoubleDouble<A>(N_[i]);
    const double d_error = place_of<kUnit>(lattice_, offset_, N, d);
    const StableMeeting<A, D, kBall> meeting(v_, d, d_error, lattice_);
    return meeting.time(d, d_error, lattice_, error);
  }

  double close_of_ball() const {
    const double q = std::sqrt(entry_.slack), v2 = speed_squared(v_[0], v_[1], v_[2]);
    if (entry_.slack_error > kGrazing * kRoundoff * q * entry_.s) {  // a grazing hit nearby
      double error;
      return rare(error).value();
    }
    if (!(entry_.s > kNear * q)) return near_ball(q);
    double s = 0;
    for (int k = 0; k < D; ++k) s += v_[k] * distance(k);
    return (s - q) / v2;
  }

  // Nearby the difference would cancel: (s^2 - q^2) / (s + q), where s^2 - q^2 = v^2 (|d|^2 - r^2).
  double near_ball(double q) const {
    DD d[D], N[D];
    for (int i = 0; i < D; ++i) N[i] = DD(N_[i]);
    place_of<kUnit>(lattice_, offset_, N, d);
    double s = 0;
    DD gap = -DD::product(lattice_.radius, lattice_.radius);
    for (int k = 0; k < D; ++k) {
      const DD square = DD::product(d[k].hi, d[k].hi), sum = DD::sum(gap.hi, square.hi);
      gap = DD(sum.hi, sum.lo + (gap.lo + square.lo + 2 * d[k].hi * d[k].lo));
      s += v_[k] * d[k].hi;
    }
    return std::max(gap.value(), 0.0) / (s + q);
  }

  // The terms of along . d are larger than their sum. In 2D it is ((v . d) v2 + h skew) / v.v, and h is
  // known; in 3D it is computed in double-double. Nearby s - q would cancel: then t = (d . G d - r^2) / (s +
  // q). In 3D the bound of the slack is so large that what is near has gone to the second stage before.
  double close_of_ellipsoid() const {
    const double q = std::sqrt(entry_.slack), condition = lattice_.shape.condition;
    double error;
    // What the last bits of h do to the time of a slender one is more than some ulps.
    if (condition > kSlender) return std::max(wide(error).value(), 0.0);
    const double unsure =
        (kGrazing + kGrazingOfShape * condition) * kRoundoff;  // bounds are larger by so much
    if (entry_.slack_error > unsure * q * entry_.s) return rare(error).value();
    if constexpr (D == 2) {
      const double v2 = entry_.v2, euclidean_v2 = entry_.euclidean_v2, across = entry_.across;
      const double along = v_[0] * distance(0) + v_[1] * distance(1);
      if (!(entry_.s > kNear * q)) return close_gap() / ((along * v2 + across) / euclidean_v2 + q);
      return along / euclidean_v2 + (across - q * euclidean_v2) / (euclidean_v2 * v2);
    } else {
      DD d[D];
      place(d);
      return std::max((close_product(entry_.along, d).hi - q) / entry_.v2, 0.0);
    }
  }

  // The obstacle's place seen from x, to some squares of the roundoff of the terms: place_of in fewer
  // operations.
  void place(DD (&d)[D]) const {
    for (int k = 0; k < D; ++k) {
      if constexpr (kUnit) {
        d[k] = DD::sum(N_[k].hi, offset_.d[k].hi);
        d[k].lo += N_[k].lo;
        continue;
      }
      DD sum(offset_.d[k]);
      double low = 0;
      for (int i = 0; i < D; ++i) {
        sum = add_product(sum, DD(lattice_.basis[i][k]), N_[i].hi);
        low += lattice_.basis[i][k].hi * N_[i].lo;
      }
      d[k] = DD(sum.hi, sum.lo + low);
    }
  }

  // a . d, to some roundoffs of the result and some squares of the terms.
  template <class A>
  static DD close_product(const A& a, const DD (&d)[D]) {
    DD sum(0.0);
    double low = 0;
    for (int k = 0; k < D; ++k) {
      sum = add_product(sum, DD(a[k]), d[k].hi);
      low += a[k].hi * d[k].lo;
    }
    return DD::sum(sum.hi, sum.lo + low);
  }

  // d . G d - r^2, at least 0.
  double close_gap() const {
    DD d[D], image[D];
    place(d);
    for (int i = 0; i < D; ++i) image[i] = close_product(lattice_.shape.metric[i], d);
    const DD square = close_product(image, d), limit = DD::product(lattice_.radius, lattice_.radius);
    return std::max((square.hi - limit.hi) + (square.lo - limit.lo), 0.0);
  }

  // Component k of the obstacle's place seen from x, to some ulps of |d|.
  double distance(int k) const {
    if constexpr (kUnit) return N_[k].hi + offset_.d[k].hi;
    double d = offset_.d[k].hi;
    for (int i = 0; i < D; ++i) d += lattice_.basis[i][k].hi * N_[i].hi;
    return d;
  }

  const Bravais& lattice_;
  const Offset<SplitProduct, D>& offset_;
  const Wide (&N_)[D];
  const Entry<D, kBall>& entry_;
  const Vec& v_;
};

}  // namespace lorentz
