// lorentz doctor: whether this machine and this build give trustworthy results.
#include <lorentz/batch.hpp>
#include <lorentz/exchange.hpp>

#include <algorithm>
#include <cfenv>

#include "cli/app.hpp"
#include "cli/output.hpp"
#include "judge/fitness.hpp"
#include "report/manifest.hpp"
#include "src/exchange/json_writer.hpp"
#include "src/exchange/nearest_name.hpp"

namespace lorentz::cli {
namespace {

using fitness::Symptom;
using fitness::Use;

std::vector<Symptom> all_findings() {
  std::vector<Symptom> findings = fitness::findings_of(arithmetic_checks());
  for (Symptom& finding : fitness::examine_known_answers()) findings.push_back(std::move(finding));
  return findings;
}

// The names of the uses for which the machine is fit, or of those for which it is not.
std::vector<std::string> uses_of(const std::vector<Use>& unfit, bool fit) {
  std::vector<std::string> names;
  for (const Use use : fitness::kUses)
    if ((std::ranges::count(unfit, use) == 0) == fit) names.emplace_back(fitness::name_of(use));
  return names;
}

std::string verdict(const std::vector<Use>& unfit) {
  if (unfit.empty()) return "Fit: answers here are what they are everywhere.\n";
  const std::vector<std::string> fit = uses_of(unfit, true);
  return fmt::format("NOT FIT for {}.\n{}docs/doctor.md says what each finding means, and what helps.\n",
                     fmt::join(uses_of(unfit, false), "; "),
                     fit.empty() ? "" : fmt::format("Fit for {}.\n", fmt::join(fit, "; ")));
}

std::string text_of(const report::Manifest& its, const std::vector<Symptom>& findings,
                    const std::vector<Use>& unfit) {
  const std::string vectors = Batch::instruction_sets().front();
  const bool lanes = vectors != "none";
  std::string text = fmt::format(
      "lorentz {} ({})\n  compiled by    {}\n  options        {}\n  machine        {}\n  vectors        {}\n "
      " fused a b + c  {}\n\n",
      its.version, its.commit, its.compiler, its.flags, its.machine,
      lanes ? vectors : "none: batches take as long as single flights",
      lanes ? "in hardware" : "by splitting: slower, the same answers");
  for (const Symptom& finding : findings)
    text +=
        fmt::format("  {:<8}  {:<37}  {}\n", finding.fit ? "fit" : "NOT FIT", finding.name, finding.found);
  text += "\nlibraries: " + fmt::format("{}", fmt::join(library_versions(), ", ")) + "\n\n";
  return text + verdict(unfit);
}

std::string json_of(const report::Manifest& its, const std::vector<Symptom>& findings,
                    const std::vector<Use>& unfit) {
  return json::line_of([&](json::Members& object) {
    object.add("fit", unfit.empty(), "fit_for", uses_of(unfit, true), "not_fit_for", uses_of(unfit, false),
               "version", its.version, "compiler", its.compiler, "machine", its.machine, "instructions",
               Batch::instruction_sets(), "findings",
               json::objects(findings,
                             [](json::Members& one, const Symptom& finding) {
                               one.add("name", finding.name, "fit", finding.fit, "found", finding.found);
                             }),
               "libraries", library_versions());
  });
}

int run_doctor(bool as_json) {
  const std::vector<Symptom> findings = all_findings();
  std::fesetround(FE_TONEAREST);
  const std::vector<Use> unfit = fitness::unfit_uses(findings);
  const report::Manifest manifest = report::manifest_of(0, command_line());
  print(as_json ? json_of(manifest, findings, unfit) : text_of(manifest, findings, unfit));
  return unfit.empty() ? kDone : kDisagreement;
}

}  // namespace

Command doctor_command() {
  auto json = std::make_shared<bool>(false);
  return {"doctor",
          "Is this machine fit? Looks at its arithmetic and at this build, and computes known "
          "answers again with every engine and both oracles.",
          {{"--json", json.get(), "", "one JSON object"}},
          "Exit status: 0 fit, 1 not fit for something that is named, 2 bad usage, 3 the work could not be "
          "done.\n"
          "Example:\n  lorentz doctor",
          [json] { return run_doctor(*json); }};
}

}  // namespace lorentz::cli
