// What every test of the reduction engine does with a case: run it in all ways, and hold it against the
// oracle.
#pragma once

#include <catch2/catch.hpp>

#include <cstring>
#include <limits>

#include <lorentz/oracle.hpp>
#include <lorentz/reduction.hpp>
#include "tests/support/support.hpp"

namespace lorentz::test {

inline constexpr double kNoLimit = std::numeric_limits<double>::infinity();

struct Count {
  long cases = 0, hit = 0, never = 0, inside = 0;
  StageTally stages;
  double worst_ulps = 0;
};

inline bool same_bits(const Flight& a, const Flight& b) {
  return a.outcome == b.outcome && a.stage == b.stage && a.lattice == b.lattice && a.atom == b.atom &&
         a.cell == b.cell && std::memcmp(&a.time, &b.time, sizeof a.time) == 0;
}

// One query in one scene, all ways. Everything that is not `undecided` must be the oracle's answer.
inline void check(const Scene& scene, const Query& query, Count& count) {
  const Reduction fused(scene), split(scene, Reduction::Processor::without_fma);
  const Answer exact = oracle::Oracle(scene).first_hit(query);
  const Flight flight = fused.fly(query), rounded = fused.fly(query, kNoLimit, Reduction::Time::rounded);
  INFO(stream(scene, query));
  ++count.cases;
  count.stages.count(flight.stage);
  REQUIRE(same_bits(flight, split.fly(query)));
  REQUIRE(same_bits(rounded, split.fly(query, kNoLimit, Reduction::Time::rounded)));
  REQUIRE((flight.outcome == Outcome::undecided) == (flight.stage == Stage::undecided));
  if (flight.outcome == Outcome::undecided) return;
  const Answer given = answer_of(flight);
  INFO("given " << line(given, scene.dimension) << "exact " << line(exact, scene.dimension));
  REQUIRE(given.outcome == exact.outcome);
  count.never += exact.outcome == Outcome::never;
  if (exact.outcome == Outcome::never) return;
  REQUIRE(given.obstacle == exact.obstacle);
  count.inside += exact.outcome == Outcome::inside;
  if (exact.outcome != Outcome::hit) return;
  ++count.hit;
  if (rounded.time_is_rounded) REQUIRE(rounded.time == *exact.time);
  const double ulp = std::nextafter(*exact.time, kNoLimit) - *exact.time;
  if (*exact.time > 1e-12)
    count.worst_ulps = std::max(count.worst_ulps, std::fabs(flight.time - *exact.time) / ulp);
}

inline Query hard_query(Draw& draw, Style style, const Scene& scene) {
  Query query = query_of(draw, style, scene);
  if (draw.one_in(8)) query.v[draw.below(scene.dimension)] *= std::exp2(draw.between(-70, 0));
  if (draw.one_in(8)) {
    const double speed = std::exp2(draw.between(-1020, 1000));
    Vec v = query.v;
    for (double& component : v) component *= speed;
    if (v != Vec{} && std::isfinite(v[0] + v[1] + v[2])) query.v = v;
  }
  if (draw.one_in(8))
    for (int i = 0; i < scene.dimension; ++i) query.x[i] += draw.fraction(1, 1'000'000);
  return query.v == Vec{} ? Query{query.x, {1, 0, 0}, query.from} : query;
}

/// Hard queries in drawn scenes, all dimensions and styles: scene_maker(draw, style, dimension).
template <class SceneMaker>
Count campaign(std::uint64_t seed, long cases, SceneMaker scene_maker) {
  Count count;
  for (const int dimension : {2, 3})
    for (const Style style : {Style::generic, Style::grid, Style::near_grid}) {
      Draw draw(seed + 10 * dimension + static_cast<int>(style));
      for (long i = 0; i < cases; ++i) {
        const Scene scene = scene_maker(draw, style, dimension);
        check(scene, hard_query(draw, style, scene), count);
      }
    }
  return count;
}

}  // namespace lorentz::test
