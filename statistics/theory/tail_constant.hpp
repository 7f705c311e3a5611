// The constant of a tail that is approached slowly, from counts in bins (fit.hpp says what bins are).
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
  double value = 0, error = 0;  ///< one standard error, of chance alone
  double from = 0;              ///< of paths longer than this, an edge,
  std::uint64_t count = 0;      ///< so many
};

/// The constant, extrapolated: of total paths as many are expected between a and b as total times the
/// difference there of C t^-power + D t^-(power + approach); C and D by least squares, weighted by chance,
/// over the bins from the first edge on that is not below `from`. Nothing if fewer than 4 bins have 25 paths,
/// or more with their neighbours. Bad bins are an std::invalid_argument.
std::optional<TailConstant> tail_constant(std::span<const double> edges,
                                          std::span<const std::uint64_t> counts, std::uint64_t total,
                                          const SlowTail& tail, double from);

/// From where on to measure it in 3D, in mean free paths from collision to collision. What the two terms
/// leave out biases C like 1/t, and chance grows like sqrt(t^power / total): in a fixed proportion they stay
/// if t grows like total^(1 / (2 + power)).
double tail_begins(double power, std::uint64_t total);

}  // namespace lorentz::flights
