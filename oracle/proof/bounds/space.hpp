// The claims of 3D.
#pragma once

#include "oracle/proof/bounds/common.hpp"

namespace lorentz::bounds {

inline FormulaClaim width_in_space() {
  Inputs in;
  const Symbol r = in.number("r"), v0 = in.number("v0"), v1 = in.number("v1"), v2 = in.number("v2");
  return in
      .claim({"kRho", kRho, "3.5"}, "width_in_space", width_of(r, speed_squared(v0, v1, v2)),
             "r * sqrt " + kSpeed, "Rabs r * sqrt " + kSpeed)
      .within({{"r", -50, 0}, {"v0", -450, 1}, {"v1", -450, 1}, {"v2", -450, 1}});
}

/// A coordinate across: of the anchor, a plane's step, a line's and a ball's, each known within 3 (Lemma 3).
inline Symbol after_steps(Inputs& in, double of_steps, SizedTerms& terms, const std::string& name) {
  Symbol at = in.number(name);
  terms = term(name);
  for (const std::string step : {"1", "2", "3"}) {
    const std::string k = "k" + step + name, arm = name + step;
    at = stepped(at, in.number(k), in.rounded(arm, of_steps));
    terms = terms + term(k + " * exact_" + arm);
  }
  return at;
}

inline FormulaClaim across_in_space() {
  Inputs in;
  SizedTerms terms;
  const Symbol p = after_steps(in, 3, terms, "p");
  return in.claim({"kAcross", kAcross, "8"}, "across_in_space", p, terms);
}

/// z, from a compensated sum and a quotient; and s = begin + z times the window's length.
inline FormulaClaim along_window() {
  Inputs in;
  SizedTerms terms;
  const Symbol z = after_steps(in, 2.01, terms, "z");
  return in.claim({"kWindowStart", kWindowStart / kRoundoff, "16"}, "along_window", z, terms)
      .taken(2, "z of size 2");
}
inline FormulaClaim along_in_space() {
  Inputs in;
  SizedTerms terms;
  const Symbol z = after_steps(in, 2.01, terms, "z"), begin = in.number("b"), length = in.number("l");
  return in.claim({"kAlong", kAlong, "6"}, "along_in_space", begin + z * length,
                  term("b") + whole(terms) * "l");
}

/// |across|^2, by its two scales.
inline FormulaClaim scale_of_across() {
  Inputs in;
  const Symbol one("1"), r = in.number("r"), a = in.number("a"), b = in.number("b"), v0 = in.number("v0"),
                         v1 = in.number("v1"), v2 = in.number("v2"),
                         across = sqrt(sum_of_products(a, a, b, b)), first = first_scale(one, across, r),
                         point[2] = {first, first / sqrt(speed_squared(v0, v1, v2))};
  in.given("0 < r"), in.given("0 < a * a + b * b"), in.given("0 < " + kSpeed);
  const std::string width = "(sqrt (a * a + b * b) * r)",
                    second = "(1 / " + width + " / sqrt " + kSpeed + ")",
                    exact = "1 / " + width + " * (1 / " + width + ") + " + second + " * " + second;
  return in
      .claim({"kScale", kScale, "17"}, "scale_of_across", square_of(point), exact, "Rabs (" + exact + ")")
      .within(
          {{"r", -30, 0}, {"a", -200, 1}, {"b", -200, 1}, {"v0", -200, 1}, {"v1", -200, 1}, {"v2", -200, 1}});
}

/// The moment about the flight of a line through q with the steps a, after the steps to it.
inline FormulaClaim moment_of_line_in_space() {
  Inputs in;
  SizedTerms p0, p1;
  const Symbol q[2] = {after_steps(in, 3, p0, "p"), after_steps(in, 3, p1, "q")},
               a[2] = {in.rounded("a0", 3), in.rounded("a1", 3)};
  return in.claim({"kLine", kLine, "13"}, "moment_of_line_in_space", moment_of_line(q, a),
                  whole(p0) * "exact_a1" - whole(p1) * "exact_a0");
}

/// a - moment^2, where the moment errs by kLine of l, l^2 = a, and is no larger.
inline FormulaClaim discriminant_of_line() {
  Inputs in;
  in.real("l");
  const Symbol p[2] = {in.rounded("a0", 3), in.rounded("a1", 3)}, moment = in.rounded("m", kLine, "l");
  return in
      .claim({"kDiscriminant", kDiscriminant * kLine, "77"}, "discriminant_of_line",
             square_of(p) - moment * moment, "exact_a0 * exact_a0 + exact_a1 * exact_a1 - exact_m * exact_m",
             "exact_a0 * exact_a0 + exact_a1 * exact_a1 + l * l")
      .taken(2, "relative to a");
}

/// dual_2 along the line, but for what is common to all of it.
inline FormulaClaim tilt_of_planes() {
  Inputs in;
  const Symbol p0 = in.rounded("p0", 3), p1 = in.rounded("p1", 3), q0 = in.rounded("q0", 3),
               q1 = in.rounded("q1", 3), inverse = in.number("inverse");
  return in.claim({"kTilt", kTilt, "9"}, "tilt_of_planes", difference_of_products(p0, q1, q0, p1) * inverse,
                  whole(term("exact_p0 * exact_q1") - term("exact_q0 * exact_p1")) * "inverse");
}

/// The volume of a basis that errs by 3, where kappa is the largest: relative to it.
inline constexpr double kMaxKappa = kMaxDefect * kMaxDefect, kCrossErrs = 8.001 * kMaxKappa,
                        kVolumeErrs3 = 19.87 * kMaxKappa, kDualErrs = kCrossErrs + kVolumeErrs3 + 2.001;
inline FormulaClaim cross_of_basis() {
  Inputs in;
  const Symbol p0 = in.rounded("p0", 3), p1 = in.rounded("p1", 3), q0 = in.rounded("q0", 3),
               q1 = in.rounded("q1", 3);
  return in.claim({"kPlane", kPlane / kMaxKappa, "8"}, "cross_of_basis",
                  difference_of_products(p0, q1, q0, p1),
                  term("exact_p0 * exact_q1") - term("exact_q0 * exact_p1"));
}
inline FormulaClaim volume_of_basis() {
  Inputs in;
  std::array<Symbol, 3> b, cross;
  std::string exact, size;
  for (int i = 0; i < 3; ++i) {
    const std::string n = std::to_string(i);
    in.real("size" + n);
    b[i] = in.rounded("b" + n, 3), cross[i] = in.rounded("c" + n, 8.001 * 1.73206, "size" + n);
    exact += " + exact_b" + n + " * exact_c" + n, size += " + Rabs exact_b" + n + " * size" + n;
  }
  return in.claim({"kPlane", kPlane / kMaxKappa, "19.8"}, "volume_of_basis", volume_of(b, cross),
                  exact.substr(3), size.substr(3));
}
/// xi = (g . point - tilt z) / |g across|, where each component of g errs by kDualErrs of the largest kappa.
inline FormulaClaim distance_from_plane() {
  Inputs in;
  const Symbol g0 = in.rounded("g0", kDualErrs), g1 = in.rounded("g1", kDualErrs),
               g2 = in.rounded("g2", kDualErrs), p0 = in.rounded("p0", kAcross),
               p1 = in.rounded("p1", kAcross), p2 = in.rounded("p2", kAcross), z = in.number("z"),
               slope = sqrt(sum_of_products(g0, g0, g1, g1)), kappa = sum_of_products(g0, p0, g1, p1, g2, p2);
  in.given("0 < exact_g0 * exact_g0 + exact_g1 * exact_g1");
  const SizedTerms terms = whole(term("exact_g0 * exact_p0") + term("exact_g1 * exact_p1") +
                                 term("exact_g2 * exact_p2") - term("exact_g2 * z"));
  const std::string g = "sqrt (exact_g0 * exact_g0 + exact_g1 * exact_g1)";
  return in.claim({"kPlane", kPlane, "460"}, "distance_from_plane",
                  distance_of_plane(kappa, g2, z, Symbol("1") / slope), terms.exact + " / " + g,
                  terms.size + " / Rabs (" + g + ")");
}

inline std::vector<FormulaClaim> of_space() {
  return {width_in_space(),  across_in_space(),         along_window(),         along_in_space(),
          scale_of_across(), moment_of_line_in_space(), discriminant_of_line(), tilt_of_planes(),
          cross_of_basis(),  volume_of_basis(),         distance_from_plane()};
}

}  // namespace lorentz::bounds
