// lorentz fuzz: runs a campaign, or goes on with one, and reports.
#include "cli/fuzz.hpp"

#include <algorithm>
#include <chrono>
#include <thread>

#include <lorentz/exchange.hpp>
#include <lorentz/margin.hpp>
#include "cli/exit_status.hpp"
#include "cli/messages.hpp"
#include "cli/numbers.hpp"
#include "cli/progress.hpp"
#include "cli/terminal.hpp"
#include "compare/answerer.hpp"
#include "compare/registry.hpp"
#include "compare/sampling.hpp"
#include "fuzz/campaign/ranks.hpp"
#include "fuzz/examine/engine_subject.hpp"

namespace lorentz::cli {

using namespace compare;

namespace {

using fuzz::Kind;
using fuzz::Store;

constexpr double kDefaultSeconds = 60;
constexpr std::uint64_t kMostCases = 1'000'000'000'000;

struct Options {
  std::vector<std::string> targets;
  std::optional<std::string> seconds, count, store, ulps, timeout;
  std::string engine = "reduction", seed = std::to_string(kDefaultSeed), jobs = "1", shard = "0/1",
              keep = "3", mutate = "32", reword = "1", judge = "oracle";
  bool json = false, first = false, times = false, undecided = false, no_undecided = false;
};

std::vector<const cases::Target*> targets_of(const Options& options) {
  std::vector<std::string> names;
  for (const cases::Target& target : cases::targets()) names.emplace_back(target.name());
  std::vector<const cases::Target*> targets;
  for (const std::string& name : names_in(options.targets)) {
    const cases::Target* target = cases::target_named(name);
    if (!target)
      throw InputError(fmt::format("--target: no target is called {}; there are {}", json_quoted(name),
                                   fmt::join(names, ", ")));
    if (std::find(targets.begin(), targets.end(), target) != targets.end())
      throw InputError(fmt::format("--target: {} is named twice", name));
    targets.push_back(target);
  }
  if (targets.empty())
    for (const cases::Target& target : cases::targets()) targets.push_back(&target);
  return targets;
}

void set_shard(const std::string& text, fuzz::Plan& plan) {
  const auto slash = text.find('/');
  if (slash == std::string::npos)
    throw InputError(
        fmt::format("--shard: {} is not I/N, like 0/4 for the first of four", json_quoted(text)));
  plan.shards = whole_number(text.substr(slash + 1), "--shard", 1, 1'000'000);
  plan.shard = whole_number(text.substr(0, slash), "--shard", 0, plan.shards - 1);
}

fuzz::Truth truth_of(const Options& options) {
  if (options.judge == "oracle") return fuzz::Truth::oracle;
  if (options.judge != "certified")
    throw InputError(
        fmt::format("--judge: {} is none; there are oracle and certified", json_quoted(options.judge)));
  if (traits_of(options.engine).uses_reduction)
    throw InputError("--judge: certified rests on reduction, and is no judge of either; use oracle");
  return fuzz::Truth::certified;
}

fuzz::Plan plan_of(const Options& options) {
  fuzz::Plan plan;
  plan.targets = targets_of(options);
  plan.seed = whole_number(options.seed, "--seed", 0, ~std::uint64_t{0});
  set_shard(options.shard, plan);
  plan.keep = whole_number(options.keep, "--keep", 1, 1'000'000);
  plan.mutate = whole_number(options.mutate, "--mutate", 0, 1'000'000'000);
  plan.reword = whole_number(options.reword, "--reword", 0, 1'000'000'000);
  plan.truth = truth_of(options);
  plan.counts.times = options.times;
  plan.counts.undecided =
      options.undecided || (!options.no_undecided && !traits_of(options.engine).leaves_undecided);
  plan.counts.ulps = tolerance(options.ulps);
  return plan;
}

fuzz::Bounds bounds_of(const Options& options) {
  fuzz::Bounds bounds;
  if (options.count) bounds.count = whole_number(*options.count, "--count", 1, kMostCases);
  const auto seconds = positive_number(options.seconds, "--time");
  if (seconds || !options.count) bounds.seconds = seconds.value_or(kDefaultSeconds);
  bounds.first = options.first;
  bounds.jobs = static_cast<unsigned>(whole_number(options.jobs, "--jobs", 1, 1024));
  return bounds;
}

fuzz::Manifest manifest_of(const fuzz::Plan& plan, const std::string& engine) {
  fuzz::Manifest manifest;
  manifest.version = LORENTZ_VERSION;
  manifest.engine = engine;
  for (const cases::Target* target : plan.targets)
    manifest.targets += (manifest.targets.empty() ? "" : ",") + std::string(target->name());
  manifest.seed = plan.seed;
  manifest.keep = plan.keep;
  // Words of a store: another text would be another campaign, and "mutants" is what variants were called.
  manifest.options =
      fmt::format("ulps {}, mutants of 1 in {}, reworded 1 in {}, {} kept{}{}{}", plan.counts.ulps,
                  plan.mutate, plan.reword, plan.keep, plan.counts.times ? ", times" : "",
                  plan.counts.undecided ? "" : ", without undecided",
                  plan.truth == fuzz::Truth::certified ? ", judged by certified" : "");
  manifest.shard = fmt::format("{}/{}", plan.shard, plan.shards);
  return manifest;
}

// The store's journal, with a progress bar: of seconds, or of cases.
class JournalWithProgress final : public fuzz::Journal {
 public:
  JournalWithProgress(Store& store, std::int64_t campaign, const fuzz::Bounds& bounds, std::size_t targets)
      : journal_(store, campaign),
        by_time_(bounds.count > kMostCases),
        progress_(by_time_ ? "seconds" : "cases",
                  by_time_ ? static_cast<std::size_t>(bounds.seconds) : bounds.count * targets, 1) {}

  void record(const cases::Target& target, const fuzz::TargetTally& tally,
              const std::vector<fuzz::Finding>& kept) override {
    done_[target.name()] = tally.next;
    journal_.record(target, tally, kept);
  }
  void tick() override {
    journal_.tick();
    std::size_t done = 0;
    for (const auto& [target, next] : done_) done += next;
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start_;
    progress_.at(by_time_ ? static_cast<std::size_t>(seconds.count()) : done);
  }

 private:
  fuzz::StoreJournal journal_;
  bool by_time_;
  Progress progress_;
  std::map<std::string_view, std::uint64_t> done_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

int exit_status(const FuzzReport& report, bool times, bool subject_failed) {
  if (subject_failed) return kFailed;
  const bool wrong = report.total(Kind::wrong) + report.total(Kind::error) > 0;
  return wrong || (times && report.total(Kind::wrong_time) > 0) ? kDisagreement : kDone;
}

// What the plan, the store and the other processes make of it; reports.
int run_campaign(const Options& options, const fuzz::Plan& plan, const fuzz::MakeSubject& make_subject,
                 fuzz::Ranks* ranks) {
  const fuzz::Bounds bounds = bounds_of(options);
  FuzzReport report;
  report.manifest = manifest_of(plan, options.engine);
  Store store(options.store.value_or(":memory:"), Store::Access::write);
  const std::int64_t campaign = store.open_campaign(report.manifest);
  bool resumed = false;
  for (const cases::Target* target : plan.targets) {
    report.targets.emplace_back(target->name());
    report.tallies.push_back(store.tally(campaign, target->name()));
    resumed |= report.tallies.back().next > 0;
  }
  std::vector<fuzz::Finding> unshrunk;
  for (const fuzz::Stored& one : store.findings())
    if (one.campaign == campaign && one.finding.shrinking != fuzz::Shrinking::done)
      unshrunk.push_back(one.finding);
  if (resumed) say("{}: goes on with campaign {}", store.path(), campaign);
  bool failed = false;
  {
    JournalWithProgress journal(store, campaign, bounds, plan.targets.size());
    failed = fuzz::run(plan, bounds, make_subject, report.tallies, journal, ranks, unshrunk);
  }
  for (fuzz::Stored& one : store.findings())
    if (one.campaign == campaign) report.findings.push_back(std::move(one));
  print(options.json ? report.json() : report.text());
  return exit_status(report, options.times, failed);
}

int act(const Options& options) {
  const fuzz::Plan plan = plan_of(options);
  const unsigned jobs = bounds_of(options).jobs;
  const double timeout =
      positive_number(options.timeout, "--timeout").value_or(AnswererOptions::kDefaultTimeout);
  const fuzz::MakeSubject make_subject = fuzz::subject_maker(options.engine, {{}, timeout, terminal()});
  const std::unique_ptr<fuzz::Ranks> ranks = fuzz::Ranks::join();
  if (!ranks) return run_campaign(options, plan, make_subject, nullptr);
  try {
    if (ranks->rank() == 0) return run_campaign(options, plan, make_subject, ranks.get());
    ranks->work(plan, jobs, make_subject);
    return kDone;
  } catch (const std::exception& error) {  // nobody waits for a process that is gone
    say("{}", error.what());
    ranks->abort(kFailed);
  }
}

void add_options(CLI::App* command, Options& options) {
  std::vector<std::string> names;
  for (const cases::Target& target : cases::targets()) names.emplace_back(target.name());
  command
      ->add_option("-t,--target", options.targets,
                   fmt::format("what to aim at (default: all): {}", fmt::join(names, ", ")))
      ->type_name("T");
  command->add_option("-e,--engine", options.engine, names_for_help())->capture_default_str()->type_name("E");
  command->add_option("--time", options.seconds, "how long (default: 60, or until --count)")
      ->type_name("SECONDS");
  command
      ->add_option("--count", options.count,
                   "until each target has had so many cases, its variants not counted")
      ->type_name("N");
  command->add_option("--seed", options.seed, "of the cases")->capture_default_str()->type_name("N");
  command
      ->add_option("--jobs", options.jobs,
                   "threads (of each process, under mpirun); the findings are the same")
      ->capture_default_str()
      ->type_name("N");
  command->add_option("--store", options.store, "where findings are kept and campaigns gone on with")
      ->type_name("FILE");
  command->add_option("--shard", options.shard, "only the indices I modulo N")
      ->capture_default_str()
      ->type_name("I/N");
  command->add_option("--keep", options.keep, "findings of one sort that are kept and shrunk, of each target")
      ->capture_default_str()
      ->type_name("N");
  command
      ->add_option("--mutate", options.mutate,
                   "climb to smaller margins from one in so many cases; 0: from none")
      ->capture_default_str()
      ->type_name("N");
  command
      ->add_option("--reword", options.reword,
                   "ask one in so many cases, and its variants, in other words, too; 0: none")
      ->capture_default_str()
      ->type_name("N");
  command
      ->add_option(
          "--judge", options.judge,
          "whose answers are the truth: oracle, or certified, which is faster and rests on reduction")
      ->capture_default_str()
      ->type_name("J");
  command->add_flag("--first", options.first, "stop at the first finding");
  command
      ->add_option("--ulps", options.ulps,
                   "the tolerance k, as in `compare` (default: 4); 0: the exact answer and no other")
      ->type_name("K");
  command->add_option("--timeout", options.timeout, kTimeoutHelp)->type_name("SECONDS");
  command->add_flag("--times", options.times, "wrong times are findings, too");
  CLI::Option* undecided = command->add_flag("--undecided", options.undecided,
                                             "`undecided` is a finding (the default, but for reduction)");
  command->add_flag("--no-undecided", options.no_undecided, "`undecided` is no finding")->excludes(undecided);
  command->add_flag("--json", options.json, "one JSON object instead of tables");
}

}  // namespace

void add_fuzz(CLI::App& app, Action& action) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand(
      "fuzz",
      "Campaigns: hard cases and variants of them until an engine fails, and what is found made readable.");
  add_options(command, *options);
  add_fuzz_store(*command, action);
  command->require_subcommand(0, 1);
  command->footer(
      "docs/campaigns.md: targets, variants, what is a finding, how it is shrunk, the store.\n"
      "Example:\n  lorentz fuzz --engine published --time 60 --store published.campaign\n"
      "  lorentz fuzz list --store published.campaign");
  command->callback([options, command, &action] {
    if (command->get_subcommands().empty()) action = [options] { return act(*options); };
  });
}

}  // namespace lorentz::cli
