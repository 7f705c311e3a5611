// What kernels and their host share: queries in columns, and where their results go.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

#include <lorentz/flight.hpp>
#include "src/engines/reduction/bravais.hpp"

namespace lorentz::gpu {

/// The rows [first, first + count) of columns that the card can read and write. A null column is not there.
struct CardColumns {
  const Bravais* atoms;
  std::uint64_t atom_count;
  double unit, inverse_unit;  ///< of PreparedScene
  std::uint64_t first, count;

  const double *x[3], *v[3];
  std::uint64_t x_step, v_step;  ///< from one row to the next
  const double* max_time;
  const std::int32_t *from_lattice, *from_atom;
  const std::int64_t* from_cell[3];

  double* time;
  std::int64_t* cell[3];
  std::int32_t *lattice, *atom;
  std::int32_t no_lattice;  ///< the lattice of rows without an obstacle
  Outcome* outcome;         ///< `undecided`: the row is left to the processor, and has no other results
  Stage* stage;
  bool* time_is_rounded;
  std::uint64_t* left;  ///< how many rows are left, and behind it which, in any order
};

/// Cells of obstacles that rows leave are beyond 64-bit arithmetic from here on, and so are entries of
/// Bravais::inverse. Their rows are left.
inline constexpr std::int64_t kFarCell = std::int64_t{1} << 31, kFarInverse = std::int64_t{1} << 20;

/// A direction of eighths, or a few units in the last place beside it, as bits of the start say. (A component
/// that is not 0 is at least 1/8 then.)
inline void make_hard(const double* x, double* v, int dimension) {
  double largest = 0;
  for (int k = 0; k < dimension; ++k) {
    v[k] = std::nearbyint(8 * v[k]) / 8;
    largest = largest < std::fabs(v[k]) ? std::fabs(v[k]) : largest;
  }
  if (largest == 0) v[0] = 1;
  const auto bits = std::bit_cast<std::uint64_t>(x[0]);
  for (int k = 0; k < dimension; ++k) v[k] *= 1 + static_cast<double>(bits >> (8 + 3 * k) & 7) * 0x1p-52;
}

}  // namespace lorentz::gpu
