// The checks of `lorentz doctor`: whether this machine and this build of the program give trustworthy results.
// All components that claim to be right are asked questions with known answers.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include <lorentz/answer.hpp>
#include <lorentz/environment.hpp>
#include <lorentz/query.hpp>
#include <lorentz/scene.hpp>

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

using Ask = std::function<Answer(const Scene&, const Query&)>;

/// Compares a component's answers to the eight known questions with the known answers. The component may
/// leave `may_leave` of them undecided. It is unfit if it cannot compute an answer.
Symptom examine(const char* name, std::vector<Use> spoiled, std::size_t may_leave, const Ask& ask);

/// Whether a proof made for `proven` refutes `claimed`.
using Refuted = std::function<bool(const Scene&, const Query&, const Answer& proven, const Answer& claimed)>;

/// Each true answer must be accepted with its proof. The answer with another obstacle, or without one where
/// there is one, must be refuted.
Symptom examine_certificates(const Refuted& refuted);

/// Checks the certified path of problem 2 of the 100-digit challenge by its distance from the origin at t =
/// 10.
Symptom examine_itinerary(const std::function<std::string()>& distance);

/// Examines the fast engines, both oracles, `certified`, the check of certificates, and the certified path.
/// Takes about a second.
std::vector<Symptom> examine_known_answers();

/// The uses for which the machine is unfit according to these findings.
std::vector<Use> unfit_uses(const std::vector<Symptom>& findings);

}  // namespace lorentz::fitness
