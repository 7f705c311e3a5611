// write FOLDER: what is claimed of the formulas of the reduction engine. FOLDER/Formulas.v for Coq,
// FOLDER/NAME.g for Gappa, and the constants in FOLDER/constants.tsv.
#include <cstdio>
#include <fstream>
#include <iostream>
#include <sstream>

#include "oracle/proof/bounds/cells.hpp"
#include "oracle/proof/bounds/compensated.hpp"
#include "oracle/proof/bounds/obstacles.hpp"
#include "oracle/proof/bounds/plane.hpp"
#include "oracle/proof/bounds/space.hpp"
#include "oracle/proof/bounds/times.hpp"
#include "oracle/proof/bounds/wide.hpp"

namespace lorentz::bounds {
namespace {

std::vector<FormulaClaim> claims() {
  std::vector<FormulaClaim> all;
  for (const auto& part : {of_cells(), of_plane(), of_space(), of_obstacles(), of_times(),
                           of_compensated_sums(), of_double_double()})
    all.insert(all.end(), part.begin(), part.end());
  return all;
}

// ---- A statement as Coq reads it

void write_theorem(std::ostream& out, const FormulaClaim& of) {
  out << "Theorem " << of.name << " (";
  for (const std::string& variable : of.variables) out << variable << ' ';
  out << ": R) :\n ";
  for (const std::string& hypothesis : of.given) out << ' ' << hypothesis << " ->";
  for (const std::string& product : of.no_underflow) out << "\n  safe (" << product << ") ->";
  out << "\n  Rabs (" << of.computed.text << "\n    - (" << of.exact
      << "))\n    <= " << Inputs::decimal(of.claimed()) << (of.wide ? " * (u * u)" : " * u") << "\n    * ("
      << of.size << ").\nProof. bound. Qed.\n";
}

// The constant is as large as that; its own evaluation rounds less than sixteen times, each downwards at
// worst.
void write_comparison(std::ostream& out, const FormulaClaim& of) {
  const std::string needed = Inputs::decimal(of.claimed()) + " * " + Inputs::decimal(of.times) + " + " +
                             Inputs::decimal(of.plus),
                    room = Inputs::decimal(of.constant.used) + " * (1 - 16 * u)";
  out << "Theorem " << of.name << "_is_covered : " << needed << " <= " << room << ".  (* " << of.constant.name
      << " *)\nProof. figure. Qed.\n\n";
}

void write_theorems(std::ostream& out, const std::vector<FormulaClaim>& all) {
  out << "(* Made by write.cpp from the formulas of the engine. *)\nFrom Coq Require Import Reals Lra.\n"
         "From Lorentz.bounds Require Import Errors.\nLocal Open Scope R_scope.\n\n"
      << "Definition kRho : R := " << Inputs::decimal(kRho)
      << ".\n\n"
         "Section Double_double.\n"
         "Context (add times scale divide : R -> R -> R) (A : adds add (3 * (u * u) + 13 * (u * u * u)))\n"
         "  (T : multiplies times (5 * (u * u))) (S : multiplies scale (3 * (u * u)))\n"
         "  (D : divides divide (15 * (u * u) + 56 * (u * u * u))).\n\n";
  for (const bool wide : {true, false}) {
    for (const FormulaClaim& one : all)
      if (one.wide == wide) write_theorem(out, one), write_comparison(out, one);
    if (wide) out << "End Double_double.\n\n";
  }
  out << "Definition all_of_formulas := (";
  for (const FormulaClaim& one : all) out << (&one == &all.front() ? "@" : ",\n  @") << one.name;
  out << ").\n";
}

// ---- A statement as Gappa reads it: binary64 with gradual underflow, and all inputs within 1; or a relative
// bound, in ranges where all terms are positive

// The size of this many roundoffs, in all digits.
std::string in_all_digits(double roundoffs) {
  char text[100];
  std::snprintf(text, sizeof text, "%.60g", roundoffs * kUnit);
  return text;
}

std::string range_of(const FormulaClaim& of, const std::string& name, const std::string& exact) {
  for (const PositiveInput& range : of.ranges)
    if (range.name == name)
      return name + " in [1b" + std::to_string(range.low) + ", 1b" + std::to_string(range.high) + "]";
  return "|" + exact + "| <= 1";
}

// One of `given`, or nothing.
std::string hypothesis_of(const FormulaClaim& of, const std::string& given) {
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

void write_script(std::ostream& out, const FormulaClaim& of) {
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

// ---- All of them

// One claim a line: constant, theorem, unit, derived, proved, times, plus, needed, used, because.
void write_constants(std::ostream& out, const std::vector<FormulaClaim>& all) {
  for (const FormulaClaim& one : all)
    out << one.constant.name << '\t' << one.name << '\t' << (one.wide ? "u^2" : "u") << '\t'
        << one.constant.derived << '\t' << one.claimed() << '\t' << one.times << '\t' << one.plus << '\t'
        << one.needed() << '\t' << one.constant.used << '\t' << one.because << '\n';
}

void write_all(const std::string& folder) {
  const std::vector<FormulaClaim> all = claims();
  std::ofstream theorems(folder + "/Formulas.v"), constants(folder + "/constants.tsv");
  constants.precision(12);
  write_theorems(theorems, all);
  write_constants(constants, all);
  for (const FormulaClaim& one : all) {
    if (!one.has_script()) continue;
    std::ofstream script(folder + "/" + one.name + ".g");
    write_script(script, one);
  }
}

}  // namespace
}  // namespace lorentz::bounds

int main(int count, char** words) {
  if (count != 2) {
    std::cerr << "usage: write FOLDER\n";
    return 2;
  }
  lorentz::bounds::write_all(words[1]);
}
