// Lyapunov exponents for people and for programs, with theory beside them.
#pragma once

#include <optional>
#include <string>

#include "statistics/chaos/lyapunov.hpp"
#include "statistics/theory/laws.hpp"

namespace lorentz::chaos {

struct LyapunovReport {
  LyapunovReport(std::string scene_name, LyapunovPlan its_plan, Lyapunov what_was_found);

  std::string scene;  ///< its name, as it was asked for
  LyapunovPlan plan;
  Lyapunov found;
  flights::MeanFreePath exact;
  std::optional<double> limit;  ///< of the first exponent (2D) or the sum of those above zero (3D), as r -> 0

  /// Exponent k a unit of time: by the exact mean free path where it is known.
  Estimate flow(std::size_t k) const;

  std::string table() const;
  std::string csv() const;   ///< the exponents, a row each
  std::string json() const;  ///< one object, in a line
};

}  // namespace lorentz::chaos
