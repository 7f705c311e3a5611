// What several claims are made of.
#pragma once

#include <array>

#include "proof/bounds/formula_claim.hpp"
#include "src/engines/reduction/bounds.hpp"
#include "src/engines/reduction/formulas.hpp"

namespace lorentz::bounds {

/// A high part: the binary64 nearest to its number, so one roundoff off.
inline constexpr double kHigh = 1;

inline const std::string kSpeed = "(v0 * v0 + v1 * v1 + v2 * v2)";

inline std::string numbered(const std::string& name, int i) {
  return name + std::to_string(i);
}

/// A vector of high parts.
inline std::array<Symbol, 3> vector_of(Inputs& in, const std::string& name) {
  std::array<Symbol, 3> a;
  for (int i = 0; i < 3; ++i) a[i] = in.rounded(numbered(name, i), kHigh);
  return a;
}

/// Component i of b x c, and the sizes of its terms.
inline std::string exact_cross(const std::string& b, const std::string& c, int i) {
  const int j = (i + 1) % 3, k = (i + 2) % 3;
  return "(exact_" + numbered(b, j) + " * exact_" + numbered(c, k) + " - exact_" + numbered(b, k) +
         " * exact_" + numbered(c, j) + ")";
}
inline std::string size_of_cross(const std::string& b, const std::string& c, int i) {
  const int j = (i + 1) % 3, k = (i + 2) % 3;
  return "(Rabs (exact_" + numbered(b, j) + " * exact_" + numbered(c, k) + ") + Rabs (exact_" +
         numbered(b, k) + " * exact_" + numbered(c, j) + "))";
}

/// a . (b x c).
inline std::string exact_volume(const std::string& a, const std::string& b, const std::string& c) {
  std::string sum;
  for (int i = 0; i < 3; ++i)
    sum += (i ? " + exact_" : "exact_") + numbered(a, i) + " * " + exact_cross(b, c, i);
  return sum;
}
inline std::string size_of_volume(const std::string& a, const std::string& b, const std::string& c) {
  std::string sum;
  for (int i = 0; i < 3; ++i)
    sum += (i ? " + Rabs exact_" : "Rabs exact_") + numbered(a, i) + " * " + size_of_cross(b, c, i);
  return sum;
}

}  // namespace lorentz::bounds
