// Trajectories allocate nothing: counted, by replacing the global operator new. (Not under the address
// sanitizer, which has an operator new of its own.)
#ifndef __SANITIZE_ADDRESS__

#include <catch2/catch.hpp>
#include <cmath>

#include <lorentz/trajectory_batch.hpp>
#include "tests/support/count_allocations.hpp"

using lorentz::test::allocations;

TEST_CASE("Many collisions take no memory", "[trajectory][allocation]") {
  using namespace lorentz;
  const Scene scene = unit_scene(2, 0.1);
  const Batch engine(scene);
  const auto go_on = [](std::size_t, const Particle&, const Collision&) { return true; };
  for (const Precision precision : {Precision::binary64, Precision::double_double}) {
    Particles particles(engine, scene, precision);
    for (int i = 0; i < 200; ++i) particles.add(Query{{0.5, 0.25, 0}, {0.61 + 0.001 * i, 0.23, 0}, {}});
    Trajectory one(engine.one_at_a_time(), scene, {{0.5, 0.25, 0}, {0.61, 0.23, 0}, {}}, precision);
    particles.advance(HUGE_VAL, go_on);
    REQUIRE(one.advance());
    const long before = allocations;
    for (int n = 0; n < 100; ++n) particles.advance(HUGE_VAL, go_on);
    for (int n = 0; n < 100; ++n) one.advance();
    const long after = allocations;
    CHECK(after == before);
    CHECK(one.state().collisions == 101);
  }
}

#endif
