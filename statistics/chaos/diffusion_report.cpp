// Reports of mean squared displacements as text, CSV and JSON.
#include <fmt/format.h>

#include "report/scene_name.hpp"
#include "report/table.hpp"
#include "src/exchange/json_writer.hpp"
#include "statistics/chaos/diffusion.hpp"
#include "statistics/chaos/theory.hpp"

namespace lorentz::chaos {

DiffusionReport::DiffusionReport(std::string scene_name, DiffusionPlan its_plan, Diffusion what_was_found)
    : scene(std::move(scene_name)),
      plan(std::move(its_plan)),
      found(std::move(what_was_found)),
      random_walk(machta_zwanzig(plan.scene)),
      mean_free_path(flights::mean_free_path_of(plan.scene).value),
      tail(flights::tail_of_long_paths(plan.scene, flights::Ensemble::uniform)) {}

Estimate DiffusionReport::rate(const Displacement& at) const {
  const double all = 2 * plan.scene.dimension * at.time;
  return {at.square.value / all, at.square.error / all};
}

// D. With open corridors D does not exist, and the estimate is only the value at the time T.
std::string DiffusionReport::lines_of_coefficient() const {
  const std::string estimate =
      fmt::format("{:.6g} +- {:.1e}", found.coefficient.value, found.coefficient.error);
  constexpr const char* kWhat = "(MSD(T) - MSD(T/2)) / (d T)";
  const std::string too_short =
      is_too_short() ? fmt::format(
                           "T is {:.3g} mean free paths: too short for this to be near its limit, and the "
                           "error does not show it; {:g} or more are needed\n",
                           plan.time / *mean_free_path, kLeastPaths)
                     : "";
  if (!has_corridors())
    return fmt::format("D = {}, {}\n{}{}long free paths: {}\n", estimate, kWhat, too_short,
                       tail.open ? "" : "whether there is a D is not known\n", tail.remark);
  std::string text = fmt::format(
      "no D: corridors or planar channels are open, MSD ~ 2 C t ln t in the end\n{} = {}, which grows with "
      "T\n",
      kWhat, estimate);
  text += fmt::format("slope of MSD / t in ln t from T / 16 on: {:.4g} +- {:.1g}; theory, 2 C: {}\n",
                      found.logarithmic.value, found.logarithmic.error,
                      tail.constant ? fmt::format("{:.6g}", 2 * *tail.constant) : "not known");
  return text + too_short + "(heavy tails: these errors are too small)\n";
}

std::string DiffusionReport::lines_of_theory() const {
  if (!random_walk) return "";
  return fmt::format(
      "theory, gaps -> 0 (Machta and Zwanzig): D = {:.6g}{}\n", *random_walk,
      has_corridors() ? "" : fmt::format("; here {:.4f} of it", found.coefficient.value / *random_walk));
}

std::string DiffusionReport::table() const {
  std::string text =
      fmt::format("scene {}, {} starts, seed {}\n{} particles until t = {:g}, {} collisions",
                  report::name_with_radius(scene, plan.scene), is_uniform() ? "uniform" : "surface",
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
  const std::optional<double> radius = report::common_radius(plan.scene);
  const auto if_bounded = [&](double x) { return has_corridors() ? std::nullopt : finite(x); };
  return json::line_of([&](json::Members& report) {
    report.add("scene", scene, "radius", radius, "from", is_uniform() ? "uniform" : "surface", "seed",
               plan.seed, "particles", found.particles, "collisions", found.collisions, "stopped",
               found.stopped, "whole", found.is_whole);
    report.add("displacements",
               json::objects(found.displacements, [&](json::Members& one, const Displacement& at) {
                 one.add("t", at.time, "msd", finite(at.square.value), "msd_error", finite(at.square.error),
                         "by_velocities", if_uniform(at.from_velocity.value), "by_velocities_error",
                         if_uniform(at.from_velocity.error));
               }));
    report.add("open", tail.open, "D", if_bounded(found.coefficient.value), "D_error",
               if_bounded(found.coefficient.error), "machta_zwanzig",
               has_corridors() ? std::nullopt : finite(random_walk), "logarithmic",
               finite(found.logarithmic.value), "logarithmic_error", finite(found.logarithmic.error), "two_C",
               has_corridors() && tail.constant ? finite(2 * *tail.constant) : std::nullopt, "too_short",
               is_too_short());
  });
}

}  // namespace lorentz::chaos
