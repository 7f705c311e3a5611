// The search for the first ball along a prepared direction, in 3D (direction_3d.hpp says how). Private to the
// reduction engine.
#pragma once

#include <algorithm>
#include <limits>

#include "src/engines/reduction/direction_3d.hpp"
#include "src/engines/reduction/encounter.hpp"

namespace lorentz {

/// The search for one start.
template <class Arch, bool kUnit, bool kBall>
class Search3 {
  using DD = DoubleDouble<Arch>;

 public:
  Search3(const Bravais& lattice, const Direction3<kUnit, kBall>& direction, const Offset<3>& offset)
      : lattice_(lattice), to_(direction), offset_(offset), basis_(&direction.basis) {}

  Stage stage = Stage::binary64;
  Wide best[3];  ///< coefficients of the ball found, from the home cell, in the short basis
  double best_s = kNothing, best_slack = 0, best_s_error = 0, best_slack_error = 0;

  /// `from`: coefficients of the ball that is being left, or null. Entered after s_limit: need not be found.
  Outcome run(const Wide* from, double s_limit) {
    from_ = from;
    s_limit_ = s_limit;
    set_start();
    for (int window = 0; window < kMaxWindows; ++window) {
      if (!basis_->usable || !set_anchor()) return give_up();
      no_plane_met_ = true;
      if (!scan_window()) return give_up();
      if (best_s < kNothing) return Outcome::hit;
      advance();
      if (begin_ > s_limit_ || begin_ > 2 * period()) return Outcome::never;
      if (!(begin_ < kFarthest)) return give_up();
      if (window >= 1) lengthen(kLonger);
    }
    return give_up();
  }

 private:
  static constexpr double kNothing = std::numeric_limits<double>::infinity();

  /// A lattice point relative to the anchor; `size` and `extent`: of the terms that p and z were summed from.
  struct Point {
    double n[3]{};
    double p[2]{};
    double z = 0, size = 0, extent = 0;

    Point() = default;
    Point(const Point& base, double k, const Arm3& arm) {
      for (int i = 0; i < 3; ++i) n[i] = base.n[i] + k * arm.n[i];
      const double step[2] = {k * arm.p[0], k * arm.p[1]};
      for (int i = 0; i < 2; ++i) p[i] = stepped(base.p[i], k, arm.p[i]);
      z = stepped(base.z, k, arm.z);
      size = base.size + std::fabs(step[0]) + std::fabs(step[1]) + std::fabs(k) * arm.floor;
      extent = base.extent + std::fabs(k * arm.z);
    }
  };

  Outcome give_up() {
    stage = Stage::undecided;
    return Outcome::undecided;
  }

  void set_start() {
    to_.template forms_of<Arch>(offset_.d, start_);
    for (const Wide& component : offset_.d) start_size_ += std::fabs(component.hi);
  }

  // A lattice point near the middle of the window; all others are counted from it, in small numbers.
  bool set_anchor() {
    for (Wide& n : anchor_) n = Wide();
    for (int i = 0; i < 2; ++i) anchor_point_.p[i] = to_.scale[i] * start_[i].hi;
    anchor_point_.z = (start_[2].hi - begin_) / basis_->length;
    for (int pass = 0; pass < kMaxAnchorPasses; ++pass) {
      double k[3], largest = 0;
      for (int i = 0; i < 3; ++i) {
        const auto& g = basis_->dual[i];
        k[i] = -std::nearbyint(sum_of_products(g[0], anchor_point_.p[0], g[1], anchor_point_.p[1], g[2],
                                               anchor_point_.z - kMiddle));
        largest = std::max(largest, std::fabs(k[i]));
      }
      if (!(largest < kMaxAnchorStep)) return false;
      move_anchor(k);
      anchor_point_ = at(anchor_);
      if (largest < kNearAnchor) break;
      if (pass == kMaxAnchorPasses - 1) return false;
    }
    double terms = start_size_;
    for (int j = 0; j < 3; ++j) {
      if (!(std::fabs(anchor_[j].hi) < kMaxCell)) return false;
      terms += std::fabs(anchor_[j].hi) * to_.size_of[j];
    }
    const double error = kForm * (kAnchorTerms * terms + offset_.error) + kFlushed;
    p_error_ = error * to_.inverse_r;
    s_error_ = to_.along_size * error + kRoundoff * begin_;
    if constexpr (!kBall) s_error_ += kForm * lattice_.shape.metric_error * terms;
    z_error_ = s_error_ / basis_->length;
    z_first_ = -(2 * z_error_ + kWindowStart);
    return p_error_ < kSlop3d / 2;
  }

  // By integers, exactly if they are below 2^53; beyond, whatever the rounding makes of them is a lattice
  // point too.
  void move_anchor(const double (&k)[3]) {
    for (int j = 0; j < 3; ++j) {
      double sum = anchor_[j].hi, size = std::fabs(sum);
      for (int i = 0; i < 3; ++i) {
        const double step = k[i] * basis_->b[i].n[j];
        sum += step, size += std::fabs(step);
      }
      if (size < kMaxCoefficient && anchor_[j].lo == 0) {
        anchor_[j] = Wide(sum);
        continue;
      }
      for (int i = 0; i < 3; ++i) anchor_[j] = anchor_[j] + Wide::product(k[i], basis_->b[i].n[j]);
    }
  }

  Point at(const Wide (&N)[3]) const {
    Point point;
    for (int i = 0; i < 2; ++i) point.p[i] = to_.scale[i] * compensated_sum<DD>(to_.form[i], N, start_[i]);
    point.z = compensated_sum<DD>(to_.form[2], N, start_[2] - Wide(begin_)) / basis_->length;
    point.size = std::fabs(point.p[0]) + std::fabs(point.p[1]);
    point.extent = std::fabs(point.z);
    return point;
  }

  // To the next window: right behind this one, or where the next lattice plane comes within r of the line.
  void advance() {
    const Basis3& basis = *basis_;
    double step = 1;
    if (no_plane_met_) {
      const double tilt = basis.dual[2][2], kappa = plane_of(anchor_point_);
      const double steepest = std::fabs(tilt) + basis.tilt_error;
      // Planes at k + kappa - tilt z = 0 on the line; how far the nearest one ahead has to come.
      const auto gap_above = [&](double here) { return std::ceil(here + basis.g) - here - basis.g; };
      const double up = gap_above(tilt - kappa), down = gap_above(kappa - tilt);
      // Of a tilt that is below its error not even the sign is known.
      const double gap = std::fabs(tilt) <= basis.tilt_error ? std::min(up, down) : tilt > 0 ? up : down;
      const double jump = 1 + (gap - kSlop3d) / steepest;
      step = std::min(std::max(step, jump), kMaxJump);
    }
    const double next = begin_ + step * (1 - kSlop3d) * basis.length;
    begin_ =
        std::max(begin_, next - kNextWindow * kRoundoff * next);  // rounded down: no gap between the windows
  }

  // What lies on the line repeats after this: v . b of a lattice vector b that is exactly parallel to it.
  double period() const {
    for (const Arm3& arm : basis_->b)
      if (arm.p[0] == 0 && arm.p[1] == 0 && is_parallel(lattice_, to_.v, arm.n))
        return arm.z * basis_->length;
    return kNothing;
  }

  void lengthen(double factor) {
    if (basis_ != &longer_) longer_ = *basis_;
    to_.template lengthen<Arch>(longer_, factor);
    basis_ = &longer_;
  }

  double plane_of(const Point& point) const {
    const auto& g = basis_->dual[2];
    return sum_of_products(g[0], point.p[0], g[1], point.p[1], g[2], point.z);
  }

  // Can one count from low to high by ones?
  static bool are_countable(double low, double high) {
    return std::fabs(low) < kMaxCoefficient && std::fabs(high) < kMaxCoefficient;
  }

  double end() const { return std::min(1.0, (best_s - begin_) / basis_->length) + kSlop3d + 2 * z_error_; }

  // The planes k b_2 + (b_0, b_1) that meet the window.
  bool scan_window() {
    const Basis3& basis = *basis_;
    const double kappa = plane_of(anchor_point_), tilt = basis.dual[2][2];
    const double low = std::min(0.0, tilt) - basis.g - kappa - kSlop3d,
                 high = std::max(0.0, tilt) + basis.g - kappa + kSlop3d;
    if (!are_countable(low, high)) return false;
    for (double k = std::ceil(low); k <= high; ++k) {
      const Point point(anchor_point_, k, basis.b[2]);
      if (!scan_plane(point, kappa + k)) return false;
    }
    return true;
  }

  // By how much xi, where the line passes the plane of this point, may be off. A plane that the line passes
  // at nearly the radius leaves a section of the half width sqrt(1 - xi^2), whose square is off by twice
  // that: more than all of it, when the section is thin.
  double xi_error(const Point& point) const {
    const Basis3& basis = *basis_;
    const auto& g = basis.dual[2];
    const double terms =
        1 + std::max(std::fabs(g[0]), std::fabs(g[1])) * point.size + std::fabs(g[2]) * point.extent;
    return p_error_ + to_.scale_error +
           basis.inverse_g *
               (basis.tilt_error + std::fabs(g[2]) * s_error_ / basis.length + kPlane * kRoundoff * terms);
  }

  // The lines of a plane: in the coordinates xi (along e), eta (across e), z the plane is g xi + tilt z =
  // kappa.
  bool scan_plane(const Point& point, double kappa) {
    const Basis3& basis = *basis_;
    const double tilt = basis.dual[2][2];
    double z_first = z_first_, z_last = end();
    const double at_first = kappa - tilt * z_first, at_last = kappa - tilt * z_last,
                 g = basis.g * (1 + kSlop3d);
    if (std::fabs(at_first) > g || std::fabs(at_last) > g) {  // the section ends within the window
      if ((at_first > g && at_last > g) || (at_first < -g && at_last < -g)) return true;
      const double one = (kappa - g) / tilt, other = (kappa + g) / tilt;
      z_first = std::max(z_first, std::min(one, other) - kSlop3d);
      z_last = std::min(z_last, std::max(one, other) + kSlop3d);
      if (z_first > z_last) return true;
    }
    no_plane_met_ = false;
    const double xi_first = distance_of_plane(kappa, tilt, z_first, basis.inverse_g),
                 xi_last = distance_of_plane(kappa, tilt, z_last, basis.inverse_g);
    double nearest = 0;
    if (xi_first * xi_last > 0) nearest = std::min(std::fabs(xi_first), std::fabs(xi_last));
    const double eta = std::sqrt(std::max(0.0, 1 - nearest * nearest) + 2 * xi_error(point)) + kSlop3d;
    const auto& g1 = basis.dual[1];
    const double a = basis.g1_e * xi_first + g1[2] * z_first, b = basis.g1_e * xi_last + g1[2] * z_last;
    const double here = g1[0] * point.p[0] + g1[1] * point.p[1] + g1[2] * point.z,
                 half = std::fabs(basis.g1_f) * eta;
    const double spread = kSlop3d * (1 + std::fabs(basis.g1_e) + std::fabs(g1[2]));
    const double low = std::ceil(std::min(a, b) - half - here - spread),
                 high = std::max(a, b) + half - here + spread;
    if (!are_countable(low, high)) return false;
    if (high - low > kManyLines) return scan_plane_finely(point, z_first, z_last, kappa);
    for (double k = low; k <= high; ++k)
      if (!scan_line(Point(point, k, basis.b[1]), basis.b[0], z_first, z_last)) return false;
    return true;
  }

  // A long, thin section: the first ball in an ellipse of a 2D lattice. Parts of it, short at first and then
  // twice as long each, with a basis of the plane that is short in the metric of the part.
  [[gnu::noinline]] bool scan_plane_finely(const Point& in_plane, double z_first, double z_last,
                                           double kappa) {
    const Basis3& basis = *basis_;
    const double tilt = basis.dual[2][2];
    const double unsure = 2 * xi_error(in_plane);
    const auto half_width = [&](double z1, double z2) {
      const double xi_1 = distance_of_plane(kappa, tilt, z1, basis.inverse_g),
                   xi_2 = distance_of_plane(kappa, tilt, z2, basis.inverse_g);
      const double nearest = xi_1 * xi_2 > 0 ? std::min(std::fabs(xi_1), std::fabs(xi_2)) : 0;
      return std::sqrt(std::max(0.0, (1 - nearest) * (1 + nearest)) + unsure) + kSectionSlop;
    };
    const auto eta = [&](const double* p) { return p[1] * basis.e[0] - p[0] * basis.e[1]; };
    Arm3 c[2] = {basis.b[0], basis.b[1]};
    const double cell = std::fabs(c[0].z * eta(c[1].p) - c[1].z * eta(c[0].p));
    double part = z_last - z_first;
    while (part * half_width(z_first, z_first + part) > kPartCells * cell) part /= 4;
    Point base = in_plane;
    for (double z = z_first; z < std::min(z_last, end()); z += part, part *= 2) {
      const double z_next = std::min(z + part, z_last), width = half_width(z, z_next),
                   middle = z + 0.5 * (z_next - z);
      const double along = 2 / (z_next - z), across = 1 / width;
      if (!reduce_in_plane(c, along, across, eta)) return false;
      const double inverse = 1 / (c[0].z * eta(c[1].p) - c[1].z * eta(c[0].p));
      for (int pass = 0; pass < 2; ++pass) {  // a lattice point near the middle of the part
        const double dz = middle - base.z, dh = -eta(base.p);
        const double k0 = std::nearbyint((dz * eta(c[1].p) - c[1].z * dh) * inverse);
        const double k1 = std::nearbyint((c[0].z * dh - dz * eta(c[0].p)) * inverse);
        const Point moved(Point(base, k0, c[0]), k1, c[1]);
        for (int i = 0; i < 3; ++i)  // or the integers were rounded
          if (!(std::fabs(base.n[i]) + std::fabs(k0 * c[0].n[i]) + std::fabs(k1 * c[1].n[i]) <
                kMaxCoefficient))
            return false;
        base = recomputed(moved);
      }
      // k_1 = (c_0 x (point - base)) / (c_0 x c_1)
      const double centre = (c[0].z * -eta(base.p) - (middle - base.z) * eta(c[0].p)) * inverse;
      const double reach =
          (std::fabs(c[0].z) * width + 0.5 * (z_next - z) * std::fabs(eta(c[0].p))) * std::fabs(inverse) +
          kSlop3d;
      if (!(reach < kMaxLinesInPart && are_countable(centre - reach, centre + reach))) return false;
      for (double k = std::ceil(centre - reach); k <= centre + reach; ++k)
        if (!scan_line(Point(base, k, c[1]), c[0], z - kSlop3d * part, z_next + kSlop3d * part)) return false;
    }
    return true;
  }

  // Lagrange's reduction of two vectors of the plane; the shorter one is c_0, and points forward.
  template <class Eta>
  bool reduce_in_plane(Arm3 (&c)[2], double along, double across, Eta eta) const {
    const auto times = [&](const Arm3& a, const Arm3& b) {
      return a.z * along * (b.z * along) + eta(a.p) * across * (eta(b.p) * across);
    };
    for (int step = 0; step < kMaxPlaneReductionSteps; ++step) {
      if (times(c[1], c[1]) < times(c[0], c[0])) std::swap(c[0], c[1]);
      const double k = std::nearbyint(times(c[0], c[1]) / times(c[0], c[0]));
      if (k == 0) {
        if (c[0].z < 0) {
          for (double& n : c[0].n) n = -n;
          c[0].p[0] = -c[0].p[0], c[0].p[1] = -c[0].p[1], c[0].z = -c[0].z;
        }
        return true;
      }
      c[1].subtract(k, c[0]);
      to_.template recompute<Arch>(c[1], basis_->length);
    }
    return false;
  }

  // The same point, its coordinates from the integers.
  Point recomputed(const Point& point) const {
    Wide N[3];
    for (int i = 0; i < 3; ++i) N[i] = anchor_[i] + Wide(point.n[i]);
    Point same = at(N);
    for (int i = 0; i < 3; ++i) same.n[i] = point.n[i];
    return same;
  }

  // The balls along one line: |q + k p| < 1 is a quadratic in k.
  bool scan_line(const Point& q, const Arm3& arm, double z_first, double z_last) {
    const double a = square_of(arm.p);
    const double b = sum_of_products(q.p[0], arm.p[0], q.p[1], arm.p[1]);
    const double moment = moment_of_line(q.p, arm.p);
    const double unsure = line_error(q);
    const double discriminant = a * (1 + kDiscriminant * unsure) - moment * moment;  // rounded up
    if (discriminant < 0) return true;
    const double inverse = 1 / a, half = std::sqrt(discriminant) * inverse;
    double k_first = -b * inverse - half, k_last = -b * inverse + half;
    const double slack = kSlop3d + kLineEnd * unsure * std::sqrt(inverse);
    if (!(slack < kMaxUnsure)) return scan_line_closely(q, arm, z_first, z_last, k_first);
    k_first -= slack, k_last += slack;
    if (arm.z > 0) {
      const double inverse_z = 1 / arm.z;
      k_first = std::max(k_first, (z_first - q.z) * inverse_z - kSlop3d);
      k_last = std::min(k_last, (z_last - q.z) * inverse_z + kSlop3d);
    }
    return scan_stretch(q, arm, std::ceil(k_first), k_last);
  }

  double line_error(const Point& q) const {
    return kLine * kRoundoff * (1 + q.size) + p_error_ + (kBall ? 0 : to_.scale_error);
  }

  // A line nearly parallel to the flight, where binary64 cannot tell at which k it enters the cylinder;
  // `estimate` is about there.
  [[gnu::noinline]] bool scan_line_closely(const Point& q, const Arm3& arm, double z_first, double z_last,
                                           double estimate) {
    if (!(arm.z > 0)) return false;
    const double k_first = std::ceil((z_first - q.z) / arm.z - kSlop3d),
                 k_last = (z_last - q.z) / arm.z + kSlop3d;
    const Point first(q, k_first, arm);
    const double drift = (std::fabs(arm.p[0]) + std::fabs(arm.p[1])) * (k_last - k_first);
    const double distance = std::hypot(first.p[0], first.p[1]);
    const double unsure = kDiscriminant * line_error(first);
    if (distance - drift > 1 + unsure) return true;
    if (distance < 1 - unsure || k_last - k_first < kShortStretch || !(estimate > k_first))
      return scan_stretch(q, arm, k_first, k_last);
    double k = std::nearbyint(estimate);
    return refine_entry(q, arm, k) && scan_stretch(q, arm, std::max(k_first, k), k_last);
  }

  // From k near the entry of a line into the cylinder to one just before it, by Newton's step in
  // double-double.
  bool refine_entry(const Point& q, const Arm3& arm, double& k) {
    const Point there(q, k, arm);
    Wide N[3];
    for (int i = 0; i < 3; ++i) {
      if (!(std::fabs(there.n[i]) < kMaxCoefficient)) return false;
      N[i] = anchor_[i] + Wide(there.n[i]);
    }
    stage = std::max(stage, Stage::double_double);
    const Encounter<SplitProduct, 3, kBall> encounter = encounter_at(N);
    const double rho2 = to_.rho * to_.rho, outside = -encounter.slack.hi / rho2;  // |p|^2 - 1
    const double inward = -2 * (there.p[0] * arm.p[0] + there.p[1] * arm.p[1]);
    const double speed = std::fabs(arm.p[0]) + std::fabs(arm.p[1]), step = outside / inward;
    if (!(inward > 0 && std::fabs(step) * speed * speed < kEntryCurvature * inward))
      return false;  // grazing, or not near
    const double unsure =
        kEntrySlop + std::fabs(step) * (2 * kEntryCurvature) + encounter.slack_error / rho2 / inward;
    if (!(unsure < kMaxEntryError)) return false;
    k = std::floor(k + step - unsure);
    return true;
  }

  bool scan_stretch(const Point& q, const Arm3& arm, double k_first, double k_last) {
    if (k_first <= k_last && !are_countable(k_first, k_last)) return false;
    int steps = 0;
    for (double k = k_first; k <= k_last; ++k) {
      if (++steps > kMaxCandidatesOnLine) return false;
      const Look look = look_at(Point(q, k, arm));
      if (look == Look::doubtful) return false;
      if (look != Look::missed) return true;
    }
    return true;
  }

  enum class Look { missed, taken, beyond, doubtful };

  Look look_at(const Point& point) {
    const double square = square_of(point.p);
    const double error = kAcross * kRoundoff * point.size + p_error_;
    const double spread = (1 + square) * (2 * error + scale_error());
    const Decision meets = is_positive(1 - square, spread);
    if (meets == Decision::no) return Look::missed;
    const double s = begin_ + point.z * basis_->length;
    const double s_error = s_error_ + kAlong * kRoundoff * point.extent * basis_->length;
    if (s < -s_error) return Look::missed;
    if (s - s_error > std::min(best_s + best_s_error, s_limit_)) return Look::beyond;
    Wide N[3];
    for (int i = 0; i < 3; ++i) {
      if (!(std::fabs(point.n[i]) < kMaxCoefficient)) return Look::doubtful;
      N[i] = anchor_[i] + Wide(point.n[i]);
    }
    if (from_ && same(N, from_)) return Look::missed;
    if (meets == Decision::yes && s > s_error)
      return offer(N, s, s_error, (1 - square) * (to_.rho * to_.rho), 2 * spread * (to_.rho * to_.rho));
    return look_closely(N);
  }

  double scale_error() const {
    if constexpr (kBall) return kScale * kRoundoff;
    return to_.scale_error;
  }

  Look offer(const Wide* N, double s, double s_error, double slack, double slack_error) {
    if (!(s + s_error < best_s - best_s_error)) return same(N, best) ? Look::missed : Look::doubtful;
    for (int i = 0; i < 3; ++i) best[i] = N[i];
    best_s = s, best_s_error = s_error, best_slack = slack, best_slack_error = slack_error;
    return Look::taken;
  }

  static bool same(const Wide* a, const Wide* b) {
    for (int i = 0; i < 3; ++i)
      if (a[i].hi != b[i].hi || a[i].lo != b[i].lo) return false;
    return true;
  }

  Encounter<SplitProduct, 3, kBall> encounter_at(const Wide (&N)[3]) const {
    Wide d[3];
    const double error = place_of<SplitProduct, kUnit, 3>(lattice_, offset_, N, d);
    return {to_.v, d, error, lattice_};
  }

  // The same decisions in double-double.
  [[gnu::noinline]] Look look_closely(const Wide (&N)[3]) {
    stage = std::max(stage, Stage::double_double);
    const Encounter<SplitProduct, 3, kBall> encounter = encounter_at(N);
    const Decision meets = encounter.meets();
    if (meets == Decision::doubtful) return Look::doubtful;
    if (meets == Decision::no) return Look::missed;
    const Decision ahead = encounter.is_ahead();
    if (ahead == Decision::doubtful) return Look::doubtful;
    if (ahead == Decision::no) return Look::missed;
    return offer(N, encounter.s.hi, encounter.s_error + kRoundoff * encounter.s.hi, encounter.slack.hi,
                 encounter.slack_error + kRoundoff * encounter.slack.hi);
  }

  const Bravais& lattice_;
  const Direction3<kUnit, kBall>& to_;
  const Offset<3>& offset_;
  const Basis3* basis_;
  Basis3 longer_;
  const Wide* from_ = nullptr;
  double s_limit_ = 0;
  Wide start_[3];
  double start_size_ = 0;
  double begin_ = 0;  ///< of the window, in units of s
  Wide anchor_[3];
  Point anchor_point_;
  double p_error_ = 0, s_error_ = 0, z_error_ = 0;
  double z_first_ = 0;  ///< of a window, with its error
  bool no_plane_met_ = true;
};

}  // namespace lorentz
