// The second oracle: cell by cell, exact, slow and simple. It exists to catch errors of the first oracle, and
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
///  1. An outcome other than `undecided` is exact, and the time is correctly rounded.
///  2. Any number of threads may use one walk.
///
/// Units: as in Query. Cost: microseconds per cell and atom, so it grows with the distance and with
/// 1/r^(d-1).
class Walk {
 public:
  /// Throws InputError if the scene is invalid or has dependent vectors. The walk gives up after `max_cells`
  /// cells of one atom's lattice.
  explicit Walk(Scene scene, std::int64_t max_cells = 100'000);

  /// The exact answer, with the time correctly rounded. It is `later` if nothing is entered before `max_time`
  /// (infinity: no limit), which is compared with the exact time. It is `undecided` if the flight passes more
  /// than `max_cells` cells, or if a start beyond 2^50 cells or an obstacle that reaches beyond 100 cells
  /// makes a walk not worth trying. An invalid query yields `error`.
  Answer first_hit(const Query& query, double max_time = std::numeric_limits<double>::infinity()) const;

 private:
  Scene scene_;
  std::int64_t max_cells_;
};

/// Names and versions of the libraries that the walk uses.
std::string walk_libraries();

}  // namespace lorentz::oracle
