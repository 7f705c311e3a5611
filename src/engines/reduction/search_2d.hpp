// The search for the first ball along a prepared direction, in 2D (direction_2d.hpp says how). Private to the
// reduction engine.
#pragma once

#include <algorithm>

#include "src/engines/reduction/direction_2d.hpp"
#include "src/engines/reduction/found.hpp"
#include "src/engines/reduction/stable_meeting.hpp"

namespace lorentz {

/// The search for one start.
template <class Arch, bool kUnit, bool kBall>
class Search2 {
  using DD = DoubleDouble<Arch>;

 public:
  Search2(const Bravais& lattice, const Direction2<SplitProduct, kUnit, kBall>& direction,
          const Offset<SplitProduct, 2>& offset)
      : lattice_(lattice), to_(direction), offset_(offset) {}

  Found<2> found;

  /// `from`: coefficients of the ball that is being left, or null. Balls that are entered after s_limit may
  /// be ignored.
  Outcome run(const Wide* from, double s_limit) {
    from_ = from;
    s_limit_ = s_limit;
    if (!to_.usable || !set_anchor()) return give_up();
    const auto &R = to_.R, &L = to_.L;
    const double nu = row_number(L.S, y_, L.D, s_, to_.inverse_A), reach = reach_of_rows();
    if (!(std::fabs(nu) + reach < kMaxCoefficient)) return give_up();
    const double slope = row_slope(kUnit ? L.D : (L.D + L.D_error) * (1 + kRowSlope), to_.inverse_A);
    double n = std::ceil(nu - reach);
    for (int row = 0; row < kMaxRows; ++row, ++n) {
      double last = nu + reach;
      if (L.D > 0) last += std::min(found.s, s_limit) * slope;
      if (!(n <= last)) return outcome();
      if (!look_in_row(n)) return give_up();
      if (found.any() && R.D > 2 * to_.rho * (1 + kSlop2d) + (kUnit ? 0 : R.D_error) && (kBall || R.S >= 0))
        return outcome();  // rows come one after the other
    }
    return give_up();
  }

 private:
  // Never: nothing before s_limit; or the rows are exactly parallel to the line, and were all passed.
  Outcome outcome() const { return found.any() ? Outcome::hit : Outcome::never; }

  Outcome give_up() {
    found.stage = Stage::undecided;
    return Outcome::undecided;
  }

  // Rows in the strip beside the start: within this of nu, which errs, too. On the unit lattices D_R >= 2
  // rho, so the terms of nu are below 2^20, and kRowSlop is enough; among tiny balls they are about 1, and
  // what y errs by counts. On other lattices the terms are what they are.
  double reach_of_rows() const {
    constexpr double kRows = kRowNumber * kRoundoff;
    const auto& L = to_.L;
    if constexpr (kUnit && kBall) return kRowSlop + L.S * (to_.rho + anchor_error_) * to_.inverse_A;
    const double height = to_.rho + kRows * (std::fabs(y_) + to_.rho) + y_error_,
                 along = kRows * std::fabs(s_) + s_error_;
    return kRowSlop + (L.S * height + L.D * along) * to_.inverse_A;
  }

  // Heights and positions are counted from the ball of the home cell; but among tiny balls from the lattice
  // point nearest to the start in the coordinates of R and L, since the home cell's are so large that their
  // products leave the exact integers, and multiply what errors D_R and D_L have.
  bool set_anchor() {
    const auto &R = to_.R, &L = to_.L;
    const DD h = height_of_home();
    const double size = std::fabs(offset_.d[0].hi) + std::fabs(offset_.d[1].hi);
    y_ = to_.sigma * h.hi;
    y_error_ = kRoundoff * std::fabs(y_) + kForm * offset_.error + kAnchorTerms * size + kFlushed;
    s_ = sum_of_products(to_.along(0), offset_.d[0].hi, to_.along(1), offset_.d[1].hi);
    s_error_ = kAlong * kRoundoff * size + kForm * offset_.error;
    if constexpr (!kBall)
      s_error_ = to_.shape.along_error * size +
                 kForm * offset_.error * (std::fabs(to_.along(0)) + std::fabs(to_.along(1)));
    if (to_.rho > kRhoOfAnchor) return true;
    const double n = std::nearbyint(row_number(L.S, y_, L.D, s_, to_.inverse_A));
    const double m = std::nearbyint((R.S * y_ - R.D * s_) * to_.inverse_A);
    double terms = 0, along = 0;
    for (int i = 0; i < 2; ++i) {
      const DD sum =
          DD::product(n, R.n[i]) + DD::product(m, L.n[i]);  // large terms, but what they leave is not
      if (!(std::fabs(sum.hi) < kMaxCoefficient && std::fabs(n) < kMaxCoefficient &&
            std::fabs(m) < kMaxCoefficient))
        return false;
      anchor_[i] = sum.hi;
      terms += std::fabs(anchor_[i]) * to_.H_size[i];
      if constexpr (kBall)
        along += std::fabs(anchor_[i] * to_.S[i]);
      else
        s_error_ += to_.shape.along_error * std::fabs(anchor_[i]) * to_.size_of[i];
    }
    y_ = to_.sigma * compensated_height<!kUnit>(h, anchor_, to_.H);
    y_error_ += kAnchor * kRoundoff * std::fabs(y_) + kAnchorTerms * terms;
    anchor_error_ = y_error_;
    s_ += sum_of_products(anchor_[0], to_.S[0], anchor_[1], to_.S[1]);
    s_error_ += kAlong * kRoundoff * along;
    return true;
  }

  DD height_of_home() const {
    if constexpr (kUnit)
      return add_product(DD::product(offset_.d[1].hi, to_.v[0]), offset_.d[0].hi, -to_.v[1]);
    else
      return add_product(first_product(DD(offset_.d[1]), to_.v[0]), DD(offset_.d[0]), -to_.v[1]);
  }

  // The first ball of row n that is met ahead, if it comes before the best so far. False: undecided.
  bool look_in_row(double n) {
    const auto &R = to_.R, &L = to_.L;
    const double y = y_ + n * R.D, rho = to_.rho;
    double m = passing_of_row(s_, n, R.S, to_.inverse_S_L);
    double unsure = kSlop2d;
    if (L.D > 0) {
      m = std::max(m, entry_of_row(y, rho, to_.inverse_D_L));
      unsure +=
          (kRowEntry * kRoundoff * (std::fabs(y) + std::fabs(n * R.D) + rho) + y_error_) * to_.inverse_D_L;
      if constexpr (!kUnit) unsure += (std::fabs(n) * R.D_error + std::fabs(m) * L.D_error) * to_.inverse_D_L;
    }
    if (unsure > kMaxUnsure) return look_closely_in_row(n);
    return look_from(n, std::ceil(m - unsure));
  }

  // The balls of row n from m on, until one is met or the row has left the strip.
  bool look_from(double n, double m) {
    for (int step = 0; step < kMaxCandidatesInRow; ++step) {
      const Look2 look = look_at(n, m + step);
      if (look == Look2::doubtful) return false;
      if (look != Look2::before) return true;
    }
    return false;
  }

  enum class Look2 { before, taken, beyond, doubtful };

  // The ball at n R + m L: before the strip or behind the start, met, or beyond the strip.
  Look2 look_at(double n, double m) {
    const auto &R = to_.R, &L = to_.L;
    const double h = height_in_row(y_, n, R.D, m, L.D);
    double error = kHeight * kRoundoff * (std::fabs(y_) + std::fabs(n * R.D) + std::fabs(m * L.D)) + y_error_;
    if constexpr (!kUnit) error = error + std::fabs(n) * R.D_error + std::fabs(m) * L.D_error;
    const double s = sum_along(s_, n, R.S, m, L.S);
    double s_error = s_error_ + kAlong * kRoundoff * (std::fabs(n * R.S) + std::fabs(m * L.S));
    if constexpr (!kBall) s_error += std::fabs(n) * R.S_error + std::fabs(m) * L.S_error;
    const Decision meets = is_below(h, to_.rho, error, to_.rho_error());
    if (meets == Decision::no) return h < 0 || L.D == 0 ? Look2::beyond : Look2::before;
    if (s < -s_error) return Look2::before;
    if (s - s_error > std::min(found.s + found.s_error, s_limit_)) return Look2::beyond;
    double N[2] = {anchor_[0] + n * R.n[0] + m * L.n[0], anchor_[1] + n * R.n[1] + m * L.n[1]};
    for (int i = 0; i < 2; ++i)
      if (!(std::fabs(N[i]) < kMaxCoefficient && std::fabs(n * R.n[i]) < kMaxCoefficient &&
            std::fabs(m * L.n[i]) < kMaxCoefficient))
        return Look2::doubtful;
    if (from_ && N[0] == from_[0].hi && N[1] == from_[1].hi && from_[0].lo == 0 && from_[1].lo == 0)
      return Look2::before;
    if (meets == Decision::yes && s > s_error)
      return offer(N, s, s_error, to_.slack_scale() * ((to_.rho - h) * (to_.rho + h)),
                   to_.slack_scale() * (4 * to_.rho * (error + to_.rho_error() * to_.rho)), h);
    return look_closely(N, h);
  }

  Look2 offer(const double* N, double s, double s_error, double slack, double slack_error, double h) {
    if (!(s + s_error < found.s - found.s_error)) return Look2::doubtful;
    found.N[0] = Wide(N[0]), found.N[1] = Wide(N[1]);
    found.s = s, found.s_error = s_error, found.slack = slack, found.slack_error = slack_error;
    if constexpr (!kBall) found.h = to_.sigma * h;
    return Look2::taken;
  }

  // The same decisions in double-double.
  [[gnu::noinline]] Look2 look_closely(const double* N, double h) {
    found.needs(Stage::double_double);
    const Wide wide_N[2] = {N[0], N[1]};
    Wide d[2];
    const double error = place_of<kUnit>(lattice_, offset_, wide_N, d);
    const StableMeeting<SplitProduct, 2, kBall> meeting(to_.v, d, error, lattice_);
    const Decision meets = lorentz::meets(meeting);
    if (meets == Decision::doubtful) return Look2::doubtful;
    if (meets == Decision::no) return h < 0 || to_.L.D == 0 ? Look2::beyond : Look2::before;
    const Decision ahead = is_ahead(meeting);
    if (ahead == Decision::doubtful) return Look2::doubtful;
    if (ahead == Decision::no) return Look2::before;
    return offer(N, meeting.s.hi, meeting.s_error + kRoundoff * meeting.s.hi, meeting.slack.hi,
                 meeting.slack_error + kRoundoff * meeting.slack.hi, h);
  }

  // A row nearly parallel to the line, where binary64 cannot tell at which m it enters the strip.
  [[gnu::noinline]] bool look_closely_in_row(double n) {
    const auto &R = to_.R, &L = to_.L;
    found.needs(Stage::double_double);
    double N[2];
    for (int i = 0; i < 2; ++i) {
      N[i] = anchor_[i] + n * R.n[i];
      if (!(std::fabs(n * R.n[i]) < kMaxCoefficient && std::fabs(N[i]) < kMaxCoefficient)) return false;
    }
    const Wide wide_N[2] = {N[0], N[1]};
    Wide d[2];
    const double error = place_of<kUnit>(lattice_, offset_, wide_N, d);
    const StableMeeting<SplitProduct, 2, kBall> start(to_.v, d, error, lattice_);
    const Wide h = difference_of_products(d[1], to_.v[0], d[0], to_.v[1]) * to_.sigma;
    Wide rho = Wide(lattice_.radius) * sqrt(start.v2);
    if constexpr (!kBall) {
      const Wide& scale = lattice_.shape.wide_cofactor[2][2];
      rho = rho / (scale.hi < 0 ? -scale : scale);
    }
    const Wide m = (h - rho) / Wide(L.D, L.D_low);
    const double unsure =
        (start.across_error + kStable * (std::fabs(h.hi) + rho.hi) + std::fabs(m.hi) * L.D_error) / L.D +
        kStable * std::fabs(m.hi) + kSlop2d;
    if (!(unsure < kMaxUnsure)) return false;
    const double first = std::max(std::ceil(m.value() - unsure),
                                  std::ceil(passing_of_row(s_, n, R.S, to_.inverse_S_L) - kSlop2d));
    return std::fabs(first) < kMaxCoefficient && look_from(n, first);
  }

  const Bravais& lattice_;
  const Direction2<SplitProduct, kUnit, kBall>& to_;
  const Offset<SplitProduct, 2>& offset_;
  const Wide* from_ = nullptr;
  double s_limit_ = 0;
  double anchor_[2]{}, anchor_error_ = 0;  // of an anchor that is not the home cell
  double y_ = 0, y_error_ = 0, s_ = 0, s_error_ = 0;
};

}  // namespace lorentz
