// The claims of compensated sums: their high parts lose nothing (lemma 1 of docs/bounds.md), so that they err
// by what their low parts do, and by the last rounding.
#pragma once

#include "oracle/proof/bounds/common.hpp"

namespace lorentz::bounds {

/// A product or a sum in two parts, which add up to it.
struct TwoParts {
  Symbol hi, lo;

  static Inputs*& inputs() {
    static Inputs* in = nullptr;
    return in;
  }
  static TwoParts named(const std::string& high, const std::string& low) {
    return {inputs()->number(high), inputs()->number(low)};
  }
  static TwoParts product(const Symbol& a, const Symbol& b) { return adding_up_to(a.text + " * " + b.text); }
  static TwoParts sum(const Symbol& a, const Symbol& b) { return adding_up_to(a.text + " + " + b.text); }

 private:
  static TwoParts adding_up_to(const std::string& exactly) {
    const std::string number = std::to_string(inputs()->variables().size());
    const TwoParts parts = named("high" + number, "low" + number);
    inputs()->given(parts.hi.text + " + " + parts.lo.text + " = " + exactly);
    return parts;
  }
};

/// What is added to the high part of a sum. (Gappa does not reorder this many terms.)
inline Symbol without_high_part(const Symbol& sum) {
  const std::string& text = sum.before_rounding;
  return {text.substr(text.find(" + ") + 3), sum.error - 1, 0};
}
inline std::string high_part(const Symbol& sum) {
  return sum.before_rounding.substr(0, sum.before_rounding.find(' '));
}

/// The low part is what is left of the exact sum; sizes are those of all low parts, and of `terms` besides.
inline FormulaClaim low_part(const Inputs& in, const std::string& name, const Symbol& sum,
                             const std::string& exact, const std::string& terms, int kinds,
                             const std::string& which) {
  std::string size = terms;
  for (const std::string& variable : in.variables())
    if (variable.starts_with("low")) size += " + Rabs " + variable;
  return in
      .claim({"kAnchorTerms", kAnchorTerms / kWideRoundoff, "16"}, name, without_high_part(sum),
             exact + " - " + high_part(sum), size)
      .taken(kinds + 0.001, which + "; the forms' own 6, and 1", 7);
}

inline FormulaClaim low_part_of_height() {
  Inputs in;
  TwoParts::inputs() = &in;
  const TwoParts H[2] = {TwoParts::named("H0", "h0"), TwoParts::named("H1", "h1")},
                 h = TwoParts::named("H", "low");
  const Symbol n[2] = {in.number("n0"), in.number("n1")};
  return low_part(in, "low_part_of_height", compensated_height<true>(h, n, H),
                  "H + low + n0 * (H0 + h0) + n1 * (H1 + h1)", "Rabs (n0 * h0) + Rabs (n1 * h1)", 4,
                  "products, two sums, forms");
}

/// Three forms, and perhaps a start.
struct ThreeForms {
  Inputs in;
  TwoParts f[3];

  ThreeForms() {
    TwoParts::inputs() = &in;
    for (int i = 0; i < 3; ++i) f[i] = TwoParts::named(numbered("F", i), numbered("f", i));
  }
  static TwoParts start() { return TwoParts::named("S", "low"); }
};
inline const std::string kOfForms = "n0 * (F0 + f0) + n1 * (F1 + f1) + n2 * (F2 + f2)",
                         kLowOfForms = "Rabs (n0 * f0) + Rabs (n1 * f1) + Rabs (n2 * f2)";

inline FormulaClaim low_part_of_sum(bool from_start) {
  ThreeForms forms;
  Inputs& in = forms.in;
  const Symbol n[3] = {in.number("n0"), in.number("n1"), in.number("n2")};
  if (!from_start)
    return low_part(in, "low_part_of_sum", compensated_sum<TwoParts>(forms.f, n), kOfForms, kLowOfForms, 4,
                    "products, two sums, forms");
  return low_part(in, "low_part_of_sum_from_start", compensated_sum_from<TwoParts>(forms.start(), forms.f, n),
                  "S + low + " + kOfForms, kLowOfForms, 5, "products, three sums, forms");
}

/// With coefficients in double-double: the products of two low parts, 1 u^2, are left out.
inline FormulaClaim low_part_of_wide_sum() {
  ThreeForms forms;
  TwoParts N[3];
  std::string exact = "S + low", size;
  for (int i = 0; i < 3; ++i) {
    const std::string F = numbered("F", i), f = numbered("f", i), M = numbered("N", i), n = numbered("n", i);
    N[i] = TwoParts::named(M, n);
    exact += " + " + M + " * (" + F + " + " + f + ") + " + n + " * " + F;
    size += " + Rabs (" + M + " * " + f + ") + Rabs (" + n + " * " + F + ")";
  }
  return low_part(forms.in, "low_part_of_wide_sum", compensated_sum<TwoParts>(forms.f, N, forms.start()),
                  exact, size.substr(3), 6, "products, three sums, two of forms");
}

inline std::vector<FormulaClaim> of_compensated_sums() {
  return {low_part_of_height(), low_part_of_sum(false), low_part_of_sum(true), low_part_of_wide_sum()};
}

}  // namespace lorentz::bounds
