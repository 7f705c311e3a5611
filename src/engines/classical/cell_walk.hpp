// The classical algorithm where one obstacle a cell is not enough: any lattices, any motif, overlaps,
// ellipsoids.
#pragma once

#include <array>
#include <cstdint>
#include <memory>

#include <lorentz/engine.hpp>

namespace lorentz {

using CellIndex = std::array<std::int64_t, 3>;

/// Follows the particle through each lattice's own cells (the parallelepipeds centred at its points) in
/// binary64: solves the quadratics of all obstacles that reach into the cell, which are listed once a scene,
/// and takes the earliest that is not beyond the cell's wall; else moves to the nearest wall and starts there
/// anew. The lattices are walked one after the other, each only as far as the best time so far. Costs are
/// proportional to the free path times the obstacles in the list, and rounding errors add up with every cell.
/// After kMaxCells or kMaxTests in a lattice it says `undecided`.
class CellWalk : public Engine {
 public:
  static constexpr long kMaxCells = 10'000'000;
  static constexpr long kMaxTests = 100'000'000;      ///< of obstacles
  static constexpr double kMaxObstacles = 1'000'000;  ///< that reach into a cell, over all lattices

  /// Throws UnsupportedError for a scene that is beyond the walker.
  explicit CellWalk(const Scene& scene);
  ~CellWalk() override;

  /// Why the walker does not do a scene without flaws, or nothing. Lists nothing.
  static std::optional<std::string> beyond(const Scene& scene);

 private:
  struct CellLattice;
  void first_hit_scaled(const Ray& ray, double max_time, Answer& answer) const override;
  std::vector<CellLattice> lattices_;
};

}  // namespace lorentz
