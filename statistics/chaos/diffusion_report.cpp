// Reports of mean squared displacements as text, CSV and JSON.
#include <fmt/format.h>

#include "report/query_text.hpp"
#include "report/table.hpp"
#include "src/exchange/json_writer.hpp"
#include "statistics/chaos/diffusion.hpp"

namespace lorentz::chaos {

Estimate Diffusion::rate(const Displacement& at) const {
  const double all = 2 * plan.scene.dimension * at.time;
  return {at.square.value / all, at.square.error / all};
}

// D. With open corridors D does not exist, and the estimate is only the value at the time T.
std::string Diffusion::lines_of_coefficient() const {
  const std::string estimate = fmt::format("{:.6g} +- {:.1e}", coefficient.value, coefficient.error);
  constexpr const char* kWhat = "(MSD(T) - MSD(T/2)) / (d T)";
  const std::string too_short =
      is_too_short() ? fmt::format(
                           "T is {:.3g} mean free paths: too short for this to be near its limit, and the "
                           "error does not show it; {:g} or more are needed\n",
                           paths(), kLeastPaths)
                     : "";
  if (!has_corridors())
    return fmt::format("D = {}, {}\n{}{}long free paths: {}\n", estimate, kWhat, too_short,
                       tail.open ? "" : "whether there is a D is not known\n", tail.remark);
  std::string text = fmt::format(
      "no D: corridors or planar channels are open, MSD ~ 2 C t ln t in the end\n{} = {}, which grows with "
      "T\n",
      kWhat, estimate);
  text += fmt::format("slope of MSD / t in ln t from T / 16 on: {:.4g} +- {:.1g}; theory, 2 C: {}\n",
                      logarithmic.value, logarithmic.error,
                      tail.constant ? fmt::format("{:.6g}", 2 * *tail.constant) : "not known");
  return text + too_short + "(heavy tails: these errors are too small)\n";
}

std::string Diffusion::lines_of_theory() const {
  if (!random_walk) return "";
  return fmt::format(
      "theory, gaps -> 0 (Machta and Zwanzig): D = {:.6g}{}\n", *random_walk,
      has_corridors() ? "" : fmt::format("; here {:.4f} of it", coefficient.value / *random_walk));
}

std::string Diffusion::table() const {
  std::string text =
      fmt::format("scene {}, {} starts, seed {}\n{} particles until t = {:g}, {} collisions",
                  report::name_with_radius(plan.scene_name, plan.scene), is_uniform() ? "uniform" : "surface",
                  plan.seed, particles, plan.time, collisions);
  if (stopped > 0) text += fmt::format("; {} ended before, and are not counted", stopped);
  text += '\n' + remark_on_end(is_whole) + '\n';
  std::vector<std::string> header{"t", "MSD", "+-", "MSD / (2 d t)", "+-"};
  if (is_uniform()) header.insert(header.end(), {"MSD by velocities", "+-"});
  report::Table table(header);
  for (const Displacement& at : displacements) {
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

std::string Diffusion::csv() const {
  std::string text = "t,msd,msd_error,msd_by_velocities,msd_by_velocities_error\n";
  for (const Displacement& at : displacements)
    text += fmt::format("{},{},{},{},{}\n", at.time, at.square.value, at.square.error,
                        is_uniform() ? fmt::format("{}", at.from_velocity.value) : "",
                        is_uniform() ? fmt::format("{}", at.from_velocity.error) : "");
  return text;
}

std::string Diffusion::json() const {
  using json::finite;
  const auto if_uniform = [&](double x) { return is_uniform() ? finite(x) : std::nullopt; };
  const std::optional<double> radius = report::common_radius(plan.scene);
  const auto if_bounded = [&](double x) { return has_corridors() ? std::nullopt : finite(x); };
  return json::line_of([&](json::Members& report) {
    report.add("scene", plan.scene_name, "radius", radius, "from", is_uniform() ? "uniform" : "surface",
               "seed", plan.seed, "particles", particles, "collisions", collisions, "stopped", stopped,
               "whole", is_whole);
    report.add("displacements", json::objects(displacements, [&](json::Members& one, const Displacement& at) {
                 one.add("t", at.time, "msd", finite(at.square.value), "msd_error", finite(at.square.error),
                         "by_velocities", if_uniform(at.from_velocity.value), "by_velocities_error",
                         if_uniform(at.from_velocity.error));
               }));
    report.add("open", tail.open, "D", if_bounded(coefficient.value), "D_error",
               if_bounded(coefficient.error), "machta_zwanzig",
               has_corridors() ? std::nullopt : finite(random_walk), "logarithmic", finite(logarithmic.value),
               "logarithmic_error", finite(logarithmic.error), "two_C",
               has_corridors() && tail.constant ? finite(2 * *tail.constant) : std::nullopt, "too_short",
               is_too_short());
  });
}

}  // namespace lorentz::chaos
