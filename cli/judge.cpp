// lorentz judge: the full report of this program on one engine, and a verdict.

#include <algorithm>
#include <chrono>

#include <lorentz/exchange.hpp>
#include "cli/app.hpp"
#include "cli/examination_options.hpp"
#include "cli/golden_questions.hpp"
#include "cli/help_texts.hpp"
#include "cli/interrupt.hpp"
#include "cli/output.hpp"
#include "cli/progress.hpp"
#include "cli/terminal.hpp"
#include "judge/golden/production.hpp"
#include "judge/judge_report.hpp"
#include "report/claim_words.hpp"
#include "report/files/whole_file.hpp"
#include "report/page.hpp"
#include "src/exchange/exchange_write.hpp"

namespace lorentz::cli {

using judge::JudgeOrder;
using judge::JudgeReport;

namespace {

int exit_status(const JudgeReport& report, const FailureLedger& ledger, const ExaminationOptions& options) {
  if (report.is_broken() || report.rows_given_up() + report.rows_too_slow() > 0) return kFailed;
  return ledger.failures(report.total().counts, options.times, options.strict) > 0 ? kDisagreement : kDone;
}

// The callback that records the failures of each row; empty if no file needs them.
judge::OnJudged recorder(const ExaminationOptions& options, FailureLedger& ledger) {
  if (!ledger.needs_ids()) return {};
  return [&](const std::string& row, const question::Judged& judged) {
    const question::Question& question = judged.question;
    const Scene& scene = question.place->scene();
    const std::string id = question.is_query() ? golden::id_of(scene, question.query)
                                               : golden::id_of(scene_line(scene), question.text);
    std::optional<std::string> failure = failure_of(judged.judgement, options.times, options.strict);
    if (!question.is_query() && judged.judgement.verdict == oracle::Verdict::wrong)
      failure = options.strict ? std::optional("nonsense") : std::nullopt;
    ledger.take(row, id, failure);
  };
}

// Shows which part of the planned time has passed; or the current row, if questions are counted.
std::function<void(const std::string&)> shown(const JudgeOrder& order) {
  constexpr double kTicks = 10;  // per second
  const bool is_counted = order.questions.has_value();
  const auto bar = std::make_shared<Progress>(
      is_counted ? "judging (rows)" : "judging (tenths of a second)",
      is_counted ? judge::number_of_rows(order) : static_cast<std::size_t>(kTicks * order.seconds()), 1);
  const auto start = std::chrono::steady_clock::now();
  return [=, last = std::string(), begun = std::size_t{0}](const std::string& row) mutable {
    if (row != last) ++begun, last = row;
    const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start;
    bar->at(is_counted ? begun - 1 : static_cast<std::size_t>(kTicks * passed.count()), [&] { return row; });
  };
}

JudgeOrder order_of(ExaminationOptions options) {
  if (options.engines.size() != 1) throw InputError("--engine: name one (" + names_for_help() + ")");
  JudgeOrder order;
  order.quick = options.quick;
  order.time = options.seconds;
  order.questions = options.questions;
  constexpr double kShareOfStart = 0.5;  // the largest, of the time, for loading an engine
  order.engine = question::engine_named(
      options.engines[0], order.questions
                              ? options.longest_wait()
                              : std::min(options.longest_wait(), kShareOfStart * order.seconds()));
  order.introduction = options.claim.ask({order.engine}, options.strict).front();
  order.command = command_line();
  order.seed = options.seed;
  order.jobs = static_cast<unsigned>(options.jobs);
  order.ulps = options.tolerance();
  order.claim = options.claim.claim();
  order.timeout = options.timeout;
  order.times = options.times;
  order.strict = options.strict;
  order.listener = terminal();
  return order;
}

// A golden set with the simplest case of each fault. Records have no limit: faults that need one are left out.
std::string golden_set_of(const JudgeReport& report) {
  golden::GivenQuestions given({.name = "findings",
                                .description = "The simplest case of each fault of an engine.",
                                .generator = report.command,
                                .version = LORENTZ_VERSION,
                                .precision = report.claim.precision});
  std::size_t with_limit = 0;
  for (const judge::Finding& finding : report.findings) {
    const question::Question& question = finding.simplest.question;
    if (!question.is_query()) continue;
    with_limit += question.has_limit();
    if (question.has_limit()) continue;
    const std::string tag(judge::name_of(finding.cause()));
    const Scene& scene = question.place->scene();
    if (!given.header.explains(tag)) given.header.tags.emplace_back(tag, judge::title_of(finding.cause()));
    given.add({scene, golden::question_of(question.query, scene), question.query, {tag}});
  }
  if (with_limit > 0)
    say("--golden: {} of {} findings are left out: their questions have a limit (max_time), which no record "
        "has",
        with_limit, report.findings.size());
  return made_set(given).first;
}

// Where the rest of the report is.
std::string words_of_more(const ExaminationOptions& options) {
  std::string text = "more:    --all prints the table, and each finding with an example and commands";
  for (const auto& file : {options.html, options.golden, options.files.junit, options.files.baseline})
    if (file) text += "; " + printable(*file);
  return text + '\n';
}

int run_judge(const ExaminationOptions& options) {
  JudgeOrder order = order_of(options);
  if (const auto option = options.files.first_option(); option && !options.questions)
    throw InputError(*option + ": needs --questions, so that each run asks the same");
  if (options.html) report::page("{}");  // throws without a page: now rather than after two minutes
  RequestedFile html(options.html);
  RequestedFile golden(options.golden);
  FailureLedger ledger(options.files);
  order.on_judged = recorder(options, ledger);
  const Interrupt interrupt;
  order.on_progress = shown(order);
  const JudgeReport report = judge::judged(order, Interrupt::came());
  order.on_progress = {};  // removes the bar before anything is printed
  print(options.json ? report.json() : report.text(options.all));
  html.write([&] { return report::page(report.json()); });
  golden.write([&] { return golden_set_of(report); });
  if (!options.json && !options.all) print(words_of_more(options));
  if (Interrupt::came()) {
    say("{}: this is what was found so far", Interrupt::what());
    return kFailed;
  }
  for (const auto& row : report.rows)  // of others it is not known what fails no more
    if (row.asked() > 0 && row.scenes_given_up == 0 && row.tally[question::Count::too_slow] == 0)
      ledger.end(row.name);
  ledger.finish(order.engine.name);
  return exit_status(report, ledger, options);
}

}  // namespace

Command judge_command() {
  auto options = std::make_shared<ExaminationOptions>();
  return {
      "judge",
      "Judges one engine: drawn and hard flights, golden sets, a campaign, speed; one verdict and its "
      "reasons.",
      options->rows({"--engine",        "--quick",    "--time",      "--questions",      "--seed",
                     "--jobs",          "--ulps",     "--precision", "--time-tolerance", "--domain",
                     "--starts-inside", "--timeout",  "--html",      "--golden",         "--json",
                     "--all",           "--baseline", "--junit",     "--times",          "--strict"}),

      "docs/judge.md says what is asked, what --timeout means without --questions, and what the verdict "
      "means. --jobs: threads of the campaign; all else is asked on one. --baseline and --junit need "
      "--questions. Exit status 1: an answer is wrong or missing, or a valid question was called an error;\n"
      "3: a cmd: or lib: engine broke, or was given up or too slow in a scene.\n"
      "Example:\n  lorentz judge --quick --engine 'cmd:python3 docs/examples/naive_engine.py'",
      [options] { return run_judge(*options); }};
}

}  // namespace lorentz::cli
