// lorentz survival: the number of right collisions in arithmetic with a given number of bits.
#include "statistics/survival/survival.hpp"
#include <lorentz/errors.hpp>
#include "cli/app.hpp"
#include "cli/help_texts.hpp"
#include "cli/interrupt.hpp"
#include "cli/numbers.hpp"
#include "cli/progress.hpp"
#include "cli/scan.hpp"
#include "report/files/messages.hpp"
#include "report/files/whole_file.hpp"
#include "report/page.hpp"

namespace lorentz::cli {
namespace {

struct SurvivalOptions : ScanOptions {
  std::string engine = "reduction";
  std::uint64_t count = 100, collisions = 500;
  std::vector<std::string> bits{"53", "106", "128", "256"};
  std::optional<std::string> html;
};

survival::SurvivalPlan plan_of(const SurvivalOptions& options) {
  survival::SurvivalPlan plan;
  plan.engine = question::engine_named(options.engine);
  if (!plan.engine.is_own())
    throw InputError(
        "--engine: survival is of engines of this program (lorentz trajectory --engine takes others)");
  plan.count = options.count, plan.collisions = options.collisions, plan.seed = options.seed;
  plan.bits.clear();
  for (const std::string& name : options.bits)
    plan.bits.push_back(static_cast<long>(whole_number(name, "--bits", 24, 100'000)));
  return plan;
}

survival::Survival followed(const survival::SurvivalPlan& plan) {
  Progress progress("following", plan.count, 1);
  survival::Survival found =
      survival::survival_of(plan, Interrupt::came(), [&](std::uint64_t done) { progress.at(done); });
  if (Interrupt::came()) say("{}: after {} of {} starts", Interrupt::what(), found.starts(), plan.count);
  return found;
}

int act(const SurvivalOptions& options) {
  if (options.html && !report::has_page()) report::page("");  // throws with the reason
  if (options.is_of_several() && options.html)
    throw InputError("--html: of one scene at one radius; --csv has all of them in one table");
  survival::SurvivalPlan plan = plan_of(options);
  RequestedFile html(options.html);
  const Interrupt interrupt;
  return scan(
      options, "right collisions are counted", [&](const ScanPlace& place) -> std::optional<ScanFinding> {
        plan.scene_name = place.name, plan.scene = place.scene, plan.radius = place.radius;
        const survival::Survival found = followed(plan);
        if (found.starts() == 0) return std::nullopt;
        html.write([&] { return report::page(found.page_json(command_line())); });
        return ScanFinding{options.json ? found.json() : found.table(), found.csv(), !Interrupt::came()};
      });
}

}  // namespace

Command survival_command() {
  auto options = std::make_shared<SurvivalOptions>();
  return {
      "survival", "How many collisions of a trajectory are right, in binary64 and in more bits.",
      joined(scan_rows(*options, "shares of starts that are right after k collisions"),
             {
                 {"-e,--engine", &options->engine, "ENGINE",
                  "the engine of the flights in binary64 and double-double; " + std::string(kEngineHelp)},
                 {"--bits", &options->bits, "LIST",
                  "arithmetics: 53 is the engine in binary64, 106 in double-double, any other number "
                  "plain arithmetic of that many bits",
                  kCommas},
                 {"--count", Whole{&options->count, 1, 10'000'000}, "N",
                  "starts, off the surface of an obstacle (cosine law)"},
                 {"--collisions", Whole{&options->collisions, 1, 1'000'000}, "N", "at most N of each start"},
                 {"--html", &options->html, "FILE",
                  "a page that opens offline: the shares with 95 % bounds, and their numbers", kOutput},
             }),

      "Each start is followed with certainty (lorentz trajectory), and each arithmetic until it hits "
      "another\nobstacle. docs/itineraries.md has figures.\n"
      "Example:\n  lorentz survival --scene square --radius 0.1 --count 1000 --html survival.html",
      [options] { return act(*options); }};
}

}  // namespace lorentz::cli
