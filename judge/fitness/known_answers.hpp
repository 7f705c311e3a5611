// Questions with known exact answers, for all components that claim to be exact.
#pragma once

#include <functional>
#include <vector>

#include <lorentz/answer.hpp>
#include <lorentz/query.hpp>
#include <lorentz/scene.hpp>
#include "judge/fitness/examination.hpp"

namespace lorentz::fitness {

using Ask = std::function<Answer(const Scene&, const Query&)>;

/// Whether a proof made for `proven` refutes `claimed`.
using Refuted = std::function<bool(const Scene&, const Query&, const Answer& proven, const Answer& claimed)>;

/// Compares a component's answers to the eight known questions with the known answers. The component may
/// leave `may_leave` of them undecided. It is unfit if it cannot compute an answer.
Symptom examine(const char* name, std::vector<Use> spoiled, std::size_t may_leave, const Ask& ask);

/// Each true answer must be accepted with its proof. The answer with another obstacle, or without one where
/// there is one, must be refuted.
Symptom examine_certificates(const Refuted& refuted);

/// Checks the certified path of problem 2 of the 100-digit challenge by its distance from the origin at t =
/// 10.
Symptom examine_itinerary(const std::function<std::string()>& distance);

/// Examines both oracles, `certified`, the check of certificates, and the certified path.
std::vector<Symptom> examine_known_answers();

}  // namespace lorentz::fitness
