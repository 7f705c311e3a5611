// lorentz fuzz export: writes the findings of a campaign as a golden set or as a query stream.
#include <algorithm>
#include <map>

#include <lorentz/exchange.hpp>
#include "cli/app.hpp"
#include "cli/fuzz.hpp"
#include "cli/golden_questions.hpp"
#include "cli/output.hpp"
#include "cli/set_output.hpp"
#include "judge/golden/production.hpp"
#include "question/engines.hpp"
#include "report/claim_words.hpp"
#include "src/exchange/nearest_name.hpp"

namespace lorentz::cli {
namespace {

using fuzz::Store;
using fuzz::Stored;

struct ExportOptions {
  std::string store, output = "-";
  bool all = false, queries = false;
};

// A shrunk case and the cause that it illustrates.
struct ExportedCase {
  const Stored* stored;
  fuzz::ReadCase shrunk;
};

// The simplest finding of each cause, or all findings, grouped by scene.
std::vector<ExportedCase> examples_in(const std::vector<Stored>& findings, bool all) {
  std::vector<const Stored*> chosen;
  if (all)
    for (const Stored& one : findings) chosen.push_back(&one);
  else
    for (const FindingCause& cause : causes_of(findings)) chosen.push_back(cause.simplest);
  std::stable_sort(chosen.begin(), chosen.end(), [](const Stored* a, const Stored* b) {
    return a->finding.shrunk.scene < b->finding.shrunk.scene;
  });
  std::vector<ExportedCase> examples;
  for (const Stored* one : chosen) examples.push_back({one, fuzz::case_in(one->finding.shrunk)});
  return examples;
}

std::string queries_of(const std::vector<ExportedCase>& examples) {
  std::string scene, lines;
  for (const ExportedCase& one : examples) {
    const fuzz::CaseText& text = one.stored->finding.shrunk;
    if (text.scene != scene) lines += text.scene + '\n';
    scene = text.scene;
    lines += text.query + '\n';
  }
  return lines;
}

// Explains each tag that no finding explains yet by the aim of its target.
void explain_targets(const std::vector<fuzz::Campaign>& campaigns, std::map<std::string, std::string>& tags) {
  for (const fuzz::Campaign& campaign : campaigns)
    for (const std::string& name : items_of(campaign.manifest.targets, "targets"))
      if (const cases::Target* target = cases::target_named(name)) tags.emplace(name, target->description());
}

golden::Header header_of(const std::vector<fuzz::Campaign>& campaigns) {
  golden::Header header;
  for (const fuzz::Campaign& campaign : campaigns)
    header.precision = claim_of(campaign.manifest).precision;  // the same for all
  header.name = "findings";
  header.description = "What campaigns found, shrunk: the answers are the exact ones.";
  header.version = LORENTZ_VERSION;
  for (const fuzz::Campaign& campaign : campaigns) {
    const fuzz::CampaignManifest& m = campaign.manifest;
    header.generator += fmt::format("lorentz fuzz --engine {} --seed {} --shard {} --target {}{} ({}); ",
                                    shell_quoted(m.engine), m.seed, m.shard, m.targets,
                                    report::arguments_of(claim_of(m)), m.options);
  }
  header.generator += "lorentz fuzz export";
  return header;
}

// Findings that shrank to the same question become one record.
std::string golden_set_of(const std::vector<ExportedCase>& examples,
                          const std::vector<fuzz::Campaign>& campaigns) {
  golden::GivenQuestions given(header_of(campaigns));
  std::map<std::string, std::string> tags;
  for (const ExportedCase& one : examples) {
    const fuzz::Finding& finding = one.stored->finding;
    if (const cases::Target* target = cases::target_named(finding.target))
      tags.emplace(finding.target, target->description());
    tags.emplace(tag_of(finding.kind), "what was found: an answer of the kind `" + finding.kind + "`");
    const auto& [scene, query] = std::tie(one.shrunk.scene, one.shrunk.query);
    given.add({scene, golden::question_of(query, scene), query, {finding.target, tag_of(finding.kind)}});
  }
  if (examples.empty()) explain_targets(campaigns, tags);
  given.header.tags.assign(tags.begin(), tags.end());
  MadeSet made = made_set(given);
  say_unproved(made.counts);
  return std::move(made.text);
}

int act(const ExportOptions& options) {
  if (options.queries && options.output.ends_with('/'))
    throw InputError("--queries: is a stream, which needs no folder; name a file");
  std::optional<SetOutput> output;
  if (options.output != "-") output.emplace(options.output, "findings");
  const Store store(options.store, Store::Access::read, say_left_out);
  const std::vector<Stored> findings = store.findings();
  const std::vector<ExportedCase> examples = examples_in(findings, options.all);
  const auto text = [&] {
    return options.queries ? queries_of(examples) : golden_set_of(examples, store.campaigns());
  };
  if (output)
    output->write(text);
  else
    print(text());
  return store.is_whole() ? kDone : kFailed;
}

}  // namespace

Command fuzz_export_command() {
  auto options = std::make_shared<ExportOptions>();
  return {"export",
          "A golden set of the simplest shrunk finding of each cause: exact answers, with their proofs.",
          {
              {"--store", &options->store, "FILE", "the store", kRequired},
              {"--all", &options->all, "", "of every finding"},
              {"--queries", &options->queries, "", "a query stream instead"},
              {"-o,--output", &options->output, "FILE", kSetOutputHelp, kOutput | kTakesStdout},
          },

          "Example:\n  lorentz fuzz export --store published.campaign -o mine/; "
          "lorentz golden check mine --engine published",
          [options] { return act(*options); }};
}

}  // namespace lorentz::cli
