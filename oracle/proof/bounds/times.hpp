// The claims of times.
#pragma once

#include "oracle/proof/bounds/common.hpp"

namespace lorentz::bounds {

inline FormulaClaim rough_time() {
  Inputs in;
  const Symbol s = in.number("s"), slack = in.number("slack"), v0 = in.number("v0"), v1 = in.number("v1"),
               v2 = in.number("v2");
  in.given("0 <= slack"), in.given("0 < " + kSpeed);
  return in
      .claim({"kRoughTime", kRoughTime, "11"}, "rough_time",
             rough_time_of(s, sqrt(slack), speed_squared(v0, v1, v2)), "(s - sqrt slack) / " + kSpeed,
             "(Rabs s + sqrt slack) / Rabs " + kSpeed)
      .taken(2, "q <= s");
}

inline FormulaClaim root_of_slack() {
  Inputs in;
  const Symbol slack = in.rounded("slack", kHigh);
  in.given("0 <= exact_slack");
  return in
      .claim({"kRoot", kRoot, "1.75"}, "root_of_slack", sqrt(slack), "sqrt (exact_slack)", "sqrt exact_slack")
      .within({{"slack", -900, 900}});
}

/// h by Kahan's difference of products errs by 2, v^2 by 1.
inline FormulaClaim soon_slack() {
  Inputs in;
  const Symbol r = in.number("r"), v2 = in.rounded("v2", 1), h = in.rounded("h", 2);
  return in
      .claim({"kSoonSlack", kSoonSlack, "10"}, "soon_slack", squared_width_of(r, v2) - h * h,
             "r * r * exact_v2 - exact_h * exact_h", "r * r * Rabs exact_v2 + exact_h * exact_h")
      .taken(2, "h^2 <= rho^2");
}

inline std::vector<FormulaClaim> of_times() {
  return {rough_time(), root_of_slack(), soon_slack()};
}

}  // namespace lorentz::bounds
