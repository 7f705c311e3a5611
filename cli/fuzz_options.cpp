// The options of lorentz fuzz and their meaning.
#include "cli/fuzz.hpp"

#include <algorithm>
#include <charconv>
#include <limits>
#include <tuple>

#include <lorentz/exchange.hpp>
#include "cli/help_texts.hpp"
#include "cli/numbers.hpp"
#include "question/answerer.hpp"
#include "question/engines.hpp"
#include "report/claim_words.hpp"
#include "report/files/messages.hpp"
#include "src/exchange/nearest_name.hpp"

namespace lorentz::cli {

using namespace question;

namespace {

fuzz::Scope scope_of(const FuzzOptions& options) {
  using Scenes = fuzz::Scope::Scenes;
  fuzz::Scope scope;
  if (options.dimension) scope.dimension = static_cast<int>(*options.dimension);
  constexpr Scenes kScenes[] = {Scenes::unit, Scenes::lattice, Scenes::ball, Scenes::any};
  scope.scenes = kScenes[index_of_name(options.scenes, {"unit", "lattice", "ball", "any"}, "--scenes")];
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
          fmt::format("--target: {} has no such scenes as --scenes and --dimension ask for", target->name()));
  }
  if (kept.empty()) throw InputError("no target has such scenes as --scenes and --dimension ask for");
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

fuzz::Plan plan_of(FuzzOptions options, const question::EngineInfo& engine) {
  fuzz::Plan plan;
  plan.seed = options.seed;
  plan.scope = scope_of(options);
  plan.targets = within(plan.scope, plan.seed, !options.targets.empty(), targets_of(options));
  std::tie(plan.shard, plan.shards) = shard_in(options.shard);
  plan.keep = options.keep;
  plan.mutate = options.mutate;
  plan.reword = options.reword;
  options.claim.ask({engine});
  plan.claim = options.claim.claim();
  plan.truth = truth_named(options.judge, {engine});
  plan.sought.times = options.times;
  plan.sought.undecided = options.undecided || (!options.no_undecided && !engine.traits.leaves_undecided);
  plan.sought.ulps = options.ulps.value_or(oracle::kDefaultUlps);
  return plan;
}

fuzz::Bounds bounds_of(const FuzzOptions& options) {
  fuzz::Bounds bounds;
  if (options.count) bounds.count = *options.count;
  if (options.seconds || !options.count) bounds.seconds = options.seconds.value_or(kDefaultSeconds);
  bounds.first = options.first;
  bounds.jobs = static_cast<unsigned>(options.jobs);
  return bounds;
}

fuzz::CampaignManifest manifest_of(const fuzz::Plan& plan, const std::string& engine) {
  fuzz::CampaignManifest manifest;
  manifest.version = LORENTZ_VERSION;
  manifest.engine = engine;
  for (const cases::Target* target : plan.targets)
    manifest.targets += (manifest.targets.empty() ? "" : ",") + std::string(target->name());
  manifest.seed = plan.seed;
  manifest.keep = plan.keep;
  // Part of the identity of a stored campaign: a different text would be a different campaign. "mutants" is
  // the former name of variants.
  manifest.options =
      fmt::format("ulps {}, mutants of 1 in {}, reworded 1 in {}, {} kept{}{}{}", plan.sought.ulps,
                  plan.mutate, plan.reword, plan.keep, plan.sought.times ? ", times" : "",
                  plan.sought.undecided ? "" : ", without undecided",
                  plan.truth == fuzz::Truth::certified ? ", judged by certified" : "");
  if (plan.scope.dimension != 0) manifest.options += fmt::format(", {}D", plan.scope.dimension);
  if (plan.scope.scenes != fuzz::Scope::Scenes::any)
    manifest.options += ", scenes " + name_of_scenes(plan.scope.scenes);
  manifest.options += report::words_of(plan.claim);  // empty for binary64, which all older stores use
  manifest.shard = fmt::format("{}/{}", plan.shard, plan.shards);
  return manifest;
}

Claim claim_of(const fuzz::CampaignManifest& manifest) {
  constexpr std::string_view kWithin = ", times within ";
  const std::string& words = manifest.options;
  Claim claim;
  if (words.find(", in binary32") != words.npos) claim.precision = NumberFormat::binary32;
  if (words.find(", times not judged") != words.npos)
    claim.time_tolerance = std::numeric_limits<double>::infinity();
  if (const auto at = words.find(kWithin); at != words.npos) {
    double tolerance = 0;
    std::from_chars(words.data() + at + kWithin.size(), words.data() + words.size(), tolerance);
    claim.time_tolerance = tolerance;
  }
  return claim;
}

std::string command_of(const FuzzOptions& o) {
  const FuzzOptions usual;
  std::string command = "lorentz fuzz";
  const auto add = [&](const char* option, const auto& value) {
    command += fmt::format(" {} {}", option, shell_quoted(fmt::format("{}", value)));
  };
  const auto add_if = [&](const char* option, const auto& value) {
    if (value) add(option, *value);
  };
  const auto add_unless = [&](const char* option, const auto& value, const auto& by_default) {
    if (value != by_default) add(option, value);
  };
  const auto add_flag = [&](const char* option, bool is_set) {
    if (is_set) command += fmt::format(" {}", option);
  };
  add("--engine", o.engine);
  for (const std::string& target : o.targets) add("--target", target);
  add_if("--dimension", o.dimension);
  add_unless("--scenes", o.scenes, usual.scenes);
  add_if("--time", o.seconds);
  add_if("--count", o.count);
  add_unless("--seed", o.seed, usual.seed);
  add_unless("--jobs", o.jobs, usual.jobs);
  add_unless("--shard", o.shard, usual.shard);
  add_unless("--keep", o.keep, usual.keep);
  add_unless("--mutate", o.mutate, usual.mutate);
  add_unless("--reword", o.reword, usual.reword);
  add_unless("--judge", o.judge, usual.judge);
  add_if("--precision", o.claim.precision);
  add_if("--time-tolerance", o.claim.time_tolerance);
  add_if("--ulps", o.ulps);
  add_if("--timeout", o.timeout);
  add_if("--progress", o.progress);
  add_flag("--first", o.first);
  add_flag("--times", o.times);
  add_flag("--undecided", o.undecided);
  add_flag("--no-undecided", o.no_undecided);
  add_flag("--json", o.json);
  add_if("--store", o.store);
  add_if("--baseline", o.files.baseline);
  add_if("--junit", o.files.junit);
  return command;
}

std::vector<Option> rows_of(FuzzOptions& options) {
  std::vector<std::string> names;
  for (const cases::Target& target : cases::targets()) names.emplace_back(target.name());
  return {
      {"-t,--target", &options.targets, "TARGET",
       fmt::format("what to aim at (default: all): {}", fmt::join(names, ", ")), kCommas},
      {"--dimension", Whole{&options.dimension, 2, 3}, "2|3",
       "only scenes in the plane, or in space (default: both)"},
      {"--scenes", &options.scenes, "unit|lattice|ball|any",
       "only such as the engine can do: unit (the square or cubic lattice with spacing 1 and one "
       "ball), lattice (one, with one ball), ball (one, that is not repeated), any"},
      {"-e,--engine", &options.engine, "ENGINE", names_for_help()},
      {"--time", Positive{&options.seconds}, "SECONDS", "how long (default: 60, or until --count)"},
      {"--count", Whole{&options.count, 1, kMostCases}, "N",
       "until each target has had N cases: its variants do not count, cases that --scenes leaves out do"},
      {"--seed", Whole{&options.seed}, "N", "of the cases"},
      {"--jobs", Whole{&options.jobs, 1, 1024}, "N",
       "threads (of each process, under mpirun); the findings are the same"},
      {"--store", &options.store, "FILE", "where findings are kept and campaigns gone on with", kOutput},
      {"--shard", &options.shard, "I/N", "only the indices I modulo N"},
      {"--keep", Whole{&options.keep, 1, 1'000'000}, "N",
       "findings of one sort that are kept and shrunk, of each target"},
      {"--mutate", Whole{&options.mutate, 0, 1'000'000'000}, "N",
       "climb to smaller margins from one case in N; 0: from none"},
      {"--reword", Whole{&options.reword, 0, 1'000'000'000}, "N",
       "ask one case in N, and its variants, in other words, too; 0: none"},
      {"--judge", &options.judge, "oracle|certified", kJudgeHelp},
      {"--first", &options.first, "", "stop at the first finding"},
      {"--ulps", Tolerance{&options.ulps}, "K",
       "the tolerance k, as in `compare` (default: 4); 0: the exact answer and no other"},
      options.claim.precision_row(),
      options.claim.time_tolerance_row(),
      {"--timeout", Positive{&options.timeout}, "SECONDS", kTimeoutHelp},
      {"--times", &options.times, "", "wrong times are findings, too"},
      {"--undecided", &options.undecided, "",
       "`undecided` is a finding (the default, but for reduction and batch)", kPlain, "--no-undecided"},
      {"--no-undecided", &options.no_undecided, "", "`undecided` is not a finding", kPlain, "--undecided"},
      {"--progress", Positive{&options.progress}, "SECONDS",
       "where stderr is not a terminal: print a line there every SECONDS (default: 60)"},
      options.files.baseline_row(),
      options.files.junit_row(),
      {"--json", &options.json, "", "one JSON object instead of tables"}};
}

}  // namespace lorentz::cli
