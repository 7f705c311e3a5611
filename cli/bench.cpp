// lorentz bench: speed and error for all combinations of engines, scenes, radii and difficulties.
#include <lorentz/exchange.hpp>
#include "cli/app.hpp"
#include "cli/bench_cells.hpp"
#include "cli/numbers.hpp"
#include "cli/output.hpp"
#include "report/bench_report.hpp"
#include "report/claim_words.hpp"
#include "report/files/scene_file.hpp"
#include "report/files/whole_file.hpp"
#include "report/manifest.hpp"
#include "report/page.hpp"
#include "src/exchange/json_writer.hpp"
#include "src/exchange/nearest_name.hpp"

namespace lorentz::cli {
namespace {

// The radii at which a scene is run: the given ones or the defaults. A scene with semiaxes runs at its own
// size.
std::vector<std::optional<std::string>> radii_of(const ExaminationOptions& options,
                                                 const std::string& scene_name) {
  if (!options.radii.empty()) return {options.radii.begin(), options.radii.end()};
  for (const Lattice& lattice : read_scene(scene_name, {}).lattices)
    for (const Atom& atom : lattice.atoms)
      if (!atom.is_ball()) return {std::nullopt};
  return {"0.3", "0.1", "0.01", "0.001", "1e-06"};
}

// What all engines are asked together, as cells without results.
std::vector<report::Cell> groups_of(const ExaminationOptions& options) {
  std::vector<report::Cell> groups;
  for (const std::string& difficulty : options.difficulties)
    index_of_name(difficulty, {"drawn", "near-rational", "grazing"}, "--difficulty");
  for (const std::string& scene : options.scenes)
    for (const auto& radius : radii_of(options, scene))
      for (const std::string& difficulty : options.difficulties)
        groups.push_back(
            {.scene = scene, .radius = positive_number(radius, "--radius"), .difficulty = difficulty});
  return groups;
}

int run_bench(ExaminationOptions options) {
  if (options.count < kFewestQueries)
    throw InputError(
        fmt::format("--count: {} queries say nothing; give {} or more", options.count, kFewestQueries));
  const std::vector<question::EngineInfo> engines = options.named_engines();
  options.claim.ask(engines);
  const Claim claim = options.claim.claim();
  const std::vector<report::Cell> groups = groups_of(options);
  if (options.html && !report::has_page()) report::page("");  // throws with the reason
  RequestedFile csv(options.csv), html(options.html);
  const std::string manifest = json::text_of(report::manifest_of(options.seed, command_line()));
  std::vector<report::Cell> cells;
  bool failed = false;
  for (const report::Cell& group : groups) {
    MeasuredCells measured = measure_cells(options, engines, group);
    failed |= measured.failed;
    std::ranges::move(measured.cells, std::back_inserter(cells));
  }
  const std::string json = report::bench_json(cells, manifest, claim);
  print(options.json ? json
                     : fmt::format("Speed against error, one thread (seed {}{}).\n\n{}", options.seed,
                                   report::words_of(claim), report::bench_text(cells, names_of(engines))));
  csv.write([&] { return report::bench_csv(cells); });
  html.write([&] { return report::page(json); });
  return failed ? kFailed : kDone;
}

}  // namespace

Command bench_command() {
  auto options = std::make_shared<ExaminationOptions>();
  options->engines = {"classical", "published", "reduction", "certified", "oracle"};
  options->scenes = {"square", "cubic"};
  options->difficulties = {"drawn", "near-rational", "grazing"};
  options->count = 2000;
  return {
      "bench", "Speed against error: engines by scenes by radii by difficulty.",
      options->rows({"--engine", "--scene", "--radius", "--difficulty", "--count", "--seed", "--ulps",
                     "--precision", "--time-tolerance", "--timeout", "--json", "--csv", "--html"}),

      "Without --engine: classical, published, reduction, certified and oracle. Without --scene: square and "
      "cubic. Without --radius: 0.3, 0.1, 0.01, 0.001 and 1e-06; scenes with semiaxes at their own size.\n"
      "drawn: uniform starts, isotropic directions. near-rational: directions a few ulps from small integers."
      "\ngrazing: the first ball is passed or met within r 2^-10 to r 2^-50 of its edge.\nExample:\n"
      "  lorentz bench --scene square --radius 0.1,1e-6 --engine published,reduction --csv speed.csv",
      [options] { return run_bench(*options); }};
}

}  // namespace lorentz::cli
