// lorentz lyapunov: how fast neighbouring particles part.
#include "statistics/chaos/lyapunov.hpp"
#include <lorentz/exchange.hpp>
#include "cli/app.hpp"
#include "cli/chaos_options.hpp"
#include "cli/exit_status.hpp"
#include "cli/output.hpp"
#include "report/finding_json.hpp"
#include "report/table.hpp"
#include "src/exchange/json_writer.hpp"
#include "statistics/chaos/theory.hpp"
#include "statistics/theory/laws.hpp"

namespace lorentz::cli {
namespace {

using chaos::Estimate;
using chaos::Lyapunov;
using chaos::LyapunovPlan;

struct LyapunovOptions : ChaosOptions {
  std::uint64_t collisions = 1'000'000;
  bool spectrum = false;
};

// What was found, with all that stands beside it.
struct LyapunovReport {
  std::string scene;
  LyapunovPlan plan;
  Lyapunov found;
  flights::MeanFreePath exact;
  std::optional<double> limit;  ///< of the first exponent (2D) or the sum of those above zero (3D), as r -> 0

  Estimate flow(std::size_t k) const {
    if (!exact.value) return found.flow[k];
    return {found.map[k].value / *exact.value, found.map[k].error / *exact.value};
  }
  const char* limit_of() const {
    return plan.scene.dimension == 2 ? "the exponent above zero" : "the sum of those above zero";
  }

  std::string table() const;
  std::string json() const;
};

std::string plus_minus(const Estimate& estimate) {
  return fmt::format("{:.7g} +- {:.2g}", estimate.value, estimate.error);
}

std::string LyapunovReport::table() const {
  std::string text =
      fmt::format("scene {}, seed {}\n{} collisions of {} particles", name_with_radius(scene, plan.scene),
                  plan.seed, found.collisions, chaos::kGroups * chaos::kParticles);
  if (found.stopped > 0) text += fmt::format(", {} of which ended on the way", found.stopped);
  text += '\n' + remark_on_end(found.is_whole) + '\n';
  report::Table table({"exponent", "a collision", "+-", "a unit of time", "+-"});
  for (std::size_t k = 0; k < found.map.size(); ++k)
    table.add({fmt::format("{}", k + 1), fmt::format("{:.6f}", found.map[k].value),
               fmt::format("{:.1e}", found.map[k].error), fmt::format("{:.6g}", flow(k).value),
               fmt::format("{:.1e}", flow(k).error)});
  text += table.text() + '\n';
  if (plan.whole_spectrum) text += fmt::format("sum of all, a collision: {:.1e}\n", found.sum.value);
  if (plan.scene.dimension == 3)
    text += fmt::format("sum of those above zero, a collision: {}\n", plus_minus(found.growing));
  if (limit)
    text += fmt::format("theory, r -> 0: {:.7g} a collision, {}; here {:+.2g} of it\n", *limit, limit_of(),
                        found.growing.value - *limit);
  text += fmt::format("mean free path {}; ", plus_minus(found.mean_flight));
  return text + (exact.value ? fmt::format("exact {:.10g}, by which exponents a unit of time are taken\n",
                                           *exact.value)
                             : fmt::format("the exact one is {}\n", exact.how));
}

std::string LyapunovReport::json() const {
  using json::finite;
  return json::line_of([&](json::Members& report) {
    report.add("scene", scene, "seed", plan.seed, "collisions", found.collisions, "particles",
               chaos::kGroups * chaos::kParticles, "stopped", found.stopped, "whole", found.is_whole);
    report.add("exponents", json::objects(found.map, [&](json::Members& one, const Estimate& map) {
                 const auto k = static_cast<std::size_t>(&map - found.map.data());
                 one.add("map", finite(map.value), "map_error", finite(map.error), "flow",
                         finite(flow(k).value), "flow_error", finite(flow(k).error));
               }));
    report.add("sum", finite(found.sum.value), "sum_error", finite(found.sum.error), "growing",
               finite(found.growing.value), "small_obstacles", finite(limit), "mean_flight",
               finite(found.mean_flight.value), "mean_flight_error", finite(found.mean_flight.error),
               "mean_free_path", finite(exact.value));
  });
}

int act(const LyapunovOptions& options) {
  LyapunovReport report;
  report.scene = options.scene;
  report.plan = {scene_of(options), options.seed, options.collisions, options.spectrum};
  const Scene& scene = report.plan.scene;
  const runs::Plan words{{"collisions", std::to_string(report.plan.collisions)},
                         {"spectrum", report.plan.whole_spectrum ? "whole" : "above zero"},
                         {"seed", std::to_string(report.plan.seed)},
                         {"scene", report::scene_line(scene)}};
  with_work(options, "lyapunov", words,
            [&](const chaos::Work& work) { report.found = chaos::lyapunov_of(report.plan, work); });
  if (report.found.collisions == 0) {
    say("no part was done: there is nothing to report");
    return kFailed;
  }
  report.exact = flights::mean_free_path_of(scene);
  report.limit =
      scene.dimension == 2 ? chaos::exponent_of_small_discs(scene) : chaos::exponents_of_small_balls(scene);
  print(options.json ? report.json() : report.table());
  return report.found.is_whole ? kDone : kFailed;
}

}  // namespace

Command lyapunov_command() {
  auto options = std::make_shared<LyapunovOptions>();
  return {"lyapunov", "Lyapunov exponents, with standard errors, and theory beside them.",
          joined(chaos_rows(*options),
                 {
                     {"--collisions", Whole{&options->collisions, 1, std::uint64_t{1} << 52}, "N",
                      "how many are counted, of 4096 particles together"},
                     {"--spectrum", &options->spectrum, "", "the exponents below zero, too"},
                 }),

          "docs/chaos.md: what is measured, how, and what theory knows.\n"
          "Example:\n  lorentz lyapunov --scene square --radius 0.2 --collisions 1e7 --jobs 2",
          [options] { return act(*options); }};
}

}  // namespace lorentz::cli
