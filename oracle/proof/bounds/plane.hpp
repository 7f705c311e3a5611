// The claims of 2D.
#pragma once

#include "oracle/proof/bounds/common.hpp"

namespace lorentz::bounds {

inline FormulaClaim height_of_obstacle() {
  Inputs in;
  const Symbol y = in.number("y"), n = in.number("n"), D_R = in.rounded("D_R", 1), m = in.number("m"),
               D_L = in.rounded("D_L", 1);
  return in.claim({"kHeight", kHeight, "4"}, "height_of_obstacle", height_in_row(y, n, D_R, m, D_L),
                  "(y + n * exact_D_R) - m * exact_D_L",
                  "Rabs y + Rabs (n * exact_D_R) + Rabs (m * exact_D_L)");
}

/// On the unit lattices S of an arm is n_0 v_0 + n_1 v_1.
inline FormulaClaim along_on_unit_lattice() {
  Inputs in;
  const Symbol v[2] = {in.number("v0"), in.number("v1")}, s = in.number("s"), n = in.number("n"),
               R[2] = {in.number("R0"), in.number("R1")}, m = in.number("m"),
               L[2] = {in.number("L0"), in.number("L1")};
  return in.claim(
      {"kAlongOnUnit", kAlongOnUnit, "8"}, "along_on_unit_lattice",
      sum_along(s, n, sum_of_products(R[0], v[0], R[1], v[1]), m, sum_of_products(L[0], v[0], L[1], v[1])),
      term("s") + "n" * whole(term("R0 * v0") + term("R1 * v1")) +
          "m" * whole(term("L0 * v0") + term("L1 * v1")));
}

/// Elsewhere it is n_0 S_0 + n_1 S_1, and S_i is v . B_i, whose components are rounded.
inline Symbol along_basis(Inputs& in, const Symbol (&v)[2], const std::string& i) {
  const Symbol y = in.rounded("y" + i, 1), x = in.rounded("x" + i, 1);
  return sum_of_products(v[0], x, v[1], y);
}
inline SizedTerms along_terms(const std::string& arm) {
  const auto one = [&](const std::string& i) {
    return (arm + i) * whole(term("v0 * exact_x" + i) + term("v1 * exact_y" + i));
  };
  return whole(one("0") + one("1"));
}
inline FormulaClaim along_in_plane() {
  Inputs in;
  const Symbol v[2] = {in.number("v0"), in.number("v1")}, S0 = along_basis(in, v, "0"),
               S1 = along_basis(in, v, "1"), s = in.number("s"), n = in.number("n"),
               R[2] = {in.number("R0"), in.number("R1")}, m = in.number("m"),
               L[2] = {in.number("L0"), in.number("L1")};
  return in.claim(
      {"kAlong", kAlong, "8"}, "along_in_plane",
      sum_along(s, n, sum_of_products(R[0], S0, R[1], S1), m, sum_of_products(L[0], S0, L[1], S1)),
      term("s") + "n" * along_terms("R") + "m" * along_terms("L"));
}

/// r |v|. A comparison with it is without a rounding of its own (Errors.v, above).
inline FormulaClaim width_in_plane() {
  Inputs in;
  const Symbol r = in.number("r"), v[2] = {in.number("v0"), in.number("v1")};
  const std::string exact = "r * sqrt (v0 * v0 + v1 * v1)";
  return in
      .claim({"kRho", kRho, "3.5"}, "width_in_plane", width_of(r, square_of(v)), exact,
             "Rabs r * sqrt (v0 * v0 + v1 * v1)")
      .within({{"r", -50, 0}, {"v0", -450, 1}, {"v1", -450, 1}});
}

/// A = |v|^2 times the area of a cell, whose two terms are 2 / sqrt(3) of it at most.
inline constexpr double kVolumeErrs = 4.7;
inline Symbol inverse_of_area(Inputs& in, const Symbol (&v)[2]) {
  in.given("0 < v0 * v0 + v1 * v1"), in.given("0 < exact_area");
  return Symbol("1") / (square_of(v) * in.rounded("area", kVolumeErrs));
}
inline const std::string kArea = "((v0 * v0 + v1 * v1) * exact_area)";

inline FormulaClaim number_of_row(const Constant& constant, const std::string& name) {
  Inputs in;
  const Symbol v[2] = {in.number("v0"), in.number("v1")}, S0 = along_basis(in, v, "0"),
               S1 = along_basis(in, v, "1"), L[2] = {in.number("L0"), in.number("L1")},
               S_L = sum_of_products(L[0], S0, L[1], S1), y = in.number("y"), D_L = in.rounded("D_L", 1),
               s = in.number("s");
  const SizedTerms terms = whole(along_terms("L") * "y" + term("exact_D_L * s")) / kArea;
  return in.claim(constant, name, row_number(S_L, y, D_L, s, inverse_of_area(in, v)), "- " + terms.exact,
                  terms.size);
}
inline FormulaClaim row_beside_start() {
  return number_of_row({"kRowNumber", kRowNumber, "16"}, "row_beside_start");
}
inline FormulaClaim row_beside_start_widened() {
  return number_of_row({"kRowSlop", kRowSlop / kRoundoff / 0x1p20, "16"}, "row_beside_start_widened")
      .taken(1, "terms below 2^20");
}

/// On the unit lattices of discs A = |v|^2.
inline FormulaClaim row_beside_start_on_square() {
  Inputs in;
  const Symbol v[2] = {in.number("v0"), in.number("v1")}, L[2] = {in.number("L0"), in.number("L1")},
               S_L = sum_of_products(L[0], v[0], L[1], v[1]), y = in.number("y"), D_L = in.number("D_L"),
               s = in.number("s");
  in.given("0 < v0 * v0 + v1 * v1");
  const SizedTerms terms =
      whole(whole(term("L0 * v0") + term("L1 * v1")) * "y" + term("D_L * s")) / "(v0 * v0 + v1 * v1)";
  return in.claim({"kRowNumber", kRowNumber, "16"}, "row_beside_start_on_square",
                  row_number(S_L, y, D_L, s, Symbol("1") / square_of(v)), "- " + terms.exact, terms.size);
}

inline FormulaClaim entry_into_strip() {
  Inputs in;
  const Symbol v[2] = {in.number("v0"), in.number("v1")}, r = in.number("r"), y = in.number("y"),
               n = in.number("n"), D_R = in.rounded("D_R", 1), D_L = in.rounded("D_L", 1);
  in.given("0 < exact_D_L");
  return in.claim({"kRowEntry", kRowEntry, "8"}, "entry_into_strip",
                  entry_of_row(stepped(y, n, D_R), width_of(r, square_of(v)), Symbol("1") / D_L),
                  "(y + n * exact_D_R - r * sqrt (v0 * v0 + v1 * v1)) / exact_D_L",
                  "(Rabs y + Rabs (n * exact_D_R) + Rabs r * sqrt (v0 * v0 + v1 * v1)) / Rabs exact_D_L");
}

/// Rows that a unit of s passes: two more roundings raise it.
inline FormulaClaim slope_of_rows() {
  Inputs in;
  const Symbol v[2] = {in.number("v0"), in.number("v1")}, raised = in.rounded("D_L", 3);
  return in
      .claim({"kRowSlope", kRowSlope / kRoundoff, "12"}, "slope_of_rows",
             row_slope(raised, inverse_of_area(in, v)), "exact_D_L * (1 / " + kArea + ")",
             "Rabs exact_D_L / Rabs " + kArea)
      .within({{"D_L", -400, 1}, {"v0", -200, 1}, {"v1", -200, 1}, {"area", -100, 100}});
}

/// Where S_L is not small beside its terms.
inline FormulaClaim passing_of_start() {
  Inputs in;
  const Symbol s = in.number("s"), n = in.number("n"), S_R = in.rounded("S_R", 5), S_L = in.rounded("S_L", 5);
  in.given("0 < exact_S_L");
  return in
      .claim({"kSlop2d", kSlop2d / kRoundoff / 0x1p18, "14"}, "passing_of_start",
             passing_of_row(s, n, S_R, Symbol("1") / S_L), "- (s + n * exact_S_R) / exact_S_L",
             "(Rabs s + Rabs (n * exact_S_R)) / Rabs exact_S_L")
      .taken(1, "quotients below 2^18");
}

/// w = N v of an ellipse: relative to |N| |v|, which is at most the condition times |w|.
inline FormulaClaim velocity_in_shape() {
  Inputs in;
  const Symbol N0 = in.rounded("N0", 1), N1 = in.rounded("N1", 1), v0 = in.number("v0"), v1 = in.number("v1");
  return in.claim({"kRhoOfShape", kRhoOfShape, "3"}, "velocity_in_shape", sum_of_products(N0, v0, N1, v1),
                  term("exact_N0 * v0") + term("exact_N1 * v1"));
}

/// The width of the most slender ellipse that is done: |w|^2 errs by twice what w does, and by 2 of its own;
/// the scale is a cofactor's inverse.
inline FormulaClaim width_of_ellipse() {
  Inputs in;
  const Symbol r = in.number("r"), w2 = in.rounded("w2", 2 * 3.001 * kMaxCondition + 2.001),
               scale = in.rounded("scale", 2);
  in.given("0 < exact_w2");
  return in.claim({"kRho, kRhoOfShape", kRho + kRhoOfShape * kMaxCondition, "49157"}, "width_of_ellipse",
                  width_of(r, w2) * scale, "r * sqrt exact_w2 * exact_scale",
                  "Rabs r * sqrt exact_w2 * Rabs exact_scale");
}

/// s = (N^T w) . d, where w errs by 3.001 of the condition; that is 1 at least, and then this is worst.
inline FormulaClaim along_of_ellipse() {
  Inputs in;
  const Symbol N[2][2] = {{in.rounded("N00", 1), in.rounded("N01", 1)},
                          {in.rounded("N10", 1), in.rounded("N11", 1)}},
               w[2] = {in.rounded("w0", 3.001), in.rounded("w1", 3.001)},
               d[2] = {in.rounded("d0", 1), in.rounded("d1", 1)};
  const Symbol along[2] = {sum_of_products(N[0][0], w[0], N[1][0], w[1]),
                           sum_of_products(N[0][1], w[0], N[1][1], w[1])};
  return in.claim({"kAlongOfShape", kAlongOfShape, "16"}, "along_of_ellipse",
                  sum_of_products(along[0], d[0], along[1], d[1]),
                  whole(term("exact_N00 * exact_w0") + term("exact_N10 * exact_w1")) * "exact_d0" +
                      whole(term("exact_N01 * exact_w0") + term("exact_N11 * exact_w1")) * "exact_d1");
}

inline std::vector<FormulaClaim> of_plane() {
  return {height_of_obstacle(),       along_on_unit_lattice(),      along_in_plane(),
          width_in_plane(),           row_beside_start_on_square(), row_beside_start(),
          row_beside_start_widened(), entry_into_strip(),           slope_of_rows(),
          passing_of_start(),         velocity_in_shape(),          width_of_ellipse(),
          along_of_ellipse()};
}

}  // namespace lorentz::bounds
