// lorentz fuzz: runs or resumes a campaign, and reports.
#include "cli/fuzz.hpp"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <map>
#include <mutex>
#include <thread>

#include <lorentz/exchange.hpp>
#include "cli/app.hpp"
#include "cli/interrupt.hpp"
#include "cli/output.hpp"
#include "cli/progress.hpp"
#include "cli/terminal.hpp"
#include "fuzz/campaign/examiner.hpp"
#include "fuzz/campaign/ranks.hpp"
#include "question/answerer.hpp"
#include "report/claim_words.hpp"
#include "src/problem/threads.hpp"

namespace lorentz::cli {

using namespace question;

namespace {

using fuzz::Kind;
using fuzz::Store;

constexpr double kShareOfStart = 0.5;  // the largest, of the time, for loading an engine

int exit_status(const FuzzReport& report, bool times, bool answerer_failed) {
  if (answerer_failed) return kFailed;
  const bool wrong = report.total(Kind::wrong) + report.total(Kind::error) > 0;
  return wrong || (times && report.total(Kind::wrong_time) > 0) ? kDisagreement : kDone;
}

std::vector<fuzz::Stored> findings_of(const Store& store, std::int64_t campaign) {
  std::vector<fuzz::Stored> findings = store.findings();
  std::erase_if(findings, [&](const fuzz::Stored& one) { return one.campaign != campaign; });
  return findings;
}

// A store has one claim. Otherwise it would mix margins and findings in ulps of different precisions.
void check_claim(const Store& store, const Claim& claim) {
  for (const fuzz::Campaign& campaign : store.campaigns()) {
    const Claim& known = campaign.manifest.claim;
    if (known == claim) continue;
    const std::string arguments = report::arguments_of(known);
    throw InputError(fmt::format("{}: its campaign {} is judged{}; go on {}, or name another store",
                                 store.path(), campaign.id, report::full_words_of(known),
                                 arguments.empty() ? "without options of a claim" : "with" + arguments));
  }
}

// The campaign in its store, with its current progress.
FuzzReport opened(Store& store, const fuzz::Plan& plan, const FuzzOptions& options) {
  check_claim(store, plan.claim);
  FuzzReport report;
  report.is_stored = options.store.has_value();
  report.manifest = manifest_of(plan, options.engine());
  report.campaign = store.open_campaign(report.manifest);
  report.findings = findings_of(store, report.campaign);
  bool resumed = false;
  for (const std::string& target : report.manifest.targets) {
    report.tallies.push_back(store.tally(report.campaign, target));
    resumed |= report.tallies.back().next > 0;
  }
  if (resumed) say("{}: goes on with campaign {}", store.path(), report.campaign);
  return report;
}

// The store's journal. If stderr is a terminal, it shows a progress bar in seconds or in cases; if not, it
// prints a line at intervals.
class JournalWithProgress final : public fuzz::Journal {
 public:
  JournalWithProgress(Store& store, std::int64_t campaign, const fuzz::Bounds& bounds, std::size_t targets,
                      std::function<void(double silent)> on_end)
      : journal_(store, campaign),
        most_seconds_(bounds.seconds),
        by_time_(bounds.count > kMostCases),
        targets_(targets),
        seconds_a_line_(60 * std::chrono::duration<double>(Progress::patience()).count()),
        next_line_(isatty(STDERR_FILENO) != 1 ? seconds_a_line_ : std::numeric_limits<double>::infinity()),
        on_end_(std::move(on_end)) {
    progress_.emplace(
        by_time_ ? "seconds" : "indices",
        by_time_ ? static_cast<std::size_t>(std::clamp(bounds.seconds, 0.0, 1e18)) : bounds.count * targets,
        1);
  }

  void record(const cases::Target& target, const fuzz::TargetTally& tally,
              const std::vector<fuzz::Finding>& kept) override {
    met_[target.name()] = tally;
    journal_.record(target, tally, kept);
    last_record_ = seconds();
  }

  void tick() override {
    journal_.tick();
    const double now = seconds();
    std::size_t done = 0;
    for (const auto& [target, met] : met_) done += met.next;
    progress_->at(by_time_ ? static_cast<std::size_t>(now) : done, [&] { return summary(); });
    if (now < next_line_) return;
    next_line_ = now + seconds_a_line_;
    const std::string of = std::isfinite(most_seconds_) ? fmt::format(" of {:.0f}", most_seconds_) : "";
    say("{:.0f}{} s: {}", now, of, summary());
  }

  void ended() override {
    journal_.ended();
    progress_.reset();  // removes the bar before anything is printed
    on_end_(seconds() - last_record_);
  }

 private:
  double seconds() const { return std::chrono::duration<double>(Progress::Clock::now() - start_).count(); }

  // Like "1234 cases, 5 findings, 7 of 33 targets".
  std::string summary() const {
    std::uint64_t cases = 0, findings = 0;
    std::size_t begun = 0;
    for (const auto& [target, met] : met_) {
      cases += met.cases;
      begun += met.cases > 0;
      for (const auto& [sort, number] : met.sorts) findings += number;
    }
    return fmt::format("{} cases, {} findings, {} of {} targets", cases, findings, begun, targets_);
  }

  fuzz::StoreJournal journal_;
  const double most_seconds_;
  const bool by_time_;
  const std::size_t targets_;
  const double seconds_a_line_;
  double next_line_, last_record_ = 0;
  const std::function<void(double silent)> on_end_;
  std::optional<Progress> progress_;
  std::map<std::string_view, fuzz::TargetTally> met_;
  Progress::Clock::time_point start_ = Progress::Clock::now();
};

// Ends the program if this thread lives for more than a second: a thread may be at an exact answer of
// thousands of bits, which is not waited for once the report is printed.
std::vector<std::jthread> last_resort_of(const std::function<void()>& end) {
  return threads_of(1, [end](const std::stop_token& in_time) {
    std::mutex mutex;
    std::condition_variable_any changed;
    std::unique_lock lock(mutex);
    changed.wait_for(lock, in_time, std::chrono::seconds(1), [] { return false; });
    if (!in_time.stop_requested()) end();
  });
}

// What the end of a campaign left open.
void say_how_it_ended(const FuzzOptions& options, double silent) {
  constexpr double kLong = 1;  // seconds
  if (Interrupt::came())
    say("{}; {}", Interrupt::what(),
        options.store ? "this goes on: " + command_line() : "without --store nothing is kept to go on with");
  if (silent >= kLong)
    say("no answer was judged in the last {:.1f} s: the cases asked then are not counted", silent);
}

// Says why no case was asked, or none was answered, if that is so.
std::optional<int> status_of_none(const FuzzReport& report, const fuzz::Plan& plan,
                                  const fuzz::Bounds& bounds) {
  std::uint64_t cases = 0;
  bool is_complete = true;
  for (const fuzz::TargetTally& tally : report.tallies)
    cases += tally.cases, is_complete &= tally.next >= bounds.count;
  if (cases > 0 || (is_complete && plan.scope.is_all())) return std::nullopt;
  if (is_complete) {
    say("no case was asked: none of the first {} indices has a scene for --domain and --scenes; take a "
        "larger --count",
        bounds.count);
    return kBadInput;
  }
  say("no case was judged: the first were still being made or answered at the end{}",
      Interrupt::came() ? "" : "; take a longer --time");
  return kFailed;
}

// Runs the plan with the store and the other processes, and reports.
int run_campaign(const FuzzOptions& options, const fuzz::Plan& plan, fuzz::Bounds bounds,
                 const question::MakeAnswerer& make_answerer, fuzz::Ranks* ranks) {
  const Interrupt interrupt;
  bounds.stop = &Interrupt::came();
  std::optional<Store> store(std::in_place, options.store.value_or(":memory:"), Store::Access::write);
  FuzzReport report = opened(*store, plan, options);
  std::vector<fuzz::Finding> known;
  for (const fuzz::Stored& one : report.findings) known.push_back(one.finding);
  std::optional<int> of_none;
  std::vector<std::jthread> last_resort;
  const auto on_end = [&](double silent) {
    report.findings = findings_of(*store, report.campaign);
    print(options.json ? report.json() : report.text());
    say_how_it_ended(options, silent);
    of_none = status_of_none(report, plan, bounds);
    last_resort = last_resort_of([&, ranks] {
      int status = of_none.value_or(exit_status(report, options.times, false));
      try {
        finish_output();
      } catch (const FileError& error) {
        say("{}", error.what());
        status = kFailed;
      }
      store.reset();
      question::kill_programs();
      if (ranks) ranks->abort(status);
      std::_Exit(status);
    });
  };
  bool failed = false;
  {
    JournalWithProgress journal(*store, report.campaign, bounds, plan.targets.size(), on_end);
    failed = fuzz::run(plan, bounds, make_answerer, report.tallies, journal, ranks, known);
    last_resort.clear();  // before the journal, which uses the store
  }
  return of_none ? *of_none : exit_status(report, options.times, failed);
}

int run_fuzz(const FuzzOptions& options) {
  const auto begun = Progress::Clock::now();
  fuzz::Bounds bounds = bounds_of(options);
  const double timeout = options.longest_wait();
  const question::EngineInfo engine =
      question::engine_named(options.engine(), std::min(timeout, kShareOfStart * bounds.seconds));
  const fuzz::Plan plan = plan_of(options, engine);
  const question::MakeAnswerer make_answerer = fuzz::answerer_maker(engine, {{}, timeout, terminal()});
  const std::unique_ptr<fuzz::Ranks> ranks = runs::join<fuzz::Ranks>("--jobs, or campaigns with other seeds");
  bounds.seconds -= std::chrono::duration<double>(Progress::Clock::now() - begun).count();
  if (!ranks) return run_campaign(options, plan, bounds, make_answerer, nullptr);
  try {
    if (ranks->rank() == 0) return run_campaign(options, plan, bounds, make_answerer, ranks.get());
    ranks->work(plan, bounds.jobs, make_answerer);
    return kDone;
  } catch (const std::exception& error) {  // so that no rank waits for one that has ended
    say("{}", error.what());
    ranks->abort(kFailed);
  }
}

}  // namespace

Command fuzz_command() {
  auto options = std::make_shared<FuzzOptions>();
  return {"fuzz",
          "Campaigns: constructs hard cases and variants until an engine fails, and reduces what it finds to "
          "simple cases.",
          rows_of(*options),

          "docs/campaigns.md: targets, variants, what is a finding, how it is shrunk, the store. Without "
          "--engine: reduction.\nExample:\n  lorentz fuzz --engine published --time 60 --store "
          "published.campaign\n  lorentz fuzz show --store published.campaign",
          [options] { return run_fuzz(*options); },
          {fuzz_show_command()}};
}

}  // namespace lorentz::cli
