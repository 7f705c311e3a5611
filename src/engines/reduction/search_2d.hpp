// The search for the first ball along a prepared direction, in 2D (direction_2d-inl.hpp says how). Private to
// the reduction engine.
#pragma once

#include <algorithm>

#include "src/engines/reduction/atom_start.hpp"
#include "src/engines/reduction/found.hpp"
#include "src/engines/reduction/one_flight.hpp"
#include "src/engines/reduction/predicates.hpp"
#include "src/engines/reduction/unrounded.hpp"

namespace lorentz {

/// The search for one start.
template <class Arch, bool kUnit, bool kBall>
class Search2 : RowsOf2<Arch, SplitProduct, kUnit, kBall> {
  using Rows = RowsOf2<Arch, SplitProduct, kUnit, kBall>;
  using Rows::to_;

 public:
  Search2(const Bravais& lattice, const Direction2<SplitProduct, kUnit, kBall>& direction,
          const Offset<SplitProduct, 2>& offset, const UnroundedLook<2, kUnit, kBall>& unrounded)
      : Rows(direction, lattice, offset), unrounded_(unrounded) {}

  Found<2> found;

  /// `from`: coefficients of the ball that is being left, or null. Balls that are entered after s_limit may
  /// be ignored. `never`: nothing is entered before s_limit; or the rows are exactly parallel to the line,
  /// and all were passed.
  Outcome run(const Wide* from, double s_limit) {
    from_ = from;
    s_limit_ = s_limit;
    if (!to_.usable || !this->set_anchor(true)) return found.give_up();
    const double nu = this->row_beside_start(), reach = this->reach_of_rows();
    if (!(std::fabs(nu) + reach < kMaxCoefficient)) return found.give_up();
    const double slope = this->slope_of_rows();
    double n = std::ceil(nu - reach);
    for (int row = 0; row < kMaxRows; ++row, ++n) {
      double last = nu + reach;
      if (to_.rises) last += std::min(found.s, s_limit) * slope;
      if (!(n <= last)) return found.outcome();
      if (!look_in_row(n)) return found.give_up();
      if (found.any() && this->are_in_order()) return found.outcome();
    }
    return found.give_up();
  }

 private:
  // Takes the first ball of row n that is met ahead, if it comes before the best so far. False: undecided.
  bool look_in_row(double n) {
    double unsure;
    const double m = this->start_of_row(n, unsure);
    if (unsure > kMaxUnsure) return look_closely_in_row(n);
    return look_from(n, std::ceil(m - unsure));
  }

  // Looks at the balls of row n from m on, until one is met or the row has left the strip.
  bool look_from(double n, double m) {
    for (int step = 0; step < kMaxCandidatesInRow; ++step) {
      const Look2 look = look_at(n, m + step);
      if (look == Look2::doubtful) return false;
      if (look != Look2::before) return true;
    }
    return false;
  }

  enum class Look2 { before, taken, beyond, doubtful };

  // Looks at the ball n R + m L: is it before the strip or behind the start, met, or beyond the strip?
  Look2 look_at(double n, double m) {
    const auto ball = this->ball_at(n, m);
    const Decision meets = is_below(ball.h, to_.rho, ball.error, to_.rho_error());
    if (meets == Decision::no) return ball.h < 0 || !to_.rises ? Look2::beyond : Look2::before;
    if (ball.s < -ball.s_error) return Look2::before;
    if (ball.s - ball.s_error > std::min(found.s + found.s_error, s_limit_)) return Look2::beyond;
    double N[2];
    if (!this->name_ball(n, m, N)) return look_far(n, m, ball.h);
    if (from_ && N[0] == from_[0].hi && N[1] == from_[1].hi && from_[0].lo == 0 && from_[1].lo == 0)
      return Look2::before;
    if (meets == Decision::yes && ball.s > ball.s_error)
      return offer(N, ball.s, ball.s_error, this->slack_of(ball), this->slack_error_of(ball), ball.h);
    return look_closely(N, ball.h);
  }

  // A ball with coefficients that need double-double.
  [[gnu::noinline]] Look2 look_far(double n, double m, double h) {
    Wide N[2];
    bool held = std::fabs(n) < kMaxCoefficient && std::fabs(m) < kMaxCoefficient;
    for (int i = 0; i < 2; ++i) {
      N[i] = Wide(this->anchor_[i]) + Wide::product(n, to_.R.n[i]) + Wide::product(m, to_.L.n[i]);
      held &= std::fabs(to_.R.n[i]) < kMaxCoefficient && std::fabs(N[i].hi) < kMaxCell;
    }
    return !held ? Look2::doubtful : from_ && same(N, from_) ? Look2::before : look_closely(N, h);
  }

  template <class Integer>
  Look2 offer(const Integer (&N)[2], double s, double s_error, double slack, double slack_error, double h) {
    if (!(s + s_error < found.s - found.s_error)) return Look2::doubtful;
    found.N[0] = Wide(N[0]), found.N[1] = Wide(N[1]);
    found.s = s, found.s_error = s_error, found.slack = slack, found.slack_error = slack_error;
    if constexpr (!kBall) found.h = to_.sigma * h;
    return Look2::taken;
  }

  // The same decisions in double-double, or without rounding.
  template <class Integer>
  [[gnu::noinline]] Look2 look_closely(const Integer (&N)[2], double h) {
    found.needs(Stage::double_double);
    auto ball = Rows::look_closely(N);
    const Wide cell[2] = {Wide(N[0]), Wide(N[1])};
    if constexpr (kUnit && kBall)
      look_with_integers<2>(to_.v, cell, this->offset_, this->lattice_.radius, ball);
    unrounded_.at(cell, ball);
    if (ball.is_missed) return h < 0 || !to_.rises ? Look2::beyond : Look2::before;
    if (!ball.is_met) return Look2::doubtful;
    if (ball.is_behind) return Look2::before;
    if (!ball.is_ahead) return Look2::doubtful;
    return offer(N, ball.s, ball.s_error, ball.slack, ball.slack_error, h);
  }

  // For a row nearly parallel to the line, for which binary64 cannot tell at which m it enters the strip.
  [[gnu::noinline]] bool look_closely_in_row(double n) {
    found.needs(Stage::double_double);
    double m;
    return this->start_of_level_row(n, true, m) && look_from(n, m);
  }

  const UnroundedLook<2, kUnit, kBall> unrounded_;
  const Wide* from_ = nullptr;
  double s_limit_ = 0;
};

}  // namespace lorentz
