// The checks of `lorentz doctor`: whether this machine and this build of the program give trustworthy
// results.
#pragma once

#include <string>
#include <vector>

#include <lorentz/environment.hpp>
#include "judge/fitness/digests/digests.hpp"

namespace lorentz::fitness {

/// The uses for which a machine may be fit.
enum class Use {
  engines,       ///< binary64: reduction, batch, classical, published; paths, starts
  oracle,        ///< exact answers, by either oracle, and `certified`
  certificates,  ///< making and checking proofs
  itineraries    ///< certified trajectories
};
inline constexpr Use kUses[] = {Use::engines, Use::oracle, Use::certificates, Use::itineraries};

/// For example "the binary64 engines, paths and starts".
const char* name_of(Use use);

/// The result of one check.
struct Symptom {
  std::string name;          ///< "rounding mode"
  bool fit = true;           ///< true: as required
  std::string found;         ///< "upward"; if the check failed, also the expected value
  std::vector<Use> spoiled;  ///< if not fit: the uses that become unreliable
};

/// The symptoms of the arithmetic checks. A failed check spoils all uses.
std::vector<Symptom> findings_of(const std::vector<ArithmeticCheck>& checks);

/// Counts the digests that differ from the known ones or are missing, and names the first of them.
Symptom examine_digests(const std::vector<Digest>& found, const std::vector<Digest>& known);

/// Checks this thread's arithmetic in this build. Takes microseconds.
std::vector<Symptom> examine_arithmetic();

/// Computes known answers again: the digests of all engines, exact answers by both oracles and `certified`, a
/// proof that must be accepted and one that must not, a certified path. Takes about a second.
std::vector<Symptom> examine_answers();

/// The uses for which the machine is unfit according to these findings.
std::vector<Use> unfit_uses(const std::vector<Symptom>& findings);

}  // namespace lorentz::fitness
