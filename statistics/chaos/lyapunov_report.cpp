// Reports of Lyapunov exponents as text, CSV and JSON.
#include <fmt/format.h>

#include "report/scene_name.hpp"
#include "report/table.hpp"
#include "src/exchange/json_writer.hpp"
#include "statistics/chaos/lyapunov.hpp"
#include "statistics/chaos/theory.hpp"

namespace lorentz::chaos {
namespace {

std::string plus_minus(const Estimate& estimate) {
  return fmt::format("{:.7g} +- {:.2g}", estimate.value, estimate.error);
}

}  // namespace

LyapunovReport::LyapunovReport(std::string scene_name, LyapunovPlan its_plan, Lyapunov what_was_found)
    : scene(std::move(scene_name)),
      plan(std::move(its_plan)),
      found(std::move(what_was_found)),
      exact(flights::mean_free_path_of(plan.scene)),
      limit(plan.scene.dimension == 2 ? exponent_of_small_discs(plan.scene)
                                      : exponents_of_small_balls(plan.scene)) {}

Estimate LyapunovReport::flow(std::size_t k) const {
  if (!exact.value) return found.flow[k];
  return {found.map[k].value / *exact.value, found.map[k].error / *exact.value};
}

std::string LyapunovReport::table() const {
  std::string text =
      fmt::format("scene {}, seed {}\n{} collisions of {} particles",
                  report::name_with_radius(scene, plan.scene), plan.seed, found.collisions, found.particles);
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
    text += fmt::format("theory, r -> 0: {:.7g} a collision, {}; off by {:+.2g}\n", *limit,
                        plan.scene.dimension == 2 ? "the exponent above zero" : "the sum of those above zero",
                        found.growing.value - *limit);
  text += fmt::format("mean free path {}; ", plus_minus(found.mean_flight));
  return text + (exact.value ? fmt::format("exact {:.10g}, by which exponents a unit of time are taken\n",
                                           *exact.value)
                             : fmt::format("the exact one is {}\n", exact.how));
}

std::string LyapunovReport::csv() const {
  std::string text = "exponent,map,map_error,flow,flow_error\n";
  for (std::size_t k = 0; k < found.map.size(); ++k)
    text += fmt::format("{},{},{},{},{}\n", k + 1, found.map[k].value, found.map[k].error, flow(k).value,
                        flow(k).error);
  return text;
}

std::string LyapunovReport::json() const {
  using json::finite;
  const std::optional<double> radius = report::common_radius(plan.scene);
  return json::line_of([&](json::Members& report) {
    report.add("scene", scene, "radius", radius, "seed", plan.seed, "collisions", found.collisions,
               "particles", found.particles, "stopped", found.stopped, "whole", found.is_whole);
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

}  // namespace lorentz::chaos
