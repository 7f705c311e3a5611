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
  Finding finding{"digests of seeded flights", found.size() == known.size(), "", {Use::engines}};
  std::size_t others = 0;
  for (std::size_t i = 0; finding.fit && i < found.size(); ++i) {
    if (found[i] == known[i]) continue;
    finding.found += (others++ == 0 ? ", first of " : "") + (others == 1 ? found[i].name : "");
  }
  finding.fit = finding.fit && others == 0;
  const std::string all = std::to_string(known.size());
  finding.found = finding.fit ? "all " + all + " as known"
                              : std::to_string(others) + " of " + all + " differ" + finding.found;
  return finding;
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
