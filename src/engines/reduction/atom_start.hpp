// A start relative to one atom's lattice: whether it lies in an obstacle, and the cells of `from` and of the
// obstacle found. Private to the reduction engine.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>

#include "src/engines/reduction/obstacle_unrounded.hpp"
#include "src/engines/reduction/offset.hpp"

namespace lorentz {

/// Cells are counted from the home cell, in the short basis.
template <int D, bool kUnit, bool kBall>
class AtomStart {
 public:
  const Bravais* lattice = nullptr;
  Offset<SplitProduct, D> offset;

  /// False if the start is too far away.
  template <class Arch>
  bool set(const Bravais& of_lattice, const Vec& x) {
    lattice = &of_lattice;
    return set_offset<Arch, kUnit>(of_lattice, x, true, offset);
  }

  /// Does x lie in an obstacle (`from` excepted)? If so, N is its cell.
  Decision inside(const Task& task, Wide (&N)[D], Stage& stage) const {
    for (Wide& n : N) n = Wide();
    double other[D]{};
    int others = 0;
    if constexpr (!(kUnit && kBall))
      if (lattice->reaches_out) others = neighbours(other);
    if (others == 0) {  // nearly always
      const Decision decision = is_inside<kUnit, kBall>(offset.d, offset.error, *lattice, stage);
      if (decision == Decision::no) return decision;
    }
    Wide leaving[D];
    const bool has_from = find_from(task.ray.from, leaving);
    for (int which = 0; which <= others; ++which) {
      if ((which & others) != which) continue;
      Wide d[D];
      std::copy(offset.d, offset.d + D, d);
      double error = offset.error;
      if (which > 0) {
        for (int i = 0; i < D; ++i) N[i] = which >> i & 1 ? Wide(other[i]) : Wide();
        error = place_of<kUnit>(*lattice, offset, N, d);
      }
      Decision decision = is_inside<kUnit, kBall>(d, error, *lattice, stage);
      if (decision == Decision::no || (has_from && same(leaving, N))) continue;
      if (decision == Decision::doubtful)
        if (const auto obstacle = unrounded(task, N)) decision = is_inside_unrounded(*obstacle);
      if (decision != Decision::no) return decision;
    }
    return Decision::no;
  }

  /// Finds the cell of `from`. False if `from` belongs to another atom, or is farther away than any obstacle
  /// that the search names (kMaxWideCell, and kMaxCoefficient more). In a skewed cell a near obstacle may have
  /// coordinates of 84 bits: those of the search times a transform's 2^20, three of these. Such coordinates
  /// times an inverse's 2^41, three of these, are below 2^127.
  [[gnu::noinline]] bool find_from(const ObstacleId* from, Wide (&here)[D]) const {
    if (!from || from->lattice != lattice->lattice || from->atom != lattice->atom) return false;
    constexpr WideInteger kFarthestCell = WideInteger{1} << kFarthestCellBits,
                          kFarthestHere = WideInteger{1} << kFarthestHereBits;
    WideInteger cell[D];
    for (int k = 0; k < D; ++k) {
      const auto n = from->cell[k].int128();
      if (!n || *n > kFarthestCell || *n < -kFarthestCell) return false;
      cell[k] = *n;
    }
    for (int i = 0; i < D; ++i) {
      WideInteger sum = -home(i);
      for (int k = 0; k < D; ++k) sum += cell[k] * (kUnit ? k == i : lattice->inverse[k][i]);
      if constexpr (!kUnit) {
        if (lattice->stride[i] > 1 && sum % lattice->stride[i] != 0) return false;
        if (lattice->stride[i] > 1) sum /= lattice->stride[i];
      }
      if (sum > kFarthestHere || sum < -kFarthestHere) return false;
      const double high = static_cast<double>(sum);
      here[i] = Wide(high, static_cast<double>(sum - static_cast<WideInteger>(high)));
    }
    return true;
  }

  /// The cell N in the scene's own primitive vectors; false if 64 bits do not hold it.
  bool set_cell(const Wide (&N)[D], std::array<std::int64_t, 3>& cell) const {
    std::int64_t n[3]{};
    for (int i = 0; i < D; ++i) {
      const double stride = kUnit ? 1 : static_cast<double>(lattice->stride[i]);
      if (!(std::fabs(N[i].hi * stride) < kMaxCell)) return false;
      n[i] =
          static_cast<std::int64_t>(N[i].hi * stride) + static_cast<std::int64_t>(N[i].lo * stride) + home(i);
    }
    if constexpr (kUnit) {
      for (int k = 0; k < D; ++k) cell[k] = n[k];
      return true;
    }
    for (int k = 0; k < D; ++k) {
      cell[k] = 0;
      for (int i = 0; i < D; ++i) {
        std::int64_t step;
        if (__builtin_mul_overflow(n[i], lattice->transform[i][k], &step) ||
            __builtin_add_overflow(cell[k], step, &cell[k]))
          return false;
      }
    }
    return true;
  }

  /// The same in 128 bits; false beyond what the search counts with.
  [[gnu::noinline]] bool set_cell(const Wide (&N)[D], std::array<WideInteger, 3>& cell) const {
    cell = {};
    for (int i = 0; i < D; ++i) {
      const std::int64_t stride = kUnit ? 1 : lattice->stride[i];
      if (!(std::fabs(N[i].hi) * static_cast<double>(stride) < kMaxWideCell)) return false;
      const WideInteger n =
          (static_cast<WideInteger>(N[i].hi) + static_cast<WideInteger>(N[i].lo)) * stride + home(i);
      for (int k = 0; k < D; ++k) cell[k] += n * (kUnit ? k == i : lattice->transform[i][k]);
    }
    return true;
  }

  /// The obstacle of cell N, from which nothing is rounded; nothing where that is not known.
  [[gnu::noinline]] std::optional<UnroundedObstacle> unrounded(const Task& task, const Wide (&N)[D]) const {
    std::array<std::int64_t, 3> cell{};
    if (!set_cell(N, cell)) return std::nullopt;
    return UnroundedObstacle::of(task, *lattice, cell);
  }

 private:
  // Coordinate i of the home cell, in strides of one.
  std::int64_t home(int i) const {
    return static_cast<std::int64_t>(offset.home[i] * (kUnit ? 1 : static_cast<double>(lattice->stride[i])));
  }

  // The steps to the cells besides the home cell whose obstacle may contain x: up to one along each basis
  // vector. Returns a bit for each.
  int neighbours(double (&other)[D]) const {
    int bits = 0;
    for (int i = 0; i < D; ++i) {
      const double coordinate = coordinate_from_home(*lattice, offset, i);
      if (std::fabs(coordinate) + lattice->reach[i] < 1 - kMaxHomeError) continue;
      other[i] = std::copysign(1, coordinate);
      bits |= 1 << i;
    }
    return bits;
  }
};

/// Decides about the obstacles that a search names what double-double leaves open.
template <int D, bool kUnit, bool kBall>
struct UnroundedLook {
  const Task& task;
  const AtomStart<D, kUnit, kBall>& start;

  [[gnu::noinline]] void at(const Wide (&N)[D], CloseLook<SplitProduct>& close) const {
    if (close.is_missed || (close.is_met && (close.is_behind || close.is_ahead))) return;
    Wide here[D];
    std::copy(N, N + D, here);
    if constexpr (kUnit && kBall) Octant(D, task.ray.v).undo(N, here);  // the search is turned
    if (const auto obstacle = start.unrounded(task, here)) look_unrounded(*obstacle, close);
  }
};

}  // namespace lorentz
