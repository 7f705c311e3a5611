// Time limits: at the time itself and next to it, of all who take one, at any speed.
#include <boost/multiprecision/mpfr.hpp>
#include <catch2/catch.hpp>

#include <array>
#include <iostream>
#include <map>
#include <optional>

#include <lorentz/batch.hpp>
#include <lorentz/certified.hpp>
#include <lorentz/engine_base.hpp>
#include <lorentz/geometry.hpp>
#include <lorentz/oracle.hpp>
#include <lorentz/scene_check.hpp>
#include "fuzz/families/family.hpp"
#include "tests/engines/reduction_support.hpp"

using namespace lorentz;
using namespace lorentz::test;

namespace {

constexpr std::uint64_t kSeed = 11;

// The time to 60 digits, which tells any two times of the cases here apart, or shows that they are equal.
using Decimal = boost::multiprecision::number<boost::multiprecision::mpfr_float_backend<80>>;
constexpr int kDigits = 60;

enum class Side { before, at, after };

Side side_of(const Answer& exact, double limit) {
  const Decimal time(exact.time_decimal), there(limit);
  if (abs(time - there) <= there * Decimal("1e-58")) return Side::at;
  return there < time ? Side::before : Side::after;
}

oracle::Request until(double limit) {
  oracle::Request request;
  request.max_time = limit;
  return request;
}

// The rounded time, its neighbours, and what is far off.
std::array<double, 7> limits_around(double time) {
  return {time, std::nextafter(time, 0), std::nextafter(time, kNoLimit), time / 2, 2 * time, 0, kNoLimit};
}

// Drawn cases of the scenes that reach the limit in every way: exact times that are binary64, times midway
// between two, times of subnormals and of endless flights, starts inside.
template <class Check>
void each(std::uint64_t count, const Check& check) {
  INFO("seed " << kSeed);
  for (const char* target : {"generic", "rounding", "tie", "boundary", "never", "mixture", "slender"})
    for (std::uint64_t index = 0; index < count; ++index) {
      const cases::Case one = cases::target_named(target)->make(kSeed, index);
      INFO(target << ' ' << index << '\n' << stream(one.scene, one.query));
      check(one.scene, one.query);
    }
}

// The same flights in other units and from another side: lengths 2^a times as large, coordinates exchanged
// and reflected.
struct View {
  int dimension, first;
  double unit;

  View(cases::Random& random, int of_dimension)
      : dimension(of_dimension),
        first(static_cast<int>(random.below(static_cast<std::uint64_t>(of_dimension)))),
        unit(std::ldexp(random.sign(), static_cast<int>(random.one_in(2) ? random.integer(-60, 60) : 0))) {}

  Vec turned(const Vec& a, double factor) const {
    Vec there{};
    for (int i = 0; i < dimension; ++i) there[i] = factor * a[(first + i) % dimension];
    return there;
  }
  Scene operator()(Scene scene) const {
    for (Lattice& lattice : scene.lattices) {
      for (int i = 0; i < dimension; ++i) lattice.vectors[i] = turned(lattice.vectors[i], unit);
      for (Atom& atom : lattice.atoms) {
        atom.position = turned(atom.position, unit), atom.radius *= std::fabs(unit);
        for (Vec& axis : atom.semiaxes) axis = turned(axis, unit);
      }
    }
    return scene;
  }
  Query operator()(const Query& query, double speed) const {
    return {turned(query.x, unit), turned(query.v, std::copysign(speed, unit)), query.from};
  }
};

// In which a flight passes the largest obstacle, about.
double chord_time(const Scene& scene, const Query& query) {
  double size = 0;
  for (const Lattice& lattice : scene.lattices)
    for (const Atom& atom : lattice.atoms)
      for (int i = 0; i < scene.dimension; ++i)
        size = std::max(size, length(semiaxes_of(atom, scene.dimension)[i]));
  return size / std::hypot(query.v[0], query.v[1], query.v[2]);  // whose square may overflow
}

bool has_tiny_component(const Vec& v) {
  const ScaledVelocity velocity(v);
  return Ray{v, velocity.scaled, nullptr, v}.has_tiny_component();
}

// Limits around a time: it and its neighbours, nearer and nearer, far off, and one of any size near a start.
std::vector<double> limits_near(cases::Random& random, double time) {
  std::vector<double> limits{time,     std::nextafter(time, 0),      std::nextafter(time, kNoLimit), time / 2,
                             2 * time, time * random.octave(-30, 30)};
  for (int bits = 20; bits <= 51; bits += static_cast<int>(random.integer(1, 12)))
    for (const double beside : {-1, 1}) limits.push_back(time * (1 + beside * std::ldexp(1, -bits)));
  return limits;
}

// What is asked in one scene, alone and in a batch, and the exact answers.
struct Asked {
  struct Question {
    Query query;
    double limit;
    Answer free, exact;
    bool near;  ///< the limit is within what double-double may not tell from the time
  };
  std::vector<Question> questions;
  QueryTable table;

  void add(Question question) {
    if (table.push_back(question.query, question.limit)) questions.push_back(std::move(question));
  }
};

struct Held {
  long cases = 0, questions = 0, wrong = 0, undecided = 0, undecided_far = 0, unlike = 0;
  std::map<Outcome, long> outcomes;
  std::string first;

  void note(const Scene& scene, const Asked::Question& one, const char* what, const Flight& flight) {
    if (!first.empty()) return;
    char limit[64];
    std::snprintf(limit, sizeof limit, "%a", one.limit);
    first = std::string(what) + ", limit " + limit + "\n" + stream(scene, one.query) + "given " +
            line(answer_of(flight), scene.dimension) + "exact " + line(one.exact, scene.dimension);
  }
  // `known`: without a limit it is decided.
  void hold(const Scene& scene, const Asked::Question& one, const Flight& flight, bool known) {
    ++questions;
    ++outcomes[flight.outcome];
    if (flight.outcome == Outcome::undecided) {
      undecided += known;
      undecided_far += known && !one.near;
      if (known && !one.near) note(scene, one, "undecided", flight);
      return;
    }
    const Answer given = answer_of(flight);
    const bool names = one.exact.outcome == Outcome::hit || one.exact.outcome == Outcome::inside;
    if (given.outcome == one.exact.outcome && (!names || given.obstacle == one.exact.obstacle)) return;
    ++wrong;
    note(scene, one, "wrong", flight);
  }
};

void ask_all(const Scene& scene, const Asked& asked, Held& held) {
  const Batch batch(scene);
  const Reduction& engine = batch.one_at_a_time();
  FlightTable flights;
  flights.resize(asked.questions.size());
  batch.fly(asked.table.columns(), flights.columns());
  for (std::size_t i = 0; i < asked.questions.size(); ++i) {
    const Asked::Question& one = asked.questions[i];
    const Flight flight = engine.fly(one.query, one.limit);
    // Whether a velocity with a tiny component leads nowhere is never decided.
    const bool known =
        engine.fly(one.query).outcome != Outcome::undecided && !has_tiny_component(one.query.v);
    held.hold(scene, one, flight, known);
    if (same_bits(flight, flights[i]) && same(engine.first_hit(one.query, one.limit), answer_of(flight)))
      continue;
    ++held.unlike;
    held.note(scene, one, "unlike in a batch, or by first_hit", flights[i]);
  }
}

// A row of cases that share a scene.
void ask_row(const cases::Target& target, std::uint64_t seed, std::uint64_t row, Held& held) {
  cases::Random random(seed, target.name(), row, cases::Use::rewordings);
  std::optional<View> view;
  std::optional<oracle::Oracle> oracle;
  Scene scene;
  Asked asked;
  for (std::uint64_t index = row * cases::kCasesPerScene; index < (row + 1) * cases::kCasesPerScene;
       ++index) {
    const cases::Case made = target.make(seed, index);
    if (!view) {
      view.emplace(random, made.scene.dimension);
      scene = (*view)(made.scene);
      if (flaw_of(scene) || oracle::dependence_in(scene) || Reduction::beyond(scene)) return;
      oracle.emplace(scene);
    }
    const Query query = (*view)(made.query, std::ldexp(1, static_cast<int>(random.integer(-40, 40))));
    if ((*view)(made.scene) != scene || flaw_of(query, scene)) continue;
    ++held.cases;
    const Answer free = oracle->first_hit(query);
    const double time = free.time.value_or(std::ldexp(1, static_cast<int>(random.integer(-40, 40))));
    for (const double limit : limits_near(random, time)) {
      Answer exact = free;
      if (free.outcome == Outcome::never || (free.time && limit < time)) exact = Answer::later();
      if (free.time && limit == time) exact = oracle->first_hit(query, until(limit));
      // Next to a surface any limit is near.
      const bool near = target.name() == "skin" ||
                        std::fabs(limit - time) <= 0x1p-10 * time + 0x1p-76 * chord_time(scene, query);
      if (std::isfinite(limit)) asked.add({query, limit, free, std::move(exact), near});
    }
  }
  ask_all(scene, asked, held);
}

Held hold_targets(std::uint64_t seed, std::uint64_t rows) {
  std::cout << "limits within ulps of the time, seed " << seed << '\n';
  Held all;
  for (const cases::Target& target : cases::targets()) {
    Held held;
    for (std::uint64_t row = 0; row < rows * (target.name() == "skin" ? 8 : 1); ++row)
      ask_row(target, seed, row, held);
    std::cout << "  " << target.name() << ": " << held.cases << " cases, " << held.questions << " questions, "
              << held.wrong << " wrong, " << held.unlike << " unlike in a batch, " << held.undecided
              << " undecided, " << held.undecided_far << " of them far from the time\n"
              << held.first << std::flush;
    all.cases += held.cases, all.questions += held.questions, all.wrong += held.wrong;
    all.undecided += held.undecided, all.undecided_far += held.undecided_far, all.unlike += held.unlike;
    for (const auto& [outcome, count] : held.outcomes) all.outcomes[outcome] += count;
  }
  std::cout << all.cases << " cases, " << all.questions << " questions, " << all.wrong << " wrong, "
            << all.undecided << " undecided, " << all.undecided_far << " far\n";
  return all;
}

}  // namespace

TEST_CASE(
    "Limits in units of the scaled velocity: zero and the absence of a limit stay, others stay above zero "
    "and finite",
    "[engines][time_limit]") {
  using Range = std::numeric_limits<double>;
  for (const int exponent : {-1070, -500, -3, 0, 3, 500, 1020}) {
    for (const double limit : {0.0, -1.0, -kNoLimit, kNoLimit}) CHECK(scaled_limit(limit, exponent) == limit);
    CHECK(std::isnan(scaled_limit(NAN, exponent)));
    for (const double limit : {Range::denorm_min(), Range::min(), 1.0, Range::max()})
      CHECK(scaled_limit(limit, exponent) ==
            std::clamp(std::scalbn(limit, exponent), Range::min(), Range::max()));
  }
}

TEST_CASE("A component is tiny below 2^-450 of a scaled velocity, unless it is zero as given",
          "[engines][time_limit]") {
  const auto is_tiny = [](double component, double given, int at) {
    Vec v{1, 1, 1}, given_v{1, 1, 1};
    v[at] = component, given_v[at] = given;
    return Ray{v, v, nullptr, given_v}.has_tiny_component();
  };
  for (int at = 0; at < 3; ++at)
    for (const double sign : {-1, 1}) {
      CHECK_FALSE(is_tiny(sign * kTinyComponent, sign, at));
      CHECK(is_tiny(std::nextafter(sign * kTinyComponent, 0), sign, at));
      CHECK(is_tiny(0, sign, at));
      CHECK_FALSE(is_tiny(0, 0, at));
    }
}

TEST_CASE("A hit is before a limit iff its exact time is, and certified says what the oracle says",
          "[engines][time_limit]") {
  std::map<Side, int> sides;
  std::map<Outcome, int> outcomes;
  each(160, [&](const Scene& scene, const Query& query) {
    const oracle::Oracle oracle(scene);
    const oracle::Certified certified(scene);
    oracle::Request digits;
    digits.digits = kDigits;
    const Answer free = oracle.first_hit(query, digits);
    ++outcomes[free.outcome];
    for (const double limit : limits_around(free.time.value_or(1))) {
      INFO("limit " << limit);
      const Answer exact = oracle.first_hit(query, until(limit));
      REQUIRE(same(certified.first_hit(query, until(limit)), exact));
      if (free.outcome == Outcome::inside) REQUIRE(same(exact, free));
      if (free.outcome == Outcome::never)
        REQUIRE(exact.outcome == (std::isinf(limit) ? Outcome::never : Outcome::later));
      if (free.outcome != Outcome::hit) continue;
      const Side side = std::isinf(limit) ? Side::after : side_of(free, limit);
      REQUIRE(exact.outcome == (side == Side::after ? Outcome::hit : Outcome::later));
      if (exact.outcome == Outcome::hit) REQUIRE(same(exact, free));
      if (limit == *free.time) ++sides[side];
    }
  });
  CHECK(sides[Side::before] > 340);       // 434 seen
  CHECK(sides[Side::at] > 64);            // 81 seen
  CHECK(sides[Side::after] > 350);        // 441 seen
  CHECK(outcomes[Outcome::never] > 110);  // 143 seen
  CHECK(outcomes[Outcome::inside] > 50);  // 85 seen
}

TEST_CASE("Limits within ulps of the time: every decided answer is right, alone and in a batch",
          "[engines][time_limit]") {
  const Held held = hold_targets(kSeed, 2);
  CHECK(held.wrong == 0);
  CHECK(held.unlike == 0);
  CHECK(held.undecided_far == 0);
}

TEST_CASE("Near a lattice vector a limit ends a flight in a batch as it ends it alone",
          "[engines][time_limit]") {
  // Alone, the line is seen to stay between two lattice planes: in double-double.
  const Scene cubic = unit_scene(3, 0.1177);
  const Query query{{-0.9145, 0.4325, -0.6452}, {-512, 256.00000000000006, -512}, {}};
  const Batch batch(cubic);
  QueryTable table;
  for (const double limit : {0x1p-25, 0x1p-7, 0x1p40}) table.push_back(query, limit);
  FlightTable flights;
  flights.resize(table.size());
  batch.fly(table.columns(), flights.columns());
  for (std::size_t i = 0; i < table.size(); ++i)
    CHECK(same_bits(flights[i], batch.one_at_a_time().fly(query, table.columns().max_time[i])));
  CHECK(flights[0].stage == Stage::double_double);
}

TEST_CASE("Limits within ulps of the time, a million flights", "[engines][time_limit][long]") {
  const Held held = hold_targets(kSeed + 1, 1000);
  CHECK(held.cases > 1'000'000);
  CHECK(held.wrong == 0);
  CHECK(held.unlike == 0);
  CHECK(held.undecided_far == 0);
}
