// A batch is held against one flight at a time, bit for bit, with every set of instructions that this
// processor has: drawn flights, flights at the families of hard cases, with limits, from surfaces, far out.
#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iostream>
#include <map>
#include <optional>

#include <lorentz/certified_batch.hpp>
#include <lorentz/collision.hpp>
#include <lorentz/errors.hpp>
#include <lorentz/geometry.hpp>
#include "fuzz/families/family.hpp"
#include "question/cases/random.hpp"
#include "tests/engines/reduction_support.hpp"
#include "tests/support/scenes.hpp"

using namespace lorentz;
using namespace lorentz::test;
using cases::Random;

namespace {

constexpr std::uint64_t kSeed = 20261122;

Atom ellipsoid(std::vector<Vec> semiaxes, const Vec& position = {}) {
  return {position, 0, std::move(semiaxes)};
}

Scene with_atoms(int dimension, const std::array<Vec, 3>& vectors, std::vector<Atom> atoms) {
  Scene scene;
  scene.dimension = dimension;
  scene.lattices = {{vectors, std::move(atoms)}};
  return scene;
}

// One scene of each kind that lanes treat in a way of its own, with obstacles of about this size.
std::map<std::string, Scene> scenes_of(double r) {
  const std::array<Vec, 3> square{Vec{1, 0, 0}, {0, 1, 0}}, cubic{Vec{1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
      oblique{Vec{1.3, 0.2, 0}, {0.7, 1.1, 0}},
      triclinic{Vec{1.1, 0.1, 0}, {0.3, 1.2, 0.1}, {0.2, 0.35, 0.95}},
      fcc{Vec{0, 0.5, 0.5}, {0.5, 0, 0.5}, {0.5, 0.5, 0}}, wide{Vec{1000, 0, 0}, {0, 1000, 0}},
      small{Vec{0x1p-300, 0, 0}, {0, 0x1p-300, 0}, {0, 0, 0x1p-300}};
  const std::vector<Vec> slim{{1.4 * r, 0.3 * r, 0}, {-0.3 * r, 0.7 * r, 0}},
      stout{{1.3 * r, 0, 0.1 * r}, {0, r, 0.1 * r}, {0, 0, 0.7 * r}};
  Scene twisted = unit_scene(2, r);
  twisted.lattices.push_back(
      {{Vec{std::cos(0.6), std::sin(0.6), 0}, {-std::sin(0.6), std::cos(0.6), 0}}, {{{0.3, 0.1, 0}, r, {}}}});
  return {
      {"square", unit_scene(2, r)},
      {"cubic", unit_scene(3, r)},
      {"oblique", one_atom(2, oblique, r, {0.1, 0.3, 0})},
      {"triclinic", one_atom(3, triclinic, r, {0.1, 0.2, 0.3})},
      {"fcc", one_atom(3, fcc, r)},
      {"wide", one_atom(2, wide, 1000 * r)},
      {"small", one_atom(3, small, 0x1p-300 * r)},
      {"ellipse", with_atoms(2, square, {ellipsoid(slim)})},
      {"oblique ellipse", with_atoms(2, oblique, {ellipsoid(slim, {0.1, 0.2, 0})})},
      {"ellipsoid", with_atoms(3, cubic, {ellipsoid(stout)})},
      {"triclinic ellipsoid", with_atoms(3, triclinic, {ellipsoid(stout, {0.1, 0.2, 0.3})})},
      {"motif in the plane",
       with_atoms(
           2, square,
           {{{}, r, {}}, {{0.5, 0.5, 0}, r, {}}, {{0.5, 0, 0}, 0.5 * r, {}}, {{0, 0.5, 0}, 0.7 * r, {}}})},
      {"motif in space",
       with_atoms(
           3, cubic,
           {{{}, r, {}}, {{0.5, 0.5, 0.5}, r, {}}, {{0.5, 0, 0}, 0.5 * r, {}}, {{0, 0.5, 0}, 0.7 * r, {}}})},
      {"seven atoms",  // more than lanes keep
       with_atoms(2, square,
                  {{{}, 0.1 * r, {}},
                   {{0.5, 0.5, 0}, 0.1 * r, {}},
                   {{0.5, 0, 0}, 0.1 * r, {}},
                   {{0, 0.5, 0}, 0.1 * r, {}},
                   {{0.25, 0.5, 0}, 0.1 * r, {}},
                   {{0.25, 0.25, 0}, 0.1 * r, {}},
                   {{0.75, 0.25, 0}, 0.1 * r, {}}})},
      {"ellipsoid and ball", with_atoms(3, cubic, {ellipsoid(stout), {{0.5, 0.5, 0.5}, r, {}}})},
      {"two lattices", twisted}};
}

enum class Kind { drawn, near_rational, grazing, far, limited, leaving };
constexpr Kind kKinds[] = {Kind::drawn, Kind::near_rational, Kind::grazing,
                           Kind::far,   Kind::limited,       Kind::leaving};

// A query of one kind, and its limit.
Query query_of(Random& random, Kind kind, const Scene& scene, const Reduction& engine, double& limit) {
  const int d = scene.dimension;
  const Vec& u = scene.lattices[0].vectors[0];
  const double cell = std::fabs(u[0]) + std::fabs(u[1]) + std::fabs(u[2]);
  const double range = cell * (kind == Kind::far ? random.octave(0, 50) : 1);
  Query query;
  for (int k = 0; k < d; ++k) query.x[k] = random.between(-range, range);
  query.v = random.direction(d);
  if (kind == Kind::near_rational) {
    const std::int64_t n = std::int64_t{1} << random.below(7);
    do
      for (int k = 0; k < d; ++k) query.v[k] = static_cast<double>(random.integer(-n, n));
    while (query.v == Vec{});
    for (int k = 0; k < d && random.one_in(2); ++k)
      query.v[k] += random.between(-1, 1) * random.octave(-52, 0);
  }
  if (kind == Kind::limited) {
    limit = cell * random.octave(-6, 10);
    for (int k = 0; k < d; ++k) query.v[k] *= 3;
  }
  if (kind != Kind::grazing && kind != Kind::leaving) return query;
  const Flight flight = engine.fly(query);
  if (flight.outcome != Outcome::hit) return query;
  const ObstacleId id{flight.lattice, flight.atom, {flight.cell[0], flight.cell[1], flight.cell[2]}};
  for (int k = 0; k < d; ++k) query.x[k] += flight.time * query.v[k];
  if (kind == Kind::leaving) query.from = id, query.v = random.direction(d);
  if (kind == Kind::grazing) {  // from the surface back, and then along it, give or take some ulps
    const Vec along = collision_detail(scene, {query.x, query.v, {}}, Answer::hit(id, 0)).normal;
    query.v = d == 2 ? Vec{-along[1], along[0], 0} : Vec{-along[1], along[0], random.between(0, 1)};
    for (int k = 0; k < d; ++k) query.x[k] -= cell * random.octave(-2, 3) * query.v[k];
  }
  return query;
}

// Room for `count` flights, with nonsense in it: what a batch forgets to write is not zero by chance.
FlightTable spoiled(std::size_t count) {
  FlightTable flights;
  flights.resize(count);
  const FlightColumns columns = flights.columns();
  std::ranges::fill(columns.outcome, Outcome::error);
  std::ranges::fill(columns.stage, Stage::undecided);
  std::ranges::fill(columns.time_is_rounded, true);
  for (const auto column : {columns.lattice, columns.atom}) std::ranges::fill(column, -7);
  for (const auto column : columns.cell) std::ranges::fill(column, -7);
  std::ranges::fill(columns.time, -7.0);
  return flights;
}

// What differs between a batch and single flights, first of all in words.
struct Compared {
  long queries = 0, different = 0, left = 0, hits = 0, inside = 0, never = 0, rounded = 0;
  std::string first;

  void add(const Scene& scene, const Batch& batch, const QueryTable& table, Batch::Time time, int jobs = 1) {
    FlightTable flights = spoiled(table.size());
    const QueryColumns columns = table.columns();
    left += static_cast<long>(batch.fly(columns, flights.columns(), time, jobs));
    for (std::size_t i = 0; i < table.size(); ++i) {
      const Query query = table[i];
      const double limit = columns.max_time.empty() ? kNoLimit : columns.max_time[i];
      const Flight one = batch.one_at_a_time().fly(query, limit, time), many = flights[i];
      ++queries;
      hits += one.outcome == Outcome::hit, inside += one.outcome == Outcome::inside;
      never += one.outcome == Outcome::never, rounded += one.time_is_rounded;
      if (same_bits(one, many) && one.time_is_rounded == many.time_is_rounded) continue;
      if (different++ == 0)
        first = stream(scene, query) + "one  " + line(answer_of(one), 3) + "many " + line(answer_of(many), 3);
    }
  }

  void print(const std::string& what) const {
    std::cout << what << ": " << queries << " flights (" << left << " of them single ones), " << different
              << " differ" << std::endl;
  }
};

// Every kind of flight in every kind of scene.
Compared compare(const std::string& instructions, std::size_t count, std::uint64_t seed) {
  Compared compared;
  for (const double r : {0.3, 0.1, 0.02, 1e-3, 1e-6})  // of which three have times that are soon rounded
    for (const auto& [name, scene] : scenes_of(r)) {
      if (Reduction::beyond(scene)) continue;
      const Batch batch(scene, instructions);
      for (const Kind kind : kKinds) {
        QueryTable table;
        for (std::size_t i = 0; i < count; ++i) {
          Random random(seed, name, i * 8 + static_cast<std::size_t>(kind));
          double limit = kNoLimit;
          const Query query = query_of(random, kind, scene, batch.one_at_a_time(), limit);
          if (!flaw_of(query, scene)) table.push_back(query, limit);
        }
        for (const auto time : {Batch::Time::close, Batch::Time::rounded})
          compared.add(scene, batch, table, time);
      }
    }
  return compared;
}

// The families of hard cases, those of campaigns included; in each scene its cases together, and each with
// limits about its time.
Compared compare_families(const std::string& instructions, std::uint64_t count, std::uint64_t seed) {
  Compared compared;
  for (const cases::Target& target : cases::targets()) {
    QueryTable table;
    std::optional<Batch> batch;
    Scene scene;
    const auto fly = [&] {
      if (!batch || table.size() == 0) return;
      compared.add(scene, *batch, table, Batch::Time::close);
      compared.add(scene, *batch, table, Batch::Time::rounded);
      table.clear();
    };
    for (std::uint64_t index = 0; index < count; ++index) {
      const cases::Case one = target.make(seed, index);
      if (!batch || !(one.scene == scene)) {
        fly();
        scene = one.scene;
        batch.reset();
        if (!Reduction::beyond(scene)) batch.emplace(scene, instructions);
      }
      if (!batch) continue;
      table.push_back(one.query);
      const Flight flight = batch->one_at_a_time().fly(one.query);
      if (flight.outcome != Outcome::hit || !std::isfinite(flight.time)) continue;
      for (const double factor : {0.5, 1.0, 1 + 0x1p-40, 2.0})
        table.push_back(one.query, flight.time * factor);
    }
    fly();
  }
  return compared;
}

// What a certified batch is certain of, held against single answers.
struct Certain {
  long certain = 0, asked = 0, later = 0, at_limit = 0;

  void add(const Scene& scene, const oracle::CertifiedBatch& batch, const QueryTable& table) {
    FlightTable flights = spoiled(table.size());
    std::vector<std::size_t> uncertain;
    const QueryColumns columns = table.columns();
    batch.first_hits(columns, flights.columns(), uncertain, 2);
    std::size_t next = 0;
    for (std::size_t i = 0; i < table.size(); ++i) {
      ++asked;
      if (next < uncertain.size() && uncertain[next] == i) {
        ++next;
        continue;
      }
      ++certain;
      oracle::Request request;
      if (!columns.max_time.empty() && std::isfinite(columns.max_time[i]))
        request.max_time = columns.max_time[i];
      const Answer exact = batch.one_at_a_time().first_hit(table[i], request);
      later += exact.outcome == Outcome::later;
      INFO(stream(scene, table[i]) << line(answer_of(flights[i]), 3) << line(exact, 3));
      REQUIRE(same(answer_of(flights[i]), exact));
    }
  }
};

}  // namespace

TEST_CASE("A batch says what one flight at a time says, to the bit, with every set of instructions",
          "[engines][batch]") {
  for (const std::string& instructions : Batch::instruction_sets()) {
    DYNAMIC_SECTION(instructions) {
      const Compared compared = compare(instructions, 100, kSeed);
      compared.print(instructions);
      INFO(instructions << ": " << compared.first);
      CHECK(compared.different == 0);
      CHECK(compared.queries > 50'000);
      CHECK(compared.hits > 0.6 * compared.queries);
      CHECK(compared.never > 100);
      CHECK(compared.inside > 100);
      CHECK(compared.rounded > 0.2 * compared.queries);
      if (instructions == "none")
        CHECK(compared.left == compared.queries);
      else
        CHECK((compared.left > 0 && compared.left < 0.2 * compared.queries));
    }
  }
}

TEST_CASE("A batch says what one flight at a time says of the families of hard cases", "[engines][batch]") {
  for (const std::string& instructions : Batch::instruction_sets()) {
    if (instructions == "none") continue;
    DYNAMIC_SECTION(instructions) {
      const Compared compared = compare_families(instructions, 64, kSeed);
      compared.print(instructions + ", families");
      INFO(instructions << ": " << compared.first);
      CHECK(compared.different == 0);
      CHECK(compared.queries > 10'000);
      CHECK(compared.left < 0.6 * compared.queries);
    }
  }
}

TEST_CASE("Far out among ellipses a batch times hits as one flight does", "[engines][batch]") {
  Scene scene = unit_scene(2, 1);
  scene.lattices[0].vectors = {Vec{1, 1}, Vec{-1, 0.8662109375}, Vec{}};
  scene.lattices[0].atoms[0] = {{}, 0, {Vec{1, 0}, Vec{0, 0x1p-8}}};
  QueryTable table;
  Random random(kSeed, "far ellipses", 0);
  for (int i = 0; i < 4000; ++i)
    table.push_back({{0, random.octave(36, 43) * random.between(1, 2), 0}, random.direction(2), {}},
                    kNoLimit);
  Compared compared;
  for (const auto time : {Batch::Time::close, Batch::Time::rounded})
    compared.add(scene, Batch(scene), table, time);
  INFO(compared.first);
  CHECK(compared.different == 0);
  CHECK(compared.hits > 4000);  // 4 952 seen
}

TEST_CASE("What a batch cannot name or time is left to single flights: far cells, ends of the range",
          "[engines][batch]") {
  for (const std::string& instructions : Batch::instruction_sets()) {
    Compared compared;
    const auto fly = [&](const Scene& scene, const QueryTable& table) {
      const Batch batch(scene, instructions);
      compared.add(scene, batch, table, Batch::Time::close);
      compared.add(scene, batch, table, Batch::Time::rounded);
    };
    // Out of corridors, along the shortest vectors of cells that are upright, and of such that are not.
    for (const double skew : {0., 1., 1000.})
      for (const int dimension : {2, 3})
        for (const double radius : {0.1, dimension == 2 ? 1e-11 : 1e-6}) {
          Scene scene = unit_scene(dimension, radius);
          if (skew != 0) scene.lattices[0].vectors[1][0] = skew;
          QueryTable table;
          for (int k = 1; k <= 62; ++k)
            for (const double sign : {1., -1.}) {
              const double drift = sign * std::ldexp(1, -k);
              if (dimension == 2) table.push_back({{0, 0.5, 0}, {sign, drift, 0}, {}});
              if (dimension == 3) table.push_back({{0, 0, 0.5}, {1, 0.618, drift}, {}});
              if (dimension == 3) table.push_back({{0.5, 0.5, 0.5}, {0.53, -0.618, drift}, {}});
            }
          fly(scene, table);
        }
    // Starts far out.
    for (const double skew : {0., 1., 1000.})
      for (const int dimension : {2, 3}) {
        Scene scene = unit_scene(dimension, 0.1);
        if (skew != 0) scene.lattices[0].vectors[1][0] = skew;
        QueryTable table;
        const double z = dimension == 2 ? 0 : 0.4375;
        for (int k = 20; k <= 70; ++k)
          for (const double sign : {1., -1.}) {
            table.push_back({{sign * std::ldexp(1, k), 0.375, z}, {1, 0.618, z}, {}});
            table.push_back({{0.375, sign * std::ldexp(1, k), z}, {1, 0.618, z}, {}});
          }
        fly(scene, table);
      }
    // Times of 2^-60 and less in cells and at speeds near the ends of what lanes do: numbers below the
    // normal.
    for (const int dimension : {2, 3})
      for (const int length : {-390, 0, 390}) {
        Scene scene = unit_scene(dimension, std::ldexp(0.25, length));
        scene.lattices[0].atoms[0].position[0] = scene.lattices[0].atoms[0].radius;  // 0 is on its surface
        for (int k = 0; k < dimension; ++k)
          scene.lattices[0].vectors[k] = times_power_of_two(scene.lattices[0].vectors[k], length);
        QueryTable table;
        for (int speed = -480; speed <= 480; speed += 40)
          for (int k = 1; k <= 200; ++k)
            table.push_back({times_power_of_two({-1.1 * std::ldexp(1, -k), 0, 0}, length),
                             times_power_of_two({1.3, 0, 0}, speed),
                             {}});
        fly(scene, table);
      }
    INFO(instructions << ": " << compared.first);
    CHECK(compared.different == 0);
    CHECK(compared.hits > 1000);
  }
}

TEST_CASE("Ten million flights in batches are those of single flights", "[engines][batch][long]") {
  for (const std::string& instructions : Batch::instruction_sets()) {
    if (instructions == "none") continue;
    DYNAMIC_SECTION(instructions) {
      long queries = 0;
      for (std::uint64_t part = 1; part <= 20; ++part) {
        const Compared compared = compare(instructions, 700, kSeed + part),
                       families = compare_families(instructions, 512, kSeed + part);
        compared.print(instructions);
        families.print(instructions + ", families");
        INFO(instructions << ": " << compared.first << families.first);
        CHECK(compared.different + families.different == 0);
        queries += compared.queries;
      }
      CHECK(queries > 10'000'000);
    }
  }
}

TEST_CASE("Lanes leave at most 6 of 20 000 drawn flights to single flights", "[engines][batch]") {
  if (Batch::instruction_sets().size() == 1) return;  // there are no lanes
  for (const double r : {0.1, 1e-3, 1e-6})
    for (const auto& [name, scene] : scenes_of(r)) {
      const Batch batch(scene);
      QueryTable table;
      for (std::size_t i = 0; table.size() < 20'000; ++i) {
        Random random(kSeed, name, i);
        double limit;
        const Query query = query_of(random, Kind::drawn, scene, batch.one_at_a_time(), limit);
        if (batch.one_at_a_time().fly(query).outcome != Outcome::inside) table.push_back(query);
      }
      FlightTable flights;
      flights.resize(table.size());
      INFO(name << " at r = " << r);
      CHECK(batch.fly(table.columns(), flights.columns()) <= 6);  // of 20 000; seen: at most 2 in 10 000
    }
}

TEST_CASE("The length of a batch, its columns and its threads do not matter", "[engines][batch]") {
  const Scene scene = unit_scene(3, 0.05);
  const Batch batch(scene);
  QueryTable table;
  for (std::size_t i = 0; i < 10'000; ++i) {
    Random random(kSeed, "length", i);
    double limit;
    table.push_back(query_of(random, Kind::drawn, scene, batch.one_at_a_time(), limit));
  }
  Compared whole;
  for (const int jobs : {1, 2, 3, 7}) whole.add(scene, batch, table, Batch::Time::close, jobs);
  CHECK(whole.different == 0);
  constexpr std::size_t kMost = 200;
  const Flight untouched = spoiled(1)[0];
  for (std::size_t length = 0; length < 20; ++length)
    for (const std::size_t begin : {std::size_t{0}, std::size_t{1}, std::size_t{127}}) {
      FlightTable flights = spoiled(kMost);
      batch.fly(table.columns().part(begin, length), flights.columns().part(begin));
      for (std::size_t i = 0; i < kMost; ++i)
        REQUIRE(same_bits(
            flights[i], i < begin || i >= begin + length ? untouched : batch.one_at_a_time().fly(table[i])));
    }
  // Columns that are not wanted.
  std::vector<Outcome> outcomes(table.size());
  FlightColumns only_outcomes;
  only_outcomes.outcome = outcomes;
  batch.fly(table.columns(), only_outcomes);
  for (std::size_t i = 0; i < table.size(); ++i)
    REQUIRE(outcomes[i] == batch.one_at_a_time().fly(table[i]).outcome);
}

TEST_CASE("Columns that are missing or too short are refused", "[engines][batch]") {
  const Scene scene = unit_scene(3, 0.1);
  const Batch batch(scene);
  QueryTable table;
  for (int i = 0; i < 200; ++i)
    table.push_back({{0.5, 0.4, 0.3}, {0.3, 0.7, 0.01 * i}, ObstacleId{0, 0, {1, 2, 3}}}, 100);
  FlightTable flights = spoiled(table.size());
  const auto refused = [&](const auto& spoil, const std::string& column) {
    QueryColumns queries = table.columns();
    FlightColumns told = flights.columns();
    spoil(queries, told);
    const std::optional<std::string> flaw = flaw_of(queries, told, 3);
    REQUIRE(flaw);
    CHECK_THAT(*flaw, Catch::StartsWith("the column " + column + " "));
    CHECK_THROWS_AS(batch.fly(queries, told), InputError);
  };
  const auto shorter = [](auto& column) { column = column.first(199); };
  const auto missing = [](auto& column) { column = {}; };
  for (const std::size_t k : {0, 1, 2}) {
    const std::string at = "[" + std::to_string(k) + "]";
    if (k > 0) refused([&](auto& q, auto&) { missing(q.x[k]); }, "x" + at);
    refused([&](auto& q, auto&) { shorter(q.v[k]); }, "v" + at);
    refused([&](auto& q, auto&) { missing(q.v[k]); }, "v" + at);
    refused([&](auto& q, auto&) { shorter(q.from_cell[k]); }, "from_cell" + at);
    refused([&](auto& q, auto&) { missing(q.from_cell[k]); }, "from_cell" + at);
    refused([&](auto&, auto& f) { shorter(f.cell[k]); }, "cell" + at);
  }
  refused([&](auto& q, auto&) { shorter(q.max_time); }, "max_time");
  refused([&](auto& q, auto&) { shorter(q.from_lattice); }, "from_lattice");
  refused([&](auto& q, auto&) { missing(q.from_atom); }, "from_atom");
  refused([&](auto&, auto& f) { missing(f.outcome); }, "outcome");
  refused([&](auto&, auto& f) { f.outcome = f.outcome.first(1); }, "outcome");
  refused([&](auto&, auto& f) { shorter(f.stage); }, "stage");
  refused([&](auto&, auto& f) { shorter(f.time_is_rounded); }, "time_is_rounded");
  refused([&](auto&, auto& f) { shorter(f.lattice); }, "lattice");
  refused([&](auto&, auto& f) { shorter(f.atom); }, "atom");
  refused([&](auto&, auto& f) { shorter(f.time); }, "time");
  CHECK_FALSE(flaw_of(table.columns(), flights.columns(), 3));
  CHECK_NOTHROW(batch.fly(QueryColumns{}, FlightColumns{}));
  for (const double radius : {0.1, 0.6}) {  // the second is beyond the fast engine
    const oracle::CertifiedBatch certified(unit_scene(3, radius));
    std::vector<std::size_t> uncertain;
    QueryColumns queries = table.columns();
    FlightColumns told = flights.columns();
    CHECK_NOTHROW(certified.first_hits(queries, told, uncertain));
    missing(told.time);
    CHECK_THROWS_AS(certified.first_hits(queries, told, uncertain), InputError);
    told = flights.columns(), missing(told.time_is_rounded);
    CHECK_THROWS_AS(certified.first_hits(queries, told, uncertain), InputError);
    told = flights.columns(), shorter(queries.v[1]);
    CHECK_THROWS_AS(certified.first_hits(queries, told, uncertain), InputError);
  }
}

TEST_CASE("A query with a flaw is an error of its own in a batch", "[engines][batch]") {
  const double nan = std::nan(""), infinity = HUGE_VAL;
  for (const int dimension : {2, 3})
    for (const bool general : {false, true}) {
      Scene scene = unit_scene(dimension, 0.1);
      if (general) scene.lattices[0].vectors[0][1] = 0.25;
      const Batch batch(scene);
      QueryTable table;
      const Query good{{0.5, 0.4, 0}, {0.3, 0.7, 0}, {}};
      std::vector<Query> bad(9, good);
      bad[0].v = {}, bad[1].v[0] = nan, bad[2].v[1] = infinity, bad[3].x[0] = nan, bad[4].x[1] = -infinity;
      bad[5].from = ObstacleId{0, 3, {}}, bad[6].from = ObstacleId{0, 1, {}};
      bad[7].from = ObstacleId{0, -1, {}}, bad[8].from = ObstacleId{1, 0, {}};
      for (const Query& query : bad) table.push_back(good), table.push_back(query);
      FlightTable flights;
      flights.resize(table.size());
      batch.fly(table.columns(), flights.columns());
      for (std::size_t i = 0; i < table.size(); ++i) {
        INFO(i);
        CHECK(flights[i].outcome == (i % 2 == 0 ? batch.one_at_a_time().fly(good).outcome : Outcome::error));
      }
    }
}

TEST_CASE("Instructions that the processor has not are refused", "[engines][batch]") {
  CHECK(Batch::instruction_sets().back() == "none");
  CHECK_THROWS_AS(Batch(unit_scene(2, 0.1), "MMX"), UnsupportedError);
  CHECK_THROWS_AS(Batch(unit_scene(2, 9)), UnsupportedError);  // beyond the engine
  QueryTable table;
  Query far{{}, {1, 0, 0}, ObstacleId{0, 0, {*Integer::from_decimal("100000000000000000000"), 0, 0}}};
  CHECK_FALSE(table.push_back(far));
  CHECK(table.size() == 0);
}

TEST_CASE("What a certified batch is certain of is what certified says, to the bit", "[engines][batch]") {
  Certain counts;
  for (const double r : {0.3, 1e-3})
    for (const auto& [name, scene] : scenes_of(r)) {
      const oracle::CertifiedBatch batch(scene);
      for (const Kind kind : kKinds) {
        QueryTable table;
        for (std::size_t i = 0; i < 60; ++i) {
          Random random(kSeed + 2, name, i * 8 + static_cast<std::size_t>(kind));
          double limit = kNoLimit;
          const Query query = query_of(random, kind, scene, Reduction(scene), limit);
          table.push_back(query, limit);
          // On which side of its rounded time the exact one is, the batch must not guess.
          const Answer exact = batch.one_at_a_time().first_hit(query);
          if (kind != Kind::limited || exact.outcome != Outcome::hit) continue;
          counts.at_limit += table.push_back(query, *exact.time);
        }
        counts.add(scene, batch, table);
      }
    }
  CHECK(counts.certain > 0.7 * counts.asked);
  CHECK(counts.later > 50);
  CHECK(counts.at_limit > 500);
}
