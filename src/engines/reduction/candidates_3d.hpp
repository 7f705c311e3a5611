// The decisions of the search in 3D: is this ball met, and is it the first so far? Private to the reduction
// engine.
#pragma once

#include <algorithm>

#include "src/engines/reduction/atom_start.hpp"
#include "src/engines/reduction/found.hpp"
#include "src/engines/reduction/offset.hpp"
#include "src/engines/reduction/unrounded.hpp"
#include "src/engines/reduction/window_3d.hpp"

namespace lorentz {

template <class Arch, bool kUnit, bool kBall, class Integer>
class Candidates3 {
  using Window = Window3<Arch, kUnit, kBall, Integer>;

 public:
  enum class Look { missed, taken, beyond, doubtful };

  Found<3> found;

  const UnroundedLook<3, kUnit, kBall> unrounded;
  const Wide* from = nullptr;  ///< coefficients of the ball that is being left
  double s_limit = 0;          ///< balls that are entered after it may be ignored

  Candidates3(const Window& window, const UnroundedLook<3, kUnit, kBall>& unrounded)
      : unrounded(unrounded), window_(window) {}

  /// The place in the window beyond which nothing more is needed.
  double end() const { return window_.end_before(found.s); }

  Look look_at(const typename Window::Point& point) {
    double margin, spread, s, s_error;
    window_.set_across(point, margin, spread);
    const Decision meets = is_positive(margin, spread);
    if (meets == Decision::no) return Look::missed;
    window_.set_along(point, s, s_error);
    if (s < -s_error) return Look::missed;
    if (s - s_error > std::min(found.s + found.s_error, s_limit)) return Look::beyond;
    Wide N[3];
    if (!window_.cell_of(point, N)) return Look::doubtful;
    if (from && same(N, from)) return Look::missed;
    const double rho = window_.to.rho;
    if (meets == Decision::yes && s > s_error)
      return offer(N, s, s_error, margin * (rho * rho), 2 * spread * (rho * rho));
    return look_closely(N);
  }

  /// Is this ball certainly not met, whether ahead or behind?
  bool is_missed(const typename Window::Point& point) {
    Wide N[3];
    return window_.cell_of(point, N) && close_look(N).is_missed;
  }

  StableMeeting<SplitProduct, 3, kBall> meeting_at(const Wide (&N)[3]) const {
    Wide d[3];
    const double error = place_of<kUnit>(window_.lattice, window_.offset, N, d);
    return {window_.to.v, d, error, window_.lattice};
  }

  /// The slack of a ball.
  void set_slack(const Wide (&N)[3], double& slack, double& error) const {
    if constexpr (kUnit && kBall) {
      slack = close_slack(window_.to.v, N, window_.home(), window_.lattice.radius, error);
    } else {
      const auto meeting = meeting_at(N);
      slack = meeting.slack.hi, error = meeting.slack_error;
    }
  }

 private:
  Look offer(const Wide (&N)[3], double s, double s_error, double slack, double slack_error) {
    if (!(s + s_error < found.s - found.s_error)) return same(N, found.N) ? Look::missed : Look::doubtful;
    for (int i = 0; i < 3; ++i) found.N[i] = N[i];
    found.s = s, found.s_error = s_error, found.slack = slack, found.slack_error = slack_error;
    return Look::taken;
  }

  // Decided in double-double, or without rounding.
  CloseLook<SplitProduct> close_look(const Wide (&N)[3]) {
    found.needs(Stage::double_double);
    CloseLook<SplitProduct> close(meeting_at(N));
    if constexpr (kUnit && kBall)
      look_with_integers<3>(window_.to.v, N, window_.offset, window_.lattice.radius, close);
    unrounded.at(N, close);
    return close;
  }

  // The same decisions.
  [[gnu::noinline]] Look look_closely(const Wide (&N)[3]) {
    const CloseLook<SplitProduct> close = close_look(N);
    if (close.is_missed || (close.is_met && close.is_behind)) return Look::missed;
    if (!(close.is_met && close.is_ahead)) return Look::doubtful;
    return offer(N, close.s, close.s_error, close.slack, close.slack_error);
  }

  const Window& window_;
};

}  // namespace lorentz
