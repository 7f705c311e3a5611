// When an obstacle that was found is entered, for one flight: within a few ulps, or in double-double with a
// bound on the error. Private to the reduction engine.
#pragma once

#include "src/engines/reduction/one_flight.hpp"

namespace lorentz {

template <class Arch, int D, bool kUnit, bool kBall>
class EntryTime
    : public CloseTime<EntryTime<Arch, D, kUnit, kBall>, Arch, SplitProduct, D, kUnit, kBall, Wide, Vec> {
 public:
  EntryTime(const Bravais& lattice, const Offset<SplitProduct, D>& offset, const Wide (&N)[D],
            const Entry<SplitProduct, D, kBall>& entry, const Vec& v)
      : EntryTime::CloseTime(lattice, offset, N, entry, v) {}

  /// The time in double-double, and a bound on its error. Not inlined, because it would take its caller's
  /// registers.
  Wide rare(double& error) const {
    if constexpr (std::is_same_v<Arch, HardwareFma>)
      return rare_with_fma(error);
    else
      return rare_without_fma(error);
  }
  double rare_time() const {
    double error;
    return rare(error).value();
  }

 private:
  [[gnu::noinline, LORENTZ_WITH_FMA]] Wide rare_with_fma(double& error) const {
    return Wide(wide_in<HardwareFma>(error));
  }
  [[gnu::noinline]] Wide rare_without_fma(double& error) const { return wide_in<SplitProduct>(error); }

  template <class A>
  DoubleDouble<A> wide_in(double& error) const {
    DoubleDouble<A> d[D], N[D];
    for (int i = 0; i < D; ++i) N[i] = DoubleDouble<A>(this->N_[i]);
    const double d_error = place_of<kUnit>(this->lattice_, this->offset_, N, d);
    StableMeeting<A, D, kBall> meeting(this->v_, d, d_error, this->lattice_);
    if (!(meeting.slack.hi > meeting.slack_error))  // it was decided without rounding
      meeting.slack = DoubleDouble<A>(this->entry_.slack), meeting.slack_error = this->entry_.slack_error;
    return meeting.time(d, d_error, this->lattice_, error);
  }
};

}  // namespace lorentz
