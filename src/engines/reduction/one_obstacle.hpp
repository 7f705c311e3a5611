// One obstacle on the line of flight. Private to the reduction engine.
#pragma once

#include <algorithm>

#include "src/engines/reduction/atom_start.hpp"
#include "src/engines/reduction/found.hpp"
#include "src/engines/reduction/one_flight.hpp"

namespace lorentz {

enum class Look { met, missed, behind, doubtful };

/// Is the obstacle of cell N at d, whose components err by at most `error`, entered ahead? If so, or if that is
/// doubtful, `found` gets everything but its cell.
template <int D, bool kBall>
[[gnu::noinline]] Look look_closely_at(const Wide (&d)[D], double error, const Wide (&N)[D],
                                       const Bravais& obstacle, const Vec& v,
                                       const UnroundedLook<D, false, kBall>& unrounded, Found<D>& found) {
  found.needs(Stage::double_double);
  const auto decide = [&](const auto& meeting) {
    CloseLook<SplitProduct> close(meeting);
    unrounded.at(N, close);
    if (close.is_missed) return Look::missed;
    if (close.is_met && close.is_behind) return Look::behind;
    found.s = close.s, found.s_error = close.s_error;
    found.slack = close.slack, found.slack_error = close.slack_error;
    if constexpr (D == 2) found.h = difference_of_products(d[1], v[0], d[0], v[1]).hi;
    return close.is_met && close.is_ahead ? Look::met : Look::doubtful;
  };
  return decide(StableMeeting<SplitProduct, D, kBall>(v, d, error, obstacle));
}

/// The same. A ball is decided in binary64 if that is certain; otherwise, and for an ellipsoid, in
/// double-double. v2 = |v|^2.
template <int D, bool kBall>
inline Look look_at(const Wide (&d)[D], double error, const Wide (&N)[D], const Bravais& obstacle,
                    const Vec& v, double v2, const UnroundedLook<D, false, kBall>& unrounded,
                    Found<D>& found) {
  if constexpr (kBall) {
    double velocity[D];
    std::copy_n(v.begin(), D, velocity);
    const LoneBall<SplitProduct, D> ball(velocity, d, error, v2, obstacle.radius);
    if (ball.is_missed()) return Look::missed;
    if (ball.is_behind()) return Look::behind;
    found.s = ball.s, found.s_error = ball.s_error;
    found.slack = ball.slack, found.slack_error = ball.slack_error;
    if (ball.is_met() && ball.is_ahead()) return Look::met;
  }
  return look_closely_at<D, kBall>(d, error, N, obstacle, v, unrounded, found);
}

}  // namespace lorentz
