// lorentz doctor: whether this machine and this build give trustworthy results.
#include <lorentz/batch.hpp>
#include <lorentz/exchange.hpp>

#include <algorithm>
#include <cfenv>

#include "cli/app.hpp"
#include "cli/output.hpp"
#include "judge/fitness/examination.hpp"
#include "report/manifest.hpp"
#include "src/exchange/json_writer.hpp"
#include "src/exchange/nearest_name.hpp"

namespace lorentz::cli {
namespace {

using fitness::Symptom;
using fitness::Use;

struct DoctorOptions {
  bool json = false;
  std::string rounding;
};

/// The findings and their consequences.
struct MachineReport {
  report::Manifest manifest;
  std::vector<std::string> instruction_sets, libraries;
  std::vector<Symptom> findings;
  std::vector<Use> unfit;

  bool fit() const { return unfit.empty(); }
};

// For tests: a wrong rounding mode must be detected.
void set_rounding(const std::string& mode) {
  constexpr int kModes[] = {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO};
  std::fesetround(kModes[index_of_name(mode, {"upward", "downward", "toward-zero"}, "--pretend-rounding")]);
}

MachineReport diagnose() {
  MachineReport diagnosis{
      report::manifest_of(0, command_line()), Batch::instruction_sets(), library_versions(), {}, {}};
  diagnosis.findings = fitness::examine_arithmetic();
  for (Symptom& finding : fitness::examine_answers()) diagnosis.findings.push_back(std::move(finding));
  diagnosis.unfit = fitness::unfit_uses(diagnosis.findings);
  return diagnosis;
}

// The names of the uses for which the machine is fit, or of those for which it is not.
std::vector<std::string> uses_of(const MachineReport& diagnosis, bool fit) {
  std::vector<std::string> names;
  for (const Use use : fitness::kUses)
    if ((std::ranges::count(diagnosis.unfit, use) == 0) == fit) names.emplace_back(fitness::name_of(use));
  return names;
}

std::string verdict(const MachineReport& diagnosis) {
  if (diagnosis.fit()) return "Fit: answers here are what they are everywhere.\n";
  const std::vector<std::string> fit = uses_of(diagnosis, true);
  return fmt::format("NOT FIT for {}.\n{}docs/doctor.md says what each finding means, and what helps.\n",
                     fmt::join(uses_of(diagnosis, false), "; "),
                     fit.empty() ? "" : fmt::format("Fit for {}.\n", fmt::join(fit, "; ")));
}

std::string text_of(const MachineReport& diagnosis) {
  const bool lanes = diagnosis.instruction_sets.front() != "none";
  std::string text = fmt::format(
      "lorentz {} ({})\n  compiled by    {}\n  options        {}\n  machine        {}\n  vectors        {}\n "
      " fused a b + c  {}\n\n",
      diagnosis.manifest.version, diagnosis.manifest.commit, diagnosis.manifest.compiler,
      diagnosis.manifest.flags, diagnosis.manifest.machine,
      lanes ? diagnosis.instruction_sets.front() : "none: batches take as long as single flights",
      lanes ? "in hardware" : "by splitting: slower, the same answers");
  for (const Symptom& finding : diagnosis.findings)
    text +=
        fmt::format("  {:<8}  {:<37}  {}\n", finding.fit ? "fit" : "NOT FIT", finding.name, finding.found);
  text += "\nlibraries: " + fmt::format("{}", fmt::join(diagnosis.libraries, ", ")) + "\n\n";
  return text + verdict(diagnosis);
}

std::string json_of(const MachineReport& diagnosis) {
  return json::line_of([&](json::Members& object) {
    object.add("fit", diagnosis.fit(), "fit_for", uses_of(diagnosis, true), "not_fit_for",
               uses_of(diagnosis, false), "version", diagnosis.manifest.version, "compiler",
               diagnosis.manifest.compiler, "machine", diagnosis.manifest.machine, "instructions",
               diagnosis.instruction_sets, "findings",
               json::objects(diagnosis.findings,
                             [](json::Members& one, const Symptom& finding) {
                               one.add("name", finding.name, "fit", finding.fit, "found", finding.found);
                             }),
               "libraries", diagnosis.libraries);
  });
}

int act(const DoctorOptions& options) {
  if (!options.rounding.empty()) set_rounding(options.rounding);
  const MachineReport diagnosis = diagnose();
  std::fesetround(FE_TONEAREST);
  print(options.json ? json_of(diagnosis) : text_of(diagnosis));
  return diagnosis.fit() ? kDone : kDisagreement;
}

}  // namespace

Command doctor_command() {
  auto options = std::make_shared<DoctorOptions>();
  return {"doctor",
          "Is this machine fit? Looks at its arithmetic and at this build, and computes known "
          "answers again with every engine and both oracles.",
          {
              {"--json", &options->json, "", "one JSON object"},
              {"--pretend-rounding", &options->rounding, "upward|downward|toward-zero", "", kHidden},
          },
          "Exit status: 0 fit, 1 not fit for something that is named, 2 bad usage, 3 the work could not be "
          "done.\n"
          "Example:\n  lorentz doctor",
          [options] { return act(*options); }};
}

}  // namespace lorentz::cli
