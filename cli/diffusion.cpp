// lorentz diffusion: mean squared displacements of particles.
#include "cli/app.hpp"
#include "cli/chaos_options.hpp"
#include "cli/output.hpp"
#include "report/query_text.hpp"
#include "statistics/chaos/diffusion.hpp"

namespace lorentz::cli {
namespace {

struct DiffusionOptions : ChaosOptions {
  std::uint64_t count = 100'000;
  std::string from = "uniform";
  std::optional<double> time;
};

std::optional<ScanFinding> found_at(const ScanPlace& place, const DiffusionOptions& options) {
  const chaos::DiffusionPlan plan{place.scene, starts::ensemble_named(options.from, "--from"), options.seed,
                                  options.count, options.time.value_or(100)};
  const runs::Plan words{{"count", std::to_string(plan.count)},
                         {"time", fmt::format("{}", plan.time)},
                         {"starts", options.from},
                         {"seed", std::to_string(plan.seed)},
                         {"scene", report::scene_line(plan.scene)}};
  chaos::Diffusion found;
  with_work(options, "diffusion", words,
            [&](const chaos::Work& work) { found = chaos::diffusion_of(plan, work); });
  const chaos::DiffusionReport report(place.name, plan, std::move(found));
  if (!report.has_content()) {
    say("{}: there is nothing to report",
        report.found.is_whole ? "no particle got beyond its first obstacle" : "no part was done");
    return std::nullopt;
  }
  return ScanFinding{options.json ? report.json() : report.table(), report.csv(), report.found.is_whole};
}

int act(const DiffusionOptions& options) {
  check_store(options);
  return scan(options, "means of trajectories are taken",
              [&](const ScanPlace& place) { return found_at(place, options); });
}

}  // namespace

Command diffusion_command() {
  auto options = std::make_shared<DiffusionOptions>();
  return {
      "diffusion", "Mean squared displacements of many particles, and theory beside them.",
      joined(chaos_rows(*options, "the displacements, a row each"),
             {
                 {"--count", Whole{&options->count, 1, std::uint64_t{1} << 52}, "N", "how many particles"},
                 {"--time,--max-time", Positive{&options->time}, "T",
                  "until when they are followed, at speed 1 [100]"},
                 {"--from,--start", &options->from, "uniform|surface",
                  "uniform: anywhere outside the obstacles; surface: off an obstacle (cosine law)"},
             }),

      "docs/chaos.md: what is measured, how, and what theory knows.\n"
      "Example:\n  lorentz diffusion --scene triangular --radius 0.45 --count 1e5 --time 50 --jobs 2",
      [options] { return act(*options); }};
}

}  // namespace lorentz::cli
