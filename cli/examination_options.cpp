#include "cli/examination_options.hpp"

#include <algorithm>

#include <lorentz/verdict.hpp>
#include "cli/help_texts.hpp"
#include "question/engines.hpp"

namespace lorentz::cli {
namespace {

using O = ExaminationOptions;

// What is asked.
std::vector<Option> rows_of_sources(O& o) {
  return {
      {"--scene", &o.scenes, "SCENE",
       "scene files, or names of the catalogue, with commas between them (default: square; bench: "
       "square,cubic)",
       kCommas | kToldDefault},
      {"--radius", &o.radii, "R", "radii of every ball of --scene, with commas between them", kCommas},
      {"--difficulty", &o.difficulties, "drawn|near-rational|grazing",
       "kinds of queries (default: drawn,near-rational,grazing)", kCommas | kToldDefault},
      {"--queries", &o.queries, "FILE",
       "asks these queries instead of drawn ones: a stream (NDJSON; - is standard input), or columns (.npy, "
       ".csv; "
       "docs/formats.md), which need --scene",
       kPlain, "--count"},
      {"--count", Whole{&o.count, 0, 1'000'000'000}, "N", "number of queries drawn in each scene", kPlain,
       "--queries"},
      {"--seed", Whole{&o.seed}, "N", "seed of everything that is drawn"},
      {"sets", &o.sets, "SET", "files, folders, or names of committed sets (default: all of these)"},
      {"--first", Whole{&o.first, 1, 1'000'000'000'000}, "N", "only the first N records of each set"},
      {"--id", &o.id, "ID", "only the record with this id, or whose id begins so"},
      {"--quick", &o.quick, "", "20 seconds instead of two minutes, and fewer drawn flights", kPlain,
       "--questions"},
      {"--time", Positive{&o.seconds}, "SECONDS",
       "length of the run, with the engine's start; each part takes its share (default: 124; with "
       "--quick 19.5)"},
      {"--questions", Whole{&o.questions, 1, 1'000'000'000}, "N",
       "asks N questions in each row, however long that takes: the same on every machine", kToldDefault,
       "--time"},
  };
}

// The engines, and the rules by which answers are judged.
std::vector<Option> rows_of_engines(O& o) {
  return {
      {"-e,--engine", &o.engines, "ENGINE",
       std::string(kEngineHelp) + "; compare, golden check and bench take several, with commas between them",
       kOneAtATime | kToldDefault},
      {"--answers", &o.answers, "NAME=FILE",
       "also judges the answers in FILE, which some program wrote, as those of an engine called NAME: a "
       "stream, or columns (.npy, .csv) to queries in columns"},
      {"--jobs", Whole{&o.jobs, 1, 1024}, "N",
       "number of threads for exact answers and for engines of this program; results are the same, and "
       "times are those of one thread",
       kPlain, "--questions"},
      {"--timeout", Positive{&o.timeout}, "SECONDS", kTimeoutHelp},
      {"--no-oracle", &o.no_oracle, "", "only measures times, judges nothing", kPlain, "--answers"},
      {"--ulps", Tolerance{&o.ulps}, "K",
       "the tolerance k: answers that k ulps in every input would make right are ill-posed, not wrong; 0 "
       "forgives nothing (default: 4)"},
      o.claim.precision_row(),
      o.claim.time_tolerance_row(),
      o.claim.domain_row(),
      o.claim.starts_inside_row(),
      {"--times", &o.times, "", "wrong times are failures, too: exit status 1"},
      {"--strict", &o.strict, "",
       "ill-posed and undecided answers (of judge answers to invalid questions, too) are failures: exit "
       "status 1; unknown keys are errors"},
  };
}

// Where results go.
std::vector<Option> rows_of_sinks(O& o) {
  return {
      {"--json", &o.json, "", "writes JSON instead of tables, one object per line"},
      {"--all", &o.all, "", "prints all findings in full, with examples and commands, and the table"},
      {"--failures", Whole{&o.failures, 0, 1'000'000}, "N", "shows at most N failures of each engine"},
      {"--disagreements", &o.disagreements, "FILE",
       "writes each wrong or ill-posed answer (with --times each wrong time) to FILE, as a query stream",
       kOutput},
      o.files.baseline_row(),
      o.files.junit_row(),
      {"--csv", &o.csv, "FILE", "also writes the figures to FILE, one line per cell", kOutput},
      {"--html", &o.html, "FILE", "writes the report to FILE, as a page that opens offline", kOutput},
      {"--golden", &o.golden, "FILE",
       "writes the simplest case of each fault to FILE, as a golden set for the engine's own tests", kOutput},
  };
}

}  // namespace

std::vector<Option> ExaminationOptions::rows(std::initializer_list<const char*> names) {
  const std::vector<Option> all =
      joined(joined(rows_of_sources(*this), rows_of_engines(*this)), rows_of_sinks(*this));
  std::vector<Option> picked;
  for (const char* name : names) {
    picked.push_back(*std::ranges::find(all, name, &Option::name));
    const std::string& other = picked.back().excludes;
    if (std::ranges::none_of(names, [&](const char* one) { return other == one; }))
      picked.back().excludes.clear();
  }
  return picked;
}

double ExaminationOptions::tolerance() const {
  return ulps.value_or(oracle::kDefaultUlps);
}

double ExaminationOptions::longest_wait() const {
  return timeout.value_or(question::AnswererOptions::kDefaultTimeout);
}

std::vector<question::EngineInfo> ExaminationOptions::named_engines() const {
  std::vector<question::EngineInfo> named = question::engines_named(engines, timeout);
  if (named.empty() && answers.empty()) throw InputError("--engine: name one (" + names_for_help() + ")");
  if (const auto option = files.first_option(); option && named.size() + answers.size() > 1)
    throw InputError(*option + ": is of one engine; name one");
  return named;
}

}  // namespace lorentz::cli
