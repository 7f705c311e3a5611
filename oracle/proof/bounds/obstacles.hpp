// The claims of single obstacles and of rows and layers of them.
#pragma once

#include "oracle/proof/bounds/common.hpp"

namespace lorentz::bounds {

inline FormulaClaim inside_of_ball() {
  Inputs in;
  const Symbol r = in.number("r"),
               d[3] = {in.rounded("d0", kHigh), in.rounded("d1", kHigh), in.rounded("d2", kHigh)};
  const std::string square = "exact_d0 * exact_d0 + exact_d1 * exact_d1 + exact_d2 * exact_d2";
  return in.claim({"kInside", kInside, "5"}, "inside_of_ball", (r * r - square_of(d)).unrounded(),
                  "r * r - (" + square + ")", "r * r + (" + square + ")");
}

/// d . G d against r^2; all nine terms of it.
inline FormulaClaim inside_of_ellipsoid() {
  Inputs in;
  struct HighPart {
    Symbol hi;
  };
  HighPart G[3][3];
  Symbol d[3];
  std::string form, sizes;
  for (int i = 0; i < 3; ++i) d[i] = in.rounded(numbered("d", i), kHigh);
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) {
      const std::string entry = numbered(numbered("G", i), k);
      const std::string product =
          "exact_" + entry + " * exact_" + numbered("d", i) + " * exact_" + numbered("d", k);
      G[i][k].hi = in.rounded(entry, kHigh);
      form += " + " + product, sizes += " + Rabs (" + product + ")";
    }
  const Symbol r = in.number("r");
  return in.claim({"kInsideEllipsoid", kInsideEllipsoid, "13"}, "inside_of_ellipsoid",
                  (r * r - form_of(G, d)).unrounded(), "r * r - (" + form.substr(3) + ")", "r * r" + sizes);
}

inline FormulaClaim along_to_ball() {
  Inputs in;
  const Symbol v[3] = {in.number("v0"), in.number("v1"), in.number("v2")},
               d[3] = {in.rounded("d0", kHigh), in.rounded("d1", kHigh), in.rounded("d2", kHigh)};
  return in.claim({"kLoneAlong", kLoneAlong, "4"}, "along_to_ball", product_of(v, d),
                  term("v0 * exact_d0") + term("v1 * exact_d1") + term("v2 * exact_d2"));
}

inline FormulaClaim across_to_ball() {
  Inputs in;
  const Symbol v[2] = {in.number("v0"), in.number("v1")},
               d[2] = {in.rounded("d0", kHigh), in.rounded("d1", kHigh)};
  Symbol h[1];
  cross_of(v, d, h);
  return in
      .claim({"kLoneAcross", kLoneAcross, "4.2"}, "across_to_ball", h[0],
             term("v0 * exact_d1") - term("v1 * exact_d0"))
      .taken(1.41422, "three components");
}

inline FormulaClaim slack_of_ball() {
  Inputs in;
  const Symbol r = in.number("r"), v0 = in.number("v0"), v1 = in.number("v1"), v2 = in.number("v2"),
               h[3] = {in.number("h0"), in.number("h1"), in.number("h2")};
  const Symbol slack = squared_width_of(r, speed_squared(v0, v1, v2)) - square_of(h);
  return in.claim({"kLoneSlack", kLoneSlack, "6"}, "slack_of_ball", slack,
                  "r * r * " + kSpeed + " - (h0 * h0 + h1 * h1 + h2 * h2)",
                  "r * r * " + kSpeed + " + (h0 * h0 + h1 * h1 + h2 * h2)");
}

/// One component of the start of a row, d + k e, where e = t_0 B_0 + t_1 B_1.
inline Symbol start_of_row(Inputs& in, const Symbol& k, const Symbol& t0, const Symbol& t1,
                           const std::string& i) {
  const Symbol B0 = in.rounded("B0_" + i, kHigh), B1 = in.rounded("B1_" + i, kHigh),
               d = in.rounded("d" + i, kHigh);
  return stepped(d, k, sum_of_products(t0, B0, t1, B1));
}
inline SizedTerms start_terms(const std::string& i) {
  return whole(term("exact_d" + i) + "k" * whole(term("t0 * exact_B0_" + i) + term("t1 * exact_B1_" + i)));
}

inline FormulaClaim across_to_row() {
  Inputs in;
  const Symbol v0 = in.number("v0"), v1 = in.number("v1"), k = in.number("k"), t0 = in.number("t0"),
               t1 = in.number("t1"), a0 = start_of_row(in, k, t0, t1, "0"),
               a1 = start_of_row(in, k, t0, t1, "1");
  return in
      .claim({"kSparse", kSparse, "9.9"}, "across_to_row", difference_of_products(v0, a1, v1, a0),
             "v0" * start_terms("1") - "v1" * start_terms("0"))
      .taken(1.41422, "three components");
}

inline FormulaClaim along_to_row() {
  Inputs in;
  const Symbol v[3] = {in.number("v0"), in.number("v1"), in.number("v2")}, k = in.number("k"),
               t0 = in.number("t0"), t1 = in.number("t1"),
               a[3] = {start_of_row(in, k, t0, t1, "0"), start_of_row(in, k, t0, t1, "1"),
                       start_of_row(in, k, t0, t1, "2")};
  return in.claim({"kSparse", kSparse, "8"}, "along_to_row", product_of(v, a),
                  "v0" * start_terms("0") + "v1" * start_terms("1") + "v2" * start_terms("2"));
}

/// N a of a vector, relative to the size of its terms: the condition times the image's, at most.
inline FormulaClaim image_in_shape() {
  Inputs in;
  const Symbol N[3] = {in.rounded("N0", kHigh), in.rounded("N1", kHigh), in.rounded("N2", kHigh)},
               a[3] = {in.rounded("a0", kHigh), in.rounded("a1", kHigh), in.rounded("a2", kHigh)};
  return in
      .claim({"kSparseOfShape", kSparseOfShape, "10"}, "image_in_shape", product_of(N, a),
             term("exact_N0 * exact_a0") + term("exact_N1 * exact_a1") + term("exact_N2 * exact_a2"))
      .taken(2, "two vectors");
}

/// d . (b x c), before its last rounding.
inline FormulaClaim height_over_layer() {
  Inputs in;
  const std::array<Symbol, 3> b = vector_of(in, "b"), c = vector_of(in, "c"), d = vector_of(in, "d");
  return in.claim({"kLayer", kLayer, "8"}, "height_over_layer", volume_of(d, cross_product(b, c)).unrounded(),
                  volume_terms("d", "b", "c"));
}

inline std::vector<FormulaClaim> of_obstacles() {
  return {inside_of_ball(), inside_of_ellipsoid(), along_to_ball(),  across_to_ball(),   slack_of_ball(),
          across_to_row(),  along_to_row(),        image_in_shape(), height_over_layer()};
}

}  // namespace lorentz::bounds
