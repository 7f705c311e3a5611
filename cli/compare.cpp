// lorentz compare: compares engines, and answers logged elsewhere, with the oracle.
#include <algorithm>

#include <lorentz/exchange.hpp>
#include "cli/app.hpp"
#include "cli/compare_questions.hpp"
#include "cli/compare_table.hpp"
#include "cli/disagreement_file.hpp"
#include "cli/help_texts.hpp"
#include "cli/logged_answers.hpp"
#include "cli/output.hpp"
#include "cli/terminal.hpp"
#include "files/signals.hpp"
#include "question/examine.hpp"
#include "question/race.hpp"
#include "report/claim_words.hpp"
#include "report/reason.hpp"
#include "src/exchange/columns_csv.hpp"
#include "src/exchange/columns_npy.hpp"
#include "src/exchange/json_writer.hpp"

namespace lorentz::cli {

using namespace question;

namespace {

// Median, 99 % quantile and largest value; null without values.
auto spread_of(const std::vector<double>& values) {
  const auto spread = [&values](json::Members& object) {
    object.add("median", quantile(values, 0.5), "p99", quantile(values, 0.99), "max", quantile(values, 1));
  };
  return values.empty() ? std::nullopt : std::optional(spread);
}

void add_tally(json::Members& object, const Tally& t, bool judged) {
  const auto if_timed = [&](double ulps) { return t.timed_hits > 0 ? std::optional(ulps) : std::nullopt; };
  const auto if_fast = [&](double ns) { return t.speed.ns_per_query > 0 ? std::optional(ns) : std::nullopt; };
  object.add("engine", t.name, "queries", t.queries);
  add_counts(object, t.counts, Counted::examinations, judged);
  object.add("max_ulp", if_timed(t.max_ulp()), "mean_ulp", if_timed(t.mean_ulp()), "ns_per_query",
             if_fast(t.speed.ns_per_query), "ns_median", if_fast(t.speed.ns_median), "engine_ns",
             t.speed.own_ns, "wrong_time_ulps", spread_of(t.wrong_ulps), "wrong_time_conditions",
             spread_of(t.wrong_conditions));
}

std::string json_of(const std::string& scene, const CompareOptions& options, std::size_t not_asked,
                    const std::vector<Tally>& tallies) {
  const Claim claim = options.claim.claim();
  const auto judge = options.no_oracle ? std::nullopt : std::optional(options.judge);
  return json::line_of([&](json::Members& object) {
    object.add("scene", scene, "seed", options.seed, "judge", judge);
    report::add_claim(object, claim);
    object.add("not_asked", not_asked, "engines",
               json::objects(tallies, [&](json::Members& one, const Tally& tally) {
                 add_tally(one, tally, judge.has_value());
               }));
  });
}

// An engine or a file of answers that is compared.
struct Compared {
  std::string name;
  std::vector<std::unique_ptr<Answerer>> answerers;  // one per thread
  std::optional<EngineInfo> engine = {};             // either this
  LoggedAnswers* logged = nullptr;                   // or this: then it is the answerer
  Tally tally = {};
  std::vector<std::string> wrong = {};  // the first wrong answers, for people
};

std::unique_ptr<LoggedAnswers> logged_in(const std::string& path, const ComparedQuestions& questions,
                                         UnknownKeys unknown) {
  if (!is_columns(path)) return std::make_unique<LoggedAnswers>(path, unknown);
  if (!questions.are_columns())
    throw InputError("--answers: " + path +
                     ": its rows are matched by their numbers; --queries needs columns, too");
  if (path.ends_with(".npy"))
    return std::make_unique<LoggedAnswers>(read_npy_answers(path, questions.dimension()));
  return std::make_unique<LoggedAnswers>(std::make_unique<CsvAnswerReader>(path, questions.components()));
}

Compared logged_answers(const std::string& argument, const ComparedQuestions& questions,
                        UnknownKeys unknown) {
  const auto equals = argument.find('=');
  if (equals == std::string::npos || equals == 0 || equals + 1 == argument.size())
    throw InputError("--answers: " + json_quoted(argument) + " is not NAME=FILE");
  auto logged = logged_in(argument.substr(equals + 1), questions, unknown);
  Compared one{argument.substr(0, equals), {}, {}, logged.get()};
  one.answerers.push_back(std::move(logged));
  return one;
}

// The heading: the scene's name, or the number of scenes if a file has several.
std::string title(const CompareOptions& options, const ComparedQuestions& questions) {
  if (questions.scenes() > 1) return fmt::format("{} scenes", questions.scenes());
  const std::string name = options.scene.value_or(options.queries.value_or("square"));
  return options.radius ? fmt::format("{} (radius {})", name, *options.radius) : name;
}

int exit_status(const std::vector<Tally>& tallies, const CompareOptions& options, bool bad_input) {
  for (const Tally& t : tallies)
    if (t.failed) return kFailed;
  if (bad_input) return kBadInput;
  for (const Tally& t : tallies)
    if (t[Count::wrong] > 0 || (options.times && t[Count::wrong_time] > 0) ||
        (options.strict &&
         t.counts.sum({Count::ill_posed, Count::undecided, Count::error, Count::missing}) > 0))
      return kDisagreement;
  return kDone;
}

std::string description(const Judged& judged) {
  const Question& question = judged.question;
  const Scene& scene = question.place->scene();
  std::string query, truth, says;
  append_query_line(query, question.id, question.query, scene);
  append_answer_line(truth, question.id, question.exact, scene);
  append_answer_line(says, question.id, judged.reply.answer, scene);
  return fmt::format("  {}    says  {}    truth {}{}", query, says, truth,
                     report::reason_of(question.place->margins(), scene, question.query, question.exact,
                                       judged.reply.answer, judged.judgement.obstacle, "    "));
}

// The line on questions that were not asked; empty if all were asked.
std::string not_asked_of(const ComparedQuestions& questions) {
  const std::size_t count = questions.not_asked();
  return count == 0 ? ""
                    : fmt::format("{} more were not asked: their numbers are of another precision\n", count);
}

void show(const CompareOptions& options, const ComparedQuestions& questions,
          const std::vector<Tally>& tallies, const std::vector<Compared>& compared) {
  if (options.json) {
    print(json_of(title(options, questions), options, questions.not_asked(), tallies));
    return;
  }
  const bool drawn = !options.queries;
  print(fmt::format("{}: {} {} queries{}{}{}\n{}\n{}", title(options, questions), questions.count(),
                    drawn ? "drawn" : "given", drawn ? ", seed " + std::to_string(options.seed) : "",
                    options.judge == "oracle" ? "" : ", judged by " + options.judge,
                    report::words_of(options.claim.claim()), not_asked_of(questions),
                    table_of(tallies, !options.no_oracle)));
  if (options.no_oracle) return;
  for (std::size_t i = 0; i < tallies.size(); ++i) {
    const std::vector<std::string>& wrong = compared[i].wrong;
    print(fmt::format("\n{}\n{}{}", verdict_of(tallies[i]),
                      wrong.empty() ? "" : "  The first wrong answers:\n", fmt::join(wrong, "")));
  }
}

void check(const CompareOptions& options, const std::vector<EngineInfo>& engines) {
  const Truth truth = truth_named(options.judge, engines);
  if (options.no_oracle && truth != Truth::oracle)
    throw InputError("--judge: has no effect with --no-oracle; leave one of them out");
  if (options.no_oracle && !options.answers.empty())
    throw InputError("--answers needs the oracle; leave --no-oracle out");
  if (!options.queries && !options.answers.empty())
    throw InputError("--answers needs --queries: the queries that were answered");
}

std::vector<Compared> all_compared(const CompareOptions& options, const std::vector<EngineInfo>& engines,
                                   const ComparedQuestions& questions) {
  const AnswererOptions answerer{
      {}, options.timeout.value_or(AnswererOptions::kDefaultTimeout), terminal(), options.strict};
  std::vector<Compared> all;
  for (const EngineInfo& engine : engines) {
    Compared& one = all.emplace_back(Compared{engine.name, {}, engine});
    for (std::uint64_t job = 0; job < (engine.is_own() ? options.jobs : 1); ++job)
      one.answerers.push_back(engine.answerer(answerer));
  }
  for (const std::string& argument : options.answers)
    all.push_back(logged_answers(argument, questions, options.unknown_keys()));
  for (Compared& one : all) one.tally.name = one.name;
  return all;
}

// Skips the logged answers to these questions, so that the files stay in step with the questions.
void pass_over(const std::vector<Question>& questions, std::vector<Compared>& compared) {
  for (Compared& one : compared)
    if (one.logged) ask_all(all_of(questions), *one.answerers[0], [](const Question&, Reply&) {});
}

// Judges some questions: all answers that differ from the exact ones go to the file, the first wrong ones are described
// for people.
void examine_part(const CompareOptions& options, std::vector<Question>& questions,
                  std::vector<Compared>& compared, DisagreementFile& file) {
  const double ulps = options.ulps.value_or(oracle::kDefaultUlps);
  answer_exactly(questions, truth_named(options.judge, {}), terminal(), static_cast<int>(options.jobs));
  for (Compared& one : compared)
    examine(questions, one.answerers, ulps, [&](const Judged& judged) {
      const oracle::Judgement& judgement = judged.judgement;
      one.tally.count(judgement);
      if (!departs(judgement) || (judgement.wrong_time && !options.times)) return;
      file.add(judged, one.name);
      if (judgement.verdict == oracle::Verdict::wrong && !options.json && one.wrong.size() < options.failures)
        one.wrong.push_back(description(judged));
    });
}

// Asks part after part, so that memory does not grow with the number of queries. Returns the first questions,
// for the race.
std::vector<Question> examine_all(const CompareOptions& options, ComparedQuestions& questions,
                                  std::vector<Compared>& compared, DisagreementFile& file) {
  constexpr std::size_t kTogether = 10'000;
  std::vector<Question> first, some;
  while (!(some = questions.next(kTogether)).empty()) {
    pass_over(questions.passed_over(), compared);
    if (!options.no_oracle) examine_part(options, some, compared, file);
    if (first.empty() || options.no_oracle)
      first.insert(first.end(), std::make_move_iterator(some.begin()), std::make_move_iterator(some.end()));
  }
  pass_over(questions.passed_over(), compared);
  return first;
}

// Measures the speeds of the engines that did not fail.
void race_all(const CompareOptions& options, const std::vector<Question>& questions,
              std::vector<Compared>& compared) {
  RaceOptions race_options;
  std::vector<EngineInfo> engines;
  std::vector<Tally*> tallies;
  for (Compared& one : compared)
    if (one.engine && !one.answerers[0]->failed()) {
      engines.push_back(*one.engine), tallies.push_back(&one.tally);
      race_options.running.push_back(one.answerers[0].get());
    }
  race_options.answerer.timeout = options.timeout.value_or(AnswererOptions::kDefaultTimeout);
  race_options.answerer.listener = terminal();
  race_options.answerer.strict = options.strict;
  const std::vector<Speed> speeds = race(questions, engines, race_options);
  for (std::size_t i = 0; i < speeds.size(); ++i) {
    tallies[i]->speed = speeds[i];
    if (options.no_oracle) tallies[i]->queries = questions.size();
  }
}

int act(CompareOptions options) {
  std::vector<EngineInfo> engines = engines_named(options.engines, options.timeout);
  if (engines.empty() && options.answers.empty()) engines = engines_named({"classical", "published"});
  check(options, engines);
  options.claim.ask(engines);
  DisagreementFile file(options.disagreements);
  ComparedQuestions questions(options, file);
  std::vector<Compared> compared = all_compared(options, engines, questions);
  const std::vector<Question> first = examine_all(options, questions, compared, file);
  race_all(options, first, compared);
  bool bad_input = questions.had_bad_input();
  for (Compared& one : compared) {
    for (const auto& answerer : one.answerers) answerer->finish();
    one.tally.failed = one.answerers[0]->failed();
    if (const auto time = one.answerers[0]->own_time()) one.tally.speed.own_ns = time->ns_per_query();
    bad_input |= one.logged && one.logged->had_bad_input();
  }
  file.close();
  std::vector<Tally> tallies;
  for (Compared& one : compared) tallies.push_back(std::move(one.tally));
  show(options, questions, tallies, compared);
  return exit_status(tallies, options, bad_input);
}

}  // namespace

Command compare_command() {
  auto options = std::make_shared<CompareOptions>();
  return {
      "compare",
      "Engines, and answers that other programs logged, against the exact "
      "oracle: right or wrong, error, speed.",
      {
          {"-e,--engine", &options->engines, "ENGINE",
           names_for_help() +
               "; several with commas between them, or once each (default: classical,published)"},
          {"--answers", &options->answers, "NAME=FILE",
           "judge answers that some program wrote, as an engine NAME: a stream; or columns (.npy, .csv), "
           "to queries in columns"},
          {"--scene", &options->scene, "SCENE", "a scene file, or a name of the catalogue (default: square)"},
          {"--radius", Positive{&options->radius}, "R", "radius of every ball of --scene"},
          {"--queries", &options->queries, "FILE",
           "queries instead of drawn ones: a stream (NDJSON), - is standard input, or columns (.npy, .csv; "
           "docs/formats.md), which need --scene",
           kPlain, "--count"},
          {"--jobs", Whole{&options->jobs, 1, 1024}, "N",
           "threads, of the exact answers and of engines of this program: the same results; times are of "
           "one"},
          {"--count", Whole{&options->count, 0, 1'000'000'000}, "N", "how many queries to draw", kPlain,
           "--queries"},
          {"--seed", Whole{&options->seed}, "N", "of the drawn queries"},
          {"--disagreements", &options->disagreements, "FILE",
           "write each wrong or ill-posed answer there (--times: and wrong time), as a query stream",
           kOutput},
          {"--ulps", Tolerance{&options->ulps}, "K",
           "the tolerance k: answers that k ulps in every input would make right are ill-posed, not wrong "
           "(default: 4)"},
          options->claim.precision_row(),
          options->claim.time_tolerance_row(),
          {"--judge", &options->judge, "oracle|certified", kJudgeHelp},
          {"--timeout", Positive{&options->timeout}, "SECONDS", kTimeoutHelp},
          {"--json", &options->json, "", "one JSON object instead of a table"},
          {"--failures", Whole{&options->failures, 0, 1'000'000}, "N",
           "show at most N wrong answers of each engine"},
          {"--times", &options->times, "", "wrong times count: exit status 1, and in --disagreements"},
          {"--strict", &options->strict, "",
           "exit status 1 also for ill-posed, undecided, missing answers and errors; unknown keys are "
           "errors"},
          {"--no-oracle", &options->no_oracle, "", "only take times, judge nothing"},
      },

      "wrong: another obstacle or outcome than any error of k ulps in the inputs explains. wrong time: the "
      "right obstacle,\n"
      "but the time is off by more than k times what such errors make of it (docs/verdicts.md).\n"
      "Errors of t are in ulps from the correctly rounded time. Times are of the engine alone, on one "
      "thread, over the\nfirst 10 000 queries; of a cmd: engine by the wall, pipes included; of a lib: "
      "engine in its own calls.\n"
      "Example:\n  lorentz compare --scene cubic --radius 0.2 --count 20000 --engine published,classical",
      [options] { return act(*options); }};
}

}  // namespace lorentz::cli
