// A stretch of queries that passes through the lanes together. Private to the batch engine.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <lorentz/flight.hpp>
#include "src/engines/reduction/bravais.hpp"

namespace lorentz {

/// kStretch queries fit the first-level cache. Lanes take at most kMaxLanes at a time.
inline constexpr std::size_t kStretch = 128, kMaxLanes = 16;

/// Beyond this exponent lengths are scaled in several steps, which lanes do not do.
inline constexpr int kMaxLaneExponent = 400;

/// What a kernel reads and writes: columns of length `count`, rounded up to whole vectors. They are the
/// caller's own or those of a StretchBuffer.
struct Stretch {
  std::size_t count = 0;

  // Input. `from_cell` is in the scene's primitive vectors.
  const double *x[3], *v[3];
  const double* max_time;                        ///< null: no limits
  const std::int32_t *from_lattice, *from_atom;  ///< null: no query leaves an obstacle
  const std::int64_t* from_cell[3];
  bool rounded = false;  ///< which times are wanted: Reduction::Time

  // Output.
  double* time;
  std::int64_t* cell[3];
  std::int32_t* atom;  ///< number in the prepared scene; for scenes with several
  Outcome* outcome;
  Stage* stage;
  bool* time_is_rounded;

  /// The queries that are left to single flights. Their output has no meaning.
  int left_over[kStretch];
  std::size_t left_count = 0;
};

/// Columns in place of those that the caller does not have, or does not have in whole vectors.
struct StretchBuffer {
  template <class T>
  using Column = T[kStretch + kMaxLanes];

  alignas(64) Column<double> x[3], v[3], max_time, time;
  alignas(64) Column<std::int64_t> from_cell[3], cell[3];
  alignas(64) Column<std::int32_t> from_lattice, from_atom, atom;
  Column<Outcome> outcome;
  Column<Stage> stage;
  Column<bool> time_is_rounded;
};

using StretchKernel = void (*)(const PreparedScene&, Stretch&);

/// The kernels for one set of instructions. Null: there is no kernel, and single flights are used.
struct StretchKernels {
  const char* instructions;
  StretchKernel balls[2], ellipsoids[2];  ///< in the plane, in space

  /// Rows and layers are flown one at a time, and so are single ellipsoids, and what overlaps its translates.
  StretchKernel of(const PreparedScene& scene) const {
    const int dimension = scene.atoms[0].dimension;
    const bool single_balls = scene.most_rank == 0 && !scene.ellipsoids;
    if (scene.strides || (scene.least_rank < dimension && !single_balls)) return nullptr;
    return (scene.ellipsoids ? ellipsoids : balls)[dimension - 2];
  }
};

/// The kernels that this processor can run, best first. The last entry has none.
std::vector<StretchKernels> stretch_kernels();

/// The kernels for one kind of scene, in the order of the sets of instructions (kernels-inl.hpp).
struct BuiltKernel {
  std::int64_t target;  ///< Highway's number for the set
  StretchKernel kernel;
};
std::vector<BuiltKernel> kernels_of_balls_in_plane(), kernels_of_balls_in_space(),
    kernels_of_ellipsoids_in_plane(), kernels_of_ellipsoids_in_space();

}  // namespace lorentz
