// The claims of double-double: what its operations err by is lemma 2 of docs/bounds.md, which is assumed.
#pragma once

#include "oracle/proof/bounds/common.hpp"

namespace lorentz::bounds {

/// As Symbol; errors are in units of u^2. A double stands for the radius.
struct WideSymbol {
  std::string text = "0";
  double error = 0;

  WideSymbol() = default;
  WideSymbol(std::string name, double its_error) : text(std::move(name)), error(its_error) {}
  WideSymbol(double value) : text(value == 0 ? "0" : "r") {}
  static WideSymbol product(const Symbol& a, const Symbol& b) {
    return {"(" + a.text + " * " + b.text + ")", 0};
  }

  friend WideSymbol operator+(const WideSymbol& a, const WideSymbol& b) { return sum(a, b.text, b.error); }
  friend WideSymbol operator-(const WideSymbol& a, const WideSymbol& b) {
    return sum(a, "(- " + b.text + ")", b.error);
  }
  friend WideSymbol operator*(const WideSymbol& a, const WideSymbol& b) {
    return {"(times " + a.text + " " + b.text + ")", a.error + b.error + 5 + kHigher};
  }
  friend WideSymbol operator*(const WideSymbol& a, const Symbol& b) {
    return {"(scale " + a.text + " " + b.text + ")", a.error + 3 + kHigher};
  }
  friend WideSymbol operator*(const WideSymbol& a, double) { return a * Symbol("r"); }
  friend WideSymbol operator/(const WideSymbol& a, const WideSymbol& b) {
    return {"(divide " + a.text + " " + b.text + ")", a.error + b.error + 15 + kHigher};
  }

 private:
  static constexpr double kHigher = 1e-9;  // all terms of higher order of one operation
  static WideSymbol sum(const WideSymbol& a, const std::string& b, double b_error) {
    return {"(add " + a.text + " " + b + ")", std::max(a.error, b_error) + 3 + kHigher};
  }
};

/// The numbers of one statement, in double-double and in binary64 (whose errors there are none).
class WideInputs : public Inputs {
 public:
  WideInputs() : Inputs(true) {}
  WideSymbol wide(const std::string& name) { return {number(name).text, 0}; }
  FormulaClaim claim(Constant constant, std::string name, const WideSymbol& computed,
                     const SizedTerms& terms) const {
    return Inputs::claim(std::move(constant), std::move(name), Symbol(computed.text, computed.error), terms);
  }
};

inline constexpr double kSquare = kWideRoundoff;

inline FormulaClaim place_of_obstacle() {
  WideInputs in;
  WideSymbol step[3];
  for (int i = 0; i < 3; ++i) step[i] = in.wide(numbered("B", i)) * in.wide(numbered("N", i));
  return in.claim({"kPlace", kPlace / kSquare, "14"}, "place_of_obstacle",
                  place_after(step, in.wide("offset")),
                  term("B0 * N0") + term("B1 * N1") + term("B2 * N2") + term("offset"));
}

inline FormulaClaim across_in_double_double() {
  WideInputs in;
  const WideSymbol d[2] = {in.wide("d0"), in.wide("d1")};
  const Symbol v[2] = {in.number("v0"), in.number("v1")};
  return in.claim({"kStable", kStable / kSquare, "16"}, "across_in_double_double",
                  difference_of_products(d[1], v[0], d[0], v[1]), term("d1 * v0") - term("d0 * v1"));
}
inline FormulaClaim along_in_double_double() {
  WideInputs in;
  const WideSymbol d[3] = {in.wide("d0"), in.wide("d1"), in.wide("d2")};
  const Symbol v[3] = {in.number("v0"), in.number("v1"), in.number("v2")};
  return in.claim({"kStable", kStable / kSquare, "16"}, "along_in_double_double",
                  sum_of_products(d[0], v[0], d[1], v[1], d[2], v[2]),
                  term("d0 * v0") + term("d1 * v1") + term("d2 * v2"));
}
inline FormulaClaim square_in_double_double() {
  WideInputs in;
  const WideSymbol d[3] = {in.wide("d0"), in.wide("d1"), in.wide("d2")};
  return in.claim({"kStable", kStable / kSquare, "16"}, "square_in_double_double", square_of(d),
                  {"d0 * d0 + d1 * d1 + d2 * d2", "d0 * d0 + d1 * d1 + d2 * d2"});
}
/// One of the three terms d_i (G d)_i.
inline FormulaClaim form_in_double_double() {
  WideInputs in;
  const WideSymbol d[3] = {in.wide("d0"), in.wide("d1"), in.wide("d2")},
                   G[3] = {in.wide("G0"), in.wide("G1"), in.wide("G2")};
  const WideSymbol image = sum_of_products(G[0], d[0], G[1], d[1], G[2], d[2]);
  return in
      .claim({"kStableForm", kStableForm / kSquare, "48"}, "form_in_double_double",
             (image * d[0] + WideSymbol(0)) + WideSymbol(0),
             whole(term("G0 * d0") + term("G1 * d1") + term("G2 * d2")) * "d0")
      .taken(1.7321, "norm of a row of G");
}

using Rows = std::array<std::array<Symbol, 3>, 3>;
inline Rows semiaxes(WideInputs& in) {
  Rows a;
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) a[i][k] = in.number("a" + std::to_string(i) + std::to_string(k));
  return a;
}

inline FormulaClaim adjugate_of_semiaxes() {
  WideInputs in;
  ShapeForms<WideSymbol> forms;
  forms.set_adjugate(semiaxes(in));
  return in
      .claim({"kAdjugate", kAdjugate, "8.5"}, "adjugate_of_semiaxes", forms.adjugate[0][0],
             term("a11 * a22") - term("a12 * a21"))
      .taken(2.4495, "three products of lengths");
}
inline FormulaClaim determinant_of_semiaxes() {
  WideInputs in;
  ShapeForms<WideSymbol> forms;
  forms.set_adjugate(semiaxes(in));
  return in
      .claim({"kDeterminant", kDeterminant, "22"}, "determinant_of_semiaxes", forms.det,
             whole(term("a11 * a22") - term("a12 * a21")) * "a00" +
                 whole(term("a12 * a20") - term("a10 * a22")) * "a01" +
                 whole(term("a10 * a21") - term("a11 * a20")) * "a02")
      .taken(1.41422, "length of b x c");
}
/// From an adjugate and a determinant without error.
inline ShapeForms<WideSymbol> forms_of_shape(WideInputs& in) {
  ShapeForms<WideSymbol> forms;
  forms.adjugate[0][0] = in.wide("adjugate"), forms.det = in.wide("det");
  in.number("r"), in.given("0 < det");
  forms.set_forms(semiaxes(in), 1);
  return forms;
}
inline FormulaClaim to_ball_of_shape() {
  WideInputs in;
  const auto forms = forms_of_shape(in);
  return in.claim({"kToBall", kToBall, "20"}, "to_ball_of_shape", forms.to_ball[0][0],
                  "adjugate" * whole(term("r") / "det"));
}
inline FormulaClaim cofactor_of_shape() {
  WideInputs in;
  const auto forms = forms_of_shape(in);
  return in.claim({"kCofactor", kCofactor, "21"}, "cofactor_of_shape", forms.cofactor[0][0],
                  term("r") / "det" * "r" * "a00");
}
inline FormulaClaim metric_of_shape() {
  WideInputs in;
  ShapeForms<WideSymbol> forms;
  for (int j = 0; j < 3; ++j)
    for (int k = 0; k < 2; ++k) forms.to_ball[j][k] = in.wide("N" + std::to_string(j) + std::to_string(k));
  forms.set_metric();
  return in.claim({"kMetric", kMetric, "10"}, "metric_of_shape", forms.metric[0][1],
                  term("N00 * N01") + term("N10 * N11") + term("N20 * N21"));
}

inline std::vector<FormulaClaim> of_double_double() {
  return {place_of_obstacle(),       across_in_double_double(), along_in_double_double(),
          square_in_double_double(), form_in_double_double(),   adjugate_of_semiaxes(),
          determinant_of_semiaxes(), to_ball_of_shape(),        cofactor_of_shape(),
          metric_of_shape()};
}

}  // namespace lorentz::bounds
