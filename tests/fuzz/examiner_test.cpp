// Those who watch others, with partners that err: the examiner of an oracle that contradicts itself, the two
// ways in which `reduction` and batches are asked.
#include "fuzz/campaign/examiner.hpp"

#include <catch2/catch.hpp>

#include <cmath>

#include <lorentz/exchange.hpp>
#include "fuzz/families/family.hpp"
#include "question/scene_engine.hpp"
#include "tests/fuzz/campaign_support.hpp"
#include "tests/support/support.hpp"

using namespace lorentz;
using namespace lorentz::test;
using fuzz::Kind;
using fuzz::LimitAt;

namespace {

constexpr std::uint64_t kSeed = 1305;

// What becomes of an answer to a question whose exact answer came along from elsewhere.
fuzz::Examined examined(const Scene& scene, const Query& query, const Answer& carried, const Answer& given,
                        LimitAt limit = LimitAt::none) {
  ToldAnswerer answerer([&](const question::Place&, const Query&) { return given; });
  const auto place = std::make_shared<question::Place>(scene);
  question::Question question{.place = place, .query = query, .exact = carried};
  question.max_time = fuzz::limit_of(limit, carried);
  auto replies = fuzz::replies_to(question::all_of({&question, 1}), answerer);
  return fuzz::Examiner(answerer, place, 0).judge(question, replies.at(0), true);
}

// The first letters of the outcomes.
std::string said(question::Answerer& answerer, const Scene& scene, const std::vector<Query>& queries,
                 double max_time = HUGE_VAL) {
  std::string text;
  answerer.on_reply(
      [&](question::Reply& reply) { text += std::string(name_of(reply.answer.outcome)).substr(0, 1); });
  answerer.set_scene(scene);
  for (const Query& query : queries) answerer.ask_until("null", query, max_time);
  answerer.drain();
  return text;
}

Answer disc(long i, long j, double time) {
  return Answer::hit({0, 0, {i, j, 0}}, time);
}

}  // namespace

TEST_CASE("An answer that was carried over and is not the question's own is an error, not a wrong answer",
          "[fuzz][examiner]") {
  const Scene scene = unit_scene(2, 0.25);
  const Query query{{0.5, 0}, {1, 0}, {}};
  const Answer truth = disc(1, 0, 0.25);
  CHECK(examined(scene, query, truth, truth).kind == Kind::agree);
  CHECK(examined(scene, query, truth, Answer::never()).kind == Kind::wrong);
  // Each part of what is carried may be the one that is another.
  for (const Answer& carried : {disc(2, 0, 0.25), disc(1, 1, 0.25), disc(1, 0, std::nextafter(0.25, 1)),
                                Answer::never(), Answer::inside({0, 0, {1, 0, 0}})})
    for (const LimitAt limit : {LimitAt(), LimitAt(LimitAt::twice)}) {
      INFO(line(carried, 2));
      const fuzz::Examined one = examined(scene, query, carried, truth, limit);
      CHECK(one.kind == Kind::error);
      CHECK(same(one.given, carried));
      CHECK(same(one.exact, truth));
      // An engine that is undecided says nothing against it.
      CHECK(examined(scene, query, carried, Answer::undecided()).kind == Kind::undecided);
      const fuzz::Examined broken = examined(scene, query, carried, Answer::error("no"));
      CHECK((broken.kind == Kind::error && broken.given.outcome == Outcome::error));
    }
  // Two are entered together: the words decide which one is named, and either is carried over.
  Scene two = unit_scene(2, 0.625);
  two.lattices[0].vectors = {Vec{4, 0}, Vec{0, 1}};
  const Query between{{1, 0.5}, {1, 0}, {}};
  const Answer below = oracle::Oracle(two).first_hit(between), above = disc(1, 1, *below.time);
  CHECK(examined(two, between, above, below).kind == Kind::agree);
  CHECK(examined(two, between, above, disc(1, 2, *below.time)).kind == Kind::wrong);
  CHECK(examined(two, between, disc(1, 2, *below.time), below).kind == Kind::error);
}

TEST_CASE("A single flight that says anything else than a batch is seen", "[fuzz][examiner]") {
  const Scene scene = unit_scene(2, 0.25);
  const std::vector<Query> queries{{{0.5, 0}, {1, 0}, {}}, {{0.5, 0.1}, {1, 0.125}, {}}};
  using Change = std::function<void(Flight&)>;
  const std::vector<std::pair<Change, bool>> changes{
      {[](Flight&) {}, false},
      {[](Flight& f) { f.outcome = Outcome::never; }, true},
      {[](Flight& f) { f.time = std::nextafter(f.time, 9); }, true},
      {[](Flight& f) { ++f.cell[0]; }, true},
      {[](Flight& f) { --f.cell[1]; }, true},
      {[](Flight& f) { f.atom = 1; }, true},
      {[](Flight& f) { f.lattice = 1; }, true}};
  for (const auto& [change, seen] : changes) {
    const std::string expected = seen ? "he" : "hh";
    // In the second flight alone.
    for (const auto wrong_in : {Batch::Time::close, Batch::Time::rounded}) {
      const question::Traits traits{.together = 4096};
      const auto batch = [&](const Scene& in) {
        return question::batch_both_ways(
            in, traits, [&](const Batch& engine, const Query& query, double max_time, Batch::Time time) {
              Flight flight = engine.one_at_a_time().fly(query, max_time, time);
              if (query.v[1] != 0 && time == wrong_in) change(flight);
              return flight;
            });
      };
      CHECK(said(*question::own_answerer(traits, batch), scene, queries) == expected);
    }
  }
  // The limit goes both ways, too.
  for (const char* engine : {"reduction", "batch", "certified", "certified-batch", "walk"})
    CHECK(said(*fuzz::answerer_maker(question::engine_named(engine))({}), scene, queries, 0.125) == "ll");
  QueryTable table;
  table.push_back(queries[0], 0.125);
  FlightTable flights;
  question::engine_named("walk").in(scene).fly(table.columns(), flights);
  CHECK(flights[0].outcome == Outcome::later);
}

TEST_CASE("With a limit at, below or above the time an answer is right or wrong, never ill-posed",
          "[fuzz][examiner]") {
  const Scene scene = unit_scene(2, 0.25);
  const Query query{{0.5, 0}, {1, 0}, {}};
  const Answer truth = disc(1, 0, 0.25), missed = disc(2, 0, 1.25);
  const auto kinds = [&](LimitAt limit) {
    const bool is_later =
        oracle::Oracle(scene).first_hit(query, {.max_time = fuzz::limit_of(limit, truth)}).outcome ==
        Outcome::later;
    std::string text;
    for (const Answer& given :
         {truth, Answer::later(), Answer::never(), missed, Answer::inside({}), Answer::undecided()}) {
      ToldAnswerer answerer([&](const question::Place&, const Query&) { return given; });
      const auto place = std::make_shared<question::Place>(scene);
      const fuzz::Examined one = fuzz::Examiner(answerer, place, 4).examine(query, limit);
      text += one.kind == Kind::agree ? 'f' : name_of(one.kind).words[0];
      CHECK(same(one.given, given));
      const bool says = given.outcome != Outcome::undecided;
      CHECK((one.exact.outcome == Outcome::later) == (says && is_later));
      if (one.exact.outcome != Outcome::later) CHECK(same(one.exact, truth));
    }
    return text;
  };
  // What is entered at the limit is entered after it: `later`.
  const bool at_is_later =
      oracle::Oracle(scene).first_hit(query, {.max_time = 0.25}).outcome == Outcome::later;
  CHECK(kinds(LimitAt::time) == (at_is_later ? "wffwwu" : "fwwwwu"));
  CHECK(kinds(LimitAt::below) == "wffwwu");
  CHECK(kinds(LimitAt::half) == "wffwwu");
  CHECK(kinds({LimitAt::before, 51}) == "wffwwu");
  CHECK(kinds(LimitAt::above) == "fwwwwu");
  CHECK(kinds(LimitAt::twice) == "fwwwwu");
  CHECK(kinds({LimitAt::after, 51}) == "fwwwwu");
}

TEST_CASE("What an engine said of one scene it does not say of the next", "[fuzz][examiner]") {
  const std::vector<Query> queries{{{0.5, 0}, {1, 0}, {}}, {{0.5, 0.25}, {1, 0}, {}}};  // and a tangent
  Scene beyond = unit_scene(2, 0.25);  // for `reduction`: it overlaps too many of its translates
  beyond.lattices[0].vectors[0][0] = 0.375 / 64;
  REQUIRE(Reduction::beyond(beyond));
  for (const char* engine : {"reduction", "batch", "certified", "certified-batch"}) {
    INFO(engine);
    const auto answerer = fuzz::answerer_maker(question::engine_named(engine))({});
    const bool is_exact = std::string_view(engine).starts_with("certified");
    const std::string here = said(*answerer, unit_scene(2, 0.25), queries);
    CHECK(here.substr(0, 1) == "h");
    if (is_exact) CHECK(here == "hn");
    CHECK(here.size() == 2);
    if (!is_exact) CHECK(said(*answerer, beyond, queries) == "ee");
    CHECK(said(*answerer, unit_scene(2, 0.25), queries) == here);
  }
}
