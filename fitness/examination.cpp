#include "fitness/examination.hpp"

#include <algorithm>

#include <lorentz/environment.hpp>
#include "fitness/digests/digests.hpp"
#include "fitness/known_answers.hpp"

namespace lorentz::fitness {
namespace {

// How many digests are not those that are known, and the first of them by name.
Finding examine_digests() {
  const std::vector<Digest> found = digests(kKnownFlights), &known = known_digests();
  std::vector<std::string> others;
  for (std::size_t i = 0; i < found.size(); ++i)
    if (i >= known.size() || !(found[i] == known[i])) others.push_back(found[i].name);
  const std::string all = std::to_string(found.size());
  return {"digests of seeded flights",
          others.empty(),
          others.empty()
              ? "all " + all + " as known"
              : std::to_string(others.size()) + " of " + all + " differ, first of them: " + others[0],
          {Use::engines}};
}

}  // namespace

const char* name_of(Use use) {
  switch (use) {
    case Use::engines:
      return "the binary64 engines, paths and starts";
    case Use::oracle:
      return "exact answers";
    case Use::certificates:
      return "certificates";
    case Use::itineraries:
      return "certified trajectories";
  }
  return "";
}

std::vector<Finding> examine_arithmetic() {
  std::vector<Finding> findings;
  for (const ArithmeticCheck& check : arithmetic_checks())
    findings.push_back({check.name,
                        check.fit,
                        check.fit ? check.found : check.found + "; it should be: " + check.expected,
                        {std::begin(kUses), std::end(kUses)}});
  return findings;
}

std::vector<Finding> examine_answers() {
  std::vector<Finding> findings{examine_digests()};
  for (Finding& finding : examine_known_answers()) findings.push_back(std::move(finding));
  return findings;
}

std::vector<Use> unfit_uses(const std::vector<Finding>& findings) {
  std::vector<Use> uses;
  for (const Use use : kUses)
    if (std::any_of(findings.begin(), findings.end(), [use](const Finding& finding) {
          return !finding.fit &&
                 std::find(finding.spoiled.begin(), finding.spoiled.end(), use) != finding.spoiled.end();
        }))
      uses.push_back(use);
  return uses;
}

}  // namespace lorentz::fitness
