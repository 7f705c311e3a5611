// The classical algorithm for scenes with more than one obstacle in a cell: any lattices, any motif,
// overlaps, ellipsoids.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include <lorentz/engine.hpp>

namespace lorentz {

using CellIndex = std::array<std::int64_t, 3>;

/// The cell of an obstacle; nothing if it is farther away than any walk.
inline std::optional<CellIndex> index_of(const Cell& cell) {
  CellIndex n;
  for (std::size_t i = 0; i < 3; ++i) {
    if (!cell[i].fits_int64()) return std::nullopt;
    n[i] = cell[i].int64();
  }
  return n;
}

/// Follows the particle through each lattice's own cells (the parallelepipeds centred at its points) in
/// binary64. In each cell it solves the quadratics of all obstacles that reach into the cell, which are
/// listed once per scene, and takes the earliest hit that is not beyond the cell's wall. If there is none, it
/// moves to the nearest wall and starts again there. The lattices are walked one after the other, each only
/// as far as the best time so far.
///
/// The cost is proportional to the free path times the number of obstacles in the list, and rounding errors
/// add up with every cell. After kMaxCells cells or kMaxTests tests in a lattice the answer is `undecided`.
class CellWalk : public Engine {
 public:
  static constexpr long kMaxCells = 10'000'000;
  static constexpr long kMaxTests = 100'000'000;      ///< of obstacles
  static constexpr double kMaxObstacles = 1'000'000;  ///< that reach into a cell, over all lattices

  /// Throws UnsupportedError for a scene that is beyond the walker.
  explicit CellWalk(const Scene& scene);
  ~CellWalk() override;

  /// Why the walker does not support a valid scene, or nothing. Does not list the obstacles.
  static std::optional<std::string> beyond(const Scene& scene);

 private:
  struct CellLattice;
  void first_hit_scaled(const Ray& ray, double max_time, Answer& answer) const override;
  std::vector<CellLattice> lattices_;
};

}  // namespace lorentz
