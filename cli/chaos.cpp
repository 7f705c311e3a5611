// lorentz lyapunov, diffusion: how fast neighbouring particles separate, and how far particles get.
#include <chrono>

#include "cli/app.hpp"
#include "cli/interrupt.hpp"
#include "cli/output.hpp"
#include "cli/progress.hpp"
#include "cli/scan.hpp"
#include "report/runs/piece_store.hpp"
#include "src/exchange/exchange_write.hpp"
#include "statistics/chaos/diffusion.hpp"
#include "statistics/chaos/lyapunov.hpp"

namespace lorentz::cli {
namespace {

struct ChaosOptions : ScanOptions {
  std::uint64_t collisions = 1'000'000, count = 100'000;
  std::string from = "uniform";
  std::optional<double> time;
  bool spectrum = false;
};

// Calls `run(work)` with threads, progress, Ctrl-C, and the store of this kind and plan, if requested.
// Reports how long it took.
template <class Run>
void with_work(const ChaosOptions& options, const std::string& kind, const runs::Plan& plan, const Run& run) {
  const auto jobs = static_cast<unsigned>(options.jobs);
  runs::PieceStore store(options.store, kind, plan);
  if (store.size() > 0) say("{}: {} of {} parts are done", *options.store, store.size(), chaos::kGroups);
  const Interrupt interrupt;
  const auto start = std::chrono::steady_clock::now();
  {
    Progress progress("flying, part", chaos::kGroups, 1);
    chaos::Work work{jobs, &Interrupt::came(), [&](std::uint64_t done) { progress.at(done); }};
    if (store.is_file()) {
      work.each_kept = [&](const auto& read) { store.each(read); };
      work.keep = [&](const std::string& piece) { store.add({piece}); };
    }
    run(work);
  }
  say("{:.2f} s", std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  if (Interrupt::came())
    say("{}; {}", Interrupt::what(),
        store.is_file() ? "the same command goes on" : "without --store nothing is kept to go on with");
}

std::optional<ScanFinding> lyapunov_at(const ScanPlace& place, const ChaosOptions& options) {
  const chaos::LyapunovPlan plan{place.scene, options.seed, options.collisions, options.spectrum, place.name};
  const runs::Plan words{{"collisions", std::to_string(plan.collisions)},
                         {"spectrum", plan.whole_spectrum ? "whole" : "above zero"},
                         {"seed", std::to_string(plan.seed)},
                         {"scene", scene_line(plan.scene)}};
  chaos::Lyapunov found;
  with_work(options, "lyapunov", words,
            [&](const chaos::Work& work) { found = chaos::lyapunov_of(plan, work); });
  if (found.collisions == 0) {
    say("{}: there is nothing to report",
        found.is_whole ? "all particles ended on the way (docs/chaos.md#errors)" : "no part was done");
    return std::nullopt;
  }
  return ScanFinding{options.json ? found.json() : found.table(), found.csv(), found.is_whole};
}

std::optional<ScanFinding> diffusion_at(const ScanPlace& place, const ChaosOptions& options) {
  const chaos::DiffusionPlan plan{place.scene,
                                  starts::ensemble_named(options.from, "--from"),
                                  options.seed,
                                  options.count,
                                  options.time.value_or(100),
                                  place.name};
  const runs::Plan words{{"count", std::to_string(plan.count)},
                         {"time", fmt::format("{}", plan.time)},
                         {"starts", options.from},
                         {"seed", std::to_string(plan.seed)},
                         {"scene", scene_line(plan.scene)}};
  chaos::Diffusion found;
  with_work(options, "diffusion", words,
            [&](const chaos::Work& work) { found = chaos::diffusion_of(plan, work); });
  if (!found.has_content()) {
    say("{}: there is nothing to report",
        found.is_whole ? "no particle got beyond its first obstacle" : "no part was done");
    return std::nullopt;
  }
  return ScanFinding{options.json ? found.json() : found.table(), found.csv(), found.is_whole};
}

int run_chaos(const ChaosOptions& options,
              std::optional<ScanFinding> (*found_at)(const ScanPlace& place, const ChaosOptions& options)) {
  if (options.store && options.is_of_several())
    throw InputError("--store: parts are kept of one scene at one radius; run several one by one");
  return scan(options, "means of trajectories are taken",
              [&](const ScanPlace& place) { return found_at(place, options); });
}

}  // namespace

Command lyapunov_command() {
  auto options = std::make_shared<ChaosOptions>();
  return {"lyapunov", "Lyapunov exponents, with standard errors, and theory beside them.",
          scan_rows(*options, "the exponents, a row each", "finished parts",
                    {
                        {"--collisions", Whole{&options->collisions, 1, std::uint64_t{1} << 52}, "N",
                         "how many are counted, about: of 4096 particles together, at least one each"},
                        {"--spectrum", &options->spectrum, "", "the exponents below zero, too"},
                    }),

          "docs/chaos.md: what is measured, how, and what theory knows.\n"
          "Examples:\n  lorentz lyapunov --scene square --radius 0.2 --collisions 1e7 --jobs 2\n"
          "  lorentz lyapunov --scene square,triangular --radius 0.1,0.2,0.3 --csv exponents.csv",
          [options] { return run_chaos(*options, lyapunov_at); }};
}

Command diffusion_command() {
  auto options = std::make_shared<ChaosOptions>();
  return {
      "diffusion", "Mean squared displacements of many particles, and theory beside them.",
      scan_rows(*options, "the displacements, a row each", "finished parts",
                {
                    {"--count", Whole{&options->count, 1, std::uint64_t{1} << 52}, "N", "how many particles"},
                    {"--time,--max-time", Positive{&options->time}, "T",
                     "until when they are followed, at speed 1 [100]"},
                    {"--from,--start", &options->from, "uniform|surface",
                     "uniform: anywhere outside the obstacles; surface: off an obstacle (cosine law)"},
                }),

      "docs/chaos.md: what is measured, how, and what theory knows.\n"
      "Example:\n  lorentz diffusion --scene triangular --radius 0.45 --count 1e5 --time 50 --jobs 2",
      [options] { return run_chaos(*options, diffusion_at); }};
}

}  // namespace lorentz::cli
