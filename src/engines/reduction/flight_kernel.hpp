// One flight among one atom's obstacles, or several atoms': from the query to a Flight. Private to the
// reduction engine, which compiles it twice, with and without the fused multiply-add.
#pragma once

#include <optional>
#include <type_traits>

#include <lorentz/reduction.hpp>
#include "src/engines/reduction/search_2d.hpp"
#include "src/engines/reduction/search_3d.hpp"

namespace lorentz {

/// One atom's lattice seen along a velocity. The unit lattices of balls are turned so that it lies in the
/// first octant.
template <int D, bool kUnit, bool kBall>
struct Aim {
  Octant octant;
  std::conditional_t<D == 2, Direction2<kUnit, kBall>, Direction3<kUnit, kBall>> direction;

  template <class Arch>
  Aim(Arch arch, const Bravais& lattice, const Vec& v)
      : octant(kUnit && kBall ? Octant(D, v) : Octant()), direction(arch, lattice, octant, v) {}

  /// The same for the next atom along the same velocity, from the aim at the atom `before`.
  template <class Arch>
  static void set(std::optional<Aim>& aim, Arch arch, const Bravais* before, const Bravais& lattice,
                  const Vec& v) {
    const bool same_lattice = before && before->lattice == lattice.lattice;
    if (same_lattice && before->radius == lattice.radius && (kBall || before->shape == lattice.shape)) return;
    if constexpr (D == 3 && kBall)
      if (same_lattice) return aim->direction.template retarget<Arch>(lattice);
    aim.emplace(arch, lattice, v);
  }
};

/// The first of one atom's obstacles that is entered, with what its time needs.
template <class Arch, int D, bool kUnit, bool kBall>
class Finding {
  static constexpr bool kTurned = kUnit && kBall;
  using DD = DoubleDouble<Arch>;
  using Search = std::conditional_t<D == 2, Search2<Arch, kUnit, kBall>, Search3<Arch, kUnit, kBall>>;

 public:
  Outcome outcome = Outcome::undecided;
  Stage stage = Stage::binary64;
  Wide N[D];  ///< the cell of the ball found, or of the home cell, from the home cell, in the short basis

  Finding() {
    for (Wide& n : N) n = Wide();
  }

  /// The start's offset; false if it is too far away.
  bool start(const Bravais& lattice, const Vec& x) {
    lattice_ = &lattice;
    return set_offset<Arch, kUnit, D>(lattice, x, offset_);
  }

  /// Does x lie in a ball (`from` excepted)? Then N is its cell.
  Decision inside(const ObstacleId* from) {
    for (Wide& n : N) n = Wide();
    double other[D]{};
    int others = 0;
    if constexpr (!kTurned)
      if (lattice_->reaches_out) others = neighbours(other);
    if (others == 0) {  // nearly always
      const Decision decision = is_inside<kBall>(offset_.d, offset_.error, *lattice_, stage);
      if (decision == Decision::no) return decision;
    }
    Wide leaving[D];
    const bool has_from = find_from(from, leaving);
    for (int which = 0; which < 1 << others; ++which) {
      Wide d[D];
      std::copy(offset_.d, offset_.d + D, d);
      double error = offset_.error;
      if (which > 0) {
        choose(which, other);
        error = place_of<SplitProduct, kUnit, D>(*lattice_, offset_, N, d);
      }
      const Decision decision = is_inside<kBall>(d, error, *lattice_, stage);
      if (decision == Decision::no || (has_from && same(leaving, N))) continue;
      return decision;
    }
    return Decision::no;
  }

  /// Balls that are entered after max_time need not be found.
  void find(const Aim<D, kUnit, kBall>& aim, const ObstacleId* from, double max_time) {
    const double s_limit = (max_time * aim.direction.v2 + aim.direction.s_rho) * (1 + kAmple);
    v2_ = aim.direction.v2;
    if constexpr (!kBall && D == 3) std::copy(aim.direction.along, aim.direction.along + D, along_);
    Offset<D> turned;
    if constexpr (kTurned) aim.octant.apply(offset_.d, turned.d);
    Search search(*lattice_, aim.direction, kTurned ? turned : offset_);
    Wide leaving[D];
    if (from && find_from(from, leaving)) {
      Wide there[D];
      if constexpr (kTurned) aim.octant.apply(leaving, there);
      outcome = search.run(kTurned ? there : leaving, s_limit);
    } else {
      outcome = search.run(nullptr, s_limit);
    }
    stage = std::max(stage, search.stage);
    if (outcome == Outcome::undecided) stage = Stage::undecided;
    if (outcome != Outcome::hit) return;
    s_ = search.best_s, s_error_ = search.best_s_error;
    slack_ = search.best_slack, slack_error_ = search.best_slack_error;
    if constexpr (!kBall && D == 2) {
      euclidean_v2_ = aim.direction.shape.euclidean_v2;
      across_ = search.best_h * aim.direction.shape.skew;
    }
    if constexpr (kTurned)
      aim.octant.undo(search.best, N);
    else
      std::copy(search.best, search.best + D, N);
  }

  /// The cell in the scene's own primitive vectors; false if 64 bits do not hold it.
  bool cell(std::array<std::int64_t, 3>& cell) const {
    std::int64_t n[3]{};
    for (int i = 0; i < D; ++i) {
      if (!(std::fabs(N[i].hi) < kMaxCell)) return false;
      n[i] = static_cast<std::int64_t>(N[i].hi) + static_cast<std::int64_t>(N[i].lo) +
             static_cast<std::int64_t>(offset_.home[i]);
    }
    if constexpr (kUnit) {
      for (int k = 0; k < D; ++k) cell[k] = n[k];
      return true;
    }
    for (int k = 0; k < D; ++k) {
      cell[k] = 0;
      for (int i = 0; i < D; ++i) {
        std::int64_t step;
        if (__builtin_mul_overflow(n[i], lattice_->transform[i][k], &step) ||
            __builtin_add_overflow(cell[k], step, &cell[k]))
          return false;
      }
    }
    return true;
  }

  /// The time of entry within a few ulps.
  double close_time(const Vec& v, double v2) const {
    if constexpr (!kBall) return close_time_of_ellipsoid(v);
    const double q = std::sqrt(slack_);
    if (slack_error_ > kGrazing * kRoundoff * q * s_) {  // a grazing hit nearby
      double error;
      return wide_time(v, error).value();
    }
    if (s_ > kNear * q) {
      double s = 0;
      for (int k = 0; k < D; ++k) s += v[k] * distance(k);
      return (s - q) / v2;
    }
    // Nearby the difference would cancel: (s^2 - q^2) / (s + q), where s^2 - q^2 = v^2 (|d|^2 - r^2).
    DD d[D], N_here[D];
    for (int i = 0; i < D; ++i) N_here[i] = DD(N[i]);
    place_of<Arch, kUnit, D>(*lattice_, offset_, N_here, d);
    double s = 0;
    DD gap = -DD::product(lattice_->radius, lattice_->radius);
    for (int k = 0; k < D; ++k) {
      const DD square = DD::product(d[k].hi, d[k].hi), sum = DD::sum(gap.hi, square.hi);
      gap = DD(sum.hi, sum.lo + (gap.lo + square.lo + 2 * d[k].hi * d[k].lo));
      s += v[k] * d[k].hi;
    }
    return std::max(gap.value(), 0.0) / (s + q);
  }

  /// The time in binary64 and the bound of its error, from the search alone.
  double rough_time(double& error) const {
    const double q = std::sqrt(slack_);
    error = 2 * (s_error_ + slack_error_ / q) / v2_ + kRoughTime * kRoundoff * s_ / v2_;
    return rough_time_of(s_, q, v2_);
  }

  /// The time in double-double, and the bound of its error.
  DD time(const Vec& v, double& error) const {
    DD d[D], N_here[D];
    for (int i = 0; i < D; ++i) N_here[i] = DD(N[i]);
    const double d_error = place_of<Arch, kUnit, D>(*lattice_, offset_, N_here, d);
    const Encounter<Arch, D, kBall> encounter(v, d, d_error, *lattice_);
    return encounter.time(d, d_error, *lattice_, error);
  }

  [[gnu::noinline]] Wide wide_time(const Vec& v, double& error) const {
    Wide d[D];
    const double d_error = place_of<SplitProduct, kUnit, D>(*lattice_, offset_, N, d);
    const Encounter<SplitProduct, D, kBall> encounter(v, d, d_error, *lattice_);
    return encounter.time(d, d_error, *lattice_, error);
  }

 private:
  // The terms of along . d are larger than their sum. In 2D it is ((v . d) v2 + h skew) / v.v, and h is
  // known; in 3D it is computed in double-double. Nearby s - q would cancel: then t = (d . G d - r^2) / (s +
  // q). In 3D the bound of the slack is so large that what is near has gone to the second stage before.
  double close_time_of_ellipsoid(const Vec& v) const {
    const double q = std::sqrt(slack_);
    double error;
    // What the last bits of h do to the time of a slender one is more than some ulps.
    if (lattice_->shape.condition > kSlender) return std::max(time(v, error).value(), 0.0);
    const double unsure = (kGrazing + kGrazingOfShape * lattice_->shape.condition) *
                          kRoundoff;  // its bounds are larger by so much
    if (slack_error_ > unsure * q * s_) return wide_time(v, error).value();
    if constexpr (D == 2) {
      const double along = v[0] * distance(0) + v[1] * distance(1);
      if (!(s_ > kNear * q)) return close_gap() / ((along * v2_ + across_) / euclidean_v2_ + q);
      return along / euclidean_v2_ + (across_ - q * euclidean_v2_) / (euclidean_v2_ * v2_);
    } else {
      DD d[D];
      place(d);
      return (close_product(along_, d).hi - q) / v2_;
    }
  }

  // The obstacle's place seen from x, to some squares of the roundoff of the terms: place_of in fewer
  // operations.
  void place(DD (&d)[D]) const {
    for (int k = 0; k < D; ++k) {
      if constexpr (kUnit) {
        d[k] = DD::sum(N[k].hi, offset_.d[k].hi);
        d[k].lo += N[k].lo;
        continue;
      }
      DD sum(offset_.d[k]);
      double low = 0;
      for (int i = 0; i < D; ++i) {
        sum = add_product(sum, DD(lattice_->basis[i][k]), N[i].hi);
        low += lattice_->basis[i][k].hi * N[i].lo;
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
    for (int i = 0; i < D; ++i) image[i] = close_product(lattice_->shape.metric[i], d);
    const DD square = close_product(image, d), limit = DD::product(lattice_->radius, lattice_->radius);
    return std::max((square.hi - limit.hi) + (square.lo - limit.lo), 0.0);
  }

  // Component k of the ball's place seen from x, to some ulps of |d|.
  double distance(int k) const {
    if constexpr (kUnit) return N[k].hi + offset_.d[k].hi;
    double d = offset_.d[k].hi;
    for (int i = 0; i < D; ++i) d += lattice_->basis[i][k].hi * N[i].hi;
    return d;
  }

  static bool same(const Wide* a, const Wide* b) {
    for (int i = 0; i < D; ++i)
      if (a[i].hi != b[i].hi || a[i].lo != b[i].lo) return false;
    return true;
  }

  // The cells besides the home cell whose ball may contain x: up to one step along each basis vector.
  int neighbours(double (&other)[D]) const {
    int count = 0;
    for (int i = 0; i < D; ++i) {
      const double coordinate = coordinate_from_home(*lattice_, offset_, i);
      if (std::fabs(coordinate) + lattice_->reach[i] < 1 - kMaxHomeError) continue;
      other[i] = std::copysign(1, coordinate);
      ++count;
    }
    return count;
  }

  // The subset number `which` of these steps.
  void choose(int which, const double (&other)[D]) {
    for (int i = 0, bit = 0; i < D; ++i) {
      N[i] = Wide();
      if (other[i] == 0) continue;
      if (which >> bit & 1) N[i] = Wide(other[i]);
      ++bit;
    }
  }

  // `from` from the home cell, in the short basis; false if it is of another atom, or farther away than any
  // obstacle that the search names (2^61, and 2^53 more). In a skewed cell what is near may have coordinates
  // of 84 bits: those of the search times a transform's 2^20, three of these. They times an inverse's 2^41,
  // three of these, are below 2^127.
  [[gnu::noinline]] bool find_from(const ObstacleId* from, Wide (&here)[D]) const {
    if (!from || from->lattice != lattice_->lattice || from->atom != lattice_->atom) return false;
    constexpr WideInteger kFarthestCell = WideInteger{1} << 84, kFarthestHere = WideInteger{1} << 62;
    WideInteger cell[D];
    for (int k = 0; k < D; ++k) {
      const auto n = from->cell[k].int128();
      if (!n || *n > kFarthestCell || *n < -kFarthestCell) return false;
      cell[k] = *n;
    }
    for (int i = 0; i < D; ++i) {
      WideInteger sum = -static_cast<WideInteger>(offset_.home[i]);
      for (int k = 0; k < D; ++k) sum += cell[k] * (kUnit ? k == i : lattice_->inverse[k][i]);
      if (sum > kFarthestHere || sum < -kFarthestHere) return false;
      const double high = static_cast<double>(sum);
      here[i] = Wide(high, static_cast<double>(sum - static_cast<WideInteger>(high)));
    }
    return true;
  }

  const Bravais* lattice_ = nullptr;
  Offset<D> offset_;
  double s_, s_error_, slack_, slack_error_, v2_;
  // Of ellipsoids, for the time: in 2D v.v, and h skew; in 3D the form that s is.
  double euclidean_v2_, across_;
  Wide along_[kBall || D == 2 ? 1 : D];
};

}  // namespace lorentz
