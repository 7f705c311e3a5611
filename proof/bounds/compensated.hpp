// The claims of compensated sums: their high parts lose nothing (lemma 1 of docs/bounds.md), so that they err by
// what their low parts do, and by the last rounding.
#pragma once

#include "proof/bounds/common.hpp"

namespace lorentz::bounds {

/// A high part, which is left out, and a low one.
struct LowPart {
  Symbol hi, lo;

  static Inputs*& inputs() {
    static Inputs* in = nullptr;
    return in;
  }
  static LowPart of(const std::string& name) { return {Symbol("0"), inputs()->number(name)}; }
  static LowPart both(const std::string& high, const std::string& low) {
    return {inputs()->number(high), inputs()->number(low)};
  }
  static LowPart next() { return of("low" + std::to_string(inputs()->variables().size())); }
  static LowPart product(const Symbol&, const Symbol&) { return next(); }
  static LowPart sum(const Symbol&, const Symbol&) { return next(); }
};

/// Gappa does not put so many terms into another order.
inline Symbol without_size(Symbol of) {
  of.size = 0;
  return of;
}

/// The exact sum of the low parts, and of their sizes: `terms` are products n lo besides.
inline FormulaClaim low_parts(const Inputs& in, const std::string& name, const Symbol& computed,
                              const std::vector<std::string>& terms, int kinds, const std::string& which) {
  std::string exact, size;
  for (const std::string& variable : in.variables())
    if (variable.starts_with("low")) exact += " + " + variable, size += " + Rabs " + variable;
  for (const std::string& term : terms) exact += " + " + term, size += " + Rabs (" + term + ")";
  return in
      .claim({"kAnchorTerms", kAnchorTerms / kWideRoundoff, "16"}, name, without_size(computed.unrounded()),
             exact.substr(3), size.substr(3))
      .taken(kinds + 0.001, which + "; the forms' own 6, and 1", 7);
}

inline FormulaClaim low_part_of_height() {
  Inputs in;
  LowPart::inputs() = &in;
  const LowPart H[2] = {LowPart::of("f0"), LowPart::of("f1")}, h = LowPart::next();
  const Symbol n[2] = {in.number("n0"), in.number("n1")};
  const Symbol low = compensated_height<true>(h, n, H);
  return low_parts(in, "low_part_of_height", low, {"n0 * f0", "n1 * f1"}, 4, "products, two sums, forms");
}

inline FormulaClaim low_part_of_sum() {
  Inputs in;
  LowPart::inputs() = &in;
  const LowPart f[3] = {LowPart::of("f0"), LowPart::of("f1"), LowPart::of("f2")};
  const Symbol n[3] = {in.number("n0"), in.number("n1"), in.number("n2")};
  const Symbol low = compensated_sum<LowPart>(f, n);
  return low_parts(in, "low_part_of_sum", low, {"n0 * f0", "n1 * f1", "n2 * f2"}, 4,
                   "products, two sums, forms");
}

inline FormulaClaim low_part_of_sum_from_start() {
  Inputs in;
  LowPart::inputs() = &in;
  const LowPart f[3] = {LowPart::of("f0"), LowPart::of("f1"), LowPart::of("f2")}, start = LowPart::next();
  const Symbol n[3] = {in.number("n0"), in.number("n1"), in.number("n2")};
  const Symbol low = compensated_sum_from<LowPart>(start, f, n);
  return low_parts(in, "low_part_of_sum_from_start", low, {"n0 * f0", "n1 * f1", "n2 * f2"}, 5,
                   "products, three sums, forms");
}

/// With coefficients in double-double: the products of two low parts, 1 u^2, are left out.
inline FormulaClaim low_part_of_wide_sum() {
  Inputs in;
  LowPart::inputs() = &in;
  const LowPart f[3] = {LowPart::both("F0", "f0"), LowPart::both("F1", "f1"), LowPart::both("F2", "f2")},
                N[3] = {LowPart::both("N0", "n0"), LowPart::both("N1", "n1"), LowPart::both("N2", "n2")},
                start = LowPart::next();
  const Symbol low = compensated_sum<LowPart>(f, N, start);
  return low_parts(in, "low_part_of_wide_sum", low,
                   {"N0 * f0", "n0 * F0", "N1 * f1", "n1 * F1", "N2 * f2", "n2 * F2"}, 6,
                   "products, three sums, two of forms");
}

inline std::vector<FormulaClaim> of_compensated_sums() {
  return {low_part_of_height(), low_part_of_sum(), low_part_of_sum_from_start(), low_part_of_wide_sum()};
}

}  // namespace lorentz::bounds
