// The same scene and query written otherwise: read, they must be the same numbers.
#pragma once

#include <optional>
#include <string>

#include <lorentz/problem.hpp>
#include "cases/random.hpp"

namespace lorentz::fuzz {

/// A line that is not read as what it says.
struct Misreading {
  std::string notation;  ///< like "digits %.20f"
  std::string line;
};

/// Writes the scene and the query as lines of a query stream, in a notation that is drawn: digits, order and
/// escapes of keys, blanks, line ends. Nothing if both are read back as they are.
std::optional<Misreading> misreading(cases::Random& random, const Scene& scene, const Query& query);

}  // namespace lorentz::fuzz
