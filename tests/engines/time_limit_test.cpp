// Time limits: at the time itself and next to it, of all who take one, at any speed.
#include <boost/multiprecision/mpfr.hpp>
#include <catch2/catch.hpp>

#include <array>

#include <lorentz/certified.hpp>
#include <lorentz/oracle.hpp>
#include "cases/families/target.hpp"
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

// What a flight comes to up to a limit, if without one it comes to `free`: the same, or nothing before it.
// (Of what comes after a limit any or nothing is found.)
bool is_cut(const Flight& free, const Flight& limited, double limit) {
  constexpr double kNearly = 1 - 1e-9;
  if (limited.outcome == Outcome::undecided || free.outcome == Outcome::undecided) return true;
  if (limited.outcome == free.outcome && limited.lattice == free.lattice && limited.atom == free.atom &&
      limited.cell == free.cell)
    return true;
  const auto is_after = [&](const Flight& flight) {
    return flight.outcome == Outcome::never ||
           (flight.outcome == Outcome::hit && flight.time >= limit * kNearly);
  };
  return is_after(free) && is_after(limited);
}

}  // namespace

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
      if (free.outcome == Outcome::never) REQUIRE(exact.outcome == Outcome::later);
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

TEST_CASE("A prepared direction keeps the limit, at any speed", "[engines][time_limit]") {
  Draw draw(12);
  INFO("seed 12");
  std::map<Outcome, int> outcomes;
  each(100, [&](const Scene& scene, const Query& drawn) {
    if (Reduction::beyond(scene)) return;
    const Reduction engine(scene);
    Query query = drawn;
    const double speed = draw.between(1, 3) * std::ldexp(1, static_cast<int>(draw.below(41)) - 20);
    for (double& component : query.v) component *= speed;
    if (flaw_of(query, scene)) return;
    const ObstacleId* from = query.from ? &*query.from : nullptr;
    const Reduction::Direction direction = engine.direction(query.v);
    const Flight free = engine.fly(query);
    for (const double limit : limits_around(free.outcome == Outcome::hit ? free.time : 1 / speed))
      for (const auto time : {Reduction::Time::close, Reduction::Time::rounded}) {
        INFO("speed times " << speed << ", limit " << limit);
        const Flight limited = engine.fly(query, limit, time);
        REQUIRE(is_cut(free, limited, limit));
        REQUIRE(same_bits(engine.fly(direction, query.x, from, limit, time), limited));
        ++outcomes[limited.outcome];
      }
  });
  CHECK(outcomes[Outcome::hit] > 3600);    // 4 602 seen
  CHECK(outcomes[Outcome::never] > 2300);  // 2 956 seen
}
