// Questions, their exact answers, and what comes of an engine's: judged, counted, raced.
#include "question/examination.hpp"

#include <algorithm>

#include <catch2/catch.hpp>

#include "question/race.hpp"
#include "question/starts/free_starts.hpp"
#include "tests/support/support.hpp"

using namespace lorentz;
using oracle::Verdict;
using question::Count, question::Place, question::Question, question::Tally;

TEST_CASE("A tally counts each verdict, and wrong times among those that agree", "[compare][examine]") {
  Tally tally;
  for (const Verdict verdict : {Verdict::agree, Verdict::ill_posed, Verdict::undecided, Verdict::unsupported,
                                Verdict::error, Verdict::missing, Verdict::wrong, Verdict::wrong})
    tally.count({verdict});
  tally.count({.verdict = Verdict::agree, .ulps = 9, .departs = 7, .wrong_time = true});
  CHECK(tally.queries == 9);
  for (const std::size_t once :
       {tally[Count::ill_posed], tally[Count::undecided], tally[Count::unsupported], tally[Count::error],
        tally[Count::missing], tally[Count::wrong_time], tally.ulps.size()})
    CHECK(once == 1);
  CHECK(tally[Count::wrong] == 2);
  CHECK(tally[Count::agree] == 2);
  CHECK(tally.wrong_ulps == std::vector<double>{9});
  CHECK(tally.wrong_conditions == std::vector<double>{7});
  Tally twice = tally;
  twice.add(tally);
  CHECK((twice.queries == 18 && twice[Count::agree] == 4 && twice[Count::wrong] == 4 &&
         twice[Count::wrong_time] == 2));
  CHECK((twice.ulps.size() == 2 && twice.mean_ulp() == 9 && twice.max_ulp() == 9));
  CHECK(twice.wrong_ulps == std::vector<double>{9, 9});
}

TEST_CASE("Quantiles: the value that a share does not exceed", "[compare][examine]") {
  CHECK(question::quantile({}, 0.5) == 0);
  CHECK(question::quantile({3, 1, 2}, 0.5) == 2);
  CHECK(question::quantile({3, 1, 2}, 0.99) == 3);
}

TEST_CASE("A tally's errors of times: the largest, the mean, and what a share of them does not exceed",
          "[compare][examine]") {
  Tally tally;
  CHECK(tally.mean_ulp() == 0);
  CHECK(question::quantile(tally.ulps, 0.5) == 0);
  for (const double ulps : {3, 10, 1, 2, 9, 4, 8, 5, 7, 6})
    tally.count({.verdict = Verdict::agree, .ulps = ulps});
  tally.count({Verdict::agree});  // without a time
  CHECK(tally.ulps.size() == 10);
  CHECK(tally.max_ulp() == 10);
  CHECK(tally.mean_ulp() == 5.5);
  CHECK(question::quantile(tally.ulps, 0) == 1);
  CHECK(question::quantile(tally.ulps, 0.3) == 4);    // the nearest to 2.7 steps up from the first
  CHECK(question::quantile(tally.ulps, 0.99) == 10);  // to 8.91
  CHECK(question::quantile(tally.ulps, 1) == 10);
}

TEST_CASE("Where no judge is needed the judgement is the judge's", "[compare][examine]") {
  const auto place = std::make_shared<Place>(unit_scene(2, 0.25));
  const Query outside{{0.5, 0.125}, {1, 0}, {}}, inside{{0.1, 0}, {1, 0}, {}}, never{{0.5, 0.5}, {1, 0}, {}};
  const oracle::Judge judge(place->scene());
  for (const Query& query : {outside, inside, never})
    for (const Answer& given :
         {place->exact(outside), place->exact(inside), place->exact(never), Answer::later(),
          Answer::undecided(), Answer::error("no"), Answer::inside({0, 0, {1, 0, 0}})}) {
      const Question question{.place = place, .query = query, .exact = place->exact(query)};
      const oracle::Judgement one = question::judgement_of(question, given, 4),
                              two = judge.judge(query, question.exact, given, 4);
      CHECK((one.verdict == two.verdict && one.ulps == two.ulps && one.departs == two.departs));
    }
  // By another rule `inside` is wrong, also where a logged truth says it.
  const auto other = std::make_shared<Place>(unit_scene(2, 0.25), Claim{.inside = StartInside::miss});
  const Answer logged = place->exact(inside);
  const Question asked{.place = other, .query = inside, .exact = logged};
  CHECK(question::judgement_of(asked, logged, 4).verdict == Verdict::wrong);
}

TEST_CASE("A limit is judged like a time, and in campaigns exactly", "[compare][examine]") {
  using oracle::Verdict, question::AtLimit;
  const auto place = std::make_shared<Place>(unit_scene(2, 0.25));
  Question question{.place = place, .query = {{0.5, 0.125}, {1, 0}, {}}};
  question.exact = place->exact(question.query);
  const double time = *question.exact.time, unit = 0x1p-54;
  const auto verdict = [&](double limit, const Answer& given, AtLimit at = AtLimit::excused,
                           double ulps = 4) {
    question.max_time = limit;
    return question::judgement_of(question, given, ulps, at).verdict;
  };
  const Answer later = Answer::later(), hit = question.exact;
  // The condition of the time is 8.6 (verdict_test.cpp), so 4 ulps of the inputs are 34 of the time.
  for (const AtLimit at : {AtLimit::excused, AtLimit::exact}) {
    CHECK(verdict(time - unit, later, at) == Verdict::agree);
    CHECK(verdict(time + 40 * unit, later, at) == Verdict::wrong);
    CHECK(verdict(time + 40 * unit, hit, at) == Verdict::agree);
    CHECK(verdict(0.1, Answer::hit({0, 0, {2, 0, 0}}, 1.28), at) == Verdict::wrong);
  }
  CHECK(verdict(time + 30 * unit, later) == Verdict::ill_posed);
  CHECK(verdict(time + 30 * unit, later, AtLimit::excused, 0) == Verdict::wrong);
  CHECK(verdict(time + 30 * unit, later, AtLimit::exact) == Verdict::wrong);
  CHECK(verdict(0.1, hit) == Verdict::agree);  // it says more than it was asked
  CHECK(verdict(0.1, hit, AtLimit::exact) == Verdict::wrong);
  // A tolerance without end is one of times, not of limits.
  question.place = std::make_shared<Place>(place->scene(), Claim{.time_tolerance = HUGE_VAL});
  CHECK(verdict(time + 30 * unit, later) == Verdict::ill_posed);
  CHECK(verdict(time + 40 * unit, later) == Verdict::wrong);
}

namespace {

// 20 questions of the square lattice and 20 of the cubic one, along diagonals.
std::vector<Question> diagonals() {
  std::vector<Question> questions;
  for (const int dimension : {2, 3}) {
    const auto place = std::make_shared<Place>(unit_scene(dimension, 0.25));
    const double z = dimension == 3 ? 1 : 0;
    const std::vector<Query> queries(20, Query{{0.5, 0.5, z / 2}, {1, 1, z}, {}});
    for (Question& question : question::questions_of(place, queries)) questions.push_back(question);
  }
  question::answer_exactly(questions);
  return questions;
}

// Answers what is exact but for every third question, which it misses; from the tenth on it was given up.
class Lazy final : public question::Answerer {
 public:
  void ask(const Id&, const Query& query) override { open_.push_back(query); }
  void drain() override {
    for (const Query& query : std::exchange(open_, {})) {
      ++asked_;
      Answer answer = asked_ % 3 == 0 ? Answer::never()
                                      : Answer::hit({0, 0, {1, 1, query.x[2] > 0 ? 1 : 0}},
                                                    0.5 - 0.25 / std::sqrt(query.x[2] > 0 ? 3 : 2));
      deliver({answer, asked_ < 10 ? question::Origin::engine : question::Origin::not_asked});
    }
  }
  std::vector<int> dimensions;

 private:
  void enter(const Scene& scene) override { dimensions.push_back(scene.dimension); }

  std::vector<Query> open_;
  int asked_ = 0;
};

// A library that answers nothing, and says of each round how many seconds it took.
class Clock final : public question::Answerer {
 public:
  explicit Clock(std::vector<double> rounds) : rounds_(std::move(rounds)) {}

  void ask(const Id&, const Query&) override {}
  void drain() override { seconds_ += rounds_.at(round_++); }
  std::optional<question::OwnTime> own_time() const override { return {{seconds_, 0}}; }

 private:
  void enter(const Scene&) override {}

  std::vector<double> rounds_;
  std::size_t round_ = 0;
  double seconds_ = 0;
};

}  // namespace

TEST_CASE("Answers that come late are judged with their own questions, and what was not asked is not",
          "[compare][examine]") {
  std::vector<Question> questions = diagonals();
  questions.insert(questions.begin(), questions[30]);  // so that the place changes, and changes back
  Lazy lazy;
  Tally tally;
  std::vector<std::string> ids;
  question::examine(question::all_of(questions), lazy, 4, [&](const question::Judged& judged) {
    tally.count(judged.judgement);
    ids.push_back(judged.question.id);
    CHECK(judged.reply.was_asked() == (ids.size() < 10));
    CHECK(question::departs(judged.judgement) == (ids.size() < 10 && ids.size() % 3 == 0));
  });
  CHECK(lazy.dimensions == std::vector<int>{3, 2, 3});
  CHECK((tally[Count::agree] == 6 && tally[Count::wrong] == 3 && tally[Count::missing] == 32 &&
         tally.queries == 41));
  CHECK((ids.size() == 41 && ids[0] == "10" && ids[1] == "0" && ids[40] == "19"));
}

TEST_CASE("The right answer to an invalid question is an error", "[compare][examine]") {
  const Question invalid{.place = std::make_shared<Place>(unit_scene(2, 0.25)), .text = R"("x":[0,0])"};
  const auto verdict = [&](const Answer& given) { return question::judgement_of(invalid, given, 4).verdict; };
  CHECK(verdict(Answer::error("no v")) == Verdict::agree);
  CHECK(verdict(Answer::unsupported_because("it has none")) == Verdict::unsupported);
  CHECK(verdict(Answer::undecided()) == Verdict::undecided);
  for (const Answer& valid : {Answer::never(), Answer::hit({}, 1), Answer::inside({})})
    CHECK(verdict(valid) == Verdict::wrong);
}

TEST_CASE("A race asks each engine the requested number of questions, in each round", "[compare][race]") {
  const std::vector<Question> questions = diagonals();
  const auto engines = question::engines_named({"oracle", "reduction", "batch", "walk"});
  question::RaceOptions options;
  options.rounds = 2;
  options.counts = {0, 17, 30, 99};
  std::map<std::string, std::size_t> asked;
  options.answerer.listener.progress = [&](const std::string& name, std::size_t done, std::size_t total) {
    if (done == total) asked[name] += done;
  };
  const std::vector<question::Speed> speeds = question::race(questions, engines, options);
  REQUIRE(speeds.size() == 4);
  const std::size_t counts[] = {0, 17, 30, 40};
  for (std::size_t i = 0; i < 4; ++i) {
    INFO(engines[i].name);
    CHECK(asked[engines[i].name] == 2 * counts[i]);
    for (const double ns : {speeds[i].ns_per_query, speeds[i].ns_median, speeds[i].ns_low, speeds[i].ns_high})
      CHECK((counts[i] > 0 ? ns > 0 : ns == 0));
  }
  options.rounds = 0;
  for (const question::Speed& speed : question::race(questions, engines, options))
    CHECK((speed.ns_per_query == 0 && !speed.failed));
}

TEST_CASE("A speed is that of the median round, whatever the order of the rounds", "[compare][race]") {
  const std::vector<Question> questions = diagonals();
  const question::EngineInfo library{.name = "clock", .kind = question::EngineInfo::Kind::library};
  question::RaceOptions options;
  options.rounds = 3;
  std::vector<double> rounds{1, 2, 4};
  do {
    Clock clock(rounds);
    options.running = {&clock};
    const std::vector<question::Speed> speeds = question::race(questions, {library}, options);
    REQUIRE(speeds.size() == 1);
    const double ns = 2e9 / static_cast<double>(questions.size());
    CHECK(speeds[0].ns_per_query == ns);
    CHECK((speeds[0].ns_low == ns && speeds[0].ns_median == ns && speeds[0].ns_high == ns));
  } while (std::next_permutation(rounds.begin(), rounds.end()));
}

TEST_CASE("Threads come to what one comes to, in the order of the questions", "[compare][examine]") {
  std::vector<Question> questions;
  for (const int dimension : {2, 3}) {
    const auto place = std::make_shared<Place>(unit_scene(dimension, 0.1));
    const auto queries = starts::free_starts(place->scene(), starts::Kind::grazing, 4712, 150);
    for (Question& question : question::questions_of(place, queries))
      questions.push_back(std::move(question));
  }
  std::vector<Question> alone = questions;
  question::answer_exactly(alone);
  const question::EngineInfo engine = question::engine_named("published");
  const auto run = [&](std::size_t jobs) {
    question::Examination examination(engine, {}, 4, jobs);
    std::string text;
    examination.ask(alone, [&](const question::Judged& judged) {
      append_answer_line(text, judged.question.id, judged.reply.answer, 3);
      text += std::to_string(static_cast<int>(judged.judgement.verdict));
    });
    return text;
  };
  const std::string one = run(1);
  for (const int jobs : {2, 3, 64, 301}) {
    INFO(jobs);
    std::vector<Question> together = questions;
    question::answer_exactly(together, {}, jobs);
    for (std::size_t i = 0; i < questions.size(); ++i) CHECK(test::same(alone[i].exact, together[i].exact));
    CHECK(run(static_cast<std::size_t>(jobs)) == one);
  }
}
