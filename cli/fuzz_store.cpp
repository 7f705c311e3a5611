// lorentz fuzz show: the contents of a store, and one finding of it.
#include <algorithm>

#include <lorentz/exchange.hpp>
#include "cli/app.hpp"
#include "cli/case_report.hpp"
#include "cli/fuzz.hpp"
#include "cli/output.hpp"
#include "report/claim_words.hpp"
#include "report/files/messages.hpp"
#include "report/reason.hpp"
#include "report/table.hpp"
#include "src/exchange/json_writer.hpp"

namespace lorentz::cli {
namespace {

using fuzz::Store;
using fuzz::Stored;

struct ShowOptions {
  std::string store;
  std::optional<std::string> id;
  bool json = false;
  CaseFiles files;
};

std::string campaign_table(const Store& store) {
  report::Table table({"campaign", "engine", "seed", "version", "options"});
  table.with_prose();
  for (const fuzz::Campaign& campaign : store.campaigns()) {
    const fuzz::CampaignManifest& m = campaign.manifest;
    table.add({std::to_string(campaign.id), m.engine, std::to_string(m.seed), m.version, m.options});
  }
  return table.text();
}

std::string json_of_list(const Store& store, const std::vector<Stored>& findings) {
  return json::line_of([&](json::Members& object) {
    object.add("campaigns",
               json::objects(store.campaigns(), [&](json::Members& one, const fuzz::Campaign& its) {
                 one.add("campaign", its.id);
                 report_of(store, its).add_targets(one);
               }));
    object.add("findings", json::objects(findings, add_finding));
  });
}

int list(const Store& store, const ShowOptions& options) {
  std::vector<Stored> findings = store.findings();
  std::stable_sort(findings.begin(), findings.end(), [](const Stored& a, const Stored& b) {
    return fuzz::rank_of(a.finding.kind) < fuzz::rank_of(b.finding.kind);
  });
  if (options.json) {
    print(json_of_list(store, findings));
    return kDone;
  }
  print(campaign_table(store));
  for (const fuzz::Campaign& campaign : store.campaigns())
    print(fmt::format("\ncampaign {}\n{}", campaign.id, report_of(store, campaign).target_table()));
  print(findings.empty() ? "\nno findings\n" : '\n' + table_of(causes_of(findings)));
  return kDone;
}

// The campaign that found it.
fuzz::CampaignManifest manifest_of(const Store& store, const Stored& one) {
  for (const fuzz::Campaign& campaign : store.campaigns())
    if (campaign.id == one.campaign) return campaign.manifest;
  return {};
}

std::string heading_of_shrunk(const fuzz::Finding& f) {
  const std::string so_far = fmt::format("shrunk to {} bits a number ({} tries", f.bits, f.tries);
  return so_far + (f.shrinking == fuzz::Shrinking::cut_short ? ", cut short by the time):" : "):");
}

std::string text_of(const std::string& id, const fuzz::Finding& f, const Claim& claim) {
  std::string out = fmt::format("{}: {}{}\ncause: {}\n", id, f.kind, report::words_of(claim), f.cause);
  if (!f.words.empty()) out += fmt::format("in other words: {}\n", f.words);
  if (f.shrinking == fuzz::Shrinking::due)
    out += "not shrunk yet: the campaign does so when it is resumed\n";
  else
    out += '\n' + heading_of_shrunk(f) + '\n' + cli::text_of(f.shrunk, claim);
  return out + "\nas found:\n" + cli::text_of(f.text, claim);
}

// The report of the shrunk case, which is the one to examine.
CaseReport case_report(const Store& store, const Stored& one, const CaseFiles& files) {
  const fuzz::Finding& finding = one.finding;
  fuzz::ReadCase read = fuzz::case_in(finding.shrunk);
  CaseReport report;
  report.title = "finding " + one.label();
  report.command = fmt::format("lorentz fuzz show {} --store {}{}", shell_quoted(one.label()),
                               shell_quoted(store.path()), files.as_typed());
  const fuzz::CampaignManifest manifest = manifest_of(store, one);
  report.claim = manifest.claim, report.seed = manifest.seed;
  report.ulps = manifest.ulps();
  report.engine = manifest.engine;
  report.cause = finding.cause;
  report.where = "campaign target " + finding.target;
  report.verdict = finding.kind == "wrong time" ? "wrong-time" : finding.kind;
  report.scene = std::move(read.scene);
  report.query = read.query;
  report.given = read.given;
  report.exact = read.exact;
  report.decisive =
      report::decisive_of(report.scene, report.query, report.exact, *report.given, report.claim);
  const auto dispute = report::dispute_of(oracle::Margins(report.scene, report.claim.precision), report.scene,
                                          report.query, report.exact, *report.given, report.decisive);
  if (dispute) report.explanation = dispute->text;
  if (!finding.words.empty()) report.more.push_back("It was asked in other words: " + finding.words);
  if (finding.shrunk.departs > 0) report.by_ulps = finding.shrunk.departs;
  return report;
}

int show(const Store& store, const ShowOptions& options) {
  for (const Stored& one : store.findings()) {
    if (one.label() != *options.id) continue;
    if (options.files.any()) options.files.write(case_report(store, one, options.files));
    print(options.json ? json::line_of([&](json::Members& object) { add_finding(object, one); })
                       : text_of(*options.id, one.finding, manifest_of(store, one).claim));
    return kDone;
  }
  throw InputError(
      fmt::format("{}: no finding is called {}; `lorentz fuzz show --store {} --json` has the names",
                  options.store, json_quoted(*options.id), shell_quoted(options.store)));
}

int run_fuzz_store(const ShowOptions& options) {
  if (options.files.any() && !options.id) throw InputError("--html, --svg: are of one finding; name it");
  const Store store(options.store, Store::Access::read);
  return options.id ? show(store, options) : list(store, options);
}

}  // namespace

Command fuzz_show_command() {
  auto options = std::make_shared<ShowOptions>();
  return {"show",
          "What a store holds: campaigns, with the counters of their targets, and findings by cause; or one "
          "finding, shrunk and as it was found.",
          joined({{"--store", &options->store, "FILE", "the store", kRequired},
                  {"ID", &options->id, "TEXT", "one finding: CAMPAIGN/TARGET/INDEX"},
                  {"--json", &options->json, "", "one JSON object"}},
                 options->files.rows()),
          "Example:\n  lorentz fuzz show --store published.campaign\n"
          "  lorentz fuzz show 1/published-faults/0 --store published.campaign",
          [options] { return run_fuzz_store(*options); }};
}

}  // namespace lorentz::cli
