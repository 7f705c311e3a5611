// Questions whose exact answers are known, put to everybody who claims to be exact.
#pragma once

#include <functional>
#include <vector>

#include <lorentz/answer.hpp>
#include <lorentz/query.hpp>
#include <lorentz/scene.hpp>
#include "fitness/examination.hpp"

namespace lorentz::fitness {

using Ask = std::function<Answer(const Scene&, const Query&)>;

/// Whether `claimed` is refuted by a proof that was made for `proven`.
using Refuted = std::function<bool(const Scene&, const Query&, const Answer& proven, const Answer& claimed)>;

/// Holds a party's answers to the eight known questions against the known answers. It may leave `may_leave`
/// of them undecided; an answer that it cannot compute makes it unfit.
Symptom examine(const char* name, std::vector<Use> spoiled, std::size_t may_leave, const Ask& ask);

/// Each true answer is proved, and the same with another obstacle, or none where there is one, is not.
Symptom examine_certificates(const Refuted& refuted);

/// The certified path of problem 2 of the 100-digit challenge, by its distance from the origin at t = 10.
Symptom examine_itinerary(const std::function<std::string()>& distance);

/// By both oracles, `certified`, the check of certificates, and the certified path.
std::vector<Symptom> examine_known_answers();

}  // namespace lorentz::fitness
