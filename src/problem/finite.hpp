// Whether all components of a vector are finite. Private to src/problem.
#pragma once

#include <cmath>

#include <lorentz/vec.hpp>

namespace lorentz {

inline bool all_finite(const Vec& a) {
  return std::isfinite(a[0]) && std::isfinite(a[1]) && std::isfinite(a[2]);
}

}  // namespace lorentz
