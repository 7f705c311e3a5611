// The options of lorentz fuzz and their meaning.
#include "cli/fuzz.hpp"

#include <fmt/format.h>

#include <algorithm>

#include <lorentz/exchange.hpp>
#include "cli/help_texts.hpp"
#include "question/engines.hpp"
#include "report/claim_words.hpp"
#include "src/exchange/nearest_name.hpp"

namespace lorentz::cli {

using namespace question;

namespace {

fuzz::Scope scope_of(const FuzzOptions& options, const Domain& domain) {
  using Scenes = fuzz::Scope::Scenes;
  fuzz::Scope scope;
  if (domain.dimension_2 != domain.dimension_3) scope.dimension = domain.dimension_2 ? 2 : 3;
  constexpr Scenes kScenes[] = {Scenes::unit, Scenes::lattice, Scenes::ball, Scenes::any};
  scope.scenes = kScenes[index_of_name(options.scope, {"unit", "lattice", "ball", "any"}, "--scenes")];
  return scope;
}

std::string name_of_scenes(fuzz::Scope::Scenes scenes) {
  using Scenes = fuzz::Scope::Scenes;
  return scenes == Scenes::unit ? "unit" : scenes == Scenes::ball ? "ball" : "lattice";
}

// Targets that the user names must all have scenes in the scope. Without names, the targets that have such
// scenes are kept.
std::vector<const cases::Target*> within(const fuzz::Scope& scope, std::uint64_t seed, bool are_named,
                                         std::vector<const cases::Target*> targets) {
  if (scope.is_all()) return targets;
  std::vector<const cases::Target*> kept;
  for (const cases::Target* target : targets) {
    if (scope.meets(*target, seed))
      kept.push_back(target);
    else if (are_named)
      throw InputError(
          fmt::format("--target: {} has no such scenes as --scenes and --domain ask for", target->name()));
  }
  if (kept.empty()) throw InputError("no target has such scenes as --scenes and --domain ask for");
  return kept;
}

std::vector<const cases::Target*> targets_of(const FuzzOptions& options) {
  std::vector<std::string> names;
  for (const cases::Target& target : cases::targets()) names.emplace_back(target.name());
  std::vector<const cases::Target*> targets;
  for (const std::string& name : options.targets) {
    const cases::Target* target = cases::target_named(name);
    if (!target) index_of_name(name, names, "--target");  // throws: not a target
    if (std::find(targets.begin(), targets.end(), target) != targets.end())
      throw InputError(fmt::format("--target: {} is named twice", name));
    targets.push_back(target);
  }
  if (targets.empty())
    for (const cases::Target& target : cases::targets()) targets.push_back(&target);
  return targets;
}

}  // namespace

const std::string& FuzzOptions::engine() const {
  static const std::string usual = "reduction";
  if (engines.size() > 1) throw InputError("--engine: name one (" + names_for_help() + ")");
  return engines.empty() ? usual : engines[0];
}

fuzz::Plan plan_of(FuzzOptions options, const question::EngineInfo& engine) {
  fuzz::Plan plan;
  plan.seed = options.seed;
  options.claim.ask({engine});
  plan.claim = options.claim.claim();
  plan.scope = scope_of(options, plan.claim.domain);
  plan.targets = within(plan.scope, plan.seed, !options.targets.empty(), targets_of(options));
  plan.keep = options.keep;
  plan.mutate = options.mutate;
  plan.reword = options.reword;
  plan.sought.times = options.times;
  plan.sought.undecided = options.undecided
                              ? index_of_name(*options.undecided, {"no", "yes"}, "--undecided") == 1
                              : !engine.traits.leaves_undecided;
  plan.sought.ulps = options.tolerance();
  return plan;
}

fuzz::Bounds bounds_of(const FuzzOptions& options) {
  fuzz::Bounds bounds;
  if (options.cases) bounds.count = *options.cases;
  if (options.seconds || !options.cases) bounds.seconds = options.seconds.value_or(kDefaultSeconds);
  bounds.first = options.to_first;
  bounds.jobs = static_cast<unsigned>(options.jobs);
  return bounds;
}

fuzz::CampaignManifest manifest_of(const fuzz::Plan& plan, const std::string& engine) {
  fuzz::CampaignManifest manifest;
  manifest.version = LORENTZ_VERSION;
  manifest.engine = engine;
  for (const cases::Target* target : plan.targets) manifest.targets.emplace_back(target->name());
  manifest.seed = plan.seed;
  manifest.claim = plan.claim;
  // Part of the identity of a stored campaign: a different text would be a different campaign.
  manifest.options =
      fmt::format("ulps {}, variants of 1 in {}, reworded 1 in {}, {} kept{}{}", plan.sought.ulps,
                  plan.mutate, plan.reword, plan.keep, plan.sought.times ? ", times" : "",
                  plan.sought.undecided ? "" : ", without undecided");
  if (plan.scope.scenes != fuzz::Scope::Scenes::any)
    manifest.options += ", scenes " + name_of_scenes(plan.scope.scenes);
  manifest.options += report::words_of(plan.claim);
  return manifest;
}

std::vector<Option> rows_of(FuzzOptions& options) {
  std::vector<std::string> names;
  for (const cases::Target& target : cases::targets()) names.emplace_back(target.name());
  return joined(
      {{"-t,--target", &options.targets, "TARGET",
        fmt::format("targets of the campaign (default: all): {}", fmt::join(names, ", ")), kCommas},
       {"--scenes", &options.scope, "unit|lattice|ball|any",
        "only scenes that the engine supports: unit (the square or cubic lattice with spacing 1 and one "
        "ball), lattice (one crystal with one ball), ball (a single one), any"},
       {"--time", Positive{&options.seconds}, "SECONDS",
        "length of the campaign (default: 60, or until --count)"},
       {"--count", Whole{&options.cases, 1, kMostCases}, "N",
        "stops when each target has made N cases; variants do not count, cases that --scenes leaves out do"},
       {"--store", &options.store, "FILE", "keeps findings in FILE; the same command resumes the campaign",
        kOutput},
       {"--keep", Whole{&options.keep, 1, 1'000'000}, "N",
        "keeps and shrinks at most N findings of one sort for each target"},
       {"--mutate", Whole{&options.mutate, 0, 1'000'000'000}, "N",
        "climbs to smaller margins from one case in N; 0: from none"},
       {"--reword", Whole{&options.reword, 0, 1'000'000'000}, "N",
        "also asks one case in N, and its variants, in other words; 0: none"},
       {"--first", &options.to_first, "", "stops at the first finding"},
       {"--undecided", &options.undecided, "yes|no",
        "whether `undecided` is a finding (default: yes, but for reduction and batch)"}},
      options.rows({"--engine", "--seed", "--jobs", "--ulps", "--precision", "--time-tolerance", "--domain",
                    "--starts-inside", "--timeout", "--times", "--json"}));
}

}  // namespace lorentz::cli
