// lorentz doctor: is this machine fit? Its arithmetic, its libraries, and first hits that are known exactly.
#include <algorithm>

#include <lorentz/batch.hpp>
#include <lorentz/environment.hpp>
#include "cli/app.hpp"
#include "cli/output.hpp"
#include "question/engines.hpp"
#include "question/examine.hpp"
#include "question/starts/free_starts.hpp"
#include "report/manifest.hpp"
#include "report/table.hpp"
#include "src/exchange/json_writer.hpp"

namespace lorentz::cli {
namespace {

constexpr std::size_t kQuestions = 500;  // in the plane, and as many in space

// Asks an engine drawn questions. Right are obstacles and, within the tolerance, times that the oracle has.
ArithmeticCheck self_test(const std::string& engine) {
  std::size_t right = 0;
  for (const int dimension : {2, 3}) {
    const auto place = std::make_shared<question::Place>(unit_scene(dimension, 0.1));
    const starts::FreeStarts starts(place->scene(), starts::Kind::uniform, starts::kDefaultSeed);
    std::vector<Query> queries;
    while (queries.size() < kQuestions) queries.push_back(starts[queries.size()]);
    std::vector<question::Question> questions = question::questions_of(place, queries);
    question::answer_exactly(questions);
    const auto answerer = question::own_engine(engine)->answerer({});
    question::examine(question::all_of(questions), *answerer, 4, [&](const question::Judged& one) {
      right += one.judgement.verdict == oracle::Verdict::agree && !one.judgement.wrong_time;
    });
  }
  return {"first hits: " + engine, right == 2 * kQuestions,
          fmt::format("{} of {} as the oracle's", right, 2 * kQuestions), "all"};
}

int run_doctor(bool as_json) {
  std::vector<ArithmeticCheck> checks = arithmetic_checks();
  for (const char* engine : {"walk", "reduction", "certified", "batch", "certified-batch"})
    checks.push_back(self_test(engine));
  const bool fit = std::ranges::all_of(checks, &ArithmeticCheck::fit);
  const report::Manifest its = report::manifest_of(starts::kDefaultSeed, command_line());
  report::Table table({"looked at", "found", "fit"});
  for (const ArithmeticCheck& check : checks)
    table.add({check.name, check.found, check.fit ? "yes" : "NO: expected: " + check.expected});
  if (as_json)
    print(json::line_of([&](json::Members& object) {
      object.add("fit", fit, "version", its.version, "commit", its.commit, "compiler", its.compiler,
                 "machine", its.machine, "instructions", Batch::instruction_sets(), "findings",
                 json::objects(checks,
                               [](json::Members& one, const ArithmeticCheck& check) {
                                 one.add("name", check.name, "fit", check.fit, "found", check.found,
                                         "expected", check.expected);
                               }),
                 "libraries", library_versions());
    }));
  else
    print(fmt::format("lorentz {} ({}), {}; {}; vectors: {}\n{}\n\n{}\n{}\n", its.version, its.commit,
                      its.compiler, its.machine, fmt::join(Batch::instruction_sets(), ", "),
                      fmt::join(library_versions(), ", "), table.text(),
                      fit ? "Fit: answers here are what they are everywhere."
                          : "NOT FIT: no answer here can be relied on (docs/determinism.md)."));
  return fit ? kDone : kDisagreement;
}

}  // namespace

Command doctor_command() {
  auto json = std::make_shared<bool>(false);
  return {"doctor",
          "Is this machine fit? Looks at rounding, vector instructions and libraries, and asks engines known "
          "questions.",
          {{"--json", json.get(), "", "as one JSON object"}},
          "Exit status: 0 fit, 1 not fit.\nExample:\n  lorentz doctor",
          [json] { return run_doctor(*json); }};
}

}  // namespace lorentz::cli
