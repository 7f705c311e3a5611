// lorentz flights: large numbers of free flights from drawn starts, their statistics, and theory for
// comparison.
#include <chrono>

#include <lorentz/exchange.hpp>
#include "cli/app.hpp"
#include "cli/interrupt.hpp"
#include "cli/numbers.hpp"
#include "cli/output.hpp"
#include "cli/progress.hpp"
#include "cli/scan.hpp"
#include "question/engines.hpp"
#include "question/starts/free_starts.hpp"
#include "report/files/whole_file.hpp"
#include "report/page.hpp"
#include "report/runs/piece_store.hpp"
#include "statistics/flights/ranks.hpp"
#include "statistics/flights/report.hpp"
#include "statistics/flights/run.hpp"

namespace lorentz::cli {
namespace {

using flights::Account;
using flights::FlightsPlan;
using flights::FlightsReport;

constexpr std::chrono::seconds kBetweenStores{3};
constexpr std::uint64_t kMostFlights = std::uint64_t{1} << 52;

struct FlightsOptions : ScanOptions {
  std::string engine = "batch", from = "uniform";
  std::uint64_t count = 1'000'000;
  std::optional<double> seconds;
  std::optional<std::string> html;
};

FlightsPlan plan_of(const FlightsOptions& options, const Scene& scene) {
  FlightsPlan plan;
  plan.scene = scene;
  const question::EngineInfo engine = question::engine_named(options.engine);
  plan.engine = engine.traits.needs_card ? flights::kAsOnCard : engine.name;
  if (!engine.is_own())
    throw InputError(
        "--engine: flights are flown by engines of this program; `lorentz sample` writes the same "
        "starts for others");
  plan.from = starts::ensemble_named(options.from, "--from");
  plan.seed = options.seed;
  plan.count = options.count;
  return plan;
}

// The runs that are flown one after the other, before they begin.
std::vector<FlightsReport> tasks_of(const FlightsOptions& options) {
  std::vector<FlightsReport> tasks;
  for (const ScanPlace& place : scan_places(options.scenes, options.radii, "flights are counted")) {
    const FlightsPlan plan = plan_of(options, place.scene);
    tasks.push_back({place.name, place.radius, plan, Account::begun(plan), {}});
  }
  if (tasks.size() == 1) tasks[0].radius.reset();
  if (tasks.size() > 1 && options.store)
    throw InputError("--store: counts are kept of one scene at one radius; run several one by one");
  return tasks;
}

flights::FlightBounds bounds_of(const FlightsOptions& options) {
  flights::FlightBounds bounds;
  bounds.jobs = static_cast<unsigned>(options.jobs);
  bounds.seconds = options.seconds.value_or(0);
  if (question::engine_named(options.engine).traits.needs_card) bounds.card = 0;
  return bounds;
}

// Adds the counts that the store has.
void resume(FlightsReport& task, const runs::PieceStore& store, const std::string& file) {
  store.each([&](const std::string& piece) {
    try {
      task.account.add(Account::of(piece));
    } catch (const std::invalid_argument& error) {
      throw InputError(fmt::format("cannot be added: {}", error.what()));
    }
  });
  if (task.account.done.size() > 0)
    say("{}: {} of {} blocks are done", file, task.account.done.size(), task.plan.blocks());
}

// A function that is true at once, and then every few seconds.
auto store_clock() {
  return [next = std::chrono::steady_clock::now()]() mutable {
    const auto now = std::chrono::steady_clock::now();
    if (now < next) return false;
    next = now + kBetweenStores;
    return true;
  };
}

// For the ranks other than 0: flies their share and reports it to rank 0.
void fly_share(const FlightsPlan& plan, flights::FlightBounds bounds, flights::Ranks& ranks) {
  Account known, own = Account::begun(plan);
  ranks.share(known);
  bounds.done = known.done;
  auto is_due = store_clock();
  flights::run(plan, bounds, own, [&](const Account& account) {
    if (is_due()) ranks.report(account, false);
  });
  ranks.report(own, true);
}

// Flies a task, resumed from its store.
void fly(FlightsReport& task, const flights::FlightBounds& bounds, const FlightsOptions& options,
         flights::Ranks* ranks) {
  const FlightsPlan& plan = task.plan;
  runs::PieceStore store(options.store, "flights", plan.words());
  resume(task, store, options.store.value_or(""));
  if (ranks) ranks->share(task.account);
  const auto start = std::chrono::steady_clock::now();
  {
    Progress progress("flying", plan.count, 1);
    auto is_due = store_clock();
    flights::run(plan, bounds, task.account, [&](const Account& account) {
      progress.at(std::min(account.done.size() * flights::kBlock, plan.count));
      if (is_due() && store.is_file()) store.set((ranks ? ranks->sum(account, false) : account).text());
    });
  }
  if (ranks) task.account = ranks->sum(task.account, true);
  task.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  store.set(task.account.text());
  say("{:.2f} s", *task.seconds);
}

// Flies and reports each task in turn, and writes the files with the results of all. After an interrupt,
// tasks without results are left out.
int fly_all(std::vector<FlightsReport>&& tasks, const flights::FlightBounds& bounds,
            const FlightsOptions& options, flights::Ranks* ranks) {
  RequestedFile csv(options.csv), html(options.html);
  std::vector<FlightsReport> reports;
  const auto fly_each = [&] {
    for (FlightsReport& task : tasks) {
      fly(task, bounds, options, ranks);
      if (Interrupt::came() && task.account.done.size() == 0) continue;
      print(options.json ? task.json() : (reports.empty() ? "" : "\n") + task.table());
      reports.push_back(std::move(task));
    }
  };
  keeping_results(fly_each, [&] {
    if (reports.empty()) return;
    csv.write([&] { return csv_of(reports); });
    html.write([&] { return report::page(page_json(reports, command_line())); });
  });
  if (!Interrupt::came()) return kDone;
  say("{}; {}{}", Interrupt::what(), reports.empty() ? "there is nothing to report; " : "",
      options.store ? "the same command goes on" : "without --store nothing is kept to go on with");
  return kFailed;
}

int run_flights(const FlightsOptions& options) {
  if (options.html && !report::has_page()) report::page("");  // throws with the reason
  std::vector<FlightsReport> tasks = tasks_of(options);
  flights::FlightBounds bounds = bounds_of(options);
  const Interrupt interrupt;
  bounds.stop = &Interrupt::came();
  const std::unique_ptr<flights::Ranks> ranks = runs::join<flights::Ranks>("--jobs");
  if (!ranks) return fly_all(std::move(tasks), bounds, options, nullptr);
  try {
    bounds.shard = static_cast<std::uint64_t>(ranks->rank());
    bounds.shards = static_cast<std::uint64_t>(ranks->size());
    if (bounds.card) bounds.card = static_cast<unsigned>(ranks->rank());
    if (ranks->rank() == 0) return fly_all(std::move(tasks), bounds, options, ranks.get());
    for (const FlightsReport& task : tasks) fly_share(task.plan, bounds, *ranks);
    return kDone;
  } catch (const std::exception& error) {  // so that no rank waits for one that has ended
    say("{}", error.what());
    ranks->abort(kFailed);
  }
}

}  // namespace

Command flights_command() {
  auto options = std::make_shared<FlightsOptions>();
  return {
      "flights", "Very many free flights from drawn starts: their statistics, and theory beside them.",
      scan_rows(
          *options, "the histograms, and theory", "the counts so far",
          {{"--from,--start", &options->from, "uniform|surface",
            "uniform: anywhere outside the obstacles, in any direction; surface: off an obstacle, as from "
            "one "
            "collision to the next (cosine law)"},
           {"-e,--engine", &options->engine, "ENGINE",
            fmt::format("one of {}", fmt::join(question::own_names(), ", "))},
           {"--count", Whole{&options->count, 1, kMostFlights}, "N", "how many"},
           {"--time", Positive{&options->seconds}, "SECONDS", "stop after SECONDS (each scene and radius)"},
           {"--html", &options->html, "FILE",
            "a page that opens offline: P(free path > t) and theory, with numbers on hover", kOutput}}),

      "docs/free_paths.md: the ensembles, the closed forms, what means and error bars mean.\n"
      "Examples:\n  lorentz flights --scene square --radius 0.2 --from surface\n"
      "  lorentz flights --scene square,triangular --radius 0.1,0.01 --html lattices.html\n"
      "  lorentz flights --scene superposition-pi-5 --radius 1e-4 --count 1e8 --jobs 2 --store pi-5.flights "
      "--csv pi-5.csv",
      [options] { return run_flights(*options); }};
}

}  // namespace lorentz::cli
