// Reports of Lyapunov exponents as text, CSV and JSON.
#include <fmt/format.h>

#include "report/query_text.hpp"
#include "report/table.hpp"
#include "src/exchange/json_writer.hpp"
#include "statistics/chaos/lyapunov.hpp"

namespace lorentz::chaos {
namespace {

std::string plus_minus(const Estimate& estimate) {
  return fmt::format("{:.7g} +- {:.2g}", estimate.value, estimate.error);
}

}  // namespace

Estimate Lyapunov::flow_of(std::size_t k) const {
  if (!exact.value) return flow[k];
  return {map[k].value / *exact.value, map[k].error / *exact.value};
}

std::string Lyapunov::table() const {
  std::string text =
      fmt::format("scene {}, seed {}\n{} collisions of {} particles",
                  report::name_with_radius(plan.scene_name, plan.scene), plan.seed, collisions, particles);
  if (stopped > 0) text += fmt::format(", {} of which ended on the way", stopped);
  text += '\n' + remark_on_end(is_whole) + '\n';
  report::Table table({"exponent", "a collision", "+-", "a unit of time", "+-"});
  for (std::size_t k = 0; k < map.size(); ++k)
    table.add({fmt::format("{}", k + 1), fmt::format("{:.6f}", map[k].value),
               fmt::format("{:.1e}", map[k].error), fmt::format("{:.6g}", flow_of(k).value),
               fmt::format("{:.1e}", flow_of(k).error)});
  text += table.text() + '\n';
  if (plan.whole_spectrum) text += fmt::format("sum of all, a collision: {:.1e}\n", sum.value);
  if (plan.scene.dimension == 3)
    text += fmt::format("sum of those above zero, a collision: {}\n", plus_minus(growing));
  if (limit)
    text += fmt::format("theory, r -> 0: {:.7g} a collision, {}; off by {:+.2g}\n", *limit,
                        plan.scene.dimension == 2 ? "the exponent above zero" : "the sum of those above zero",
                        growing.value - *limit);
  text += fmt::format("mean free path {}; ", plus_minus(mean_flight));
  return text + (exact.value ? fmt::format("exact {:.10g}, by which exponents a unit of time are taken\n",
                                           *exact.value)
                             : fmt::format("the exact one is {}\n", exact.how));
}

std::string Lyapunov::csv() const {
  std::string text = "exponent,map,map_error,flow,flow_error\n";
  for (std::size_t k = 0; k < map.size(); ++k)
    text += fmt::format("{},{},{},{},{}\n", k + 1, map[k].value, map[k].error, flow_of(k).value,
                        flow_of(k).error);
  return text;
}

std::string Lyapunov::json() const {
  using json::finite;
  const std::optional<double> radius = report::common_radius(plan.scene);
  return json::line_of([&](json::Members& report) {
    report.add("scene", plan.scene_name, "radius", radius, "seed", plan.seed, "collisions", collisions,
               "particles", particles, "stopped", stopped, "whole", is_whole);
    report.add("exponents", json::objects(map, [&](json::Members& one, const Estimate& its) {
                 const auto k = static_cast<std::size_t>(&its - map.data());
                 one.add("map", finite(its.value), "map_error", finite(its.error), "flow",
                         finite(flow_of(k).value), "flow_error", finite(flow_of(k).error));
               }));
    report.add("sum", finite(sum.value), "sum_error", finite(sum.error), "growing", finite(growing.value),
               "small_obstacles", finite(limit), "mean_flight", finite(mean_flight.value),
               "mean_flight_error", finite(mean_flight.error), "mean_free_path", finite(exact.value));
  });
}

}  // namespace lorentz::chaos
