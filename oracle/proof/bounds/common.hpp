// What several claims are made of.
#pragma once

#include <array>

#include "oracle/proof/bounds/formula_claim.hpp"
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

/// Component i of b x c.
inline SizedTerms cross_terms(const std::string& b, const std::string& c, int i) {
  const auto product = [&](int j, int k) {
    return term("exact_" + numbered(b, j % 3) + " * exact_" + numbered(c, k % 3));
  };
  return whole(product(i + 1, i + 2) - product(i + 2, i + 1));
}

/// a . (b x c).
inline SizedTerms volume_terms(const std::string& a, const std::string& b, const std::string& c) {
  const auto one = [&](int i) { return ("exact_" + numbered(a, i)) * cross_terms(b, c, i); };
  return one(0) + one(1) + one(2);
}

}  // namespace lorentz::bounds
