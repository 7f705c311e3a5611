// Decisions about a number whose error is bounded. formulas.hpp has the formulas for such numbers, bounds.hpp
// the bounds.
#pragma once

#include <cmath>

#include "src/engines/reduction/bounds.hpp"

namespace lorentz {

/// Yes, no, or not certain at this precision.
enum class Decision { yes, no, doubtful };

/// Is |value| < limit, where value errs by at most error and limit by limit_error, relatively?
inline Decision is_below(double value, double limit, double error, double limit_error = kRho * kRoundoff) {
  const double size = std::fabs(value), spread = error + limit_error * limit;
  if (size + spread < limit) return Decision::yes;
  if (size - spread > limit) return Decision::no;
  return Decision::doubtful;
}

/// Is value > 0, where it errs by at most error?
inline Decision is_positive(double value, double error) {
  return value > error ? Decision::yes : value < -error ? Decision::no : Decision::doubtful;
}

}  // namespace lorentz
