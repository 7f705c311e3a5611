// What sets failing questions apart: each property in its own sentence, though a few answers are foreign; two faults
// with one cause; what is given in place of the time; and what to do about it.
#include <catch2/catch.hpp>

#include <fstream>
#include <set>

#include "judge/findings.hpp"
#include "judge/results.hpp"
#include "tests/support/command_line.hpp"

using namespace lorentz;
using namespace lorentz::judge;
using lorentz::test::contains;

namespace {

using Change = std::function<void(Features&)>;

std::vector<Features> alike(
    std::size_t number, const Change& change = [](Features&) {}) {
  Features plain;
  plain.is_unit_speed = true;
  plain.start_gap = 3, plain.centre = 1, plain.time = 2, plain.flight = 2, plain.speed = 1, plain.depth = 0.5;
  plain.chord = 0.4, plain.coordinates = 0.5;
  change(plain);
  return std::vector<Features>(number, plain);
}

std::string told(
    const Change& of_failing, const Change& of_right = [](Features&) {}) {
  const auto its = circumstance_of(alike(20, of_failing), alike(100, of_right));
  return its ? its->text : "";
}

Question asked(const Scene& scene, const Vec& x, const Vec& v, double max_time = INFINITY) {
  const auto place = std::make_shared<Place>(scene);
  Question question{.place = place, .query = {x, v, {}}, .where = "here"};
  question.exact = place->exact(question.query);
  question.max_time = max_time;
  return question;
}

// An engine that is wrong where a fault changes the exact answer, asked these questions.
Findings found(const std::vector<Question>& questions,
               const std::function<void(const Question&, Answer&)>& fault) {
  Findings findings;
  for (const Question& question : questions) {
    Answer given = question.exact;
    fault(question, given);
    const auto judgement = question.place->judge().judge(question.query, question.exact, given);
    if (const auto diagnosis = diagnosis_of(question, given, judgement))
      findings.add({question, given, judgement, *diagnosis}, "row");
    if (judgement.verdict == oracle::Verdict::agree)
      findings.add_right(features_of(question, question.exact.obstacle), !judgement.wrong_time);
  }
  return findings;
}

std::deque<question::ExaminedRow> rows(std::size_t asked) {
  std::deque<question::ExaminedRow> one(1);
  one[0].name = "row", one[0].tally.queries = asked;
  return one;
}

// Flights along a row of discs of radius 0.25, of different speeds, from different cells, midway between two discs.
std::vector<Question> along_rows(std::size_t number) {
  std::vector<Question> questions;
  const Scene scene = unit_scene(2, 0.25);
  for (std::size_t i = 0; i < number; ++i)
    questions.push_back(
        asked(scene, {0.5, 0, 0}, {i % 4 == 0 ? 2.0 + static_cast<double>(i) / 64 : 1.0, 0, 0}));
  return questions;
}

}  // namespace

TEST_CASE("Each property that failing questions share has its sentence", "[judge][circumstance]") {
  CHECK(told([](Features& f) { f.is_unit_speed = false; }) == "where |v| is not 1");
  CHECK(told([](Features& f) { f.speed = 1e200; }) == "where v.v leaves the range of binary64");
  CHECK(told([](Features& f) { f.speed = 1e-200; }) == "where v.v leaves the range of binary64");
  CHECK(told([](Features& f) { f.negative[1] = true; }) == "where v[1] is negative");
  CHECK(told([](Features& f) { f.zero_component = true; }) == "where a component of v is zero");
  CHECK(told([](Features& f) { f.negative_start = f.outside_first_cell = true; },
             [](Features& f) { f.outside_first_cell = true; }) == "where a coordinate of x is negative");
  CHECK(told([](Features& f) { f.outside_first_cell = true; }) == "where x lies outside of the first cell");
  CHECK(told([](Features& f) { f.start_gap = 0; }) ==
        "where x lies on the surface of the obstacle in question");
  CHECK(told([](Features& f) { f.start_gap = 3e-13; }) ==
        "where x lies within 1e-12 radii of the surface of the obstacle in question");
  CHECK(told([](Features& f) { f.start_gap = 0.5; }) == "");  // the surface is far
  CHECK(told([](Features&) {}, [](Features& f) { f.centre = 0; }) ==
        "where the obstacle's centre is not at 0");
  CHECK(told([](Features& f) { f.time = f.flight = 0; }) == "where the exact time is 0");
  CHECK(told([](Features& f) { f.time = f.flight = 3e-4; }) == "where the exact time is below 0.001");
  CHECK(told([](Features& f) { f.flight = 300; }) == "after flights of 100 lattice vectors or more");
  CHECK(told([](Features& f) { f.chord = 0.03; }) == "where the chord in the obstacle is shorter than 0.1");
  // Either component of v: none alone says it.
  std::vector<Features> failing = alike(20, [](Features& f) { f.negative[0] = true; });
  for (std::size_t i = 0; i < 10; ++i) failing[i].negative = {false, true, false};
  REQUIRE(circumstance_of(failing, alike(100)));
  CHECK(circumstance_of(failing, alike(100))->text == "where a component of v is negative");
}

TEST_CASE("A foreign answer in ten kills no sentence, two do", "[judge][circumstance]") {
  const auto failing = [](std::size_t foreign) {
    std::vector<Features> all = alike(20, [](Features& f) { f.flight = 300; });
    for (std::size_t i = 0; i < foreign; ++i) all[i] = alike(1)[0];
    return all;
  };
  for (const std::size_t foreign : {0, 1, 2}) {
    const auto its = circumstance_of(failing(foreign), alike(100));
    REQUIRE(its);
    CHECK(its->text == "after flights of 100 lattice vectors or more");
    CHECK((its->number == 20 - foreign && its->of == 20));
  }
  CHECK_FALSE(circumstance_of(failing(3), alike(100)));
  CHECK(circumstance_of(failing(3), alike(100), kClearPart));
  // What some lack must be rare among right answers; what all share may be true of half of them.
  auto right = alike(100);
  for (std::size_t i = 0; i < 40; ++i) right[i].flight = 300;
  CHECK_FALSE(circumstance_of(failing(1), right));
  CHECK(circumstance_of(failing(0), right));
}

TEST_CASE("Limits are compared with right answers that have the quantity, and with 20 of them",
          "[judge][circumstance]") {
  const auto failing = alike(20, [](Features& f) { f.flight = 3; });
  std::vector<Features> right = alike(1000, [](Features& f) { f.flight = Features::kNone; });
  CHECK_FALSE(circumstance_of(failing, right));
  const auto add = [&](std::size_t number, double flight) {
    const auto more = alike(number, [&](Features& f) { f.flight = flight; });
    right.insert(right.end(), more.begin(), more.end());
  };
  add(19, 30);
  CHECK_FALSE(circumstance_of(failing, right));
  add(1, 30);
  REQUIRE(circumstance_of(failing, right));
  CHECK(circumstance_of(failing, right)->text == "on flights shorter than 10 lattice vectors");
  add(20, 3);  // half of those that have a flight
  REQUIRE(circumstance_of(failing, right));
  CHECK(circumstance_of(failing, right)->share == 0.5);
  add(2, 3);
  CHECK_FALSE(circumstance_of(failing, right));
}

TEST_CASE("A property of scenes must weigh twice as much as one of the question", "[judge][circumstance]") {
  const auto failing = alike(20, [](Features& f) { f.in_space = f.zero_component = true; });
  const auto among = [&](std::size_t zeros, std::size_t in_space) {
    std::vector<Features> right = alike(1000);
    for (std::size_t i = 0; i < zeros; ++i) right[i].zero_component = true;
    for (std::size_t i = 0; i < in_space; ++i) right[i].in_space = true;
    return std::string(circumstance_of(failing, right)->name);
  };
  CHECK(among(100, 100) == "v-zero");
  CHECK(among(100, 12) == "v-zero");  // 0.012 is more than the square of 0.1
  CHECK(among(100, 8) == "in-3d");
}

TEST_CASE("What a cause implies does not count: right answers are compared that have it, too",
          "[judge][circumstance]") {
  const auto grazing = alike(20, [](Features& f) { f.depth = 1e-9, f.negative_start = true; });
  std::vector<Features> right = alike(200);
  REQUIRE(circumstance_of(grazing, right));
  CHECK(circumstance_of(grazing, right)->name == "x-negative");  // an earlier one than the depth, as rare
  const auto add = [&](std::size_t number, const Change& change) {
    const auto more = alike(number, change);
    right.insert(right.end(), more.begin(), more.end());
  };
  add(120, [](Features& f) { f.negative_start = true; });
  REQUIRE(circumstance_of(grazing, right));
  CHECK(circumstance_of(grazing, right)->name == "depth");
  add(20, [](Features& f) { f.depth = 1e-9; });
  REQUIRE(circumstance_of(grazing, right));
  CHECK(circumstance_of(grazing, right)->name == "x-negative");
  // An outcome.
  const auto inside = alike(20, [](Features& f) { f.outcome = Outcome::inside, f.in_space = true; });
  CHECK_FALSE(circumstance_of(inside, alike(100)));
  const auto both = alike(100, [](Features& f) { f.outcome = Outcome::inside; });
  REQUIRE(circumstance_of(inside, both));
  CHECK(circumstance_of(inside, both)->name == "in-3d");
}

TEST_CASE("Features of a question: its speed, its cell, the surface, the centre, and its chord",
          "[judge][features]") {
  const Scene square = unit_scene(2, 0.25);
  const auto of = [](const Question& question) { return features_of(question, question.exact.obstacle); };
  const Features plain = of(asked(square, {0.5, 0, 0}, {1, 0, 0}));
  CHECK((plain.is_unit_speed && !plain.negative[0] && !plain.negative_start && !plain.outside_first_cell));
  CHECK((plain.centre == 1 && plain.start_gap == 1 && plain.time == 0.25 && plain.chord == 0.5));
  CHECK(plain.coordinates == 0.5);
  const Features other = of(asked(square, {-0.5, 7, 0}, {-1, 1e-4, 0}));
  CHECK((other.negative[0] && !other.negative[1] && other.negative_start && other.outside_first_cell));
  CHECK_FALSE(other.is_unit_speed);
  CHECK(of(asked(square, {0.5, 0, 0}, {1, 1e-5, 0})).is_unit_speed);
  CHECK(of(asked(square, {0.5, 7, 0}, {1, 0, 0})).outside_first_cell);
  CHECK_FALSE(of(asked(square, {0.5, 7, 0}, {1, 0, 0})).negative_start);
  const Features on_surface = of(asked(square, {0.25, 0, 0}, {-1, 0, 0}));
  CHECK((on_surface.start_gap == 0 && on_surface.centre == 0 && on_surface.time == 0));
  // A lattice's coordinates are not those of space.
  Scene skewed = square;
  skewed.lattices[0].vectors = {{{1, 0, 0}, {-0.5, 1, 0}}};
  CHECK_FALSE(of(asked(skewed, {-0.2, 0.5, 0}, {1, 0, 0})).outside_first_cell);
}

TEST_CASE("An answer of another kind neither hides a fault's cause, nor illustrates it",
          "[judge][findings]") {
  // Wrong where |v| is not 1; and once where it is.
  const std::vector<Question> questions = along_rows(200);
  const Query* foreign = &questions[1].query;
  const auto all = found(questions, [&](const Question& question, Answer& given) {
                     if (question.query.v[0] != 1 || &question.query == foreign) given = Answer::never();
                   }).all(rows(200));
  REQUIRE(all.size() == 1);
  CHECK(all[0].summary() ==
        "says never where an obstacle is hit (entered by up to 1 of its radii), nearly always where |v| is "
        "not 1");
  CHECK(contains(all[0].explanation(), "(50 of 51, and none of the right answers)"));
  CHECK(all[0].simplest.question.query.v[0] != 1);  // though 1 is simpler
  CHECK(contains(all[0].why(), "docs/judging_yours.md#if-your-engine-cannot-do-all-of-this"));
}

TEST_CASE("Two faults with one cause are two findings, each with its own example", "[judge][findings]") {
  const std::vector<Question> questions = along_rows(200);
  std::size_t others = 0;
  const Findings findings = found(questions, [&](const Question& question, Answer& given) {
    const bool is_fast = question.query.v[0] != 1, is_other = !is_fast && others < 20;
    others += is_other;
    if (is_fast || is_other) given = Answer::never();
  });
  const auto all = findings.all(rows(200));
  REQUIRE(all.size() == 2);
  CHECK(contains(all[0].explanation(),
                 ", in part where |v| is not 1 (50 of 70, and none of the right answers)"));
  CHECK(all[0].simplest.question.query.v[0] != 1);
  CHECK((all[0].count == 50 && all[0].by_row.at("row") == 50));
  CHECK(all[1].summary() ==
        "says never where an obstacle is hit (entered by up to 1 of its radii), in other cases");
  CHECK(all[1].simplest.question.query.v[0] == 1);
  CHECK((all[1].count == 20 && all[1].by_row.at("row") == 20));
}

TEST_CASE("A question with numbers of every day comes before a simpler one in a vast cell",
          "[judge][findings]") {
  Scene vast = unit_scene(2, 0.25);
  vast.lattices[0].vectors = {Vec{0x1p30, 0}, Vec{0, 0x1p30}};
  const std::vector<Question> questions{asked(vast, {0.5, 0}, {-1, 0}),
                                        asked(unit_scene(2, 0.25), {0.512345, 0.01}, {1, 0.07})};
  const auto all =
      found(questions, [](const Question&, Answer& given) { given = Answer::never(); }).all(rows(2));
  CHECK(all[0].simplest.question.query.v[0] == 1);
}

TEST_CASE("Up to three faults with one cause are told apart", "[judge][findings]") {
  const Scene scene = unit_scene(2, 0.25);
  std::vector<Question> questions;
  const auto ask = [&](int number, const Vec& x, const Vec& v) {
    for (int i = 0; i < number; ++i) questions.push_back(asked(scene, x, v));
  };
  const Vec sideways{1, 0, 0};
  ask(40, {-2.5, 0, 0}, sideways), ask(30, {2.5, 0, 0}, {3, 0, 0}), ask(20, {1e6 + 0.5, 0, 0}, sideways);
  ask(10, {2.5, 0, 0}, sideways);
  const std::size_t failing = questions.size();
  ask(200, {2.5, 0, 0}, sideways), ask(100, {3.5, 0, 0}, sideways);
  const auto all = found(questions, [&](const Question& question, Answer& given) {
                     if (&question < &questions[failing]) given = Answer::never();
                   }).all(rows(questions.size()));
  REQUIRE(all.size() == 3);
  CHECK(all[0].count + all[1].count + all[2].count == 100);
  CHECK(contains(all[2].summary(), "in other cases"));
}

TEST_CASE("Two faults that say only are told before one that says nearly always", "[judge][findings]") {
  // It loses hits at a start on the surface, and those of flights from cells below 0, which are mostly short here.
  const Scene scene = unit_scene(2, 0.25);
  std::vector<Question> questions;
  const auto ask = [&](int number, const Vec& x, const Vec& v) {
    for (int i = 0; i < number; ++i) questions.push_back(asked(scene, x, v));
  };
  const Vec sideways{1, 0, 0}, slowly_up{1, 0.02, 0};
  ask(22, {-2.5, 0, 0}, sideways), ask(2, {-2.5, 0.5, 0}, slowly_up);
  ask(6, {0.25, 0, 0}, {-1, 0, 0});
  const std::size_t failing = questions.size();
  ask(80, {2.5, 0, 0}, sideways), ask(100, {-1.5, 0.5, 0}, slowly_up), ask(120, {1.5, 0.5, 0}, slowly_up);
  const auto all = found(questions, [&](const Question& question, Answer& given) {
                     if (&question < &questions[failing]) given = Answer::never();
                   }).all(rows(questions.size()));
  REQUIRE(all.size() == 2);
  CHECK(contains(all[0].summary(), "only where a coordinate of x is negative"));
  CHECK(contains(all[1].summary(), "in part where x lies on the surface"));
}

TEST_CASE("Where all times are wrong, circumstances are found among right obstacles", "[judge][findings]") {
  const auto all =
      found(along_rows(200), [&](const Question& question, Answer& given) {
        given = question.query.v[0] == 1 ? Answer::hit(given.obstacle, 7 * *given.time) : Answer::never();
      }).all(rows(200));
  REQUIRE(all.size() == 2);
  CHECK(contains(all[0].explanation(), ", only where |v| is not 1 (all 50, and none of the right answers)"));
  CHECK(contains(all[1].summary(), "that they are another quantity"));
}

TEST_CASE("Examples of everyday sizes come first", "[judge][findings]") {
  Scene aside = unit_scene(2, 0.25);
  aside.lattices[0].atoms[0].position = {0x1p-40, 0, 0};
  std::vector<Question> questions{asked(unit_scene(2, 0x1p-40), {0.5, 0, 0}, {1, 0, 0}),
                                  asked(aside, {0.5, 0, 0}, {1, 0, 0})};
  for (const double speed : {0x1p40, 0x1.23456p3, 0x1p-40})
    questions.push_back(asked(unit_scene(2, 0.25), {0.5, 0, 0}, {speed, 0, 0}));
  const auto all =
      found(questions, [](const Question&, Answer& given) { given = Answer::never(); }).all(rows(5));
  REQUIRE(all.size() == 1);
  CHECK(all[0].simplest.question.query.v[0] == 0x1.23456p3);
}

TEST_CASE("What is hit through its centre is as deep as its radius", "[judge][findings]") {
  const Features central = features_of(asked(unit_scene(2, 0.25), {0.5, 0, 0}, {1, 0, 0}));
  CHECK(central.depth == 1);
  CHECK(central.chord == 0.5);
  const Features beside = features_of(asked(unit_scene(2, 0.25), {0.5, 0.125, 0}, {1, 0, 0}));
  CHECK(beside.depth == 0.5);
}

TEST_CASE("A time that is another quantity is called by its name", "[judge][quantity]") {
  const Scene square = unit_scene(2, 0.25);
  const Question question = asked(square, {0.5, 0, 0}, {2, 0.01, 0}, 64);
  const auto given = [&](double time) {
    return quantity_of(question, Answer::hit(question.exact.obstacle, time));
  };
  const double entry = *question.exact.time, speed = std::hypot(2, 0.01);
  oracle::Request detailed;
  detailed.detail = true;
  const double exit = *question.place->exact(question.query, detailed).exit_time;
  CHECK(given(entry * speed) == kDistance);
  CHECK(given(entry * speed * (1 + 1e-7)) == kDistance);
  CHECK(given(entry * speed * (1 + 1e-5)) == "");
  CHECK(given(exit) == kExit);
  CHECK(given((entry + exit) / 2) == kNearest);
  CHECK(given(entry / 64) == kFraction);
  CHECK(given(entry) == "");
  CHECK(given(NAN) == "");
  const Question unit = asked(square, {0.5, 0, 0}, {1, 0, 0});
  CHECK(quantity_of(unit, Answer::hit(unit.exact.obstacle, *unit.exact.time)) == "");  // it is the time, too
  const Question solid = asked(unit_scene(3, 0.25), {0.5, 0, 0}, {2, 0.01, 0.02});
  CHECK(quantity_of(solid, Answer::hit(solid.exact.obstacle,
                                       *solid.place->exact(solid.query, detailed).exit_time)) == kExit);
}

TEST_CASE("Times that are another quantity are a finding of their own, and nine in ten are enough",
          "[judge][quantity]") {
  std::vector<Question> questions;
  for (int i = 0; i < 40; ++i)
    questions.push_back(asked(unit_scene(2, 0.25), {0.5, 0, 0}, {1, i / 256.0, 0}));
  const auto all = [&](std::size_t others) {
    std::size_t asked = 0;
    return found(questions,
                 [&](const Question& question, Answer& given) {
                   if (given.outcome != Outcome::hit) return;
                   oracle::Request detailed;
                   detailed.detail = true;
                   given.time = asked++ < others ? 7 * *given.time
                                                 : *question.place->exact(question.query, detailed).exit_time;
                 })
        .all(rows(40));
  };
  const auto nearly = all(4);
  REQUIRE(nearly.size() == 1);
  CHECK(contains(nearly[0].explanation(),
                 "names the right obstacle, with the time of the exit from that obstacle in "
                 "place of the time of the entry (36 of 40 times)"));
  CHECK(nearly[0].simplest.diagnosis.quantity == kExit);
  CHECK(contains(nearly[0].why(), "the larger root is taken"));
  const auto two = all(20);
  REQUIRE(two.size() == 2);
  CHECK(two[0].count == 20);
  CHECK(two[1].count == 20);
  CHECK(two[0].quantity != two[1].quantity);
}

TEST_CASE("Times that are all binary32 numbers are noticed, if they are 20 and need not be",
          "[judge][binary32]") {
  const auto told = [](int number, int of_binary64, double slope) {
    Results results;
    question::ExaminedRow& row = results.row({.name = "row"});
    for (int i = 0; i < number; ++i) {
      const Question question = asked(unit_scene(2, 0.25), {0.5, 0, 0}, {1, slope * (i + 1), 0});
      Answer given = question.exact;
      if (i >= of_binary64) given.time = static_cast<float>(*given.time);
      results.take({question, {given}, question.place->judge().judge(question.query, question.exact, given)},
                   {}, false, row);
    }
    Results sum;
    sum.add(results);
    return sum.all_in_binary32();
  };
  CHECK(told(20, 0, 1e-3) == 20);
  CHECK(told(19, 0, 1e-3) == 0);
  CHECK(told(40, 1, 1e-3) == 0);
  CHECK(told(40, 0, 0) == 0);  // 0.25 is one by itself
}

TEST_CASE("A domain without a fault is offered if half of the right answers are in it", "[judge][domain]") {
  const auto domain = [](double wrong_speed, double wrong_x, std::size_t right, double right_speed) {
    Findings findings = found({asked(unit_scene(2, 0.25), {wrong_x, 0, 0}, {wrong_speed, 0, 0})},
                              [](const Question&, Answer& given) { given = Answer::never(); });
    for (const Features& f : alike(10)) findings.add_right(f);
    for (const Features& f : alike(right, [&](Features& f) { f.speed = right_speed; })) findings.add_right(f);
    return findings.domain_without_fault();
  };
  REQUIRE(domain(0x1p40, 0.5, 0, 1));
  CHECK((domain(0x1p40, 0.5, 0, 1)->speed == Domain::Range{1e-10, 1e10}));
  CHECK((domain(0x1p40, 0.5, 0, 1)->coordinates == Domain::Range()));
  CHECK(domain(0x1p120, 0.5, 0, 1)->speed.low == 1e-30);
  CHECK(domain(0x1p40, 0.5, 10, 1e20));
  CHECK_FALSE(domain(0x1p40, 0.5, 11, 1e20));
  REQUIRE(domain(1, 0x1p40 + 0.5, 0, 1));
  CHECK(domain(1, 0x1p40 + 0.5, 0, 1)->coordinates.high == 1e10);
  CHECK(domain(1, 0x1p40 + 0.5, 0, 1)->speed == Domain::Range());
  CHECK_FALSE(domain(2, 0.5, 0, 1));
}

TEST_CASE("Circumstance: among single obstacles a start is negative by the sign of any coordinate",
          "[judge][circumstance]") {
  const Scene ball{3, {Lattice{{}, {Atom{{}, 1, {}}}, 0}}};
  const auto is_negative = [&](const Vec& x) {
    return features_of(asked(ball, x, {1, 0, 0})).negative_start;
  };
  CHECK_FALSE(is_negative({4, 4, 4}));
  CHECK(is_negative({-4, 4, 4}));
  CHECK(is_negative({4, -4, 4}));
  CHECK(is_negative({4, 4, -4}));
}

TEST_CASE("Each cause has advice, and each document that it names has the section", "[judge][advice]") {
  const auto has_section = [](const std::string& link) {
    const std::size_t hash = link.find('#');
    std::ifstream file(std::string(LORENTZ_SOURCE_DIR) + '/' + link.substr(0, hash));
    for (std::string line; std::getline(file, line);) {
      if (!line.starts_with('#')) continue;
      std::string anchor;
      for (const char c : line.substr(line.find(' ') + 1))
        if (c == ' ' || c == '-')
          anchor += '-';
        else if (std::isalnum(static_cast<unsigned char>(c)) || c == '_')
          anchor += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
      if (anchor == link.substr(hash + 1)) return true;
    }
    return false;
  };
  std::set<std::string> links;
  const auto look = [&](const Finding& finding) {
    const std::string why = finding.why();
    INFO(name_of(finding.cause()) << ": " << why);
    REQUIRE(why.ends_with(')'));
    links.insert(why.substr(why.rfind('(') + 1, why.size() - why.rfind('(') - 2));
  };
  const Question question = asked(unit_scene(2, 0.25), {0.5, 0, 0}, {1, 0, 0});
  for (int i = 0; i <= static_cast<int>(Cause::answers_nonsense); ++i) {
    Finding finding{{question, Answer::never(), {}, {static_cast<Cause>(i), Severity::wrong}}, "here", 1, {}};
    look(finding);
    for (const char* name :
         {"long-flight", "on-surface", "speed-not-1", "x-negative", "far-obstacle", "centre"}) {
      finding.circumstance.emplace().name = name;
      look(finding);
    }
    for (const std::string_view quantity : {kDistance, kExit, kNearest, kFraction}) {
      finding.quantity = quantity;
      look(finding);
    }
  }
  CHECK(links.size() >= 5);
  for (const std::string& link : links) {
    INFO(link);
    CHECK(has_section(link));
  }
}
