// Is this machine, and this build of the program, fit to be believed? `lorentz doctor` asks.
#pragma once

#include <string>
#include <vector>

#include <lorentz/environment.hpp>
#include "fitness/digests/digests.hpp"

namespace lorentz::fitness {

/// What a machine may be fit for.
enum class Use {
  engines,       ///< binary64: reduction, batch, classical, published; paths, starts
  oracle,        ///< exact answers, by either oracle, and `certified`
  certificates,  ///< making and checking proofs
  itineraries    ///< certified trajectories
};
inline constexpr Use kUses[] = {Use::engines, Use::oracle, Use::certificates, Use::itineraries};

/// "the binary64 engines, paths and starts", ..
const char* name_of(Use use);

/// One thing that was looked at.
struct Symptom {
  std::string name;          ///< "rounding mode"
  bool fit = true;           ///< as it has to be
  std::string found;         ///< "upward"; of what failed, also what should have been
  std::vector<Use> spoiled;  ///< if it is not fit: what must not be relied on then
};

/// What follows from checks of the arithmetic: one that is not fit spoils everything.
std::vector<Symptom> findings_of(const std::vector<ArithmeticCheck>& checks);

/// Counts the digests that differ from the known ones, or are missing, and names the first of them.
Symptom examine_digests(const std::vector<Digest>& found, const std::vector<Digest>& known);

/// What is wrong with this thread's arithmetic in this build. Microseconds.
std::vector<Symptom> examine_arithmetic();

/// Known answers, computed again: the digests of all engines, exact answers by both oracles and `certified`,
/// a proof that must be accepted and one that must not, a certified path. About a second.
std::vector<Symptom> examine_answers();

/// What it is not fit for, by these findings.
std::vector<Use> unfit_uses(const std::vector<Symptom>& findings);

}  // namespace lorentz::fitness
