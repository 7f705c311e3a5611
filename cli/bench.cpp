// lorentz bench: speed against error, engines by radii by difficulty.
#include <algorithm>
#include <cmath>

#include <lorentz/exchange.hpp>
#include "cli/app.hpp"
#include "cli/compare_table.hpp"
#include "cli/exit_status.hpp"
#include "cli/messages.hpp"
#include "cli/numbers.hpp"
#include "cli/scene_option.hpp"
#include "cli/table.hpp"
#include "cli/terminal.hpp"
#include "cli/whole_file.hpp"
#include "compare/hard_cases.hpp"
#include "compare/measure.hpp"

namespace lorentz::cli {

using namespace compare;

namespace {

struct Options {
  std::vector<std::string> engines{"classical", "published", "reduction", "certified", "oracle"};
  std::vector<std::string> scenes{"square", "cubic"};
  std::vector<std::string> radii;  // none: radii_of
  std::string count = "2000", seed = std::to_string(kDefaultSeed);
  std::optional<std::string> csv, timeout;
};

constexpr const char* kOwnSize = "own";  // instead of a radius

constexpr double kSecondsPerRound = 0.1;  // an engine that would take longer does fewer queries, or none
constexpr std::size_t kPilot = 16, kFewest = 32;
constexpr int kRounds = 5;

// What one engine did over all cells of the table, for the line that says what to conclude.
struct Summary {
  Tally all;  // with the engine's name
  std::size_t skipped = 0;
  double fastest = 0, slowest = 0;

  void add(const Tally& t) {
    all.add(t);
    slowest = std::max(slowest, t.ns_median);
    fastest = fastest == 0 ? t.ns_median : std::min(fastest, t.ns_median);
  }

  std::string conclusion() const {
    if (all.queries == 0) return fmt::format("{}: too slow for every cell of this table", all.name);
    std::string text = fmt::format("{}\n  {:.0f} to {:.0f} ns", verdict_of(all), fastest, slowest);
    text += fmt::format("; times at worst {:.3g} ulps off", all.max_ulp);
    if (skipped > 0) text += fmt::format("; too slow for {} cells", skipped);
    return text;
  }
};

std::string csv_header() {
  return "scene,radius,difficulty,engine,queries,ns_mean,ns_median,ns_quartile_1,ns_quartile_3,undecided,"
         "wrong,wrong_time,mean_ulp,"
         "ulp_99_percent,max_ulp,path_mean\n";
}

// The mean length of the flights that hit: what a time is to be divided by for one a length, or a cell.
std::string mean_path(const std::vector<Answer>& exact) {
  double sum = 0;
  std::size_t hits = 0;
  for (const Answer& answer : exact)
    if (answer.outcome == Outcome::hit) sum += answer.time.value_or(0), ++hits;
  return hits > 0 ? fmt::format("{:.6g}", sum / static_cast<double>(hits)) : "";
}

class Report {
 public:
  explicit Report(const Options& options)
      : timeout_(positive_number(options.timeout, "--timeout").value_or(AnswererOptions::kDefaultTimeout)) {
    for (const std::string& name : names_in(options.engines)) summaries_.emplace_back().all.name = name;
  }

  // One cell: all engines over the same queries, as many as the slowest of them can do in the time.
  void cell(const std::string& scene_name, const std::string& radius, Difficulty difficulty,
            const CaseSet& all) {
    bool first = true;
    for (Summary& summary : summaries_) {
      const std::size_t count = affordable(all, summary.all.name);
      const std::string what =
          first ? fmt::format("{}, r = {}, {}", scene_name, radius, name_of(difficulty)) : "";
      first = false;
      if (count < kFewest) {
        ++summary.skipped;
        table_.add({what, summary.all.name, "-", "too slow", "", "", "", "", "", "", ""});
        continue;
      }
      CaseSet set = all;
      set.cases.resize(count);
      const std::vector<Answer> exact = exact_answers(set, terminal());
      const Tally t =
          measure(set, exact, {summary.all.name}, {}, {oracle::kDefaultUlps, kRounds, timeout_, terminal()})
              .front();
      failed_ |= t.failed;
      summary.add(t);
      table_.add({what, summary.all.name, std::to_string(t.queries), fmt::format("{:.0f}", t.ns_median),
                  fmt::format("{:.0f}-{:.0f}", t.ns_low, t.ns_high), std::to_string(t.undecided),
                  std::to_string(t.wrong), std::to_string(t.wrong_time), fmt::format("{:.3g}", t.mean_ulp()),
                  fmt::format("{:.3g}", t.ulp_at(0.99)), fmt::format("{:.3g}", t.max_ulp)});
      csv_ += fmt::format("{},{},{},{},{},{:.1f},{:.1f},{:.1f},{:.1f},{},{},{},{:.4g},{:.4g},{:.4g},{}\n",
                          scene_name, radius, name_of(difficulty), t.name, t.queries, t.ns_per_query,
                          t.ns_median, t.ns_low, t.ns_high, t.undecided, t.wrong, t.wrong_time, t.mean_ulp(),
                          t.ulp_at(0.99), t.max_ulp, mean_path(exact));
    }
  }

  void show() const {
    print(table_.text());
    print(
        "\nns: median over blocks of 16 queries of a block's mean, and its quartiles; error of the time of "
        "right hits, "
        "in ulps.\n\n");
    for (const Summary& summary : summaries_) print(summary.conclusion() + "\n");
  }

  const std::string& csv() const { return csv_; }
  bool failed() const { return failed_; }

 private:
  std::size_t affordable(const CaseSet& all, const std::string& engine) {
    CaseSet pilot = all;
    pilot.cases.resize(std::min(all.cases.size(), kPilot));
    // The first round of another program has its start in it; it is not the median of three.
    const Tally t = measure(pilot, {}, {engine}, {},
                            {oracle::kDefaultUlps, is_command(engine) ? 3 : 1, timeout_, terminal()})
                        .front();
    const double ns = t.ns_per_query;
    failed_ |= t.failed;
    return std::min(all.cases.size(), static_cast<std::size_t>(kSecondsPerRound * 1e9 / std::max(ns, 1.0)));
  }

  double timeout_;
  bool failed_ = false;  // another program broke
  std::vector<Summary> summaries_;
  Table table_{{"queries", "engine", "number", "ns", "quartiles", "undecided", "wrong", "wrong time",
                "mean ulp", "99 % ulp", "max ulp"}};
  std::string csv_ = csv_header();
};

// The radii to run a scene at: those asked for, or some; a scene with semiaxes at its own size.
std::vector<std::string> radii_of(const Options& options, const std::string& scene_name) {
  if (!options.radii.empty()) return options.radii;
  for (const Lattice& lattice : read_scene(scene_name, {}).lattices)
    for (const Atom& atom : lattice.atoms)
      if (!atom.is_ball()) return {kOwnSize};
  return {"0.3", "0.1", "0.01", "0.001", "1e-06"};
}

int act(const Options& options) {
  for (const std::string& name : names_in(options.engines)) check_name(name);
  const std::uint64_t seed = whole_number(options.seed, "--seed", 0, ~std::uint64_t{0});
  const std::uint64_t count = whole_number(options.count, "--count", kFewest, 10'000'000);
  std::optional<WholeFile> csv;
  if (options.csv) csv.emplace(*options.csv);
  Report report(options);
  for (const std::string& name : options.scenes)
    for (const std::string& radius : radii_of(options, name))
      for (const Difficulty difficulty :
           {Difficulty::drawn, Difficulty::near_rational, Difficulty::grazing}) {
        CaseSet set;
        const bool own = radius == kOwnSize;
        set.scenes.push_back(load_scene(name, own ? std::nullopt : positive_number(radius, "--radius")));
        const oracle::Oracle oracle(set.scenes[0]);
        for (const Query& query : hard_queries(difficulty, set.scenes[0], oracle, seed, count, terminal()))
          set.cases.push_back({std::to_string(set.cases.size()), 0, query});
        report.cell(name, radius, difficulty, set);
      }
  print(fmt::format("Speed against error, one thread (seed {}).\n\n", seed));
  report.show();
  if (csv) {
    csv->write(report.csv());
    csv->commit();
  }
  return report.failed() ? kFailed : kDone;
}

}  // namespace

void add_bench(CLI::App& app, Action& action) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("bench", "Speed against error: engines by radii by difficulty.");
  command->add_option("-e,--engine", options->engines, names_for_help())->type_name("E");
  command
      ->add_option("--scene", options->scenes,
                   "scene files, or names of the catalogue (default: square,cubic)")
      ->delimiter(',')
      ->type_name("S");
  command
      ->add_option("--radius", options->radii,
                   "radii (default: 0.3,0.1,0.01,0.001,1e-06; scenes with semiaxes at their own size)")
      ->delimiter(',')
      ->type_name("R");
  command->add_option("--count", options->count, "queries for each cell of the table")
      ->capture_default_str()
      ->type_name("N");
  command->add_option("--seed", options->seed, "of the queries")->capture_default_str()->type_name("N");
  command->add_option("--timeout", options->timeout, kTimeoutHelp)->type_name("SECONDS");
  command->add_option("--csv", options->csv, "write the figures there too, one line a row")
      ->type_name("FILE");
  command->footer(
      "drawn: uniform starts, isotropic directions. near-rational: directions a few ulps from small "
      "integers.\n"
      "grazing: the first ball is passed or met within r 2^-10 to r 2^-50 of its edge.\n"
      "Example:\n  lorentz bench --scene square --radius 0.1,1e-6 --engine published,reduction --csv "
      "speed.csv");
  command->callback([options, &action] { action = [options] { return act(*options); }; });
}

}  // namespace lorentz::cli
