// Starts of free flights, drawn: where a particle is, where it goes, and which obstacle it leaves.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <lorentz/problem.hpp>
#include "cases/box.hpp"
#include "flights/starts/start_columns.hpp"
#include "flights/starts/surface.hpp"
#include "flights/theory/ensemble.hpp"

namespace lorentz::flights {

/// Starts, numbered. Start `index` depends on the scene, the ensemble, the box, the seed and the index only,
/// so that any number of threads, shards and machines draws the same, to the bit.
///
/// uniform: the point is uniform in a cell of the first lattice, of a superposition in a box of such cells;
/// directions are isotropic. surface: the obstacle is chosen by its surface, over all lattices and atoms, and
/// of a superposition by its place in the box, the point is uniform on its surface, the direction by the
/// cosine law about the outward normal, and `from` is that obstacle. In equilibrium one ensemble is what
/// flights find in passing, the other what follows a collision.
///
/// The points are those of a box that a superposition does not repeat itself in. Near obstacles much smaller
/// than the cell, free paths may be as long as a box is wide: of incommensurate lattices take a wider one.
///
/// Units: lengths are the scene's; velocities have length 1 up to rounding. Throws nothing but what is said,
/// allocates nothing where nothing grows, and may be shared by threads.
class Starts {
 public:
  static constexpr std::uint64_t kCells = 1000;  ///< of a superposition's box, unless told otherwise
  static constexpr std::uint64_t kMostAttempts = 100'000;  ///< that are worth a try

  /// For a scene without flaws (flaw_of) and with independent vectors (oracle::dependence_in). `cells`: about
  /// how many cells of the first lattice the box of a superposition has, 1 to 2^40. Throws InputError if
  /// the scene's numbers are so large or small that no starts can be drawn in binary64.
  Starts(const Scene& scene, Ensemble ensemble, std::uint64_t seed, std::uint64_t cells = kCells);

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

/// The box of about so many cells: its sides, in cells. Of 1000: 40 and 25, or 10, 10 and 10.
Vec box_sides(std::uint64_t cells, int dimension);

/// What to say when `draws` candidates of one start were all inside obstacles.
std::string nowhere_to_start(std::uint64_t draws);

}  // namespace lorentz::flights
