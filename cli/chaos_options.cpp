#include "cli/chaos_options.hpp"

#include <chrono>
#include <cmath>

#include "cli/interrupt.hpp"
#include "cli/messages.hpp"
#include "cli/numbers.hpp"
#include "cli/progress.hpp"
#include "cli/scene_option.hpp"
#include "compare/sampling.hpp"

namespace lorentz::cli {

ChaosOptions::ChaosOptions() : seed(std::to_string(compare::kDefaultSeed)) {}

void add_chaos_options(CLI::App& command, ChaosOptions& options) {
  command.add_option("--scene", options.scene, "a file, or a name of the catalogue")
      ->capture_default_str()
      ->type_name("SCENE");
  command.add_option("--radius", options.radius, "radius of every ball")->type_name("R");
  command.add_option("--seed", options.seed, "of the starts")->capture_default_str()->type_name("N");
  command.add_option("--jobs", options.jobs, "threads; the result is the same")
      ->capture_default_str()
      ->type_name("N");
  command.add_flag("--json", options.json, "one JSON object instead of a table");
}

Scene scene_of(const ChaosOptions& options) {
  return load_scene(options.scene, positive_number(options.radius, "--radius"));
}

std::uint64_t seed_of(const ChaosOptions& options) {
  return whole_number(options.seed, "--seed", 0, ~std::uint64_t{0});
}

void with_work(const ChaosOptions& options, const std::function<void(const chaos::Work&)>& run) {
  const auto jobs = static_cast<unsigned>(whole_number(options.jobs, "--jobs", 1, 1024));
  const Interrupt interrupt;
  const auto start = std::chrono::steady_clock::now();
  {
    Progress progress("flying, part", chaos::kGroups, 1);
    run({jobs, &Interrupt::came(), [&](std::uint64_t done) { progress.at(done); }});
  }
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  say("{}{:.2f} s", Interrupt::came() ? Interrupt::what() + std::string(" after ") : "", seconds);
}

std::string name_with_radius(const std::string& name, const Scene& scene) {
  std::optional<double> radius;
  bool same = true;
  for_each_atom(scene, [&](const Atom& atom) {
    same = same && atom.is_ball() && (!radius || *radius == atom.radius);
    radius = atom.radius;
  });
  return same && radius ? fmt::format("{}, r = {:g}", name, *radius) : name;
}

std::string finite_or_null(double x) {
  return std::isfinite(x) ? fmt::format("{}", x) : "null";
}

std::string remark_on_end(bool is_whole) {
  return is_whole ? "" : "interrupted: only the parts that were done by then\n";
}

}  // namespace lorentz::cli
