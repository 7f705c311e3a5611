// lorentz fuzz list, show, merge: the contents of stores.
#include <algorithm>
#include <deque>
#include <filesystem>

#include <lorentz/exchange.hpp>
#include "cli/app.hpp"
#include "cli/case_report.hpp"
#include "cli/fuzz.hpp"
#include "cli/output.hpp"
#include "report/claim_words.hpp"
#include "report/files/beside.hpp"
#include "report/reason.hpp"
#include "report/table.hpp"
#include "src/exchange/json_writer.hpp"

namespace lorentz::cli {
namespace {

using fuzz::Store;
using fuzz::Stored;

struct StoreOptions {
  std::string store, id;
  bool json = false, all = false;
  CaseFiles files;
};

struct MergeOptions {
  std::vector<std::string> stores;
  std::string output;
};

std::string campaign_table(const Store& store) {
  report::Table table({"campaign", "engine", "seed", "shard", "version", "options"});
  table.with_prose();
  for (const fuzz::Campaign& campaign : store.campaigns()) {
    const fuzz::CampaignManifest& m = campaign.manifest;
    table.add({std::to_string(campaign.id), m.engine, std::to_string(m.seed), m.shard, m.version, m.options});
  }
  return table.text();
}

std::string finding_table(const std::vector<Stored>& findings) {
  report::Table table({"finding", "bits", "margin", "cause"});
  table.with_prose();
  for (const Stored& one : findings)
    table.add({one.label(), std::to_string(one.finding.bits),
               one.finding.text.margin ? fmt::format("{:.2g}", *one.finding.text.margin) : "-",
               one.finding.cause});
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

int list(const StoreOptions& options) {
  const Store store(options.store, Store::Access::read, say_left_out);
  std::vector<Stored> findings = store.findings();
  std::stable_sort(findings.begin(), findings.end(), [](const Stored& a, const Stored& b) {
    return fuzz::rank_of(a.finding.kind) < fuzz::rank_of(b.finding.kind);
  });
  if (options.json) {
    print(json_of_list(store, findings));
    return store.is_whole() ? kDone : kFailed;
  }
  print(campaign_table(store));
  for (const fuzz::Campaign& campaign : store.campaigns())
    print(fmt::format("\ncampaign {}\n{}", campaign.id, report_of(store, campaign).target_table()));
  print("\n");
  if (findings.empty())
    print("no findings\n");
  else
    print(options.all ? finding_table(findings) : table_of(causes_of(findings)));
  return store.is_whole() ? kDone : kFailed;
}

std::string lines_of(const std::string& heading, const fuzz::CaseText& text, NumberFormat precision) {
  return '\n' + heading + '\n' + text_of(text, precision);
}

// The claim of the campaign that found it.
Claim claim_of(const Store& store, const Stored& one) {
  for (const fuzz::Campaign& campaign : store.campaigns())
    if (campaign.id == one.campaign) return cli::claim_of(campaign.manifest);
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
    return out + "not shrunk yet: the campaign does so when it is gone on with\n" +
           lines_of("as found:", f.text, claim.precision);
  return out + lines_of(heading_of_shrunk(f), f.shrunk, claim.precision) +
         lines_of("as found:", f.text, claim.precision);
}

// The report of the shrunk case, which is the one to examine.
CaseReport case_report(const Store& store, const Stored& one, const CaseFiles& files) {
  const fuzz::Finding& finding = one.finding;
  fuzz::ReadCase read = fuzz::case_in(finding.shrunk);
  CaseReport report;
  report.title = "finding " + one.label();
  report.command = fmt::format("lorentz fuzz show {} --store {}{}", shell_quoted(one.label()),
                               shell_quoted(store.path()), files.as_typed());
  report.claim = claim_of(store, one);
  report.cause = finding.cause;
  report.where = "campaign target " + finding.target;
  report.verdict = finding.kind == "wrong time" ? "wrong-time" : finding.kind;
  report.scene = std::move(read.scene);
  report.query = read.query;
  report.given = read.given;
  report.exact = read.exact;
  report.decisive = report::decisive_of(report.scene, report.query, report.exact, *report.given);
  const auto dispute = report::dispute_of(oracle::Margins(report.scene, report.claim.precision), report.scene,
                                          report.query, report.exact, *report.given, report.decisive);
  if (dispute) report.explanation = dispute->text;
  if (!finding.words.empty()) report.more.push_back("It was asked in other words: " + finding.words);
  if (finding.shrunk.departs > 0) report.by_ulps = finding.shrunk.departs;
  for (const fuzz::Campaign& campaign : store.campaigns())
    if (campaign.id == one.campaign) report.engine = campaign.manifest.engine;
  return report;
}

int show(const StoreOptions& options) {
  const Store store(options.store, Store::Access::read, say_left_out);
  for (const Stored& one : store.findings()) {
    if (one.label() != options.id) continue;
    if (options.files.any()) options.files.write(case_report(store, one, options.files));
    print(options.json ? json::line_of([&](json::Members& object) { add_finding(object, one); })
                       : text_of(options.id, one.finding, claim_of(store, one)));
    return kDone;
  }
  throw InputError(fmt::format("{}: no finding is called {}; `lorentz fuzz list --all` has the names",
                               options.store, json_quoted(options.id)));
}

int merge_stores(const MergeOptions& options) {
  std::error_code error;
  if (std::filesystem::exists(options.output, error))
    throw InputError(options.output + ": is there already; merge into a new store");
  // An incomplete store would look like a complete one, so the store is built beside its final place.
  const std::string place = place_of(options.output);
  const Beside folder(place, Beside::Kind::folder);
  const std::string store = folder.path() + "/store";
  std::deque<Unfinished> files;
  for (const char* end : {"", "-wal", "-shm", ".lock"}) files.emplace_back(store + end);
  {
    Store into(store, Store::Access::write);
    fuzz::merge(options.stores, into);
    for (const fuzz::Campaign& campaign : into.campaigns())
      say("{}: campaign {} of {} merged from {} shards{}", options.output, campaign.id,
          campaign.manifest.engine, options.stores.size(),
          campaign.manifest.shard == fuzz::CampaignManifest::kMerged
              ? "; they are not all there, or not equally far: to be read, not gone on with"
              : "");
  }
  std::filesystem::rename(store, place);
  return kDone;
}

Option store_row(StoreOptions& options) {
  return {"--store", &options.store, "FILE", "the store", kRequired};
}

}  // namespace

Command fuzz_list_command() {
  auto options = std::make_shared<StoreOptions>();
  return {"list",
          "What a store holds: campaigns, with the counters of their targets, and findings by cause.",
          {store_row(*options),
           {"--all", &options->all, "", "every finding"},
           {"--json", &options->json, "", "one JSON object with all campaigns and findings"}},
          "Example:\n  lorentz fuzz list --store published.campaign",
          [options] { return list(*options); }};
}

Command fuzz_show_command() {
  auto options = std::make_shared<StoreOptions>();
  return {"show", "One finding: shrunk, and as it was found.",
          joined({store_row(*options),
                  {"ID", &options->id, "TEXT", "CAMPAIGN/TARGET/INDEX, as in the list", kRequired},
                  {"--json", &options->json, "", "one JSON object"}},
                 options->files.rows()),
          "Example:\n  lorentz fuzz show 1/leaving/6 --store published.campaign",
          [options] { return show(*options); }};
}

Command fuzz_merge_command() {
  auto options = std::make_shared<MergeOptions>();
  return {"merge",
          "Puts the stores of shards together: as if one run had made them.",
          {{"STORE", &options->stores, "FILE", "stores of shards of one campaign", kRequired},
           {"-o,--output", &options->output, "FILE", "the new store", kOutput | kRequired}},
          "Example:\n  lorentz fuzz merge shard-0.campaign shard-1.campaign -o both.campaign",
          [options] { return merge_stores(*options); }};
}

}  // namespace lorentz::cli
