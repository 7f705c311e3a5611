// lorentz compare: compares engines, and answers logged elsewhere, with the oracle.
#include <limits>
#include <unordered_set>

#include <lorentz/exchange.hpp>
#include "cli/app.hpp"
#include "cli/given_queries.hpp"
#include "cli/lineup.hpp"
#include "cli/numbers.hpp"
#include "cli/output.hpp"
#include "cli/terminal.hpp"
#include "question/starts/varied_starts.hpp"
#include "report/claim_words.hpp"
#include "report/files/scene_file.hpp"
#include "report/files/signals.hpp"
#include "src/exchange/columns_csv.hpp"
#include "src/exchange/columns_npy.hpp"
#include "src/exchange/json_writer.hpp"

namespace lorentz::cli {

using namespace question;

namespace {

// Each scene at each radius, rounded to the engine's precision.
std::vector<Scene> scenes_named(const ExaminationOptions& options, NumberFormat precision) {
  std::vector<std::string> names = options.scenes;
  if (names.empty() && !options.queries) names = {"square"};
  if (names.empty() && !options.radii.empty())
    throw InputError("--radius: needs --scene (the scenes of a stream say their radii themselves)");
  std::vector<std::optional<std::string>> radii(options.radii.begin(), options.radii.end());
  if (radii.empty()) radii.emplace_back();
  std::vector<Scene> scenes;
  for (const std::string& name : names)
    for (const auto& radius : radii)
      scenes.push_back(rounded_scene(load_scene(name, positive_number(radius, "--radius"), options.strict),
                                     precision, name));
  if (options.queries && scenes.size() > 1) throw InputError("--scene: with --queries there is one at most");
  return scenes;
}

// The questions that the options specify, part by part, without answers.
class ComparedQuestions {
 public:
  // Throws InputError and FileError. The first scene is written at the beginning of the file of disagreements.
  // Scenes of a stream are used unchanged.
  ComparedQuestions(const ExaminationOptions& options, DisagreementFile& disagreements)
      : options_(options),
        claim_(options.claim.claim()),
        disagreements_(disagreements),
        named_(scenes_named(options, claim_.precision)) {
    std::optional<Scene> first;
    if (!named_.empty()) enter(*(first = named_[0]));
    if (options.queries) given_.emplace(*options.queries, first, options.strict);
  }

  // The next questions, at most `most`; empty at the end.
  std::vector<Question> next(std::size_t most) { return given_ ? read(most) : draw(most); }

  bool had_bad_input() const { return bad_ids_ || (given_ && given_->had_bad_input()); }
  std::size_t count() const { return count_; }
  std::size_t not_asked() const { return not_asked_; }  // because their numbers have another precision
  std::size_t outside_domain() const { return outside_domain_; }  // not asked, as the engine claims

  // The scene's name, or the number of scenes if there are several.
  std::string title() const {
    if (scenes_ > 1) return fmt::format("{} scenes", scenes_);
    const std::string name =
        !options_.scenes.empty() ? options_.scenes[0] : options_.queries.value_or("square");
    return options_.radii.empty()
               ? name
               : fmt::format("{} (radius {})", name, *positive_number(options_.radii[0], "--radius"));
  }

  // Takes out the questions that the engine is not asked because of their exact answers.
  void drop_outside(std::vector<Question>& questions) {
    const auto is_outside = [&](const Question& question) {
      if (question.place->takes(question.query, question.exact)) return false;
      pass_over(question, outside_domain_), --count_;
      return true;
    };
    std::erase_if(questions, is_outside);
  }

  // The questions since the last call that were not asked. Logged answers to them must be skipped.
  std::vector<Question> passed_over() { return std::exchange(passed_over_, {}); }

  // Whether the queries are columns, which need a scene. Rows of answers are matched to them by number.
  bool are_columns() const { return given_ && given_->are_columns(); }
  Components components() const { return Components(place_->scene()); }

 private:
  void enter(const Scene& scene) {
    place_ = std::make_shared<Place>(scene, claim_);
    disagreements_.begin(place_);
    is_new_ = true;
  }

  // Answers are matched by id, so the ids of queries must be unique.
  void add(std::vector<Question>& questions, const Query& query, const Id& id, double max_time) {
    if (!options_.answers.empty() && id != "null" && !ids_.insert(id).second) {
      bad_ids_ = true;
      say("the query id {} comes twice: answers cannot be matched to its queries", id);
    }
    const Question question{.place = place_, .query = query, .id = id, .max_time = max_time};
    if (!place_->has_numbers_for(query) || rounded(max_time, place_->claim().precision) != max_time)
      return pass_over(question, not_asked_);
    const bool is_limit_taken = claim_.domain.limits || !question.has_limit();
    if (!is_limit_taken || !place_->takes(query)) return pass_over(question, outside_domain_);
    scenes_ += std::exchange(is_new_, false);
    ++count_;
    questions.push_back(question);
  }

  void pass_over(const Question& question, std::size_t& count) {
    ++count;
    if (!options_.answers.empty()) passed_over_.push_back(question);
  }

  std::vector<Question> draw(std::size_t most) {
    std::vector<Question> questions;
    for (; scene_ < named_.size(); ++scene_, drawn_ = 0) {
      if (drawn_ == 0 && scene_ > 0) enter(named_[scene_]);
      if (drawn_ == 0) starts_.emplace(place_->scene(), options_.seed, claim_);
      for (; drawn_ < options_.count && questions.size() < most; ++drawn_) {
        const starts::VariedStart start = (*starts_)[drawn_];
        add(questions, start.query, std::to_string(number_++), start.max_time);
      }
      if (drawn_ < options_.count) break;
    }
    return questions;
  }

  std::vector<Question> read(std::size_t most) {
    std::vector<Question> questions;
    for (GivenQuery given; questions.size() < most && given_->next(given);) {
      if (given.new_scene && !(place_ && place_->scene() == *given_->scene())) enter(*given_->scene());
      if (given.query) add(questions, *given.query, given.id, given.max_time);
    }
    return questions;
  }

  const ExaminationOptions& options_;
  const Claim claim_;
  DisagreementFile& disagreements_;
  std::vector<Scene> named_;                    // the scenes of --scene and --radius
  std::size_t drawn_ = 0, scene_ = 0;           // queries of the current one of these; the next one
  std::size_t number_ = 0;                      // of queries drawn in all; their ids
  std::optional<starts::VariedStarts> starts_;  // in the current one
  std::optional<GivenQueries> given_;           // or drawn
  std::shared_ptr<Place> place_;
  bool is_new_ = false, bad_ids_ = false;
  std::vector<Question> passed_over_;
  std::size_t not_asked_ = 0, outside_domain_ = 0, count_ = 0, scenes_ = 0;
  std::unordered_set<Id> ids_;
};

// Median, 99 % quantile and largest value; null without values.
auto spread_of(const std::vector<double>& values) {
  const auto spread = [&values](json::Members& object) {
    object.add("median", quantile(values, 0.5), "p99", quantile(values, 0.99), "max", quantile(values, 1));
  };
  return values.empty() ? std::nullopt : std::optional(spread);
}

void add_tally(json::Members& object, const Tally& t, bool judged) {
  const auto if_timed = [&](double ulps) { return !t.ulps.empty() ? std::optional(ulps) : std::nullopt; };
  const auto if_fast = [&](double ns) { return t.speed.ns_per_query > 0 ? std::optional(ns) : std::nullopt; };
  object.add("engine", t.name, "queries", t.queries);
  add_counts(object, t.counts, Counted::examinations, judged);
  object.add("max_ulp", if_timed(t.max_ulp()), "mean_ulp", if_timed(t.mean_ulp()), "ns_per_query",
             if_fast(t.speed.ns_per_query), "ns_median", if_fast(t.speed.ns_median), "engine_ns",
             t.speed.own_ns, "wrong_time_ulps", spread_of(t.wrong_ulps), "wrong_time_conditions",
             spread_of(t.wrong_conditions));
}

std::string json_of(const ExaminationOptions& options, const ComparedQuestions& questions,
                    const std::list<LineupEntry>& all) {
  const auto judge = options.no_oracle ? std::nullopt : std::optional(std::string("oracle"));
  return json::line_of([&](json::Members& object) {
    object.add("scene", questions.title(), "seed", options.seed, "judge", judge);
    report::add_claim(object, options.claim.claim());
    object.add("not_asked", questions.not_asked(), "outside_domain", questions.outside_domain(), "engines",
               json::objects(all, [&](json::Members& one, const LineupEntry& its) {
                 add_tally(one, its.total(), judge.has_value());
               }));
  });
}

std::unique_ptr<LoggedAnswers> logged_in(const std::string& path, const ComparedQuestions& questions,
                                         bool strict) {
  if (!is_columns(path)) return std::make_unique<LoggedAnswers>(path, strict);
  if (!questions.are_columns())
    throw InputError("--answers: " + path +
                     ": its rows are matched by their numbers; --queries needs columns, too");
  if (path.ends_with(".npy"))
    return std::make_unique<LoggedAnswers>(read_npy_answers(path, questions.components().of_vectors()));
  return std::make_unique<LoggedAnswers>(std::make_unique<CsvAnswerReader>(path, questions.components()));
}

void add_logged(Lineup& lineup, const std::string& argument, const ComparedQuestions& questions,
                bool strict) {
  const auto equals = argument.find('=');
  if (equals == std::string::npos || equals == 0 || equals + 1 == argument.size())
    throw InputError("--answers: " + json_quoted(argument) + " is not NAME=FILE");
  lineup.add(argument.substr(0, equals), logged_in(argument.substr(equals + 1), questions, strict));
}

// The lines on questions that were not asked; empty if all were asked.
std::string not_asked_of(const ComparedQuestions& questions) {
  std::string text;
  if (const std::size_t count = questions.not_asked(); count > 0)
    text += fmt::format("{} more were not asked: their numbers are of another precision\n", count);
  if (const std::size_t count = questions.outside_domain(); count > 0)
    text += fmt::format("{} more were not asked: they are outside of the declared domain\n", count);
  return text;
}

std::string text_of(const ExaminationOptions& options, const ComparedQuestions& questions,
                    const std::list<LineupEntry>& all) {
  const bool drawn = !options.queries;
  std::string text = fmt::format(
      "{}: {} {} queries{}{}\n{}{}\n{}", questions.title(), questions.count(), drawn ? "drawn" : "given",
      drawn ? ", seed " + std::to_string(options.seed) : "", report::words_of(options.claim.claim()),
      drawn ? fmt::format("drawn: {}\n", starts::kVariedWords) : "", not_asked_of(questions),
      options.no_oracle ? times_of(all) : table_of(all));
  if (options.no_oracle) return text;
  for (const LineupEntry& one : all)
    text += fmt::format("\n{}\n{}{}", verdict_of(one.total()),
                        one.failures.empty() ? "" : "  The first failures:\n", fmt::join(one.failures, ""));
  return text;
}

// Asks part after part, so that memory does not grow with the number of queries. Returns the first questions,
// for the race.
std::vector<Question> examine_all(const ExaminationOptions& options, ComparedQuestions& questions,
                                  Lineup& lineup) {
  constexpr std::size_t kTogether = 10'000;
  std::vector<Question> first;
  lineup.begin(options.queries ? "given" : "drawn");
  for (AskedPart part; !(part.questions = questions.next(kTogether)).empty();) {
    answer_exactly(part.questions, terminal(), static_cast<int>(options.jobs));
    questions.drop_outside(part.questions);
    lineup.pass_over(questions.passed_over());
    lineup.ask(part);
    if (first.empty()) first = std::move(part.questions);
  }
  lineup.pass_over(questions.passed_over());
  lineup.end(true);
  return first;
}

// All questions, which are not judged.
std::vector<Question> all_to_time(ComparedQuestions& questions, Lineup& lineup) {
  std::vector<Question> all = questions.next(std::numeric_limits<std::size_t>::max());
  lineup.begin("timed");
  for (const LineupEntry& one : lineup.all()) one.row->tally.queries = all.size();
  return all;
}

int run_compare(ExaminationOptions options) {
  if (options.engines.empty() && options.answers.empty()) options.engines = {"classical", "published"};
  const std::vector<EngineInfo> engines = options.named_engines();
  if (!options.queries && !options.answers.empty())
    throw InputError("--answers needs --queries: the queries that were answered");
  if (options.no_oracle && (options.disagreements || options.files.first_option()))
    throw InputError(options.files.first_option().value_or("--disagreements") +
                     ": needs the oracle; leave --no-oracle out");
  options.claim.ask(engines, options.strict);
  Lineup lineup(options, engines);
  ComparedQuestions questions(options, lineup.disagreements());
  for (const std::string& argument : options.answers) add_logged(lineup, argument, questions, options.strict);
  lineup.race(options.no_oracle ? all_to_time(questions, lineup) : examine_all(options, questions, lineup));
  const int status = lineup.finish(questions.had_bad_input());
  print(options.json ? json_of(options, questions, lineup.all()) : text_of(options, questions, lineup.all()));
  return status;
}

}  // namespace

Command compare_command() {
  auto options = std::make_shared<ExaminationOptions>();
  return {
      "compare",
      "Engines, and answers that other programs logged, against the exact "
      "oracle: right or wrong, error, speed.",
      options->rows({"--engine",    "--answers",        "--scene",    "--radius",        "--queries",
                     "--jobs",      "--count",          "--seed",     "--disagreements", "--ulps",
                     "--precision", "--time-tolerance", "--domain",   "--starts-inside", "--no-oracle",
                     "--timeout",   "--json",           "--failures", "--times",         "--strict",
                     "--baseline",  "--junit"}),

      "wrong: another obstacle or outcome than any error of k ulps in the inputs explains. wrong time: the "
      "right obstacle,\nbut the time is off by more than k times what such errors make of it "
      "(docs/verdicts.md).\nErrors of t are in ulps from the correctly rounded time. Times are of the engine "
      "alone, on one thread, over the\nfirst 10 000 queries; of a cmd: engine by the wall, pipes included; "
      "of a lib: engine in its own calls.\nWithout --engine and --answers: classical and published. Exit "
      "status 1: an answer is wrong, an error or missing;\n3: a cmd: or lib: engine broke.\nExample:\n"
      "  lorentz compare --scene cubic --radius 0.2 --count 20000 --engine published,classical",
      [options] { return run_compare(*options); }};
}

}  // namespace lorentz::cli
