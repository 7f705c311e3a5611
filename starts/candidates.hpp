// Starts of free flights, drawn: where a particle is, where it goes, and which obstacle it leaves.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <lorentz/query.hpp>
#include <lorentz/scene.hpp>
#include "cases/box.hpp"
#include "starts/start_columns.hpp"
#include "starts/surface.hpp"
#include "statistics/theory/ensemble.hpp"

namespace lorentz::starts {

using flights::Ensemble;

/// Candidates for starts, numbered. Start `index` depends on the scene, the ensemble, the box, the seed and
/// the index only, so that any number of threads, shards and machines draws the same, to the bit.
///
/// uniform: the point is uniform in the box (cases::Box::of), directions are isotropic. surface: an obstacle
/// is chosen by its surface, over all lattices and atoms, of a superposition also its cell among those around
/// the box; the point is uniform on its surface, the direction by the cosine law about the outward normal,
/// and `from` is that obstacle. These are the two measures of a gas in equilibrium: at any moment, and after
/// a collision.
///
/// A box stands for all of a superposition. Lattices without a common period look different from cell to
/// cell, and obstacles of radius r are told apart only where relative places are: the fewer cells a box has,
/// the coarser. At r = 1e-4 of the spacing 10^8 cells give the limit law.
///
/// Units: lengths are the scene's; velocities have length 1 up to rounding. `draw` throws nothing, allocates
/// nothing where nothing grows, and may be called by any number of threads.
class Candidates {
 public:
  static constexpr std::uint64_t kMostAttempts = 100'000;  ///< that are worth a try

  /// For a scene without flaws (flaw_of) and with independent vectors (oracle::dependence_in). `cells`: about
  /// how many cells of the first lattice the box of a superposition has, 1 to 2^40. Throws InputError if
  /// the scene's numbers are so large or small that no starts can be drawn in binary64.
  Candidates(const Scene& scene, Ensemble ensemble, std::uint64_t seed,
             std::uint64_t cells = cases::Box::kCells);

  /// Candidate number `attempt` (0, 1, ..) of start `index`. It may lie inside an obstacle: who flies it sees
  /// the outcome `inside`, and draws the next one; after kMostAttempts of them there is nowhere_to_start().
  void draw(std::uint64_t index, std::uint64_t attempt, Query& start) const;

  /// The candidates 0 of the starts from `first` on, `count` of them.
  void draw(std::uint64_t first, std::size_t count, StartColumns& starts) const;

  /// One candidate in the place of another.
  void draw(std::uint64_t index, std::uint64_t attempt, StartColumns& starts, std::size_t place) const;

  int dimension() const { return box_.dimension; }
  Ensemble ensemble() const { return ensemble_; }

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
    std::uint64_t below;  ///< chosen by 53 bits below this, and not below that of the obstacle before
  };
  struct Cells {
    std::array<Vec, 3> vectors, dual;
  };

  Start uniform_start(cases::Random& random) const;
  Start surface_start(cases::Random& random) const;
  Start start(std::uint64_t index, std::uint64_t attempt) const;
  const Obstacle& chosen_obstacle(cases::Random& random) const;
  void choose_by_surface(const Scene& scene);
  void count_cells(const Lattice& lattice);

  Ensemble ensemble_;
  std::uint64_t seed_;
  bool in_many_cells_;
  cases::Box box_;
  std::vector<Obstacle> obstacles_;  ///< of `surface`
  std::vector<Cells> lattices_;
};

/// What to say when `draws` candidates of one start were all inside obstacles.
std::string nowhere_to_start(std::uint64_t draws);

}  // namespace lorentz::starts
