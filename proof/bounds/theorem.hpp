// A statement as Coq reads it.
#pragma once

#include <ostream>

#include "proof/bounds/formula_claim.hpp"
#include "src/engines/reduction/bounds.hpp"

namespace lorentz::bounds {

inline void write_theorem(std::ostream& out, const FormulaClaim& of) {
  out << "Theorem " << of.name << " (";
  for (const std::string& variable : of.variables) out << variable << ' ';
  out << ": R) :\n ";
  for (const std::string& hypothesis : of.given) out << ' ' << hypothesis << " ->";
  for (const std::string& product : of.no_underflow) out << "\n  safe (" << product << ") ->";
  out << "\n  Rabs (" << of.computed.text << "\n    - (" << of.exact
      << "))\n    <= " << Inputs::decimal(of.claimed()) << (of.wide ? " * (u * u)" : " * u") << "\n    * ("
      << of.size << ").\nProof. bound. Qed.\n";
}

/// The constant is as large as that; its own evaluation rounds less than sixteen times, each downwards at worst.
inline void write_comparison(std::ostream& out, const FormulaClaim& of) {
  const std::string needed = Inputs::decimal(of.claimed()) + " * " + Inputs::decimal(of.times) + " + " +
                             Inputs::decimal(of.plus),
                    room = Inputs::decimal(of.constant.used) + " * (1 - 16 * u)";
  out << "Theorem " << of.name << "_is_covered : " << needed << " <= " << room << ".  (* " << of.constant.name
      << " *)\nProof. figure. Qed.\n\n";
}

inline void write_theorems(std::ostream& out, const std::vector<FormulaClaim>& all) {
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

}  // namespace lorentz::bounds
