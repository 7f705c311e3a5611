// Measures of difficulty, and the curves that show where an engine begins to fail.
#pragma once

#include <array>

#include "report/calls.hpp"

namespace lorentz::judge {

/// What makes a question hard.
enum class Measure {
  call,      ///< by how many radii the line enters or misses the obstacle in question
  distance,  ///< from the start to the centre of the obstacle in question, in its radii
  flight,    ///< length of the flight to the obstacle that is hit, in lattice vectors
  start,     ///< distance from the origin to the start, in lattice vectors
  radius     ///< smallest radius, in lattice vectors
};
inline constexpr int kMeasures = 5;

inline const char* name_of(Measure measure) {
  constexpr const char* kNames[kMeasures] = {
      "radii by which the line enters or misses the obstacle in question",
      "radii from the start to the obstacle in question", "length of the flight, in lattice vectors",
      "distance of the start from the origin, in lattice vectors", "smallest radius, in lattice vectors"};
  return kNames[static_cast<int>(measure)];
}

/// One curve for each measure.
using Curves = std::array<report::Calls, kMeasures>;

}  // namespace lorentz::judge
