#include "judge/fitness/examination.hpp"

#include <algorithm>

#include "judge/fitness/known_answers.hpp"

namespace lorentz::fitness {

Symptom examine_digests(const std::vector<Digest>& found, const std::vector<Digest>& known) {
  std::vector<std::string> others;
  for (std::size_t i = 0; i < std::max(found.size(), known.size()); ++i)
    if (i >= known.size() || i >= found.size() || !(found[i] == known[i]))
      others.push_back(i < found.size() ? found[i].name : known[i].name + ", which is missing");
  const std::string all = std::to_string(std::max(found.size(), known.size()));
  return {"digests of seeded flights",
          others.empty(),
          others.empty()
              ? "all " + all + " as known"
              : std::to_string(others.size()) + " of " + all + " differ, first of them: " + others[0],
          {Use::engines}};
}

const char* name_of(Use use) {
  constexpr const char* kNames[] = {"the binary64 engines, paths and starts", "exact answers", "certificates",
                                    "certified trajectories"};
  static_assert(std::size(kNames) == static_cast<std::size_t>(Use::itineraries) + 1);
  return kNames[static_cast<int>(use)];
}

std::vector<Symptom> examine_arithmetic() {
  return findings_of(arithmetic_checks());
}

std::vector<Symptom> findings_of(const std::vector<ArithmeticCheck>& checks) {
  std::vector<Symptom> findings;
  for (const ArithmeticCheck& check : checks)
    findings.push_back({check.name,
                        check.fit,
                        check.fit ? check.found : check.found + "; it should be: " + check.expected,
                        {std::begin(kUses), std::end(kUses)}});
  return findings;
}

std::vector<Symptom> examine_answers() {
  std::vector<Symptom> findings{examine_digests(digests(kKnownFlights), known_digests())};
  for (Symptom& finding : examine_known_answers()) findings.push_back(std::move(finding));
  return findings;
}

std::vector<Use> unfit_uses(const std::vector<Symptom>& findings) {
  std::vector<Use> uses;
  for (const Use use : kUses)
    if (std::any_of(findings.begin(), findings.end(), [use](const Symptom& finding) {
          return !finding.fit &&
                 std::find(finding.spoiled.begin(), finding.spoiled.end(), use) != finding.spoiled.end();
        }))
      uses.push_back(use);
  return uses;
}

}  // namespace lorentz::fitness
