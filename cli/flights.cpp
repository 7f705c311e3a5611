// lorentz flights: very many free flights from drawn starts, their statistics, and theory beside them.
#include <chrono>
#include <filesystem>
#include <fstream>
#include <sstream>

#include <lorentz/exchange.hpp>
#include "cli/app.hpp"
#include "cli/exit_status.hpp"
#include "cli/flights_report.hpp"
#include "cli/interrupt.hpp"
#include "cli/messages.hpp"
#include "cli/numbers.hpp"
#include "cli/progress.hpp"
#include "cli/scene_option.hpp"
#include "cli/whole_file.hpp"
#include "compare/nearest_name.hpp"
#include "compare/registry.hpp"
#include "compare/sampling.hpp"
#include "flights/ranks.hpp"
#include "flights/run.hpp"

namespace lorentz::cli {
namespace {

using flights::Account;
using flights::Plan;

constexpr std::chrono::seconds kBetweenStores{3};
constexpr std::uint64_t kMostFlights = std::uint64_t{1} << 52;

struct Options {
  std::string scene = "square", engine = "batch", from = "uniform", count = "1000000",
              seed = std::to_string(compare::kDefaultSeed), jobs = "1", shard = "0/1",
              cells = std::to_string(flights::kCellsOfBox);
  std::optional<std::string> radius, seconds, store, csv, svg;
  bool json = false;
  std::vector<std::string> parts;
};

flights::Ensemble ensemble_of(const std::string& name) {
  if (name == "uniform") return flights::Ensemble::uniform;
  if (name == "surface") return flights::Ensemble::surface;
  throw InputError(fmt::format("--from: {} is no kind of start{}; there are uniform and surface",
                               json_quoted(name), compare::did_you_mean(name, {"uniform", "surface"})));
}

Plan plan_of(const Options& options) {
  Plan plan;
  plan.scene = load_scene(options.scene, positive_number(options.radius, "--radius"));
  compare::check_name(options.engine);
  if (compare::is_command(options.engine))
    throw InputError(
        "--engine: flights are flown by engines of this program; `lorentz sample` writes the same "
        "starts for others");
  plan.engine = options.engine;
  plan.from = ensemble_of(options.from);
  plan.seed = whole_number(options.seed, "--seed", 0, ~std::uint64_t{0});
  plan.count = whole_number(options.count, "--count", 1, kMostFlights);
  plan.cells = whole_number(options.cells, "--cells", 1, std::uint64_t{1} << 40);
  return plan;
}

flights::Bounds bounds_of(const Options& options) {
  flights::Bounds bounds;
  bounds.jobs = static_cast<unsigned>(whole_number(options.jobs, "--jobs", 1, 1024));
  bounds.seconds = positive_number(options.seconds, "--time").value_or(0);
  const auto slash = options.shard.find('/');
  if (slash == std::string::npos)
    throw InputError(
        fmt::format("--shard: {} is not I/N, like 0/4 for the first of four", json_quoted(options.shard)));
  bounds.shards = whole_number(options.shard.substr(slash + 1), "--shard", 1, 1'000'000);
  bounds.shard = whole_number(options.shard.substr(0, slash), "--shard", 0, bounds.shards - 1);
  return bounds;
}

std::string read_file(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  if (!in) throw FileError(fmt::format("{}: cannot be read", path));
  return std::move(text).str();
}

Account read_account(const std::string& path) {
  try {
    return Account::of(read_file(path));
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", path, error.what()));
  }
}

void write_file(const std::string& path, const std::string& text) {
  WholeFile file(path);
  file.write(text);
  file.commit();
}

Account empty_account(const Plan& plan) {
  Account account;
  account.plan = plan.text();
  account.tally = flights::Tally(flights::unit_exponent(plan.scene));
  return account;
}

// What the store has of this plan, and the stores of other shards.
Account opened(const Options& options, const Plan& plan) {
  Account account = empty_account(plan);
  std::vector<std::string> files = options.parts;
  if (options.store && std::filesystem::exists(*options.store)) files.insert(files.begin(), *options.store);
  for (const std::string& file : files) {
    const Account stored = read_account(file);
    if (stored.plan != account.plan)
      throw InputError(
          fmt::format("{}: is of another run: one with its scene, engine, starts, seed and count goes on "
                      "with it",
                      file));
    try {
      account.add(stored);
    } catch (const std::invalid_argument& error) {
      throw InputError(fmt::format("{}: cannot be added: {}", file, error.what()));
    }
    say("{}: {} of {} blocks are done", file, stored.done.size(), plan.blocks());
  }
  return account;
}

// Draws the progress, and stores now and then.
class News {
 public:
  News(const Options& options, const Plan& plan, flights::Ranks* ranks)
      : store_(options.store), progress_("flying", plan.count, 1), count_(plan.count), ranks_(ranks) {}

  void operator()(const Account& account) {
    const bool others = ranks_ && ranks_->rank() != 0;
    if (!others) progress_.at(std::min(account.done.size() * flights::kBlock, count_));
    const auto now = std::chrono::steady_clock::now();
    if (now < next_) return;
    next_ = now + kBetweenStores;
    if (others)
      ranks_->report(account, false);
    else if (store_)
      write_file(*store_, (ranks_ ? ranks_->sum(account, false) : account).text());
  }

 private:
  const std::optional<std::string> store_;
  Progress progress_;
  const std::uint64_t count_;
  flights::Ranks* ranks_;
  std::chrono::steady_clock::time_point next_ = std::chrono::steady_clock::now();
};

int report(const Options& options, const FlightsReport& report) {
  print(options.json ? report.json() : report.table());
  if (options.csv) write_file(*options.csv, report.csv());
  if (options.svg) write_file(*options.svg, report.svg());
  return kDone;
}

// Another rank's share: flown, and reported to rank 0.
int fly_share(const Plan& plan, flights::Bounds bounds, const Options& options, flights::Ranks& ranks) {
  Account known, own = empty_account(plan);
  ranks.share(known);
  bounds.done = known.done;
  News news(options, plan, &ranks);
  flights::run(plan, bounds, own, [&](const Account& account) { news(account); });
  ranks.report(own, true);
  return kDone;
}

int fly(const Plan& plan, const flights::Bounds& bounds, const Options& options, flights::Ranks* ranks) {
  FlightsReport result{options.scene, plan, opened(options, plan), {}};
  if (ranks) ranks->share(result.account);
  const auto start = std::chrono::steady_clock::now();
  {
    News news(options, plan, ranks);
    flights::run(plan, bounds, result.account, [&](const Account& account) { news(account); });
  }
  if (ranks) result.account = ranks->sum(result.account, true);
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (options.store) write_file(*options.store, result.account.text());
  say("{:.2f} s", *result.seconds);
  if (Interrupt::came())
    say("interrupted; {}",
        options.store ? "the same command goes on" : "without --store nothing is kept to go on with");
  return report(options, result);
}

int act(const Options& options) {
  const Plan plan = plan_of(options);
  flights::Bounds bounds = bounds_of(options);
  const Interrupt interrupt;
  bounds.stop = &Interrupt::came();
  const std::unique_ptr<flights::Ranks> ranks = flights::Ranks::join();
  if (!ranks) return fly(plan, bounds, options, nullptr);
  try {
    bounds.shard += bounds.shards * static_cast<std::uint64_t>(ranks->rank());
    bounds.shards *= static_cast<std::uint64_t>(ranks->size());
    return ranks->rank() == 0 ? fly(plan, bounds, options, ranks.get())
                              : fly_share(plan, bounds, options, *ranks);
  } catch (const std::exception& error) {  // nobody waits for a process that is gone
    say("{}", error.what());
    ranks->abort(kFailed);
  }
}

}  // namespace

void add_flights(CLI::App& app, Action& action) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand(
      "flights", "Very many free flights from drawn starts: their statistics, and theory beside them.");
  command->add_option("--scene", options->scene, "a file, or a name of the catalogue")
      ->capture_default_str()
      ->type_name("S");
  command->add_option("--radius", options->radius, "radius of every ball")->type_name("R");
  command
      ->add_option(
          "--from", options->from,
          "uniform: anywhere outside the obstacles, in any direction; surface: off an obstacle, as from one "
          "collision to the next (cosine law)")
      ->capture_default_str()
      ->type_name("KIND");
  command
      ->add_option("-e,--engine", options->engine,
                   "one of " + fmt::format("{}", fmt::join(compare::answerer_names(), ", ")))
      ->capture_default_str()
      ->type_name("E");
  command->add_option("--count", options->count, "how many")->capture_default_str()->type_name("N");
  command->add_option("--time", options->seconds, "stop after so long")->type_name("SECONDS");
  command->add_option("--seed", options->seed, "of the starts")->capture_default_str()->type_name("N");
  command->add_option("--jobs", options->jobs, "threads; the result is the same")
      ->capture_default_str()
      ->type_name("N");
  command
      ->add_option("--cells", options->cells,
                   "cells of the box in which the starts of superposed lattices lie")
      ->capture_default_str()
      ->type_name("N");
  command->add_option("--store", options->store, "where counts are kept every few seconds, and gone on from")
      ->type_name("FILE");
  command
      ->add_option("--add", options->parts, "stores of other shards of the same run, whose counts are added")
      ->type_name("FILE");
  command
      ->add_option("--shard", options->shard,
                   "only the blocks of flights I modulo N, into --store; --add joins them")
      ->capture_default_str()
      ->type_name("I/N");
  command->add_option("--csv", options->csv, "the histograms, and theory, to a file")->type_name("FILE");
  command->add_option("--svg", options->svg, "the picture: P(free path > t), theory drawn in")
      ->type_name("FILE");
  command->add_flag("--json", options->json, "one JSON object instead of a table");
  command->footer(
      "docs/free_paths.md: the ensembles, the closed forms, what means and error bars mean.\n"
      "Examples:\n  lorentz flights --scene square --radius 0.2 --from surface\n"
      "  lorentz flights --scene superposition-pi-5 --radius 1e-4 --count 1e8 --jobs 2 --store pi-5.flights "
      "--svg pi-5.svg");
  command->callback([options, &action] { action = [options] { return act(*options); }; });
}

}  // namespace lorentz::cli
