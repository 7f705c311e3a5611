// The results of many trajectories as text, JSON, CSV, pictures and pages.
#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "report/manifest.hpp"
#include "report/scene_name.hpp"
#include "report/share.hpp"
#include "src/exchange/json_writer.hpp"
#include "statistics/survival/survival.hpp"

namespace lorentz::survival {

std::string Arithmetic::name(const std::string& engine) const {
  if (bits == 53) return engine + ", binary64";
  if (bits == 106) return engine + ", double-double";
  return fmt::format("{} bits", bits);
}

double Arithmetic::mean() const {
  double sum = 0;
  for (const std::uint64_t collisions : right) sum += static_cast<double>(collisions);
  return sum / static_cast<double>(right.size());
}

double Arithmetic::share(std::uint64_t k) const {
  const auto lasting = std::count_if(right.begin(), right.end(), [k](std::uint64_t n) { return n >= k; });
  return static_cast<double>(lasting) / static_cast<double>(right.size());
}

// The last collision for which a share is shown: that of its first 0, or the last one examined.
std::uint64_t Survival::last_of(const Arithmetic& one) const {
  return std::min(plan.collisions, *std::max_element(one.right.begin(), one.right.end()) + 1);
}

std::string Survival::table() const {
  std::string text = fmt::format("scene {}, seed {}\nright collisions from {} starts (of {} at most)\n\n",
                                 report::name_with_radius(plan.scene_name, plan.scene), plan.seed, starts(),
                                 plan.collisions);
  text += fmt::format("{:<28} {:>8} {:>8} {:>8}\n", "arithmetic", "mean", "least", "most");
  for (const Arithmetic& one : arithmetics) {
    const auto [least, most] = std::minmax_element(one.right.begin(), one.right.end());
    text +=
        fmt::format("{:<28} {:>8.2f} {:>8} {:>8}\n", one.name(plan.engine.name), one.mean(), *least, *most);
  }
  const bool is_cut = std::any_of(arithmetics.begin(), arithmetics.end(),
                                  [&](const Arithmetic& one) { return one.share(plan.collisions) > 0; });
  if (is_cut)
    text += fmt::format("some starts were right to the end, {} collisions: there the mean is too small\n",
                        plan.collisions);
  return text;
}

std::string Survival::json() const {
  return json::line_of([&](json::Members& object) {
    object.add("scene", plan.scene_name, "radius", report::common_radius(plan.scene), "engine",
               plan.engine.name, "seed", plan.seed, "count", starts(), "arithmetics",
               json::objects(arithmetics, [](json::Members& one, const Arithmetic& arithmetic) {
                 one.add("bits", arithmetic.bits, "mean", json::Raw{fmt::format("{:.6g}", arithmetic.mean())},
                         "right", arithmetic.right);
               }));
  });
}

std::string Survival::csv() const {
  std::string text = "collision";
  for (const Arithmetic& one : arithmetics) text += fmt::format(",bits{}", one.bits);
  text += '\n';
  std::uint64_t last = 0;
  for (const Arithmetic& one : arithmetics) last = std::max(last, last_of(one));
  for (std::uint64_t k = 1; k <= last; ++k) {
    text += std::to_string(k);
    for (const Arithmetic& one : arithmetics) text += fmt::format(",{}", one.share(k));
    text += '\n';
  }
  return text;
}

std::string Survival::page_json(const std::string& command) const {
  const std::size_t count = starts();
  std::string line = fmt::format("{} starts; right collisions, the mean:", count);
  for (const Arithmetic& one : arithmetics) {
    line += fmt::format("{} {:.3g} in {}", &one == &arithmetics[0] ? "" : ",", one.mean(),
                        one.name(plan.engine.name));
  }
  const auto point = [&](json::Members& object, double share, std::uint64_t k) {
    const auto right = static_cast<std::size_t>(std::llround(share * static_cast<double>(count)));
    const report::Share bounds = report::share_of(right, count);
    object.add("collisions", k, "share", share, "low", bounds.low, "high", bounds.high);
  };
  const auto curve = [&](json::Members& object, const Arithmetic& one) {
    std::vector<std::uint64_t> all(last_of(one));
    std::iota(all.begin(), all.end(), 1);
    object.add("scene", plan.scene_name, "engine", one.name(plan.engine.name), "radius", plan.radius,
               "points",
               json::objects(all, [&](json::Members& its, std::uint64_t k) { point(its, one.share(k), k); }));
  };
  return json::line_of([&](json::Members& page) {
    page.add("format", 1, "kind", "survival", "title", "How long trajectories stay right: " + plan.scene_name,
             "line", line, "manifest", report::manifest_of(plan.seed, command), "survival",
             json::objects(arithmetics, curve));
  });
}

}  // namespace lorentz::survival
