// The second oracle: cell by cell, exact, slow, without any cleverness. It exists to catch the first one, and
// shares nothing with it but the problem statement: neither code nor arithmetic. It computes with another
// library's numbers.
#pragma once

#include <cstdint>
#include <limits>
#include <string>

#include <lorentz/answer.hpp>
#include <lorentz/query.hpp>
#include <lorentz/scene.hpp>

namespace lorentz::oracle {

/// First hits cell by cell, in exact arithmetic.
///
///  1. An outcome other than `undecided` is exact, the time correctly rounded.
///     held by "Oracle equals walk on generic scenes",
///             "Walk rounds ties to even"
///  2. Any number of threads may ask one walk.
///     held by "Many threads may ask one engine, oracle, walk and judge"
///
/// Units: as in Query. Cost: microseconds a cell and an atom, so it grows with the distance, and with
/// 1/r^(d-1).
class Walk {
 public:
  /// Throws InputError for a scene with a flaw, or with dependent vectors. After `max_cells` cells of one atom's
  /// lattice the walk gives up.
  explicit Walk(Scene scene, std::int64_t max_cells = 100'000);

  /// The exact answer, time correctly rounded, or `later` if nothing is entered before `max_time` (an
  /// infinity: no limit), which is compared with the exact time; `undecided` if the flight passes more than
  /// max_cells cells, or if a start beyond 2^50 cells or an obstacle beyond 100 cells makes it not worth
  /// trying; `error` for an invalid query.
  Answer first_hit(const Query& query, double max_time = std::numeric_limits<double>::infinity()) const;

 private:
  Scene scene_;
  std::int64_t max_cells_;
};

/// The libraries that the walk computes with, and their versions.
std::string walk_libraries();

}  // namespace lorentz::oracle
