// lorentz flights: large numbers of free flights from drawn starts, their statistics, and theory for
// comparison.
#include <chrono>
#include <tuple>

#include <lorentz/exchange.hpp>
#include "cli/app.hpp"
#include "cli/exit_status.hpp"
#include "cli/interrupt.hpp"
#include "cli/numbers.hpp"
#include "cli/output.hpp"
#include "cli/progress.hpp"
#include "cli/scan.hpp"
#include "files/whole_file.hpp"
#include "question/engines.hpp"
#include "report/page.hpp"
#include "runs/piece_store.hpp"
#include "src/exchange/nearest_name.hpp"
#include "starts/free_starts.hpp"
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

struct FlightsOptions {
  std::string engine = "batch", from = "uniform", shard = "0/1", size = "800x600";
  std::uint64_t count = 1'000'000, seed = starts::kDefaultSeed, jobs = 1, cells = flights::kCellsOfBox;
  std::optional<double> seconds;
  std::optional<std::string> store, csv, svg, density_svg, html, title;
  bool json = false;
  std::vector<std::string> scenes{"square"}, radii, parts;
};

FlightsPlan plan_of(const FlightsOptions& options, const Scene& scene) {
  FlightsPlan plan;
  plan.scene = scene;
  if (!question::engine_named(options.engine).is_own())
    throw InputError(
        "--engine: flights are flown by engines of this program; `lorentz sample` writes the same "
        "starts for others");
  plan.engine = options.engine;
  plan.from = starts::ensemble_named(options.from, "--from");
  plan.seed = options.seed;
  plan.count = options.count;
  plan.cells = options.cells;
  return plan;
}

// One of the runs that are flown one after the other.
struct FlightsTask {
  std::string scene_name;
  std::optional<double> radius;  // set if several radii are given
  FlightsPlan plan;
};

std::vector<FlightsTask> tasks_of(const FlightsOptions& options) {
  std::vector<FlightsTask> tasks;
  for (const ScanPlace& place : scan_places(options.scenes, options.radii, "flights are counted"))
    tasks.push_back({place.name, place.radius, plan_of(options, place.scene)});
  if (tasks.size() == 1) tasks[0].radius.reset();
  if (tasks.size() > 1 &&
      (options.store || !options.parts.empty() || options.shard != FlightsOptions().shard))
    throw InputError(
        "--store, --add and --shard: counts are kept of one scene at one radius; run several one by one");
  return tasks;
}

flights::PictureStyle style_of(const FlightsOptions& options) {
  const PictureSize size = picture_size(options.size);
  return {options.title, size.width, size.height.value_or(size.width * 3 / 4)};
}

flights::FlightBounds bounds_of(const FlightsOptions& options) {
  flights::FlightBounds bounds;
  bounds.jobs = static_cast<unsigned>(options.jobs);
  bounds.seconds = options.seconds.value_or(0);
  std::tie(bounds.shard, bounds.shards) = shard_in(options.shard);
  return bounds;
}

// The account in a stored piece. It must be possible for this plan.
Account account_in(const std::string& piece, const FlightsPlan& plan) {
  Account account = Account::of(piece);
  account.check(plan);
  return account;
}

// A run as resumed from its store and the stores of other shards.
struct Begun {
  Account account;
  runs::PieceStore store;

  Begun(const FlightsOptions& options, const FlightsPlan& plan)
      : account(Account::begun(plan)), store(options.store, "flights", plan.words()) {
    store.each(reader(plan));
    if (store.is_file()) say_how_far(*options.store, plan);
    for (const std::string& part : options.parts) {
      runs::PieceStore(part, "flights", plan.words(), runs::Access::read).each(reader(plan));
      say_how_far(part, plan);
    }
  }

 private:
  std::uint64_t before = 0;  // blocks of the previous files

  runs::ReadPiece reader(const FlightsPlan& plan) {
    return [this, &plan](const std::string& piece) {
      try {
        account.add(account_in(piece, plan));
      } catch (const std::invalid_argument& error) {
        throw InputError(fmt::format("cannot be added: {}", error.what()));
      }
    };
  }
  void say_how_far(const std::string& file, const FlightsPlan& plan) {
    if (account.done.size() > before)
      say("{}: {} of {} blocks are done", file, account.done.size() - before, plan.blocks());
    before = account.done.size();
  }
};

// Draws the progress and writes to the store at intervals.
class News {
 public:
  News(runs::PieceStore* store, const FlightsPlan& plan, flights::Ranks* ranks)
      : store_(store), progress_("flying", plan.count, 1), count_(plan.count), ranks_(ranks) {}

  void operator()(const Account& account) {
    const bool others = ranks_ && ranks_->rank() != 0;
    if (!others) progress_.at(std::min(account.done.size() * flights::kBlock, count_));
    const auto now = std::chrono::steady_clock::now();
    if (now < next_) return;
    next_ = now + kBetweenStores;
    if (others)
      ranks_->report(account, false);
    else if (store_->is_file())
      store_->set((ranks_ ? ranks_->sum(account, false) : account).text());
  }

 private:
  runs::PieceStore* store_;  // only on rank 0
  Progress progress_;
  const std::uint64_t count_;
  flights::Ranks* ranks_;
  std::chrono::steady_clock::time_point next_ = std::chrono::steady_clock::now();
};

// For the ranks other than 0: flies their share and reports it to rank 0.
void fly_share(const FlightsPlan& plan, flights::FlightBounds bounds, flights::Ranks& ranks) {
  Account known, own = Account::begun(plan);
  ranks.share(known);
  bounds.done = known.done;
  News news(nullptr, plan, &ranks);
  flights::run(plan, bounds, own, [&](const Account& account) { news(account); });
  ranks.report(own, true);
}

FlightsReport fly(const FlightsTask& task, const flights::FlightBounds& bounds, const FlightsOptions& options,
                  flights::Ranks* ranks) {
  const FlightsPlan& plan = task.plan;
  Begun begun(options, plan);
  FlightsReport result{task.scene_name, task.radius, plan, begun.account, {}};
  if (ranks) ranks->share(result.account);
  const auto start = std::chrono::steady_clock::now();
  {
    News news(&begun.store, plan, ranks);
    flights::run(plan, bounds, result.account, [&](const Account& account) { news(account); });
  }
  if (ranks) result.account = ranks->sum(result.account, true);
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  begun.store.set(result.account.text());
  say("{:.2f} s", *result.seconds);
  return result;
}

// The files with the results of all scenes and radii.
class Files {
 public:
  explicit Files(const FlightsOptions& options)
      : style_(style_of(options)),
        csv_(options.csv),
        svg_(options.svg),
        density_svg_(options.density_svg),
        html_(options.html) {}
  void write(const std::vector<FlightsReport>& reports) {
    csv_.write([&] { return csv_of(reports); });
    svg_.write([&] { return survival_svg(reports, style_); });
    density_svg_.write([&] { return density_svg(reports, style_); });
    html_.write([&] { return report::page(page_json(reports, command_line())); });
  }

 private:
  const flights::PictureStyle style_;
  RequestedFile csv_, svg_, density_svg_, html_;
};

// Flies and reports each task in turn. After an interrupt, tasks without results are left out.
int fly_all(const std::vector<FlightsTask>& tasks, const flights::FlightBounds& bounds,
            const FlightsOptions& options, flights::Ranks* ranks) {
  Files files(options);
  std::vector<FlightsReport> reports;
  std::exception_ptr failure;
  for (const FlightsTask& task : tasks) {
    std::optional<FlightsReport> flown;
    try {
      flown = fly(task, bounds, options, ranks);
    } catch (const InputError&) {  // earlier results are kept
      failure = std::current_exception();
      break;
    }
    FlightsReport& report = *flown;
    if (Interrupt::came() && report.account.done.size() == 0) continue;
    print(options.json ? report.json() : (reports.empty() ? "" : "\n") + report.table());
    reports.push_back(std::move(report));
  }
  if (!reports.empty()) files.write(reports);
  if (failure) std::rethrow_exception(failure);
  if (!Interrupt::came()) return kDone;
  say("{}; {}{}", Interrupt::what(), reports.empty() ? "there is nothing to report; " : "",
      options.store ? "the same command goes on" : "without --store nothing is kept to go on with");
  return kFailed;
}

int act(const FlightsOptions& options) {
  if (options.html && !report::has_page()) report::page("");  // throws with the reason
  const std::vector<FlightsTask> tasks = tasks_of(options);
  flights::FlightBounds bounds = bounds_of(options);
  const Interrupt interrupt;
  bounds.stop = &Interrupt::came();
  const std::unique_ptr<flights::Ranks> ranks = runs::join<flights::Ranks>("--jobs, or --shard and --add");
  if (!ranks) return fly_all(tasks, bounds, options, nullptr);
  try {
    bounds.shard += bounds.shards * static_cast<std::uint64_t>(ranks->rank());
    bounds.shards *= static_cast<std::uint64_t>(ranks->size());
    if (ranks->rank() == 0) return fly_all(tasks, bounds, options, ranks.get());
    for (const FlightsTask& task : tasks) fly_share(task.plan, bounds, *ranks);
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
      "flights",
      "Very many free flights from drawn starts: their statistics, and theory beside them.",
      {
          {"--scene", &options->scenes, "SCENE",
           "a file, or a name of the catalogue; several, with commas between them, one after the other",
           kCommas},
          {"--radius", &options->radii, "R",
           "radius of every ball; several, with commas between them, are flown from the same drawn numbers: "
           "each "
           "gives what it gives alone",
           kCommas},
          {"--from,--start", &options->from, "uniform|surface",
           "uniform: anywhere outside the obstacles, in any direction; surface: off an obstacle, as from one "
           "collision to the next (cosine law)"},
          {"-e,--engine", &options->engine, "ENGINE",
           "one of " + fmt::format("{}", fmt::join(question::own_names(), ", "))},
          {"--count", Whole{&options->count, 1, kMostFlights}, "N", "how many"},
          {"--time", Positive{&options->seconds}, "SECONDS", "stop after SECONDS (each scene and radius)"},
          {"--seed", Whole{&options->seed}, "N", "of the starts"},
          {"--jobs", Whole{&options->jobs, 1, 1024}, "N", "threads; the result is the same"},
          {"--cells", Whole{&options->cells, 1, std::uint64_t{1} << 40}, "N",
           "cells of the box in which the starts of superposed lattices lie"},
          {"--store", &options->store, "FILE", "where counts are kept every few seconds, and gone on from",
           kOutput},
          {"--add", &options->parts, "FILE",
           "stores of other shards of the same run, whose counts are added"},
          {"--shard", &options->shard, "I/N",
           "only the blocks of flights I modulo N, into --store; --add joins them"},
          {"--csv", &options->csv, "FILE",
           "the histograms, and theory, to a file; of several scenes or radii one table, with both in its "
           "first "
           "columns",
           kOutput},
          {"--svg", &options->svg, "FILE",
           "the picture: P(free path > t), theory drawn in; several scenes and radii in one", kOutput},
          {"--density-svg", &options->density_svg, "FILE",
           "the picture of the density in linear bins, theory drawn in; several scenes and radii in one, in "
           "units of the mean free path",
           kOutput},
          {"--title", &options->title, "TEXT",
           "of the pictures, instead of scene and starts; \"\" for no title"},
          {"--size", &options->size, "W[xH]", "of the pictures, in pixels; legible at half of 800x600"},
          {"--html", &options->html, "FILE",
           "a page that opens offline: P(free path > t) and theory, with numbers on hover", kOutput},
          {"--json", &options->json, "",
           "one JSON object a line instead of a table, for each scene and radius"},
      },

      "docs/free_paths.md: the ensembles, the closed forms, what means and error bars mean.\n"
      "Examples:\n  lorentz flights --scene square --radius 0.2 --from surface\n"
      "  lorentz flights --scene square,triangular --radius 0.1,0.01 --svg survival.svg --title \"Two "
      "lattices\"\n"
      "  lorentz flights --scene superposition-pi-5 --radius 1e-4 --count 1e8 --jobs 2 --store pi-5.flights "
      "--svg pi-5.svg",
      [options] { return act(*options); }};
}

}  // namespace lorentz::cli
