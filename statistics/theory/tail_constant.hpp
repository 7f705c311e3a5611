// The constant of a tail that is approached slowly, from counts in bins (fit.hpp defines bins).
#pragma once

#include <cstdint>
#include <optional>
#include <span>

namespace lorentz::flights {

/// P(path > t) = constant * t^-power (1 + O(t^-approach)).
struct SlowTail {
  double power = 1, approach = 1;
};

struct TailConstant {
  double value = 0, error = 0;  ///< one standard error, statistical only
  double from = 0;              ///< measured on paths longer than this edge
  std::uint64_t count = 0;      ///< the number of these paths
};

/// The extrapolated constant C. The model: the number of paths expected between a and b is `total` times the
/// difference of C t^-power + D t^-(power + approach) between a and b. C and D come from least squares,
/// weighted by the statistical errors, over the bins from the first edge on that is not below `from`. Empty
/// if fewer than 4 bins have at least 25 paths after merging with their neighbours. Throws
/// std::invalid_argument for bad bins.
std::optional<TailConstant> tail_constant(std::span<const double> edges,
                                          std::span<const std::uint64_t> counts, std::uint64_t total,
                                          const SlowTail& tail, double from);

/// The t from which to measure the constant in 3D, in mean free paths between collisions. The terms that the
/// model leaves out bias C like 1/t, and the statistical error grows like sqrt(t^power / total). The two stay
/// in a fixed proportion if t grows like total^(1 / (2 + power)).
double tail_begins(double power, std::uint64_t total);

}  // namespace lorentz::flights
