// The plan of a run: which flights to fly.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <lorentz/scene.hpp>
#include "starts/candidates.hpp"

namespace lorentz::flights {

/// Wide enough for flights of 10^4 cells, so that they find no two places of a superposition alike.
inline constexpr std::uint64_t kCellsOfBox = 100'000'000;

/// The flights 0 to count - 1 from the drawn starts of a scene.
struct FlightsPlan {
  Scene scene;  ///< without flaws
  std::string engine = "batch";
  Ensemble from = Ensemble::uniform;
  std::uint64_t seed = 0, count = 0;
  std::uint64_t cells = kCellsOfBox;  ///< of the first lattice, in the box with the starts of a superposition

  std::uint64_t blocks() const;

  /// The whole plan as names and values. Two runs can be added up only if these agree.
  std::vector<std::pair<std::string, std::string>> words() const;
};

/// The exponent of the unit in which times are counted. The unit is near the mean free path of a dilute gas
/// of these obstacles. Answers do not depend on it.
int unit_exponent(const Scene& scene);

}  // namespace lorentz::flights
