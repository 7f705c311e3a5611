// lorentz compare: engines, and answers logged elsewhere, against the oracle.
#include <map>
#include <unordered_map>
#include <unordered_set>

#include <lorentz/exchange.hpp>
#include "cli/app.hpp"
#include "cli/compare_table.hpp"
#include "cli/disagreement_file.hpp"
#include "cli/exit_status.hpp"
#include "cli/messages.hpp"
#include "cli/query_stream.hpp"
#include "cli/reason.hpp"
#include "cli/scene_option.hpp"
#include "cli/terminal.hpp"
#include "compare/measure.hpp"
#include "compare/sampling.hpp"
#include "src/exchange/json_writer.hpp"

namespace lorentz::cli {

using namespace compare;

namespace {

constexpr int kRounds = 5;

struct Options {
  std::vector<std::string> engines, answers;
  std::optional<std::string> scene, queries, disagreements;
  std::optional<double> radius, ulps, timeout;
  std::uint64_t count = 10'000, seed = kDefaultSeed, failures = 3;
  std::string judge = "oracle";
  bool json = false, strict = false, times = false, no_oracle = false;
};

UnknownKeys unknown_keys(const Options& options) {
  return options.strict ? UnknownKeys::errors : UnknownKeys::warned;
}

CaseSet read_cases(const std::string& path, std::optional<Scene> initial, UnknownKeys unknown,
                   bool& bad_input) {
  CaseSet set;
  if (initial) set.scenes.push_back(*initial);
  QueryStream stream(path, std::move(initial), unknown);
  for (StreamItem item; stream.next(item);) {
    if (item.kind == StreamItem::Kind::scene) set.scenes.push_back(item.scene);
    if (item.kind == StreamItem::Kind::query)
      set.cases.push_back({item.id, set.scenes.size() - 1, item.query});
  }
  bad_input |= stream.had_bad_input();
  return set;
}

CaseSet draw_cases(const Scene& scene, std::uint64_t seed, std::size_t count) {
  CaseSet set;
  set.scenes.push_back(scene);
  const auto queries = draw_queries(scene, oracle::Oracle(scene), seed, count, terminal());
  for (std::size_t i = 0; i < queries.size(); ++i) set.cases.push_back({std::to_string(i), 0, queries[i]});
  return set;
}

struct LoggedAnswer {
  Answer answer;
  std::size_t components = 0;  // of its cell
  std::size_t line = 0;
};

using Answers = std::unordered_map<Id, LoggedAnswer>;

// A logged answer stream, by id. Bad lines and ids that come twice are complained of; answers without an id
// (to lines that were no queries) are passed over.
Answers read_answers(const std::string& path, UnknownKeys unknown, bool& bad_input) {
  Answers answers;
  LineReader lines(path);
  ExchangeReader reader;
  KeyCheck keys(path, unknown);
  reader.on_unknown_key([&](const std::string& key) { keys(key); });
  Id id;
  LoggedAnswer logged;
  bool empty = true;
  for (LineReader::Line line; lines.next(line);) {
    keys.line = line.number;
    try {
      if (!reader.read_answer_line(line, id, logged.answer, logged.components)) continue;
      empty = false;
      logged.line = line.number;
      if (id != "null" && !answers.emplace(id, logged).second)
        throw InputError("the id " + id + " came before; an answer stream has one answer a query");
    } catch (const InputError& error) {
      empty = false;
      bad_input = true;
      say("{}:{}: {}", path, line.number, error.what());
    }
  }
  if (empty) {
    bad_input = true;
    say("{}: is empty: no answer in it", path);
  }
  return answers;
}

// Answers are matched by id, so the queries' must be unique, and the answers' must be among them.
void check_ids(const CaseSet& set, bool& bad_input) {
  std::unordered_set<Id> ids;
  for (const Case& one : set.cases)
    if (one.id != "null" && !ids.insert(one.id).second) {
      bad_input = true;
      say("the query id {} comes twice: answers cannot be matched to its queries", one.id);
    }
}

struct Logged {
  std::string name, file;
};

Tally judge_logged(const Logged& logged, const Answers& answers, const CaseSet& set,
                   const std::vector<Answer>& exact, const OnWrong& on_wrong, double ulps, bool& bad_input) {
  Tally tally;
  tally.name = logged.name;
  std::vector<oracle::Judge> judges;
  for (const Scene& scene : set.scenes) judges.emplace_back(scene);
  for (std::size_t i = 0; i < set.cases.size(); ++i) {
    const auto found = answers.find(set.cases[i].id);
    if (found == answers.end()) {
      tally.count(oracle::Judgement{});
      continue;
    }
    const auto& [answer, components, line] = found->second;
    const int dimension = set.scenes[set.cases[i].scene].dimension;
    if (components != 0 && components != static_cast<std::size_t>(dimension)) {
      bad_input = true;
      say("{}:{}: cell: has {} components, the scene has dimension {}", logged.file, line, components,
          dimension);
      tally.count({oracle::Verdict::error});
      continue;
    }
    const oracle::Judgement judgement =
        judges[set.cases[i].scene].judge(set.cases[i].query, exact[i], answer, ulps);
    tally.count(judgement);
    if (departs(judgement)) on_wrong(set.cases[i], exact[i], logged.name, answer, judgement);
  }
  return tally;
}

// Says what did not match; nothing matched at all is bad input, the wrong file most likely.
void check_matches(const std::string& file, const Tally& tally, std::size_t answers, bool& bad_input) {
  const std::size_t matched = tally.queries - tally.missing;
  if (answers > matched) say("{}: {} answers have an id that no query has", file, answers - matched);
  if (matched == 0 && answers > 0) {
    bad_input = true;
    say("{}: no answer matches any query; is it the right file?", file);
  }
}

// Median, 99 % and largest; null of nothing.
auto spread_of(const std::vector<double>& values) {
  const auto spread = [&values](json::Members& object) {
    object.add("median", quantile(values, 0.5), "p99", quantile(values, 0.99), "max", quantile(values, 1));
  };
  return values.empty() ? std::nullopt : std::optional(spread);
}

void add_tally(json::Members& object, const Tally& t, bool judged) {
  const auto count = [&](std::size_t n) { return judged ? std::optional(n) : std::nullopt; };
  const auto if_timed = [&](double ulps) { return t.timed_hits > 0 ? std::optional(ulps) : std::nullopt; };
  const auto if_fast = [&](double ns) { return t.ns_per_query > 0 ? std::optional(ns) : std::nullopt; };
  object.add("engine", t.name, "queries", t.queries, "agree", count(t.agree), "ill_posed", count(t.ill_posed),
             "wrong", count(t.wrong), "undecided", count(t.undecided), "unsupported", count(t.unsupported),
             "error", count(t.error), "missing", count(t.missing));
  object.add("max_ulp", if_timed(t.max_ulp), "mean_ulp", if_timed(t.mean_ulp()), "ns_per_query",
             if_fast(t.ns_per_query), "ns_median", if_fast(t.ns_median), "wrong_time", count(t.wrong_time),
             "wrong_time_ulps", spread_of(t.wrong_ulps), "wrong_time_conditions",
             spread_of(t.wrong_conditions));
}

std::string json_of(const std::string& scene, const std::string& seed, const std::vector<Tally>& tallies,
                    const std::optional<std::string>& judge) {
  return json::line_of([&](json::Members& object) {
    object.add("scene", scene, "seed", json::Raw{seed}, "judge", judge, "engines",
               json::objects(tallies, [&](json::Members& one, const Tally& tally) {
                 add_tally(one, tally, judge.has_value());
               }));
  });
}

std::vector<Logged> logged_answers(const Options& options) {
  std::vector<Logged> all;
  for (const std::string& argument : options.answers) {
    const auto equals = argument.find('=');
    if (equals == std::string::npos || equals == 0 || equals + 1 == argument.size())
      throw InputError("--answers: " + json_quoted(argument) + " is not NAME=FILE");
    all.push_back({argument.substr(0, equals), argument.substr(equals + 1)});
  }
  return all;
}

// The scene's name for the heading; the number of scenes if a file has several.
std::string title(const Options& options, const CaseSet& set) {
  std::unordered_set<std::size_t> used;
  for (const Case& one : set.cases) used.insert(one.scene);
  if (used.size() > 1) return fmt::format("{} scenes", used.size());
  const std::string name = options.scene.value_or(options.queries.value_or("square"));
  return options.radius ? fmt::format("{} (radius {})", name, *options.radius) : name;
}

int exit_status(const std::vector<Tally>& tallies, const Options& options, bool bad_input) {
  for (const Tally& t : tallies)
    if (t.failed) return kFailed;
  if (bad_input) return kBadInput;
  for (const Tally& t : tallies)
    if (t.wrong > 0 || (options.times && t.wrong_time > 0) ||
        (options.strict && t.ill_posed + t.undecided + t.error + t.missing > 0))
      return kDisagreement;
  return kDone;
}

// What departs from the exact answers: to the file, and the first wrong ones of each engine for people.
class Departures {
 public:
  Departures(const Options& options, const CaseSet& set)
      : times_(options.times),
        is_json_(options.json),
        most_(static_cast<std::size_t>(options.failures)),
        set_(set),
        file_(options.disagreements) {
    file_.begin(set);
  }

  void add(const Case& one, const Answer& exact, const std::string& name, const Answer& given,
           const oracle::Judgement& judgement) {
    if (judgement.wrong_time && !times_) return;
    file_.add(one, exact, name, given, judgement);
    if (judgement.verdict != oracle::Verdict::wrong || is_json_ || listed_[name]++ >= most_) return;
    const Scene& scene = set_.scenes[one.scene];
    text_[name] +=
        description(one, exact, given, scene) +
        reason_of(oracle::Margins(scene), scene, one.query, exact, given, judgement.obstacle, "    ");
  }

  /// The first wrong answers of an engine, for people; empty if there are none.
  std::string text_of(const std::string& name) const {
    const auto found = text_.find(name);
    return found == text_.end() ? "" : found->second;
  }
  void close() { file_.close(); }

 private:
  static std::string description(const Case& one, const Answer& exact, const Answer& given,
                                 const Scene& scene) {
    std::string query, truth, says;
    append_query_line(query, one.id, one.query, scene.dimension);
    append_answer_line(truth, one.id, exact, scene.dimension);
    append_answer_line(says, one.id, given, scene.dimension);
    return fmt::format("  {}    says  {}    truth {}", query, says, truth);
  }

  const bool times_, is_json_;
  const std::size_t most_;
  const CaseSet& set_;
  DisagreementFile file_;
  std::map<std::string, std::size_t> listed_;
  std::map<std::string, std::string> text_;
};

// The cases that were asked for: drawn, or read from a stream.
CaseSet cases_of(const Options& options, std::uint64_t seed, bool& bad_input) {
  std::optional<Scene> scene;
  if (options.scene || !options.queries)
    scene = load_scene(options.scene.value_or("square"), options.radius, unknown_keys(options));
  else if (options.radius)
    throw InputError("--radius: needs --scene (the scenes of a stream say their radii themselves)");
  return options.queries ? read_cases(*options.queries, scene, unknown_keys(options), bad_input)
                         : draw_cases(*scene, seed, options.count);
}

void show(const Options& options, const CaseSet& set, std::uint64_t seed, const std::vector<Tally>& tallies,
          const Departures& departures) {
  const std::string seed_text = std::to_string(seed);
  if (options.json) {
    print(json_of(title(options, set), seed <= 1ull << 53 ? seed_text : json_quoted(seed_text), tallies,
                  options.no_oracle ? std::nullopt : std::optional(options.judge)));
    return;
  }
  const bool drawn = !options.queries;
  print(fmt::format("{}: {} {} queries{}{}\n\n{}", title(options, set), set.cases.size(),
                    drawn ? "drawn" : "given", drawn ? ", seed " + seed_text : "",
                    options.judge == "oracle" ? "" : ", judged by " + options.judge,
                    table_of(tallies, !options.no_oracle)));
  if (options.no_oracle) return;
  for (const Tally& t : tallies) {
    const std::string text = departures.text_of(t.name);
    print(fmt::format("\n{}\n{}{}", verdict_of(t), text.empty() ? "" : "  The first wrong answers:\n", text));
  }
}

int act(const Options& options) {
  const std::vector<Logged> all_logged = logged_answers(options);
  std::vector<EngineInfo> engines = engines_named(options.engines);
  if (engines.empty() && all_logged.empty()) engines = engines_named({"classical", "published"});
  const Truth truth = truth_named(options.judge, engines);
  if (options.no_oracle && truth != Truth::oracle)
    throw InputError("--judge: nobody is judged with --no-oracle");
  if (options.no_oracle && !all_logged.empty())
    throw InputError("--answers needs the oracle; leave --no-oracle out");
  if (!options.queries && !all_logged.empty())
    throw InputError("--answers needs --queries: the queries that were answered");
  const double timeout = options.timeout.value_or(AnswererOptions::kDefaultTimeout);

  const double ulps = options.ulps.value_or(oracle::kDefaultUlps);
  bool bad_input = false;
  const CaseSet set = cases_of(options, options.seed, bad_input);
  if (!all_logged.empty()) check_ids(set, bad_input);
  Departures departures(options, set);
  const OnWrong on_wrong = [&](const Case& one, const Answer& exact, const std::string& name,
                               const Answer& given, const oracle::Judgement& judgement) {
    departures.add(one, exact, name, given, judgement);
  };
  const std::vector<Answer> exact =
      options.no_oracle ? std::vector<Answer>{} : exact_answers(set, terminal(), truth);
  std::vector<Tally> tallies =
      measure(set, exact, engines, on_wrong, {ulps, kRounds, timeout, terminal(), options.strict});
  for (const Logged& logged : all_logged) {
    const Answers answers = read_answers(logged.file, unknown_keys(options), bad_input);
    tallies.push_back(judge_logged(logged, answers, set, exact, on_wrong, ulps, bad_input));
    check_matches(logged.file, tallies.back(), answers.size(), bad_input);
  }
  departures.close();
  show(options, set, options.seed, tallies, departures);
  return exit_status(tallies, options, bad_input);
}

}  // namespace

Command compare_command() {
  auto options = std::make_shared<Options>();
  return {
      "compare",
      "Engines, and answers that other programs logged, against the exact "
      "oracle: right or wrong, error, speed.",
      {
          {"-e,--engine", &options->engines, "ENGINE",
           names_for_help() +
               "; several with commas between them, or once each (default: classical,published)"},
          {"--answers", &options->answers, "NAME=FILE",
           "judge an answer stream that some program wrote, as an engine NAME"},
          {"--scene", &options->scene, "SCENE", "a scene file, or a name of the catalogue (default: square)"},
          {"--radius", Positive{&options->radius}, "R", "radius of every ball of --scene"},
          {"--queries", &options->queries, "FILE",
           "query stream (NDJSON) instead of drawn queries; - is standard input", kPlain, "--count"},
          {"--count", Whole{&options->count, 0, 1'000'000'000}, "N", "how many queries to draw", kPlain,
           "--queries"},
          {"--seed", Whole{&options->seed}, "N", "of the drawn queries"},
          {"--disagreements", &options->disagreements, "FILE",
           "write each wrong or ill-posed answer there (--times: and wrong time), as a query stream",
           kOutput},
          {"--ulps", Tolerance{&options->ulps}, "K",
           "the tolerance k: answers that k ulps in every input would make right are ill-posed, not wrong "
           "(default: 4)"},
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
      "thread; "
      "of a cmd: engine by the wall, pipes included."
      "\nExample:\n  lorentz compare --scene cubic --radius 0.2 --count 20000 --engine published,classical",
      [options] { return act(*options); }};
}

}  // namespace lorentz::cli
