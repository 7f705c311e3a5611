// lorentz fuzz export: writes the findings of a campaign as a golden set.
#include <algorithm>
#include <map>

#include <lorentz/exchange.hpp>
#include "cli/app.hpp"
#include "cli/fuzz.hpp"
#include "cli/golden_questions.hpp"
#include "cli/output.hpp"
#include "judge/golden/production.hpp"
#include "report/claim_words.hpp"
#include "report/files/whole_file.hpp"

namespace lorentz::cli {
namespace {

using fuzz::Store;
using fuzz::Stored;

// The simplest finding of each cause, grouped by scene.
std::vector<const fuzz::Finding*> examples_in(const std::vector<Stored>& findings) {
  std::vector<const fuzz::Finding*> chosen;
  for (const FindingCause& cause : causes_of(findings)) chosen.push_back(&cause.simplest->finding);
  std::ranges::stable_sort(chosen, {}, [](const fuzz::Finding* one) { return one->shrunk.scene; });
  return chosen;
}

// Explains each tag that no finding explains yet by the aim of its target.
void explain_targets(const std::vector<fuzz::Campaign>& campaigns, std::map<std::string, std::string>& tags) {
  for (const fuzz::Campaign& campaign : campaigns)
    for (const std::string& name : campaign.manifest.targets)
      if (const cases::Target* target = cases::target_named(name)) tags.emplace(name, target->description());
}

golden::Header header_of(const std::vector<fuzz::Campaign>& campaigns) {
  golden::Header header;
  for (const fuzz::Campaign& campaign : campaigns)
    header.precision = campaign.manifest.claim.precision;  // the same for all
  header.name = "findings";
  header.description = "What campaigns found, shrunk: the answers are the exact ones.";
  header.version = LORENTZ_VERSION;
  for (const fuzz::Campaign& campaign : campaigns) {
    const fuzz::CampaignManifest& m = campaign.manifest;
    header.generator +=
        fmt::format("lorentz fuzz --engine {} --seed {} --target {}{} ({}); ", shell_quoted(m.engine), m.seed,
                    fmt::join(m.targets, ","), report::arguments_of(m.claim), m.options);
  }
  header.generator += "lorentz fuzz export";
  return header;
}

// Findings that shrank to the same question become one record.
std::string golden_set_of(const Store& store) {
  const std::vector<Stored> findings = store.findings();
  const std::vector<fuzz::Campaign> campaigns = store.campaigns();
  golden::GivenQuestions given(header_of(campaigns));
  std::map<std::string, std::string> tags;
  for (const fuzz::Finding* finding : examples_in(findings)) {
    if (const cases::Target* target = cases::target_named(finding->target))
      tags.emplace(finding->target, target->description());
    tags.emplace(tag_of(finding->kind), "what was found: an answer of the kind `" + finding->kind + "`");
    const fuzz::ReadCase shrunk = fuzz::case_in(finding->shrunk);
    given.add({shrunk.scene,
               golden::question_of(shrunk.query, shrunk.scene),
               shrunk.query,
               {finding->target, tag_of(finding->kind)}});
  }
  if (findings.empty()) explain_targets(campaigns, tags);
  given.header.tags.assign(tags.begin(), tags.end());
  auto [text, counts] = made_set(given);
  say_unproved(counts);
  return std::move(text);
}

int run_fuzz_export(const std::string& path, const std::string& output) {
  RequestedFile file(output == "-" ? std::nullopt : std::optional(output));
  const Store store(path, Store::Access::read);
  if (output == "-")
    print(golden_set_of(store));
  else
    file.write([&] { return golden_set_of(store); });
  return kDone;
}

}  // namespace

Command fuzz_export_command() {
  auto store = std::make_shared<std::string>(), output = std::make_shared<std::string>("-");
  return {
      "export",
      "A golden set of the simplest shrunk finding of each cause: exact answers, with their proofs.",
      {{"--store", store.get(), "FILE", "the store", kRequired},
       {"-o,--output", output.get(), "FILE", "file to write (- is standard output)", kOutput | kTakesStdout}},

      "Example:\n  lorentz fuzz export --store published.campaign -o mine.ndjson; "
      "lorentz golden check mine.ndjson --engine published",
      [store, output] { return run_fuzz_export(*store, *output); }};
}

}  // namespace lorentz::cli
