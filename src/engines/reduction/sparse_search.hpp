// The search for the first obstacle of a lattice that has fewer vectors than there are dimensions: a single
// obstacle, a row, a plane of them. Private to the reduction engine.
#pragma once

#include <algorithm>
#include <optional>

#include <lorentz/geometry.hpp>
#include "src/engines/reduction/atom_direction.hpp"
#include "src/engines/reduction/one_obstacle.hpp"
#include "src/engines/reduction/sparse_rows.hpp"

namespace lorentz {

/// A direction of flight for balls of a sparse lattice. (Ellipsoids take AtomDirection.)
template <int D>
struct SparseDirection {
  struct {
    Vec v;
    double v2, s_rho;
  } direction;
  Octant octant;

  template <class Arch>
  SparseDirection(Arch, const Bravais& lattice, const Vec& v) {
    octant.turn<false>(v, direction.v);
    direction.v2 = speed_squared(direction.v[0], direction.v[1], direction.v[2]);
    direction.s_rho = width_of(lattice.radius, direction.v2);
  }

  template <class Arch>
  static void set(std::optional<SparseDirection>& to, Arch arch, const Bravais*, const Bravais& lattice,
                  const Vec& v) {
    to.emplace(arch, lattice, v);
  }
};

/// As Search2 and Search3. What may be met is known roughly, in binary64 (sparse_rows.hpp), and each obstacle
/// is looked at as a single one. Obstacles of one atom do not overlap, so that they are entered in the order
/// of s.
template <int D, bool kBall>
class SparseSearch {
 public:
  Found<D> found;

  template <class Direction>
  SparseSearch(const Bravais& lattice, const Direction& to, const Offset<SplitProduct, D>& offset)
      : lattice_(lattice), v_{to.v[0], to.v[1], D == 3 ? to.v[2] : 0}, v2_(to.v2), offset_(offset) {}

  Outcome run(const Wide* from, double) {
    from_ = from;
    if (!scan()) {
      found.stage = Stage::undecided;
      return Outcome::undecided;
    }
    return found.any() ? Outcome::hit : Outcome::never;
  }

 private:
  // The lattice vector t_0 B_0 + t_1 B_1.
  struct Combination {
    double t[2];
    SparseVector seen;
  };

  // False: undecided.
  bool scan() {
    for (Combination& none : rows_) none = {};
    if (lattice_.rank == 0) return look(0, 0) != Look::doubtful;
    see();
    if (lattice_.rank == 2) shorten_across();
    Combination& row = rows_[0];
    if (dot(seen_v_, row.seen.a) < 0) row = plus({}, -1, row);
    const SparseRow along(seen_v_, unit(), row.seen, lattice_.radius);
    if (lattice_.rank == 1) return along.is_level() ? scan_level_row(along) : scan_row(along, 0);
    if (along.is_level()) return false;
    const SparseRange rows = along.rows(start_, rows_[1].seen);
    if (!rows.is_known() || rows.last - rows.first > kMaxRows) return false;
    for (double k = rows.first; k <= rows.last; ++k)
      if (!scan_row(along, k)) return false;
    return true;
  }

  // Where obstacles are balls, all vectors err by so much of their sizes (bounds.hpp).
  double unit() const {
    if constexpr (kBall) return kSparse * kRoundoff;
    return (kSparse + kSparseOfShape * lattice_.shape.condition) * kRoundoff;
  }
  Vec image(const Vec& a) const {
    if constexpr (kBall) return a;
    const Vec* N = lattice_.shape.to_ball;
    return {dot(N[0], a), dot(N[1], a), D == 3 ? dot(N[2], a) : 0};
  }
  void see() {
    const auto high = [](const auto& wide) {
      Vec a{};
      for (int k = 0; k < D; ++k) a[k] = wide[k].hi;
      return a;
    };
    const auto seen = [&](const Vec& a) {
      const Vec there = image(a);
      return SparseVector{there, length(there)};
    };
    seen_v_ = image(v_);
    start_ = seen(high(offset_.d));
    start_.error = offset_.error;
    if constexpr (!kBall) start_.error *= std::sqrt(lattice_.shape.metric_size);
    for (int i = 0; i < lattice_.rank; ++i) {
      rows_[i].t[i] = 1;
      rows_[i].seen = seen(high(lattice_.basis[i]));
    }
  }

  static Combination plus(const Combination& a, double k, const Combination& b) {
    return {{a.t[0] + k * b.t[0], a.t[1] + k * b.t[1]}, a.seen.plus(k, b.seen)};
  }

  // Two vectors of the plane that are short across the line: few rows along the first one come near it.
  void shorten_across() {
    for (int pass = 0; pass < kMaxPlaneReductionSteps; ++pass) {
      Vec c = cross(seen_v_, rows_[0].seen.a), e = cross(seen_v_, rows_[1].seen.a);
      if (dot(e, e) < dot(c, c)) std::swap(rows_[0], rows_[1]), std::swap(c, e);
      const double m = std::nearbyint(dot(c, e) / dot(c, c));
      if (m == 0 || !(std::fabs(m) < kMaxTransform)) return;
      const Combination shorter = plus(rows_[1], -m, rows_[0]);
      if (!(length(cross(seen_v_, shorter.seen.a)) < length(e))) return;
      rows_[1] = shorter;
    }
  }

  // The first obstacle of row k that is met ahead, if it comes before the best so far. False: undecided.
  bool scan_row(const SparseRow& along, double k) {
    const SparseVector start = start_.plus(k, rows_[1].seen);
    SparseRange range = along.balls(start);
    if (!range.is_known()) return false;
    if (range.last - range.first >= kMaxCandidatesInRow) {
      const SparseRange ahead = along.ahead(start);
      if (!ahead.is_known()) return false;
      range.first = std::max(range.first, ahead.first);
    }
    double n = range.first;
    for (int step = 0; step < kMaxCandidatesInRow && n <= range.last; ++step, ++n) {
      const Look seen = look(n, k);
      if (seen == Look::doubtful || seen == Look::met) return seen == Look::met;
    }
    return n > range.last;
  }

  // A row that is exactly parallel to the line: all are met, or none is.
  bool scan_level_row(const SparseRow& along) {
    double n[D]{};
    n[0] = 1;
    if (!is_parallel<SplitProduct, D>(lattice_, v_, n)) return false;
    const SparseRange ahead = along.ahead(start_);
    if (!ahead.is_known()) return false;
    for (int step = 0; step < kMaxCandidatesInRow; ++step) {
      const Look seen = look(ahead.first + step, 0);
      if (seen != Look::behind) return seen != Look::doubtful;
    }
    return false;
  }

  // The obstacle n of row k. The one that is left counts as behind.
  Look look(double n, double k) {
    double N[D]{};
    for (int i = 0; i < lattice_.rank; ++i) {
      const double along = n * rows_[0].t[i], beside = k * rows_[1].t[i];
      N[i] = along + beside;
      if (!(std::max(std::fabs(along), std::fabs(beside)) < kMaxCoefficient / 2)) return Look::doubtful;
    }
    if (from_ && std::equal(N, N + D, from_, [](double a, const Wide& b) { return a == b.hi && b.lo == 0; }))
      return Look::behind;
    Wide d[D];
    const double error = place_of<false>(lattice_, offset_, N, d);
    Found<D> one;
    const Look seen = look_at<D, kBall>(d, error, lattice_, v_, v2_, one);
    found.needs(one.stage);
    if (seen != Look::met || found.s + found.s_error < one.s - one.s_error) return seen;
    if (found.any() && !(one.s + one.s_error < found.s - found.s_error)) return Look::doubtful;
    std::copy(N, N + D, one.N);
    one.stage = found.stage;
    found = one;
    return seen;
  }

  const Bravais& lattice_;
  const Vec v_;
  const double v2_;
  const Offset<SplitProduct, D>& offset_;
  const Wide* from_ = nullptr;
  Vec seen_v_;
  SparseVector start_;
  Combination rows_[2];  ///< the row that is followed, and the step to the next one
};

}  // namespace lorentz
