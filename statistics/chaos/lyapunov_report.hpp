// Reports of Lyapunov exponents as text, CSV and JSON, with theory for comparison.
#pragma once

#include <optional>
#include <string>

#include "statistics/chaos/lyapunov.hpp"
#include "statistics/theory/laws.hpp"

namespace lorentz::chaos {

struct LyapunovReport {
  LyapunovReport(std::string scene_name, LyapunovPlan its_plan, Lyapunov what_was_found);

  std::string scene;  ///< its name as given by the user
  LyapunovPlan plan;
  Lyapunov found;
  flights::MeanFreePath exact;
  std::optional<double> limit;  ///< as r -> 0: the first exponent (2D), the sum of the positive ones (3D)

  /// Exponent k per unit of time, from the exact mean free path where it is known.
  Estimate flow(std::size_t k) const;

  std::string table() const;
  std::string csv() const;   ///< one row per exponent
  std::string json() const;  ///< one object on one line
};

}  // namespace lorentz::chaos
