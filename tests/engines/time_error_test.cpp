// How wrong a time of the reduction engine may be, in ulps: the figures of include/lorentz/reduction.hpp.
#include <algorithm>
#include <catch2/catch.hpp>

#include <lorentz/oracle.hpp>
#include "tests/engines/reduction_support.hpp"

using namespace lorentz;
using namespace lorentz::test;

namespace {

// Starts that are free, one in two a little off an obstacle's surface; directions isotropic, or nearly
// rational.
Query query_in(Draw& draw, const Scene& scene, const oracle::Oracle& oracle) {
  for (;;) {
    Query query{draw.vec(scene.dimension, -20, 20), draw.vec(scene.dimension, -1, 1), {}};
    if (draw.one_in(4)) {
      for (int i = 0; i < scene.dimension; ++i) query.v[i] = std::round(8 * query.v[i]) + draw.tiny(-50, -10);
    }
    if (oracle.is_free(query.x)) return query;
  }
}

// Against the oracle itself: `certified` hands out the engine's own times.
double worst_ulps(const Scene& scene, std::uint64_t seed, int cases, Reduction::Time time) {
  const Reduction engine(scene);
  const oracle::Oracle oracle(scene);
  Draw draw(seed);
  double worst = 0;
  for (int i = 0; i < cases; ++i) {
    const Query query = query_in(draw, scene, oracle);
    const Flight flight = engine.fly(query, kNoLimit, time);
    if (flight.outcome != Outcome::hit) continue;
    if (time == Reduction::Time::rounded && !flight.time_is_rounded) continue;
    const double exact = *oracle.first_hit(query).time;
    const double ulps = std::fabs(flight.time - exact) / (std::nextafter(exact, kNoLimit) - exact);
    if (ulps > worst) worst = ulps;
  }
  return worst;
}

}  // namespace

TEST_CASE("Times of drawn flights err by few ulps, those said to be rounded not at all",
          "[engines][reduction]") {
  for (const auto& [name, scene] : all_scenes()) {
    if (Reduction::beyond(scene)) continue;
    INFO(name);
    const bool balls = std::all_of(scene.lattices.begin(), scene.lattices.end(), [](const Lattice& lattice) {
      return std::all_of(lattice.atoms.begin(), lattice.atoms.end(),
                         [](const Atom& atom) { return atom.is_ball(); });
    });
    // In 20 000 flights of each scene: 5 (centred-rectangular) and 6 (ellipse) seen.
    CHECK(worst_ulps(scene, 31, 1'000, Reduction::Time::close) <= (balls ? 6 : 8));
    CHECK(worst_ulps(scene, 32, 500, Reduction::Time::rounded) == 0);
  }
}
