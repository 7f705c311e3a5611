// The search for the first obstacle of a lattice with fewer vectors than dimensions: a single obstacle, a
// row, or a layer. Private to the reduction engine.
#pragma once

#include <algorithm>
#include <optional>

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

  template <class Arch>
  SparseDirection(Arch, const Bravais& lattice, const Vec& v) {
    for (int k = 0; k < 3; ++k) direction.v[k] = flushed(v[k]);
    direction.v2 = speed_squared(direction.v[0], direction.v[1], direction.v[2]);
    direction.s_rho = width_of(lattice.radius, direction.v2);
  }

  template <class Arch>
  static void set(std::optional<SparseDirection>& to, Arch arch, const Bravais*, const Bravais& lattice,
                  const Vec& v) {
    to.emplace(arch, lattice, v);
  }
};

/// Like Search2 and Search3. Candidates are found roughly, in binary64 (sparse_rows.hpp), and each is
/// decided as a single obstacle. Obstacles of one atom do not overlap, so they are entered in the order of s.
template <int D, bool kBall>
class SparseSearch {
 public:
  Found<D> found;

  template <class Direction>
  SparseSearch(const Bravais& lattice, const Direction& to, const Offset<SplitProduct, D>& offset,
               const UnroundedLook<D, false, kBall>& unrounded)
      : lattice_(lattice),
        v_{to.v[0], to.v[1], D == 3 ? to.v[2] : 0},
        v2_(to.v2),
        offset_(offset),
        unrounded_(unrounded) {}

  Outcome run(const Wide* from, double) {
    from_ = from;
    return scan() ? found.outcome() : found.give_up();
  }

 private:
  using Vector = SparseVector<D>;
  using Row = SparseRow<D>;

  // False: undecided.
  bool scan() { return lattice_.rank == 0 ? look_at_only() : scan_rows(); }

  // (Not inlined, because it would take its caller's registers.)
  [[gnu::noinline]] bool scan_rows() {
    see();
    if constexpr (D == 3)
      if (lattice_.rank == 2) shorten_across(seen_v_, rows_);
    turn_forward(seen_v_, rows_[0]);
    const Row along(seen_v_, unit(), rows_[0].seen, lattice_.radius, of_place(offset_.error));
    if (lattice_.rank == 1) return along.is_level() ? scan_level_row(along) : scan_row(along, 0);
    if constexpr (D == 3) {
      const SparseRange rows = along.rows(start_, rows_[1].seen);
      if (along.is_level() || !rows.known || rows.last - rows.first > kMaxRows) return stays_outside();
      for (double k = rows.first; k <= rows.last; ++k)
        if (!scan_row(along, k)) return false;
    }
    return true;
  }

  bool look_at_only() {
    if (from_) return true;  // the only obstacle is the one that is left
    for (Wide& n : found.N) n = Wide();
    const Look seen =
        look_at<D, kBall>(offset_.d, offset_.error, found.N, lattice_, v_, v2_, unrounded_, found);
    if (seen != Look::met) found.s = Found<D>::kNothing;
    return seen != Look::doubtful;
  }

  // In the frame in which obstacles are balls: the error of all vectors, relative to their sizes
  // (bounds.hpp), and the error of a place.
  double unit() const {
    if constexpr (kBall) return kSparse * kRoundoff;
    return (kSparse + kSparseOfShape * lattice_.shape.condition) * kRoundoff;
  }
  double of_place(double error) const {
    if constexpr (kBall) return error;
    return error * std::sqrt(lattice_.shape.metric_size);
  }

  // Sets the vectors for sparse_rows.hpp: velocity, start, the row that is followed, and the step to the
  // next row.
  void see() {
    const auto image = [&](const auto& a, double(&there)[D]) {
      for (int i = 0; i < D; ++i) {
        if constexpr (kBall) there[i] = a(i);
        if constexpr (!kBall) there[i] = 0;
        for (int k = 0; k < D && !kBall; ++k) there[i] += lattice_.shape.to_ball[i][k] * a(k);
      }
    };
    const auto seen = [&](const auto& wide) {
      Vector vector;
      image([&](int k) { return wide[k].hi; }, vector.a);
      vector.size = std::sqrt(square_of(vector.a));
      return vector;
    };
    for (auto& row : rows_) row = {};
    image([&](int k) { return v_[k]; }, seen_v_);
    start_ = seen(offset_.d);
    for (int i = 0; i < lattice_.rank; ++i) {
      rows_[i].t[i] = 1, rows_[i].seen = seen(lattice_.basis[i]);
      rows_[i].seen.size += of_place(lattice_.basis_error) / kRoundoff;  // counted as the size of terms
    }
  }

  // Takes the first obstacle of row k that is met ahead, if it comes before the best so far. False:
  // undecided.
  bool scan_row(const Row& along, double k) {
    Vector start = start_;
    start.add(k, rows_[1].seen);
    SparseRange range = along.balls(start);
    if (!range.known) return false;
    if (range.last - range.first >= kMaxCandidatesInRow) {
      const SparseRange ahead = along.ahead(start);
      if (!ahead.known) return false;
      range.first = std::max(range.first, ahead.first);
    }
    double n = range.first;
    for (int step = 0; step < kMaxCandidatesInRow && n <= range.last; ++step, ++n) {
      const Look seen = look(n, k);
      if (seen == Look::doubtful || seen == Look::met) return seen == Look::met;
    }
    return n > range.last;
  }

  // Scans a row nearly parallel to the line. If the next obstacle is met, it is the first. If the row is
  // exactly parallel, all obstacles are met, or none.
  bool scan_level_row(const Row& along) {
    const SparseRange ahead = along.ahead(start_);
    if (!ahead.known) return false;
    double n[D]{};
    n[0] = 1;
    for (int step = 0; step < kMaxCandidatesInRow; ++step) {
      const Look seen = look(ahead.first + step, 0);
      if (seen == Look::missed) return is_parallel<SplitProduct, D>(lattice_, v_, n);
      if (seen != Look::behind) return seen == Look::met;
    }
    return false;
  }

  // Does the line begin outside the slab of a layer of balls, and come no nearer? (In an exact basis,
  // quantities that are exactly zero have no error.)
  bool stays_outside() const {
    if constexpr (!kBall) return false;
    const auto& b = lattice_.basis;
    double depth = 0, depth_error = 0, approach = 0, approach_error = 0, normal = 0;
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      const double one = b[0][j].hi * b[1][k].hi, other = b[0][k].hi * b[1][j].hi,
                   size = std::fabs(b[0][j].hi) + std::fabs(b[0][k].hi) + std::fabs(b[1][j].hi) +
                          std::fabs(b[1][k].hi),
                   unsure = kLayer * kRoundoff * (std::fabs(one) + std::fabs(other)) +
                            2 * lattice_.basis_error * size,
                   n = std::fabs(one - other) + unsure, place = offset_.d[i].hi;
      depth += place * (one - other);
      depth_error += std::fabs(place) * unsure + offset_.error * n;
      approach += v_[i] * (one - other), approach_error += std::fabs(v_[i]) * unsure;
      normal += n * n;
    }
    return std::fabs(depth) > depth_error + (1 + kAmple) * lattice_.radius * std::sqrt(normal) &&
           approach * std::copysign(1, depth) + approach_error <= 0;
  }

  // Looks at obstacle n of row k. The obstacle that is left counts as behind.
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
    std::copy(N, N + D, one.N);
    const Look seen = look_at<D, kBall>(d, error, one.N, lattice_, v_, v2_, unrounded_, one);
    found.needs(one.stage);
    if (seen != Look::met || found.s + found.s_error < one.s - one.s_error) return seen;
    if (found.any() && !(one.s + one.s_error < found.s - found.s_error)) return Look::doubtful;
    one.stage = found.stage;
    found = one;
    return seen;
  }

  const Bravais& lattice_;
  const Vec v_;
  const double v2_;
  const Offset<SplitProduct, D>& offset_;
  const UnroundedLook<D, false, kBall> unrounded_;
  const Wide* from_ = nullptr;
  double seen_v_[D];
  Vector start_;
  SparseCombination<D> rows_[2];  ///< the row that is followed, and the step to the next one
};

}  // namespace lorentz
