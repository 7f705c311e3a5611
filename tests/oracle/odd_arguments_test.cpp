// What a caller may give wrong: each class that takes a scene refuses the same ones in the same way, and answers odd
// questions with an error.
#include <catch2/catch.hpp>

#include <cmath>
#include <functional>
#include <limits>

#include <lorentz/batch.hpp>
#include <lorentz/certificate_check.hpp>
#include <lorentz/certified.hpp>
#include <lorentz/certified_batch.hpp>
#include <lorentz/collision.hpp>
#include <lorentz/errors.hpp>
#include <lorentz/exchange.hpp>
#include <lorentz/horizon.hpp>
#include <lorentz/itinerary.hpp>
#include <lorentz/margin.hpp>
#include <lorentz/oracle.hpp>
#include <lorentz/prover.hpp>
#include <lorentz/scene_check.hpp>
#include <lorentz/surroundings.hpp>
#include <lorentz/trajectory.hpp>
#include <lorentz/verdict.hpp>
#include <lorentz/walk.hpp>
#include "tests/support/support.hpp"

using namespace lorentz;
using namespace lorentz::test;

namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN(),
                 kInf = std::numeric_limits<double>::infinity();

struct BadScene {
  const char* words;  // that the message has
  Scene scene;
};

Scene changed(const std::function<void(Scene&)>& change, int dimension = 2) {
  Scene scene = unit_scene(dimension, 0.25);
  change(scene);
  return scene;
}

// With a flaw that any class sees.
std::vector<BadScene> flawed() {
  const auto with = [](const char* words, const auto& change) { return BadScene{words, changed(change)}; };
  std::vector<BadScene> all{
      {"dimension must be 2 or 3", Scene{}},
      with("dimension must be 2 or 3", [](Scene& s) { s.dimension = 0; }),
      with("dimension must be 2 or 3", [](Scene& s) { s.dimension = 1; }),
      with("dimension must be 2 or 3", [](Scene& s) { s.dimension = 4; }),
      with("dimension must be 2 or 3", [](Scene& s) { s.dimension = -2; }),
      with("at least one lattice", [](Scene& s) { s.lattices.clear(); }),
      with("lattice 0: needs at least one atom", [](Scene& s) { s.lattices[0].atoms.clear(); }),
      with("lattice 1: needs at least one atom", [](Scene& s) { s.lattices.emplace_back(); }),
      with("primitive vector is not finite", [](Scene& s) { s.lattices[0].vectors[1][0] = kInf; }),
      with("primitive vectors", [](Scene& s) { s.lattices[0].rank = -1; }),
      with("primitive vectors", [](Scene& s) { s.lattices[0].rank = 4; }),
      with("more primitive vectors than it says", [](Scene& s) { s.lattices[0].rank = 1; }),
      with("more primitive vectors than it says", [](Scene& s) { s.lattices[0].vectors[2][0] = 1e6; }),
      with("position is not finite", [](Scene& s) { s.lattices[0].atoms[0].position[0] = kNaN; }),
      with("as many semiaxes",
           [](Scene& s) {
             s.lattices[0].atoms[0].semiaxes = {{1, 0, 0}};
           }),
      with("two components in the plane", [](Scene& s) { s.lattices[0].vectors[0][2] = 0.5; }),
      with("two components in the plane",
           [](Scene& s) {
             s.lattices[0].vectors[2] = {0, 0, 1};
           }),
      with("two components in the plane", [](Scene& s) { s.lattices[0].atoms[0].position[2] = 5e-324; }),
      with("two components in the plane",
           [](Scene& s) {
             s.lattices[0].atoms[0].semiaxes = {{1, 0, 0}, {0, 1, 1}};
           }),
      with("a semiaxis is not finite", [](Scene& s) {
        s.lattices[0].atoms[0].semiaxes = {{1, 0, 0}, {0, kNaN, 0}};
      })};
  for (const double radius : {0.0, -0.0, -0.1, -kInf, kInf, kNaN})
    all.push_back(with("radius", [=](Scene& s) { s.lattices[0].atoms[0].radius = radius; }));
  return all;
}

// That only exact arithmetic sees.
std::vector<BadScene> dependent() {
  const auto with = [](const char* words, const auto& change) { return BadScene{words, changed(change)}; };
  return {with("linearly dependent", [](Scene& s) { s.lattices[0].vectors[1] = s.lattices[0].vectors[0]; }),
          with("linearly dependent", [](Scene& s) { s.lattices[0].vectors[1] = {}; }),
          with("linearly dependent",
               [](Scene& s) {
                 s.lattices[0].vectors = {{{0.1, 0.3, 0}, {0.2, 0.6, 0}}};
               }),
          with("linearly dependent", [](Scene& s) { s.lattices[0].vectors = {}, s.lattices[0].rank = 1; }),
          with("linearly dependent", [](Scene& s) {
            s.lattices[0].atoms[0].semiaxes = {{1, 2, 0}, {2, 4, 0}};
          })};
}

struct Class {
  const char* name;
  std::function<void(const Scene&)> make;
};

const Query kQuery{{0.5, 0.5, 0}, {1, 0.1, 0}, {}};

// That are exact, and say all that is wrong with a scene.
std::vector<Class> exact_classes() {
  return {{"Oracle", [](const Scene& s) { oracle::Oracle{s}; }},
          {"Walk", [](const Scene& s) { oracle::Walk{s}; }},
          {"Certified", [](const Scene& s) { oracle::Certified{s}; }},
          {"CertifiedBatch", [](const Scene& s) { oracle::CertifiedBatch{s}; }},
          {"Margins", [](const Scene& s) { oracle::Margins{s}; }},
          {"Judge", [](const Scene& s) { oracle::Judge{s}; }},
          {"Prover", [](const Scene& s) { oracle::Prover{s}; }},
          {"Itinerary", [](const Scene& s) { oracle::Itinerary{rational(s)}; }},
          {"Surroundings", [](const Scene& s) { oracle::Surroundings{s}; }},
          {"horizon_of", [](const Scene& s) { (void)oracle::horizon_of(s); }},
          {"contacts_in", [](const Scene& s) { (void)oracle::contacts_in(s, 3); }}};
}

// That compute in binary64, and may refuse a nearly flat cell as one that they do not do.
std::vector<Class> fast_classes() {
  std::vector<Class> all{{"Reduction", [](const Scene& s) { Reduction{s}; }},
                         {"Reduction::beyond", [](const Scene& s) { (void)Reduction::beyond(s); }},
                         {"Batch", [](const Scene& s) { Batch{s}; }},
                         {"Trajectory", [](const Scene& s) { Trajectory(AskFirstHit(), s, kQuery); }},
                         {"particle_at", [](const Scene& s) { (void)particle_at(s, kQuery); }},
                         {"checked", [](const Scene& s) { (void)checked(s); }}};
  for (const char* name : {"classical", "published", "reduction"})
    all.push_back({name, [=](const Scene& s) { (void)make_engine(name, s); }});
  return all;
}

void require_refused(const Class& one, const BadScene& bad) {
  INFO(one.name << ", " << bad.words);
  const bool is_told = [&] {
    try {
      one.make(bad.scene);
    } catch (const InputError& error) {
      const std::string said = error.what();
      return said.starts_with("scene: ") && said.find(bad.words) != said.npos;
    }
    return false;
  }();
  CHECK(is_told);
}

}  // namespace

TEST_CASE("A scene with a flaw is refused by every class, in the same words", "[oracle][odd]") {
  std::vector<Class> all = exact_classes();
  for (const Class& one : fast_classes()) all.push_back(one);
  for (const Class& one : all)
    for (const BadScene& bad : flawed()) require_refused(one, bad);
  // The check of certificates refutes whatever is said of one.
  for (const BadScene& bad : flawed()) {
    const auto why = oracle::CertificateCheck(bad.scene).refutation(kQuery, Answer::never(), {});
    REQUIRE(why);
    CHECK_THAT(*why, Catch::StartsWith("scene: ") && Catch::Contains(bad.words));
  }
}

TEST_CASE("Dependent vectors are refused by every exact class", "[oracle][odd]") {
  for (const Class& one : exact_classes())
    for (const BadScene& bad : dependent()) require_refused(one, bad);
  for (const Class& one : fast_classes())  // in binary64 they can't be sure; they do not break
    for (const BadScene& bad : dependent()) {
      INFO(one.name);
      try {
        one.make(bad.scene);
      } catch (const UnsupportedError&) {
      } catch (const InputError&) {
      }
    }
}

TEST_CASE("Odd queries are errors, of every class that answers", "[oracle][odd]") {
  const Scene scene = unit_scene(2, 0.25);
  const oracle::Oracle oracle(scene);
  const oracle::Walk walk(scene);
  const oracle::Certified certified(scene);
  std::vector<std::pair<std::string, std::function<Answer(const Query&)>>> all{
      {"oracle", [&](const Query& q) { return oracle.first_hit(q); }},
      {"walk", [&](const Query& q) { return walk.first_hit(q); }},
      {"certified", [&](const Query& q) { return certified.first_hit(q); }}};
  for (const std::string name : {"classical", "published", "reduction"}) {
    const std::shared_ptr<Engine> engine = make_engine(name, scene);
    all.emplace_back(name, [engine](const Query& q) { return engine->first_hit(q); });
  }
  const auto from = [](int lattice, int atom) {
    Query query = kQuery;
    query.from = ObstacleId{lattice, atom, {0, 0, 0}};
    return query;
  };
  // A limit that is not a number is neither a limit nor a time.
  oracle::Request request;
  request.max_time = kNaN;
  CHECK(oracle.first_hit(kQuery, request).outcome == Outcome::error);
  CHECK(certified.first_hit(kQuery, request).outcome == Outcome::error);
  CHECK(walk.first_hit(kQuery, kNaN).outcome == Outcome::error);
  for (const std::string name : {"classical", "published", "reduction"})
    CHECK(make_engine(name, scene)->first_hit(kQuery, kNaN).outcome == Outcome::error);
  // Nothing is entered before minus infinity; with infinity there is no limit.
  const Query along{{0.5, 0.5, 0}, {1, 0, 0}, {}};
  for (const double limit : {-kInf, -1.0, kInf}) {
    request.max_time = limit;
    const bool is_limit = limit < 0;
    INFO(limit);
    for (const auto& [query, exact] : {std::pair(kQuery, Outcome::hit), std::pair(along, Outcome::never)}) {
      CHECK(oracle.first_hit(query, request).outcome == (is_limit ? Outcome::later : exact));
      CHECK(certified.first_hit(query, request).outcome == (is_limit ? Outcome::later : exact));
      for (const std::string name : {"classical", "reduction"})
        if (const Answer given = make_engine(name, scene)->first_hit(query, limit);
            given.outcome != Outcome::undecided)
          CHECK(given.outcome == (is_limit ? Outcome::later : exact));
      if (exact == Outcome::hit)
        CHECK(walk.first_hit(query, limit).outcome == (is_limit ? Outcome::later : exact));
    }
  }
  for (const int digits : {-1, kMostDigits + 1, std::numeric_limits<int>::max()}) {
    CHECK_THROWS_WITH(oracle.first_hit(kQuery, {digits, false, {}}), Catch::Contains("digits"));
    CHECK_THROWS_WITH(certified.first_hit(kQuery, {digits, false, {}}), Catch::Contains("digits"));
  }
  for (const auto& [name, ask] : all) {
    INFO(name);
    for (const Query& query :
         {Query{{kNaN, 0, 0}, {1, 0, 0}, {}}, Query{{0, kInf, 0}, {1, 0, 0}, {}},
          Query{{0.5, 0.5, 0}, {0, 0, 0}, {}}, Query{{0.5, 0.5, 0}, {-0.0, 0, 0}, {}},
          Query{{0.5, 0.5, 0}, {kNaN, 1, 0}, {}}, Query{{0.5, 0.5, 0}, {1, -kInf, 0}, {}}, from(-1, 0),
          from(1, 0), from(0, -1), from(0, 1), from(1 << 30, 1 << 30)})
      CHECK(ask(query).outcome == Outcome::error);
    CHECK(ask(kQuery).outcome == Outcome::hit);
  }
}

TEST_CASE("Odd columns are refused, and odd rows are errors of their own", "[oracle][odd]") {
  const Scene scene = unit_scene(2, 0.25);
  const Batch batch(scene);
  const oracle::CertifiedBatch certified(scene);
  QueryTable table;
  for (int i = 0; i < 19; ++i) table.push_back(kQuery, i % 3 == 1 ? kNaN : i % 3 == 2 ? 0.001 : kInf);
  FlightTable flights;
  flights.resize(table.size());
  std::vector<std::size_t> uncertain;
  batch.fly(table.columns(), flights.columns());
  certified.first_hits(table.columns(), flights.columns(), uncertain);
  CHECK(uncertain.empty());
  for (std::size_t i = 0; i < table.size(); ++i)
    CHECK(flights[i].outcome == (i % 3 == 1 ? Outcome::error : i % 3 == 2 ? Outcome::later : Outcome::hit));
  const std::vector<double> numbers(20);
  const std::vector<std::int32_t> integers(20);
  const std::vector<std::int64_t> cells(20);
  struct BadColumn {
    const char* words;
    std::function<void(QueryColumns&, FlightColumns&)> change;
  };
  const BadColumn bad[] = {
      {"x[0] is missing", [](QueryColumns& q, FlightColumns&) { q.x[0] = {}; }},
      {"x[0] has 18 rows, not 19", [](QueryColumns& q, FlightColumns&) { q.x[0] = q.x[0].first(18); }},
      {"x[1] is missing", [](QueryColumns& q, FlightColumns&) { q.x[1] = {}; }},
      {"v[1] has 20 rows, not 19", [&](QueryColumns& q, FlightColumns&) { q.v[1] = numbers; }},
      {"max_time has 1 rows", [](QueryColumns& q, FlightColumns&) { q.max_time = q.max_time.first(1); }},
      {"from_lattice is missing",
       [&](QueryColumns& q, FlightColumns&) { q.from_atom = std::span(integers).first(19); }},
      {"from_lattice is missing",
       [&](QueryColumns& q, FlightColumns&) {
         for (auto& column : q.from_cell) column = std::span(cells).first(19);
       }},
      {"outcome is missing", [](QueryColumns&, FlightColumns& f) { f.outcome = {}; }},
      {"cell[1] has 3 rows", [](QueryColumns&, FlightColumns& f) { f.cell[1] = f.cell[1].first(3); }}};
  for (const BadColumn& one : bad) {
    QueryColumns queries = table.columns();
    FlightColumns told = flights.columns();
    one.change(queries, told);
    INFO(one.words);
    CHECK_THROWS_WITH(batch.fly(queries, told), Catch::Contains(one.words));
    CHECK_THROWS_WITH(certified.first_hits(queries, told, uncertain), Catch::Contains(one.words));
  }
  // In a scene beyond the fast engine no row is answered.
  const oracle::CertifiedBatch tiny(unit_scene(2, 1e-30));
  tiny.first_hits(table.columns(), flights.columns(), uncertain);
  CHECK(uncertain.size() == table.size());
  for (std::size_t i = 0; i < table.size(); ++i) CHECK(flights[i].outcome == Outcome::undecided);
  QueryColumns plane = table.columns();
  plane.x[2] = plane.v[2] = {};
  CHECK(plane.query(0, 3).x == kQuery.x);
}

TEST_CASE("Odd numbers and obstacles are refused by functions that take them", "[oracle][odd]") {
  const Scene scene = unit_scene(2, 0.25);
  for (const int dimension : {-1, 0, 1, 4, 30, std::numeric_limits<int>::max()}) {
    CHECK_THROWS_WITH(unit_scene(dimension, 0.25), Catch::Contains("dimension"));
    if (dimension == 0) continue;  // a scene that is not known yet
    CHECK_THROWS_WITH(Components(dimension), Catch::Contains("dimension"));
    Scene odd = scene;
    odd.dimension = dimension;
    std::string line;
    CHECK_THROWS_WITH(append_scene_line(line, odd), Catch::Contains("dimension"));
  }
  const oracle::Judge judge(scene);
  const Answer exact = oracle::Oracle(scene).first_hit(kQuery);
  for (const double odd : {kNaN, -1.0}) {
    CHECK_THROWS_WITH(judge.judge(kQuery, exact, Answer::never(), odd), Catch::Contains("ulps"));
    CHECK_THROWS_WITH(judge.excused(kQuery, exact, odd, 5), Catch::Contains("ulps"));
    CHECK_THROWS_WITH(oracle::Judge(scene, {NumberFormat::binary64, odd}), Catch::Contains("time_tolerance"));
  }
  const Particle good = particle_at(scene, kQuery);
  Trajectory trajectory(AskFirstHit(), scene, kQuery);
  struct BadState {
    const char* words;
    std::function<void(Particle&)> change;
  };
  const BadState bad[] = {{"names lattice 7", [](Particle& p) { p.lattice = 7; }},
                          {"names atom -1", [](Particle& p) { p.atom = -1; }},
                          {"third component", [](Particle& p) { p.offset[2] = 3; }},
                          {"offset", [](Particle& p) { p.offset[0] = kNaN; }},
                          {"velocity", [](Particle& p) { p.velocity = {}; }},
                          {"speed_squared", [](Particle& p) { p.speed_squared = kInf; }},
                          {"time", [](Particle& p) { p.time = kNaN; }}};
  for (const BadState& one : bad) {
    Particle odd = good;
    one.change(odd);
    CHECK_THROWS_WITH(trajectory.set_state(odd), Catch::Contains(one.words));
    if (odd.lattice == good.lattice && odd.atom == good.atom) continue;
    CHECK_THROWS_AS(place_of(scene, odd), InputError);
    CHECK_THROWS_AS(displacement(scene, good, odd), InputError);
    CHECK_THROWS_AS(collision_detail(scene, kQuery, Answer::hit({odd.lattice, odd.atom, {}}, 1)), InputError);
  }
  CHECK_THROWS_AS(collision_detail(scene, kQuery, Answer::never()), InputError);
}

TEST_CASE("Odd obstacles, places and answers are refused by what looks closely at a flight",
          "[oracle][odd]") {
  const Scene scene = unit_scene(2, 0.25);
  const oracle::Margins margins(scene);
  const oracle::Judge judge(scene);
  const oracle::Prover prover(scene);
  const oracle::Surroundings surroundings(scene);
  using oracle::PlaceOnLine;
  const Answer exact = oracle::Oracle(scene).first_hit(kQuery);
  REQUIRE(exact.outcome == Outcome::hit);
  for (const Query& query : {Query{{kNaN, 0, 0}, {1, 0, 0}, {}}, Query{{0.5, 0.5, 0}, {0, 0, 0}, {}}}) {
    CHECK_THROWS_AS(margins.hardest_decision(query, exact), InputError);
    CHECK_THROWS_AS(margins.passed(query, exact, 3), InputError);
    CHECK_THROWS_AS(margins.condition(query, exact), InputError);
    CHECK_THROWS_AS(margins.time_change(query, exact), InputError);
    CHECK_THROWS_AS(margins.approach(query, exact.obstacle), InputError);
    CHECK_THROWS_AS(margins.crossing(query, exact.obstacle), InputError);
    CHECK_THROWS_AS(judge.judge(query, exact, Answer::never()), InputError);
    CHECK_THROWS_AS(judge.excused(query, exact, 16, 32), InputError);
    CHECK_THROWS_AS(prover.prove(query, exact), InputError);
    CHECK_THROWS_AS(surroundings.way(query, PlaceOnLine::start(), PlaceOnLine::after(1)), InputError);
  }
  for (const ObstacleId& bad :
       {ObstacleId{-1, 0, {}}, ObstacleId{1, 0, {}}, ObstacleId{0, -1, {}}, ObstacleId{0, 1, {}}}) {
    const Answer hit = Answer::hit(bad, 1), inside = Answer::inside(bad);
    for (const Answer& answer : {hit, inside}) {
      CHECK_THROWS_AS(margins.hardest_decision(kQuery, answer), InputError);
      CHECK_THROWS_AS(judge.judge(kQuery, answer, Answer::never()), InputError);
      CHECK_THROWS_AS(prover.prove(kQuery, answer), InputError);
      CHECK(judge.judge(kQuery, exact, answer).verdict ==
            oracle::Verdict::wrong);  // another engine may say so
    }
    CHECK_THROWS_AS(margins.passed(kQuery, hit, 3), InputError);
    CHECK_THROWS_AS(margins.condition(kQuery, hit), InputError);
    CHECK_THROWS_AS(margins.approach(kQuery, bad), InputError);
    CHECK_THROWS_AS(margins.crossing(kQuery, bad), InputError);
    CHECK_THROWS_AS(judge.excused(kQuery, hit, 16, 32), InputError);
    CHECK_THROWS_AS(surroundings.centre(kQuery, PlaceOnLine::start(), bad), InputError);
    CHECK_THROWS_AS(surroundings.around(kQuery, PlaceOnLine::at(bad), 1, 3), InputError);
  }
  for (const Answer& odd :
       {Answer::never(), Answer::inside({}), Answer::undecided(), Answer::error("none")}) {
    CHECK_THROWS_AS(margins.condition(kQuery, odd), InputError);
    CHECK_THROWS_AS(margins.time_change(kQuery, odd), InputError);
  }
  for (const double reach : {0.0, -1.0, kInf, kNaN})
    CHECK_THROWS_AS(surroundings.around(kQuery, PlaceOnLine::start(), reach, 3), InputError);
  CHECK_THROWS_AS(surroundings.around(kQuery, PlaceOnLine::after(kInf), 1, 3), InputError);
  CHECK_THROWS_AS(oracle::Oracle(scene).is_free({kNaN, 0, 0}), InputError);
  // A hit that names an obstacle which is not met.
  const Answer missed = Answer::hit({0, 0, {-5, 7, 0}}, 1);
  CHECK_THROWS_AS(margins.condition(kQuery, missed), InputError);
  CHECK_THROWS_AS(margins.time_change(kQuery, missed), InputError);
  CHECK_NOTHROW(margins.hardest_decision(kQuery, missed));
  CHECK_NOTHROW(margins.passed(kQuery, missed, 3));
  CHECK_NOTHROW(judge.judge(kQuery, missed, Answer::never()));
  CHECK_THROWS_AS(prover.prove(kQuery, missed), InputError);
}

namespace {

// Moved, it says what it said; moved from, it is empty; assigned, it is whole again.
template <class T, class Use>
void require_moves(T one, T other, const Use& use) {
  const auto said = use(one);
  T moved(std::move(one));
  CHECK(use(moved) == said);
  CHECK_THROWS_AS(use(one), InputError);
  one = std::move(moved);
  CHECK(use(one) == said);
  CHECK_THROWS_AS(use(moved), InputError);
  one = std::move(other);
  CHECK(use(one) != said);
}

}  // namespace

TEST_CASE("The end of a window without an end is a text, too", "[oracle][odd]") {
  CHECK(text_of(oracle::WindowEnd(kInf)) == "inf");
  CHECK(text_of(oracle::WindowEnd(-0.75)) == "-0x18000000000000p-53");
}

TEST_CASE("All classes move and assign, and what was moved from says that it is empty", "[oracle][odd]") {
  const Scene scene = unit_scene(2, 0.25), other = unit_scene(2, 0.125);
  const auto time = [](const Answer& answer) { return answer.time.value_or(-1); };
  const Answer exact = oracle::Oracle(scene).first_hit(kQuery);
  const auto first = [&](const auto& one) { return time(one.first_hit(kQuery)); };
  require_moves(oracle::Oracle(scene), oracle::Oracle(other), first);
  require_moves(oracle::Certified(scene), oracle::Certified(other), first);
  require_moves(oracle::Walk(scene), oracle::Walk(other), first);
  require_moves(Reduction(scene), Reduction(other), [](const auto& one) { return one.fly(kQuery).time; });
  require_moves(oracle::Margins(scene), oracle::Margins(other),
                [&](const auto& one) { return one.approach(kQuery, exact.obstacle).gap; });
  require_moves(oracle::Judge(scene), oracle::Judge(other), [&](const auto& one) {
    return one.judge(kQuery, exact, Answer::hit({0, 0, {9, 1, 0}}, 8)).departs;
  });
  require_moves(oracle::Surroundings(scene), oracle::Surroundings(other), [&](const auto& one) {
    return one.way(kQuery, oracle::PlaceOnLine::start(), oracle::PlaceOnLine::at(exact.obstacle));
  });
  require_moves(Trajectory(AskFirstHit(), scene, kQuery),
                Trajectory(AskFirstHit(), scene, {{0.5, 0.5, 0}, {2, 1, 0}, {}}),
                [](const auto& one) { return one.place()[0] + one.state().velocity[0]; });
  const auto batch_time = [](const Batch& batch) {
    QueryTable queries;
    queries.push_back(kQuery);
    FlightTable flights;
    flights.resize(1);
    batch.fly(queries.columns(), flights.columns());
    return flights[0].time;
  };
  require_moves(Batch(scene), Batch(other), batch_time);
  Start start;
  start.x = {0.5, 0.5, 0.0};
  start.v = {Rational(1.0), Rational(0.1), Rational(0.0)};
  require_moves(oracle::Itinerary(rational(scene)), oracle::Itinerary(rational(other)), [&](const auto& one) {
    oracle::Journey journey;
    journey.collisions = 1;
    const auto end = one.follow(start, journey);
    return end.x[0] + ' ' + end.x[1] + ' ' + end.distance;
  });
  CHECK_THROWS_AS(oracle::Itinerary(rational(scene)).follow(start, {}), InputError);
  QueryTable full;
  Query leaving = kQuery;
  leaving.from = ObstacleId{0, 0, {0, 0, 0}};
  full.push_back(leaving, 3);
  const QueryTable taken = std::move(full);
  CHECK(taken.columns().max_time.size() == 1);
  full.push_back(kQuery);  // NOLINT(bugprone-use-after-move)
  CHECK(full.size() == 1);
  CHECK(full.columns().max_time.empty());
  CHECK(full.columns().from_lattice.empty());
}

TEST_CASE("Odd starts of itineraries are refused", "[oracle][odd]") {
  const RationalScene scene = rational(unit_scene(2, 0.25));
  const Fraction nothing{1, 0}, third{1, 3};
  Surd root;
  root.scale = 1.0;
  struct BadStart {
    const char* words;
    std::function<void(Start&)> change;
  };
  const auto with_root = [&](Rational under) {
    return [root, under](Start& start) mutable { root.root = under, start.v[1] = root; };
  };
  const BadStart bad[] = {{"x is not finite", [](Start& s) { s.x[0] = kNaN; }},
                          {"x is not finite", [](Start& s) { s.x[1] = kInf; }},
                          {"x is not finite", [&](Start& s) { s.x[1] = nothing; }},
                          {"third must be zero", [&](Start& s) { s.x[2] = third; }},
                          {"v is not finite", [](Start& s) { s.v[0] = Rational(-kInf); }},
                          {"v is not finite", [&](Start& s) { s.v[0] = Rational(nothing); }},
                          {"v is not finite", [](Start& s) { s.degrees = kNaN; }},
                          {"v is not finite", with_root(kNaN)},
                          {"v is not finite", with_root(nothing)},
                          {"square root of a number below zero", with_root(-2.0)},
                          {"square root of a number below zero", with_root(Fraction{-1, 3})},
                          {"v is zero", [](Start& s) { s.v = {}; }},
                          {"v is zero", [&](Start& s) { s.v = {}, with_root(0.0)(s); }},
                          {"from names lattice 1",
                           [](Start& s) {
                             s.from = ObstacleId{1, 0, {}};
                           }},
                          {"from names atom -1", [](Start& s) {
                             s.from = ObstacleId{0, -1, {}};
                           }}};
  const oracle::Itinerary itinerary(scene);
  oracle::Journey journey;
  journey.collisions = 1;
  const auto start = [&] {
    Start good;
    good.x = {third, 0.5, 0.0};
    good.v = {Rational(1.0), Rational(0.1), Rational(0.0)};
    return good;
  };
  CHECK(itinerary.follow(start(), journey).end == oracle::JourneyEnd::collisions);
  for (const BadStart& one : bad) {
    Start odd = start();
    one.change(odd);
    INFO(one.words);
    CHECK_THROWS_WITH(itinerary.follow(odd, journey),
                      Catch::StartsWith("start: ") && Catch::Contains(one.words));
  }
  const auto refused = [&](const char* words, const auto& change) {
    oracle::Journey odd = journey;
    change(odd);
    CHECK_THROWS_WITH(itinerary.follow(start(), odd), Catch::Contains(words));
  };
  for (const Rational& time : {Rational(kInf), Rational(kNaN), Rational(-1.0), Rational(0.0),
                               Rational(nothing), Rational(Fraction{1, -2}), Rational(Fraction{-1, -2})})
    refused("time: must be finite and above zero", [&](oracle::Journey& j) { j.time = time; });
  for (const int digits : {0, -1, kMostDigits + 1})
    refused("digits", [&](oracle::Journey& j) { j.digits = digits; });
  for (const long bits : {-1L, 1L << 40}) refused("bits", [&](oracle::Journey& j) { j.first_bits = bits; });
  refused("bits", [](oracle::Journey& j) { j.most_bits = 1L << 40; });
}
