// lorentz fuzz: runs or resumes a campaign, and reports.
#include "cli/fuzz.hpp"

#include <lorentz/exchange.hpp>
#include "cli/app.hpp"
#include "cli/exit_status.hpp"
#include "cli/fuzz_options.hpp"
#include "cli/fuzz_progress.hpp"
#include "cli/interrupt.hpp"
#include "cli/output.hpp"
#include "cli/terminal.hpp"
#include "fuzz/campaign/ranks.hpp"
#include "fuzz/examine/answerers.hpp"
#include "golden/record.hpp"
#include "question/answerer.hpp"
#include "report/claim_words.hpp"

namespace lorentz::cli {

using namespace question;

namespace {

using fuzz::Kind;
using fuzz::Store;

constexpr double kDefaultSecondsALine = 60;

int exit_status(const FuzzReport& report, bool times, bool answerer_failed) {
  if (answerer_failed) return kFailed;
  const bool wrong = report.total(Kind::wrong) + report.total(Kind::error) > 0;
  return wrong || (times && report.total(Kind::wrong_time) > 0) ? kDisagreement : kDone;
}

// Throws InputError if the options need a campaign that is the same on every machine and this one is not.
void check_files(const FuzzOptions& options) {
  const auto option = options.files.first_option();
  if (option && (!options.count || options.seconds || options.first))
    throw InputError(*option +
                     ": needs --count, and neither --time nor --first, so that each run asks the same");
}

// Records the kept failures by target and by the id of the case as found.
void take_down(const FuzzReport& report, bool times, FailureLedger& ledger) {
  for (const std::string& target : report.targets) {
    bool failed = false;
    for (const fuzz::Stored& stored : report.findings) {
      const fuzz::Finding& finding = stored.finding;
      const bool counts = finding.kind == name_of(Kind::wrong) || finding.kind == name_of(Kind::error) ||
                          (times && finding.kind == name_of(Kind::wrong_time));
      if (!counts || finding.target != target) continue;
      const fuzz::ReadCase found = fuzz::case_in(finding.text);
      ledger.take(target, golden::id_of(found.scene, found.query), tag_of(finding.kind));
      failed = true;
    }
    if (!failed) ledger.take(target, "no-failure", std::nullopt);
    ledger.end(target);
  }
}

void say_how_to_go_on(const FuzzOptions& options) {
  if (options.store)
    say("{}; this goes on: {}", Interrupt::what(), command_of(options));
  else
    say("{}; without --store nothing is kept to go on with", Interrupt::what());
}

// A campaign in its store, with its current progress.
struct Opened {
  FuzzReport report;
  std::int64_t campaign = 0;
  std::vector<fuzz::Finding> unshrunk;
};

std::vector<fuzz::Stored> findings_of(const Store& store, std::int64_t campaign) {
  std::vector<fuzz::Stored> findings = store.findings();
  std::erase_if(findings, [&](const fuzz::Stored& one) { return one.campaign != campaign; });
  return findings;
}

// A store has one claim. Otherwise it would mix margins and findings in ulps of different precisions.
void check_claim(const Store& store, const Claim& claim) {
  for (const fuzz::Campaign& campaign : store.campaigns()) {
    const Claim known = claim_of(campaign.manifest);
    if (known == claim) continue;
    const std::string arguments = report::arguments_of(known);
    throw InputError(
        fmt::format("{}: its campaign {} is judged{}; go on with {}, or name another store", store.path(),
                    campaign.id, report::full_words_of(known),
                    arguments.empty() ? "neither --precision nor --time-tolerance" : arguments.substr(1)));
  }
}

Opened opened(Store& store, const fuzz::Plan& plan, const FuzzOptions& options) {
  check_claim(store, plan.claim);
  Opened one;
  one.report.is_stored = options.store.has_value();
  one.report.manifest = manifest_of(plan, options.engine);
  one.campaign = store.open_campaign(one.report.manifest);
  bool resumed = false;
  for (const cases::Target* target : plan.targets) {
    one.report.targets.emplace_back(target->name());
    one.report.tallies.push_back(store.tally(one.campaign, target->name()));
    resumed |= one.report.tallies.back().next > 0;
  }
  for (fuzz::Stored& found : findings_of(store, one.campaign))
    if (found.finding.shrinking != fuzz::Shrinking::done) one.unshrunk.push_back(std::move(found.finding));
  if (resumed) say("{}: goes on with campaign {}", store.path(), one.campaign);
  return one;
}

// Runs the plan with the store and the other processes, and reports.
int run_campaign(const FuzzOptions& options, const fuzz::Plan& plan,
                 const question::MakeAnswerer& make_answerer, fuzz::Ranks* ranks) {
  const Interrupt interrupt;
  fuzz::Bounds bounds = bounds_of(options);
  bounds.stop = &Interrupt::came();
  FailureLedger ledger(options.files, options.files.known());
  Store store(options.store.value_or(":memory:"), Store::Access::write, say_left_out);
  auto [report, campaign, unshrunk] = opened(store, plan, options);
  bool failed = false;
  {
    JournalWithProgress journal(store, campaign, bounds, plan.targets.size(),
                                options.progress.value_or(kDefaultSecondsALine));
    failed = fuzz::run(plan, bounds, make_answerer, report.tallies, journal, ranks, unshrunk);
  }
  report.findings = findings_of(store, campaign);
  print(options.json ? report.json() : report.text());
  if (Interrupt::came()) say_how_to_go_on(options);
  std::uint64_t cases = 0, indices = 0;
  for (const fuzz::TargetTally& tally : report.tallies) cases += tally.cases, indices += tally.next;
  if (cases == 0 && indices > 0 && !plan.scope.is_all()) {
    say("no case was asked: none of the first indices has a scene for --dimension and --scenes; take a "
        "larger --count");
    return kBadInput;
  }
  const int status = exit_status(report, options.times, failed);
  if (Interrupt::came()) return status;
  take_down(report, options.times, ledger);
  ledger.finish(options.engine);
  return !ledger.has_baseline() || failed ? status : ledger.new_failures() > 0 ? kDisagreement : kDone;
}

int act(const FuzzOptions& options) {
  check_files(options);
  const fuzz::Plan plan = plan_of(options);
  const unsigned jobs = bounds_of(options).jobs;
  const double timeout = options.timeout.value_or(AnswererOptions::kDefaultTimeout);
  const question::MakeAnswerer make_answerer =
      fuzz::answerer_maker(question::engine_named(options.engine), {{}, timeout, terminal()});
  const std::unique_ptr<fuzz::Ranks> ranks =
      runs::join<fuzz::Ranks>("--jobs, or --shard and `lorentz fuzz merge`");
  if (!ranks) return run_campaign(options, plan, make_answerer, nullptr);
  try {
    if (ranks->rank() == 0) return run_campaign(options, plan, make_answerer, ranks.get());
    ranks->work(plan, jobs, make_answerer);
    return kDone;
  } catch (const std::exception& error) {  // so that no rank waits for one that has ended
    say("{}", error.what());
    ranks->abort(kFailed);
  }
}

}  // namespace

Command fuzz_command() {
  auto options = std::make_shared<FuzzOptions>();
  return {
      "fuzz",
      "Campaigns: hard cases and variants of them until an engine fails, and what is found made readable.",
      rows_of(*options),

      "docs/campaigns.md: targets, variants, what is a finding, how it is shrunk, the store.\n"
      "Example:\n  lorentz fuzz --engine published --time 60 --store published.campaign\n"
      "  lorentz fuzz list --store published.campaign",
      [options] { return act(*options); },
      {fuzz_list_command(), fuzz_show_command(), fuzz_export_command(), fuzz_merge_command()}};
}

}  // namespace lorentz::cli
