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
       "scene files, or names of the catalogue, with commas between them (default: square)", kCommas},
      {"--radius", &o.radii, "R", "radii of every ball of --scene, with commas between them", kCommas},
      {"--difficulty", &o.difficulties, "drawn|near-rational|grazing",
       "of the queries (default: drawn,near-rational,grazing)", kCommas | kToldDefault},
      {"--queries", &o.queries, "FILE",
       "queries instead of drawn ones: a stream (NDJSON), - is standard input, or columns (.npy, .csv; "
       "docs/formats.md), which need --scene",
       kPlain, "--count"},
      {"--count", Whole{&o.count, 0, 1'000'000'000}, "N", "how many queries to draw in each scene", kPlain,
       "--queries"},
      {"--seed", Whole{&o.seed}, "N", "of all that is drawn"},
      {"sets", &o.sets, "SET", "files, folders, or names of committed sets (default: all of these)"},
      {"--first", Whole{&o.first, 1, 1'000'000'000'000}, "N", "only the first N records of each set"},
      {"--id", &o.id, "ID", "only this record; the beginning of its id will do"},
      {"--quick", &o.quick, "", "20 seconds instead of two minutes, and fewer drawn flights", kPlain,
       "--questions"},
      {"--time", Positive{&o.seconds}, "SECONDS",
       "how long the run takes, the engine's start included; each part takes its share (default: 124; with "
       "--quick 19.5)"},
      {"--questions", Whole{&o.questions, 1, 1'000'000'000}, "N",
       "asks N questions of each row, however long that takes: every machine asks the same", kToldDefault,
       "--time"},
  };
}

// The engines, and the rules by which answers are judged.
std::vector<Option> rows_of_engines(O& o) {
  return {
      {"-e,--engine", &o.engines, "ENGINE",
       names_for_help() + "; several with commas between them, or once each", kOneAtATime | kToldDefault},
      {"--answers", &o.answers, "NAME=FILE",
       "judge answers that some program wrote, as an engine NAME: a stream; or columns (.npy, .csv), "
       "to queries in columns"},
      {"--jobs", Whole{&o.jobs, 1, 1024}, "N",
       "threads, of exact answers and of engines of this program: the same results; times are of one", kPlain,
       "--questions"},
      {"--timeout", Positive{&o.timeout}, "SECONDS", kTimeoutHelp},
      {"--judge", &o.judge, "oracle|certified", kJudgeHelp},
      {"--no-oracle", &o.no_oracle, "", "only take times, judge nothing", kPlain, "--answers"},
      {"--ulps", Tolerance{&o.ulps}, "K",
       "the tolerance k: answers that k ulps in every input would make right are ill-posed, not wrong; 0 "
       "forgives nothing (default: 4)"},
      o.claim.precision_row(),
      o.claim.time_tolerance_row(),
      o.claim.domain_row(),
      o.claim.starts_inside_row(),
      {"--times", &o.times, "", "wrong times count: exit status 1, and among the failures"},
      {"--strict", &o.strict, "",
       "ill-posed and undecided answers count, and those to invalid questions: exit status 1; unknown keys "
       "are errors"},
  };
}

// Where results go.
std::vector<Option> rows_of_sinks(O& o) {
  return {
      {"--json", &o.json, "", "JSON instead of tables, one object a line"},
      {"--failures", Whole{&o.failures, 0, 1'000'000}, "N", "show at most N failures of each engine"},
      {"--disagreements", &o.disagreements, "FILE",
       "write each wrong or ill-posed answer there (--times: and wrong time), as a query stream", kOutput},
      o.files.baseline_row(),
      o.files.junit_row(),
      {"--csv", &o.csv, "FILE", "write the figures there too, one line a cell", kOutput},
      {"--html", &o.html, "FILE", "write the report there as a page that opens offline, whole or not at all",
       kOutput},
      {"--golden", &o.golden, "FILE",
       "write the simplest case of each fault there, as a golden set for the engine's own tests", kOutput},
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
