// What is to be flown.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <lorentz/scene.hpp>
#include "starts/candidates.hpp"

namespace lorentz::flights {

/// Wide enough for flights of 10^4 cells, so that they see no two places of a superposition alike.
inline constexpr std::uint64_t kCellsOfBox = 100'000'000;

/// The flights 0 to count - 1 from the drawn starts of a scene.
struct FlightsPlan {
  Scene scene;  ///< without flaws
  std::string engine = "batch";
  Ensemble from = Ensemble::uniform;
  std::uint64_t seed = 0, count = 0;
  std::uint64_t cells =
      kCellsOfBox;  ///< of the first lattice, in the box in which a superposition's starts lie

  std::uint64_t blocks() const;

  /// All of it, as names and values: what two runs have in common that can be added up.
  std::vector<std::pair<std::string, std::string>> words() const;
};

/// The exponent of the unit in which times are counted: near the mean free path of a dilute gas of these
/// obstacles, and nothing that answers depend on.
int unit_exponent(const Scene& scene);

}  // namespace lorentz::flights
