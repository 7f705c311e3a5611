// Drawn starts of free flights: the position, the direction, and the obstacle that the particle leaves.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <lorentz/query.hpp>
#include <lorentz/scene.hpp>
#include "question/cases/box.hpp"
#include "question/starts/ensemble.hpp"
#include "question/starts/surface.hpp"
#include "src/exchange/columns.hpp"

namespace lorentz::starts {

using flights::Ensemble;

/// Numbered candidates for starts. Start `index` depends only on the scene, the ensemble, the box, the seed
/// and the index, so that any number of threads, shards and machines draws the same starts, to the bit.
///
/// uniform: the point is uniform in the box (cases::Box::of), directions are isotropic. surface: an obstacle
/// is chosen with a probability proportional to its surface, over all lattices and atoms. In a superposition
/// its cell is chosen, too, among those around the box. The point is uniform on its surface, the direction
/// follows the cosine law about the outward normal, and `from` is that obstacle. These are the two measures
/// of a gas in equilibrium: at any moment, and after a collision.
///
/// For a superposition, a finite box stands for the whole scene. Lattices without a common period look
/// different from cell to cell, and the fewer cells a box has, the more coarsely it samples the relative
/// positions of the lattices. At r = 1e-4 of the spacing, 10^8 cells give the limit law.
///
/// Units: lengths are in the scene's unit; velocities have length 1 up to rounding. `draw` does not throw,
/// does not allocate unless a vector grows, and may be called by any number of threads.
class Candidates {
 public:
  static constexpr std::uint64_t kMostAttempts = 100'000;     ///< the most attempts worth making
  static constexpr cases::Series kUniform{"uniform starts"};  ///< the random numbers of uniform starts

  /// For a scene without flaws (flaw_of) and with independent vectors (oracle::dependence_in). `cells`: the
  /// approximate number of cells of the first lattice in the box of a superposition, 1 to 2^40. Throws
  /// InputError if the scene's numbers are so large or small that no starts can be drawn in binary64.
  Candidates(const Scene& scene, Ensemble ensemble, std::uint64_t seed,
             std::uint64_t cells = cases::Box::kCells);

  /// Candidate number `attempt` (0, 1, ..) of start `index`. It may lie inside an obstacle. The caller that
  /// flies it then gets the outcome `inside` and draws the next one; after kMostAttempts the caller reports
  /// nowhere_to_start().
  void draw(std::uint64_t index, std::uint64_t attempt, Query& start) const;

  /// The candidates of this attempt for many starts, a row for each index.
  void draw(std::span<const std::uint64_t> indices, std::uint64_t attempt, QueryRows& rows) const;

 private:
  struct Start {
    Vec x, v;
    std::int32_t lattice, atom;
    std::array<std::int64_t, 3> cell;
  };
  struct Obstacle {
    std::int32_t lattice, atom;
    Vec position;
    Surface surface;
    std::uint64_t below;  ///< chosen by 53 bits that are below this, but not below the previous one
  };
  struct Cells {
    std::array<Vec, 3> vectors, dual;
  };

  Start surface_start(cases::Random& random) const;
  Start start(std::uint64_t index, std::uint64_t attempt) const;
  /// Draws uniform starts in the lanes of the processor's vectors, as many as fill them. Returns how many.
  std::size_t draw_in_lanes(std::span<const std::uint64_t> indices, std::uint64_t attempt,
                            QueryRows& rows) const;
  const Obstacle& chosen_obstacle(cases::Random& random) const;
  void choose_by_surface(const Scene& scene);
  void count_cells(const Lattice& lattice);

  static constexpr cases::Series kSurface{"surface starts"};

  Ensemble ensemble_;
  std::uint64_t seed_;
  bool in_many_cells_;
  cases::Box box_;
  std::vector<Obstacle> obstacles_;  ///< for the ensemble `surface`
  std::vector<Cells> lattices_;
};

/// The message for `draws` candidates of one start that are all inside obstacles.
std::string nowhere_to_start(std::uint64_t draws);

}  // namespace lorentz::starts
