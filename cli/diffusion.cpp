// lorentz diffusion: how far particles come.
#include "statistics/chaos/diffusion.hpp"
#include <lorentz/errors.hpp>
#include <lorentz/exchange.hpp>
#include "cli/app.hpp"
#include "cli/chaos_options.hpp"
#include "cli/exit_status.hpp"
#include "cli/output.hpp"
#include "files/whole_file.hpp"
#include "report/finding_json.hpp"
#include "report/table.hpp"
#include "src/exchange/json_writer.hpp"
#include "src/exchange/nearest_name.hpp"
#include "statistics/chaos/theory.hpp"
#include "statistics/theory/laws.hpp"

namespace lorentz::cli {
namespace {

using chaos::Diffusion;
using chaos::DiffusionPlan;
using chaos::Displacement;
using chaos::Estimate;
using flights::Ensemble;

struct DiffusionOptions : ChaosOptions {
  std::uint64_t count = 100'000;
  std::string from = "uniform";
  std::optional<double> time;
  std::optional<std::string> csv;
};

// What was found, with all that stands beside it.
struct DiffusionReport {
  std::string scene;
  DiffusionPlan plan;
  Diffusion found;
  std::optional<double> random_walk;  ///< Machta and Zwanzig's coefficient
  flights::Tail tail;                 ///< of free paths from uniform starts, t -> infinity

  bool is_uniform() const { return plan.from == Ensemble::uniform; }
  bool has_corridors() const { return tail.open.value_or(false); }

  /// MSD / (2 d t).
  Estimate rate(const Displacement& at) const {
    const double all = 2 * plan.scene.dimension * at.time;
    return {at.square.value / all, at.square.error / all};
  }

  std::string lines_of_coefficient() const;
  std::string lines_of_theory() const;
  std::string table() const;
  std::string csv() const;
  std::string json() const;
};

// D, if there is one: with open corridors it is but a number at the time T.
std::string DiffusionReport::lines_of_coefficient() const {
  const std::string estimate =
      fmt::format("{:.6g} +- {:.1e}", found.coefficient.value, found.coefficient.error);
  constexpr const char* kWhat = "(MSD(T) - MSD(T/2)) / (d T)";
  if (!has_corridors())
    return fmt::format("D = {}, {}\n{}long free paths: {}\n", estimate, kWhat,
                       tail.open ? "" : "whether there is a D is not known\n", tail.remark);
  std::string text = fmt::format(
      "no D: corridors or planar channels are open, MSD ~ 2 C t ln t in the end\n{} = {}, which grows with "
      "T\n",
      kWhat, estimate);
  text += fmt::format("slope of MSD / t in ln t from T / 16 on: {:.4g} +- {:.1g}; theory, 2 C: {}\n",
                      found.logarithmic.value, found.logarithmic.error,
                      tail.constant ? fmt::format("{:.6g}", 2 * *tail.constant) : "not known");
  return text + "(heavy tails: these errors are too small)\n";
}

std::string DiffusionReport::lines_of_theory() const {
  if (!random_walk) return "";
  return fmt::format(
      "theory, gaps -> 0 (Machta and Zwanzig): D = {:.6g}{}\n", *random_walk,
      has_corridors() ? "" : fmt::format("; here {:.4f} of it", found.coefficient.value / *random_walk));
}

std::string DiffusionReport::table() const {
  std::string text = fmt::format("scene {}, {} starts, seed {}\n{} particles until t = {:g}, {} collisions",
                                 name_with_radius(scene, plan.scene), is_uniform() ? "uniform" : "surface",
                                 plan.seed, found.particles, plan.time, found.collisions);
  if (found.stopped > 0) text += fmt::format("; {} ended before, and are not counted", found.stopped);
  text += '\n' + remark_on_end(found.is_whole) + '\n';
  std::vector<std::string> header{"t", "MSD", "+-", "MSD / (2 d t)", "+-"};
  if (is_uniform()) header.insert(header.end(), {"MSD by velocities", "+-"});
  report::Table table(header);
  for (const Displacement& at : found.displacements) {
    std::vector<std::string> row{fmt::format("{:.6g}", at.time), fmt::format("{:.6g}", at.square.value),
                                 fmt::format("{:.1e}", at.square.error),
                                 fmt::format("{:.6g}", rate(at).value),
                                 fmt::format("{:.1e}", rate(at).error)};
    if (is_uniform())
      row.insert(row.end(), {fmt::format("{:.5g}", at.from_velocity.value),
                             fmt::format("{:.1e}", at.from_velocity.error)});
    table.add(row);
  }
  return text + table.text() + '\n' + lines_of_coefficient() + lines_of_theory();
}

std::string DiffusionReport::csv() const {
  std::string text = "t,msd,msd_error,msd_by_velocities,msd_by_velocities_error\n";
  for (const Displacement& at : found.displacements)
    text += fmt::format("{},{},{},{},{}\n", at.time, at.square.value, at.square.error,
                        is_uniform() ? fmt::format("{}", at.from_velocity.value) : "",
                        is_uniform() ? fmt::format("{}", at.from_velocity.error) : "");
  return text;
}

std::string DiffusionReport::json() const {
  using json::finite;
  const auto if_uniform = [&](double x) { return is_uniform() ? finite(x) : std::nullopt; };
  const auto if_bounded = [&](double x) { return has_corridors() ? std::nullopt : finite(x); };
  return json::line_of([&](json::Members& report) {
    report.add("scene", scene, "from", is_uniform() ? "uniform" : "surface", "seed", plan.seed, "particles",
               found.particles, "collisions", found.collisions, "stopped", found.stopped, "whole",
               found.is_whole);
    report.add("displacements",
               json::objects(found.displacements, [&](json::Members& one, const Displacement& at) {
                 one.add("t", at.time, "msd", finite(at.square.value), "msd_error", finite(at.square.error),
                         "by_velocities", if_uniform(at.from_velocity.value), "by_velocities_error",
                         if_uniform(at.from_velocity.error));
               }));
    report.add("open", tail.open, "D", if_bounded(found.coefficient.value), "D_error",
               if_bounded(found.coefficient.error), "machta_zwanzig", finite(random_walk), "logarithmic",
               finite(found.logarithmic.value), "logarithmic_error", finite(found.logarithmic.error), "two_C",
               has_corridors() && tail.constant ? finite(2 * *tail.constant) : std::nullopt);
  });
}

int act(const DiffusionOptions& options) {
  DiffusionReport report;
  report.scene = options.scene;
  report.plan = {scene_of(options), starts::ensemble_named(options.from, "--from"), options.seed,
                 options.count, options.time.value_or(100)};
  RequestedFile csv(options.csv);
  const runs::Plan words{{"count", std::to_string(report.plan.count)},
                         {"time", fmt::format("{}", report.plan.time)},
                         {"starts", options.from},
                         {"seed", std::to_string(report.plan.seed)},
                         {"scene", report::scene_line(report.plan.scene)}};
  with_work(options, "diffusion", words,
            [&](const chaos::Work& work) { report.found = chaos::diffusion_of(report.plan, work); });
  // Those that are left after others ended are the ones that met nothing.
  const bool selected = report.found.collisions == 0 && report.found.stopped > 0;
  if (report.found.particles == 0 || selected) {
    say("{}: there is nothing to report",
        report.found.is_whole ? "no particle got beyond its first obstacle" : "no part was done");
    return kFailed;
  }
  report.random_walk = chaos::machta_zwanzig(report.plan.scene);
  report.tail = flights::tail_of_long_paths(report.plan.scene, Ensemble::uniform);
  print(options.json ? report.json() : report.table());
  csv.write([&] { return report.csv(); });
  return report.found.is_whole ? kDone : kFailed;
}

}  // namespace

Command diffusion_command() {
  auto options = std::make_shared<DiffusionOptions>();
  return {
      "diffusion", "Mean squared displacements of many particles, and theory beside them.",
      joined(chaos_rows(*options),
             {
                 {"--count", Whole{&options->count, 1, std::uint64_t{1} << 52}, "N", "how many particles"},
                 {"--time", Positive{&options->time}, "T", "until when they are followed, at speed 1 [100]"},
                 {"--from", &options->from, "uniform|surface",
                  "uniform: anywhere outside the obstacles; surface: off an obstacle (cosine law)"},
                 {"--csv", &options->csv, "FILE", "the displacements to a file", kOutput},
             }),

      "docs/chaos.md: what is measured, how, and what theory knows.\n"
      "Example:\n  lorentz diffusion --scene triangular --radius 0.45 --count 1e5 --time 50 --jobs 2",
      [options] { return act(*options); }};
}

}  // namespace lorentz::cli
