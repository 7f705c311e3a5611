// lorentz bench: speed and error for all combinations of engines, scenes, radii and difficulties.
#include <fmt/ranges.h>

#include <lorentz/exchange.hpp>
#include "cli/app.hpp"
#include "cli/claim_options.hpp"
#include "cli/help_texts.hpp"
#include "cli/numbers.hpp"
#include "cli/output.hpp"
#include "cli/terminal.hpp"
#include "files/scene_file.hpp"
#include "files/whole_file.hpp"
#include "question/cells/cell_store.hpp"
#include "question/engines.hpp"
#include "report/bench_report.hpp"
#include "report/claim_words.hpp"
#include "report/manifest.hpp"
#include "report/page.hpp"
#include "src/exchange/json_writer.hpp"
#include "src/exchange/nearest_name.hpp"
#include "starts/free_starts.hpp"

namespace lorentz::cli {

using namespace question;

namespace {

struct BenchOptions {
  std::vector<std::string> engines{"classical", "published", "reduction", "certified", "oracle"};
  std::vector<std::string> scenes{"square", "cubic"};
  std::vector<std::string> radii;  // empty: see radii_of
  std::vector<std::string> difficulties{"drawn", "near-rational", "grazing"};
  std::uint64_t count = 2000, seed = starts::kDefaultSeed;
  std::optional<double> timeout;
  std::optional<std::string> csv, html, store;
  ClaimOptions claim;
  bool json = false;
};

// The radii at which a scene is run: the given ones or the defaults. A scene with semiaxes runs at its own
// size.
std::vector<std::optional<std::string>> radii_of(const BenchOptions& options, const std::string& scene_name) {
  if (!options.radii.empty()) return {options.radii.begin(), options.radii.end()};
  for (const Lattice& lattice : read_scene(scene_name, {}).lattices)
    for (const Atom& atom : lattice.atoms)
      if (!atom.is_ball()) return {std::nullopt};
  return {"0.3", "0.1", "0.01", "0.001", "1e-06"};
}

std::vector<BenchGroup> groups_of(const BenchOptions& options) {
  std::vector<BenchGroup> groups;
  for (const std::string& difficulty : options.difficulties)
    index_of_name(difficulty, {"drawn", "near-rational", "grazing"}, "--difficulty");
  for (const std::string& scene : options.scenes)
    for (const auto& radius : radii_of(options, scene))
      for (const std::string& difficulty : options.difficulties)
        groups.push_back({scene, positive_number(radius, "--radius"), difficulty});
  return groups;
}

// The conditions besides the options on which the figures depend.
runs::Plan words_of(const report::Manifest& manifest, const Claim& claim) {
  runs::Plan words{
      {"commit", manifest.commit},   {"compiler", manifest.compiler},         {"flags", manifest.flags},
      {"machine", manifest.machine}, {"instructions", manifest.instructions}, {"system", manifest.system}};
  if (!(claim == Claim())) words.push_back({"claim", report::arguments_of(claim)});
  return words;
}

BenchPlan plan_of(BenchOptions options) {
  BenchPlan plan;
  plan.engines = engines_named(options.engines, options.timeout);
  options.claim.ask(plan.engines);
  plan.seed = options.seed;
  plan.count = options.count;
  plan.answerer.timeout = options.timeout.value_or(AnswererOptions::kDefaultTimeout);
  plan.claim = options.claim.claim();
  plan.answerer.listener = terminal();
  return plan;
}

int act(const BenchOptions& options) {
  const BenchPlan plan = plan_of(options);
  const std::vector<BenchGroup> groups = groups_of(options);
  const report::Manifest manifest = report::manifest_of(plan.seed, command_line());
  if (options.html && !report::has_page()) report::page("");  // throws with the reason
  RequestedFile csv(options.csv), html(options.html);
  if (options.store) goes_on_when_repeated();
  BenchStore store(options.store, plan, groups, words_of(manifest, plan.claim), json::text_of(manifest));
  std::vector<report::Cell> cells;
  bool failed = false;
  for (const BenchGroup& group : groups) {
    auto kept = store.find(group);
    if (!kept) {
      BenchCells measured = measure_cells(plan, group);
      failed |= measured.failed;
      if (!measured.failed) store.add(measured.cells);
      kept = std::move(measured.cells);
    }
    cells.insert(cells.end(), kept->begin(), kept->end());
  }
  const std::string json = report::bench_json(cells, store.manifest(), plan.claim);
  print(options.json
            ? json
            : fmt::format("Speed against error, one thread (seed {}{}).\n\n{}", plan.seed,
                          report::words_of(plan.claim), report::bench_text(cells, names_of(plan.engines))));
  csv.write([&] { return report::bench_csv(cells); });
  html.write([&] { return report::page(json); });
  return failed ? kFailed : kDone;
}

}  // namespace

Command bench_command() {
  auto options = std::make_shared<BenchOptions>();
  return {"bench",
          "Speed against error: engines by scenes by radii by difficulty.",
          {
              {"-e,--engine", &options->engines, "ENGINE", names_for_help(), kToldDefault},
              {"--scene", &options->scenes, "SCENE",
               "scene files, or names of the catalogue (default: square,cubic)", kCommas | kToldDefault},
              {"--radius", &options->radii, "R",
               "radii (default: 0.3,0.1,0.01,0.001,1e-06; scenes with semiaxes at their own size)",
               kCommas | kToldDefault},
              {"--difficulty", &options->difficulties, "drawn|near-rational|grazing",
               "of the queries (default: drawn,near-rational,grazing)", kCommas | kToldDefault},
              {"--count", Whole{&options->count, kFewestQueries, 10'000'000}, "N",
               "queries for each cell of the table"},
              {"--seed", Whole{&options->seed}, "N", "of the queries"},
              options->claim.precision_row(),
              options->claim.time_tolerance_row(),
              {"--timeout", Positive{&options->timeout}, "SECONDS", kTimeoutHelp},
              {"--store", &options->store, "FILE",
               "keep the cells that are done in this file, and go on from there when called again", kOutput},
              {"--json", &options->json, "", "the report as one JSON object instead of a table"},
              {"--csv", &options->csv, "FILE", "write the figures there too, one line a cell", kOutput},
              {"--html", &options->html, "FILE", "write the report there too, as a page that opens offline",
               kOutput},
          },

          "drawn: uniform starts, isotropic directions. near-rational: directions a few ulps from small "
          "integers.\n"
          "grazing: the first ball is passed or met within r 2^-10 to r 2^-50 of its edge.\n"
          "Examples:\n  lorentz bench --scene square --radius 0.1,1e-6 --engine published,reduction --csv "
          "speed.csv\n"
          "  lorentz bench --store run.bench --html speed.html   # interrupted? the same line goes on",
          [options] { return act(*options); }};
}

}  // namespace lorentz::cli
