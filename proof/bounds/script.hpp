// A statement as Gappa reads it: binary64 with gradual underflow, and all inputs within 1; or a relative bound,
// in ranges where all terms are positive.
#pragma once

#include <cstdio>
#include <ostream>
#include <sstream>

#include "proof/bounds/formula_claim.hpp"

namespace lorentz::bounds {

/// The size of this many roundoffs, in all digits.
inline std::string in_all_digits(double roundoffs) {
  char text[100];
  std::snprintf(text, sizeof text, "%.60g", roundoffs * kUnit);
  return text;
}

inline std::string range_of(const FormulaClaim& of, const std::string& name, const std::string& exact) {
  for (const PositiveInput& range : of.ranges)
    if (range.name == name)
      return name + " in [1b" + std::to_string(range.low) + ", 1b" + std::to_string(range.high) + "]";
  return "|" + exact + "| <= 1";
}

/// One of `given`, or nothing.
inline std::string hypothesis_of(const FormulaClaim& of, const std::string& given) {
  std::istringstream words(given);
  std::string kind, name, exact, size, roundoffs;
  words >> kind >> name;
  if (kind == "number") return range_of(of, name, name);
  words >> exact;
  if (kind == "rounded_of") {
    words >> size >> roundoffs;
    return "|" + exact + "| <= 1 /\\ |" + name + " - " + exact +
           "| <= " + in_all_digits(std::stod(roundoffs));
  }
  if (kind != "rounded") return "";
  words >> roundoffs;
  const std::string most = in_all_digits(std::stod(roundoffs));
  return range_of(of, name, exact) + " /\\ " + name + " -/ " + exact + " in [-" + most + ", " + most + "]";
}

inline void write_script(std::ostream& out, const FormulaClaim& of) {
  out << "# " << of.constant.name << ", in roundoffs. Made by write.cpp from the formula of the engine.\n"
      << "@rnd = float<ieee_64, ne>;\n";
  std::string hypotheses;
  for (const std::string& given : of.given) {
    const std::string hypothesis = hypothesis_of(of, given), name = given.substr(given.find(' ') + 1);
    if (hypothesis.empty()) continue;
    const std::string input = name.substr(0, name.find(' '));
    out << input << " = rnd(any_" << input << ");\n";
    hypotheses += (hypotheses.empty() ? "" : "\n  /\\ ") + hypothesis;
  }
  const bool relative = !of.ranges.empty();
  out << "computed = " << of.computed.text << ";\nexact = " << of.exact << ";\nerror = (computed - exact)"
      << (relative ? " / exact" : "") << " / 1b-53;\n{ " << hypotheses
      << "\n  -> |error| <= " << Inputs::decimal(of.claimed() * (relative ? 1 : of.computed.size)) << " }\n";
}

}  // namespace lorentz::bounds
