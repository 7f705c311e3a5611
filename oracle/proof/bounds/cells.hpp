// The claims of cells and matrices.
#pragma once

#include "oracle/proof/bounds/common.hpp"

namespace lorentz::bounds {

/// A coordinate of a vector, where kappa is 1: its volume errs by 11.4 then, and that is worst.
inline FormulaClaim volume_of_cell() {
  Inputs in;
  const std::array<Symbol, 3> a = vector_of(in, "a"), b = vector_of(in, "b"), c = vector_of(in, "c");
  return in
      .claim({"kCoordinate", kCoordinate, "11"}, "volume_of_cell", volume_of(a, cross_product(b, c)),
             volume_terms("a", "b", "c"))
      .taken(1.41422, "length of b x c");
}
inline FormulaClaim coordinate_in_cell() {
  Inputs in;
  const std::array<Symbol, 3> b = vector_of(in, "b"), c = vector_of(in, "c"), a = vector_of(in, "a"),
                              cross = cross_product(b, c);
  const Symbol volume = in.rounded("volume", 11.4);
  in.given("0 < exact_volume");
  const std::array<Symbol, 3> dual{cross[0] / volume, cross[1] / volume, cross[2] / volume};
  const auto one = [](int i) {
    return cross_terms("b", "c", i) / "exact_volume" * ("exact_" + numbered("a", i));
  };
  return in.claim({"kCoordinate", kCoordinate, "20"}, "coordinate_in_cell", volume_of(dual, a),
                  one(0) + one(1) + one(2));
}

/// The norm of a matrix.
inline FormulaClaim frobenius_norm() {
  Inputs in;
  Symbol a[9];
  std::string sum;
  for (int i = 0; i < 9; ++i) {
    const std::string n = "a" + std::to_string(i);
    a[i] = in.number(n), sum += " + " + n + " * " + n;
  }
  const std::string exact = "sqrt (" + sum.substr(3) + ")";
  return in.claim({"kAmple", kAmple / kRoundoff, "5.5"}, "frobenius_norm", sqrt(square_of(a)), exact, exact);
}

inline std::vector<FormulaClaim> of_cells() {
  return {volume_of_cell(), coordinate_in_cell(), frobenius_norm()};
}

}  // namespace lorentz::bounds
