// lorentz judge: the full report of this program on one engine, and a verdict.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>

#include <lorentz/exchange.hpp>
#include "cli/app.hpp"
#include "cli/claim_options.hpp"
#include "cli/golden_questions.hpp"
#include "cli/help_texts.hpp"
#include "cli/interrupt.hpp"
#include "cli/known_failures.hpp"
#include "cli/output.hpp"
#include "cli/progress.hpp"
#include "cli/set_output.hpp"
#include "cli/terminal.hpp"
#include "files/whole_file.hpp"
#include "golden/production.hpp"
#include "judge/baseline.hpp"
#include "judge/judging.hpp"
#include "report/claim_words.hpp"
#include "report/page.hpp"

namespace lorentz::cli {

using judge::JudgeOrder;
using judge::JudgeReport;

namespace {

using question::Count;

struct JudgeOptions {
  std::string engine;
  std::uint64_t seed = starts::kDefaultSeed, jobs = 1;
  std::optional<std::uint64_t> questions;
  std::optional<double> ulps, timeout, seconds;
  std::optional<std::string> html, golden;
  FailureFiles files;
  ClaimOptions claim;
  bool quick = false, json = false, times = false, strict = false;
};

int exit_status(const JudgeReport& report, const JudgeOptions& options) {
  const question::Tally t = report.total();
  if (t.counts.sum({Count::wrong, Count::error}) > 0 || (options.times && t[Count::wrong_time] > 0) ||
      (options.strict &&
       t.counts.sum({Count::ill_posed, Count::undecided, Count::missing, Count::nonsense}) > 0))
    return kDisagreement;
  return kDone;
}

// The baseline: an earlier report, or known failures by row and id.
struct BaselineFile {
  std::optional<judge::Baseline> report;
  std::optional<std::string> known;
};

BaselineFile baseline_of(const JudgeOptions& options) {
  if (!options.files.baseline) return {};
  const std::string& name = *options.files.baseline;
  const std::string text = text_of_file(name);
  const std::size_t begin = text.find_first_not_of(" \t\r\n");
  if (begin == text.npos || text[begin] == '{') return {judge::Baseline(text, name), {}};
  if (!options.questions)
    throw InputError("--baseline: failures by row and id need --questions, so that each run asks the same");
  return {{}, text};
}

// Reports what is worse than in an earlier report. The exit status depends on that alone.
int status_against(const judge::Baseline& baseline, const JudgeReport& report, const JudgeOptions& options) {
  const std::vector<std::string> worse = baseline.worse(report, options.times);
  const auto others = baseline.not_compared(report);
  const auto asked = std::ranges::count_if(report.rows, [](const auto& row) { return row.asked() > 0; });
  if (worse.empty() && asked > 0 && static_cast<std::size_t>(asked) == others.size()) {
    say("{} asked other numbers of questions in every row: give the same --questions",
        *options.files.baseline);
    return kBadInput;
  }
  if (!others.empty())
    say("{} rows asked another number of questions than in {}; only new kinds of fault are told of them: {}",
        others.size(), *options.files.baseline, fmt::join(others, ", "));
  for (const std::string& one : worse) say("worse than in {}: {}", *options.files.baseline, one);
  if (worse.empty()) say("nothing is worse than in {}", *options.files.baseline);
  return worse.empty() ? kDone : kDisagreement;
}

// The callback that records the failures of each row; empty if no file needs them.
judge::OnJudged ledger_of(const JudgeOptions& options, FailureLedger& ledger) {
  if (!ledger.has_baseline() && !options.files.write_baseline && !options.files.junit) return {};
  return [&](const std::string& row, const question::Question& question, const oracle::Judgement& judgement) {
    const Scene& scene = question.place->scene();
    const std::string id = question.is_query() ? golden::id_of(scene, question.query)
                                               : golden::id_of(golden::scene_line_of(scene), question.text);
    ledger.take(row, id, failure_of(judgement, options.times, options.strict));
  };
}

// Shows which part of the planned time has passed.
std::function<void(const std::string&)> clock_of(double seconds) {
  constexpr double kTicks = 10;  // per second
  const auto bar = std::make_shared<Progress>("judging (tenths of a second)",
                                              static_cast<std::size_t>(kTicks * seconds), 1);
  const auto start = std::chrono::steady_clock::now();
  return [=](const std::string& row) {
    const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start;
    bar->at(static_cast<std::size_t>(kTicks * passed.count()), [&] { return row; });
  };
}

// Shows the current row.
std::function<void(const std::string&)> rows_shown(const JudgeOrder& order) {
  struct RowBar {
    explicit RowBar(std::size_t rows) : bar("judging (rows)", rows, 1) {}
    Progress bar;
    std::string last = {};
    std::size_t begun = 0;
  };
  return [rows = std::make_shared<RowBar>(judge::number_of_rows(order))](const std::string& row) {
    if (row != rows->last) ++rows->begun, rows->last = row;
    rows->bar.at(rows->begun - 1, [&] { return row; });
  };
}

// The options quoted for a shell, without the files of the report.
std::string command_of(const JudgeOptions& o) {
  std::string command = "lorentz judge --engine " + shell_quoted(o.engine);
  if (o.quick) command += " --quick";
  if (o.seconds) command += fmt::format(" --time {}", *o.seconds);
  if (o.questions) command += fmt::format(" --questions {}", *o.questions);
  if (o.seed != JudgeOptions{}.seed) command += fmt::format(" --seed {}", o.seed);
  if (o.jobs != JudgeOptions{}.jobs) command += fmt::format(" --jobs {}", o.jobs);
  if (o.ulps) command += fmt::format(" --ulps {}", *o.ulps);
  command += report::arguments_of(o.claim.claim());
  if (o.timeout) command += fmt::format(" --timeout {}", *o.timeout);
  if (o.times) command += " --times";
  if (o.strict) command += " --strict";
  return command;
}

JudgeOrder order_of(JudgeOptions options) {
  JudgeOrder order;
  order.quick = options.quick;
  order.time = options.seconds;
  order.questions = options.questions;
  constexpr double kShareOfStart = 0.5;  // the largest, of the time, for loading an engine
  const double timeout = options.timeout.value_or(question::AnswererOptions::kDefaultTimeout);
  order.engine = question::engine_named(
      options.engine, order.questions ? timeout : std::min(timeout, kShareOfStart * order.seconds()));
  order.introduction = options.claim.ask({order.engine}).front();
  order.command = command_of(options);
  order.seed = options.seed;
  order.jobs = static_cast<unsigned>(options.jobs);
  order.ulps = options.ulps.value_or(oracle::kDefaultUlps);
  order.claim = options.claim.claim();
  order.timeout = options.timeout;
  order.times = options.times;
  order.strict = options.strict;
  order.listener = terminal();
  return order;
}

// A golden set with the simplest case of each fault.
std::string golden_set_of(const JudgeReport& report) {
  golden::GivenQuestions given({.name = "findings",
                                .description = "The simplest case of each fault of an engine.",
                                .generator = report.command,
                                .version = LORENTZ_VERSION,
                                .precision = report.claim.precision});
  for (const judge::Finding& finding : report.findings) {
    const question::Question& question = finding.simplest.question;
    if (!question.is_query()) continue;
    const std::string tag(judge::name_of(finding.cause()));
    const Scene& scene = question.place->scene();
    if (!given.header.explains(tag)) given.header.tags.emplace_back(tag, finding.summary());
    given.add({scene, golden::question_of(question.query, scene), question.query, {tag}});
  }
  return made_set(given).text;
}

int act(const JudgeOptions& options) {
  JudgeOrder order = order_of(options);
  if (options.html) report::page("{}");  // throws without a page: now rather than after two minutes
  RequestedFile html(options.html);
  SetOutput golden(options.golden, "findings");
  for (const auto& [name, path] :
       {std::pair{"--write-baseline", &options.files.write_baseline}, {"--junit", &options.files.junit}})
    if (*path && !options.questions)
      throw InputError(std::string(name) + ": needs --questions, so that each run asks the same");
  const auto [baseline, known] = baseline_of(options);
  FailureLedger ledger(options.files, known);
  order.on_judged = ledger_of(options, ledger);
  const Interrupt interrupt;
  order.on_progress = order.questions ? rows_shown(order) : clock_of(order.seconds());
  const JudgeReport report = judge::judged(order, Interrupt::came());
  order.on_progress = {};  // removes the bar before anything is printed
  print(options.json ? report.json() : report.text());
  html.write([&] { return report::page(report.json()); });
  golden.write([&] { return golden_set_of(report); });
  if (!Interrupt::came()) {
    for (const judge::ExaminedRow& row : report.rows) ledger.end(row.name);
    ledger.finish(options.engine);
    if (report.is_broken() || report.rows_given_up() + report.rows_too_slow() > 0) return kFailed;
    if (ledger.has_baseline()) return ledger.new_failures() > 0 ? kDisagreement : kDone;
    return baseline ? status_against(*baseline, report, options) : exit_status(report, options);
  }
  say("{}: this is what was found so far", Interrupt::what());
  return kFailed;
}

}  // namespace

Command judge_command() {
  auto options = std::make_shared<JudgeOptions>();
  return {
      "judge",
      "All that can be said of one engine: comparison, golden sets, a campaign, speed; one verdict.",
      {
          {"-e,--engine", &options->engine, "ENGINE", names_for_help(), kRequired},
          {"--quick", &options->quick, "", "20 seconds instead of two minutes, and fewer drawn flights",
           kPlain, "--questions"},
          {"--time", Positive{&options->seconds}, "SECONDS",
           "how long the run takes, the engine's start included; each part takes its share (default: 124; "
           "with "
           "--quick 19.5)"},
          {"--questions", Whole{&options->questions, 1, 1'000'000'000}, "N",
           "asks N questions of each row, however long that takes: every machine asks the same", kToldDefault,
           "--time"},
          {"--seed", Whole{&options->seed}, "N", "of all that is drawn"},
          {"--jobs", Whole{&options->jobs, 1, 1024}, "N", "threads of the campaign; all else is asked on one",
           kPlain, "--questions"},
          {"--ulps", Tolerance{&options->ulps}, "K",
           "the tolerance k of the verdicts, as in `compare`; 0 forgives nothing (default: 4)"},
          options->claim.precision_row(),
          options->claim.time_tolerance_row(),
          {"--timeout", Positive{&options->timeout}, "SECONDS",
           "how long a cmd: or lib: engine may be silent while it owes answers, or is loaded; a longer "
           "silence is a failure (default: 60 with --questions; else a tenth of the whole time, but at least "
           "2 "
           "and at most 60, and 60 for its first answer: one that is silent for longer is too slow to ask)"},
          {"--html", &options->html, "FILE", "write the report there as a page, whole or not at all",
           kOutput},
          {"--golden", &options->golden, "FILE",
           "write the simplest case of each fault there, as a golden set for the engine's own tests; FOLDER/ "
           "gets it with its schema, an index and checksums",
           kOutput},
          {"--json", &options->json, "", "one JSON object instead of tables"},
          options->files.baseline_row(
              "exit status 1 only for what is worse than in FILE: a report that --json printed, or, with "
              "--questions, failures that --write-baseline wrote"),
          options->files.write_baseline_row(),
          options->files.junit_row(),
          {"--times", &options->times, "", "wrong times count: in the verdict, and exit status 1"},
          {"--strict", &options->strict, "",
           "answers to invalid questions count in the verdict; exit status 1 also for these, and "
           "for ill-posed, undecided and missing answers"},
      },

      "docs/judge.md says what is asked, and what the verdict means. Exit status 1: an answer is wrong, or "
      "a valid question was called an error;\n3: a cmd: or lib: engine broke, or was given up or too slow in "
      "a "
      "scene.\n"
      "Example:\n  lorentz judge --quick --engine 'cmd:python3 examples/naive_engine.py'",
      [options] { return act(*options); }};
}

}  // namespace lorentz::cli
