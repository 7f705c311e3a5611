// write FOLDER: what is claimed of the formulas of the reduction engine. FOLDER/Formulas.v for Coq, FOLDER/NAME.g for
// Gappa, and the constants in FOLDER/constants.tsv.
#include <fstream>
#include <iostream>

#include "proof/bounds/cells.hpp"
#include "proof/bounds/compensated.hpp"
#include "proof/bounds/obstacles.hpp"
#include "proof/bounds/plane.hpp"
#include "proof/bounds/script.hpp"
#include "proof/bounds/space.hpp"
#include "proof/bounds/theorem.hpp"
#include "proof/bounds/times.hpp"
#include "proof/bounds/wide.hpp"

namespace lorentz::bounds {
namespace {

std::vector<FormulaClaim> claims() {
  std::vector<FormulaClaim> all;
  for (const auto& part : {of_cells(), of_plane(), of_space(), of_obstacles(), of_times(),
                           of_compensated_sums(), of_double_double()})
    all.insert(all.end(), part.begin(), part.end());
  return all;
}

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
