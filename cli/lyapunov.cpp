// lorentz lyapunov: how fast neighbouring particles separate.
#include "cli/app.hpp"
#include "cli/chaos_options.hpp"
#include "cli/output.hpp"
#include "report/query_text.hpp"
#include "statistics/chaos/lyapunov.hpp"

namespace lorentz::cli {
namespace {

struct LyapunovOptions : ChaosOptions {
  std::uint64_t collisions = 1'000'000;
  bool spectrum = false;
};

std::optional<ScanFinding> found_at(const ScanPlace& place, const LyapunovOptions& options) {
  const chaos::LyapunovPlan plan{place.scene, options.seed, options.collisions, options.spectrum};
  const runs::Plan words{{"collisions", std::to_string(plan.collisions)},
                         {"spectrum", plan.whole_spectrum ? "whole" : "above zero"},
                         {"seed", std::to_string(plan.seed)},
                         {"scene", report::scene_line(plan.scene)}};
  chaos::Lyapunov found;
  with_work(options, "lyapunov", words,
            [&](const chaos::Work& work) { found = chaos::lyapunov_of(plan, work); });
  if (found.collisions == 0) {
    say("no part was done: there is nothing to report");
    return std::nullopt;
  }
  const chaos::LyapunovReport report(place.name, plan, std::move(found));
  return ScanFinding{options.json ? report.json() : report.table(), report.csv(), report.found.is_whole};
}

int act(const LyapunovOptions& options) {
  check_store(options);
  return scan(options, "means of trajectories are taken",
              [&](const ScanPlace& place) { return found_at(place, options); });
}

}  // namespace

Command lyapunov_command() {
  auto options = std::make_shared<LyapunovOptions>();
  return {"lyapunov", "Lyapunov exponents, with standard errors, and theory beside them.",
          joined(chaos_rows(*options, "the exponents, a row each"),
                 {
                     {"--collisions", Whole{&options->collisions, 1, std::uint64_t{1} << 52}, "N",
                      "how many are counted, about: of 4096 particles together, at least one each"},
                     {"--spectrum", &options->spectrum, "", "the exponents below zero, too"},
                 }),

          "docs/chaos.md: what is measured, how, and what theory knows.\n"
          "Examples:\n  lorentz lyapunov --scene square --radius 0.2 --collisions 1e7 --jobs 2\n"
          "  lorentz lyapunov --scene square,triangular --radius 0.1,0.2,0.3 --csv exponents.csv",
          [options] { return act(*options); }};
}

}  // namespace lorentz::cli
