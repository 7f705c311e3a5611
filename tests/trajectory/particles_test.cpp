// Many particles at once.
#include <catch2/catch.hpp>
#include <cmath>

#include <lorentz/trajectory_batch.hpp>
#include "tests/support/scenes.hpp"
#include "tests/support/support.hpp"

using namespace lorentz;
using namespace lorentz::test;

namespace {

constexpr double kForEver = HUGE_VAL;

bool same(const Particle& a, const Particle& b) {
  return a.lattice == b.lattice && a.atom == b.atom && a.cell == b.cell && a.leaves == b.leaves &&
         a.offset == b.offset && a.offset_low == b.offset_low && a.velocity == b.velocity &&
         a.velocity_low == b.velocity_low && a.time == b.time && a.time_low == b.time_low &&
         a.collisions == b.collisions;
}

Scene motif(int dimension) {
  Scene scene = unit_scene(dimension, 0.2);
  scene.lattices[0].atoms.push_back({{0.5, 0, 0}, 0, {{0.1, 0.02, 0}, {0, 0.08, 0}, {0.01, 0, 0.1}}});
  scene.lattices[0].atoms[1].semiaxes.resize(static_cast<std::size_t>(dimension));
  return scene;
}

bool go_on(std::size_t, const Particle&, const Collision&) {
  return true;
}

}  // namespace

TEST_CASE("Particles in a batch go where each goes alone, to the bit", "[trajectory]") {
  constexpr std::size_t kParticles = 300;  // two blocks and a part
  for (const Scene& scene : {unit_scene(2, 0.1), unit_scene(2, 1e-5), unit_scene(3, 0.1), unit_scene(3, 1e-3),
                             motif(2), motif(3), two_lattices()})
    for (const Precision precision : {Precision::binary64, Precision::double_double}) {
      const Batch engine(scene);
      Particles particles(engine, scene, precision);
      std::vector<Trajectory> alone;
      Draw draw(31);
      for (std::size_t i = 0; i < kParticles; ++i) {
        const Query start = start_between(draw, scene.dimension);
        particles.add(start);
        alone.emplace_back(engine.one_at_a_time(), scene, start, precision);
      }
      for (int n = 0; n < 20; ++n)
        particles.advance(kForEver, [&](std::size_t i, const Particle& particle, const Collision& collision) {
          REQUIRE(alone[i].advance());
          REQUIRE(same(particle, alone[i].state()));
          REQUIRE(collision.flight == alone[i].collision().flight);
          REQUIRE(collision.normal == alone[i].collision().normal);
          return true;
        });
      for (std::size_t i = 0; i < kParticles; ++i) CHECK(particles[i].collisions == 20);
      const double until = 3 * particles[0].time;
      while (particles.advance(until, go_on) > 0) continue;
      for (std::size_t i = 0; i < kParticles; ++i) {
        while (alone[i].advance(until)) continue;
        REQUIRE(same(particles[i], alone[i].state()));
        REQUIRE(particles.stop(i) == alone[i].stop());
      }
    }
}

TEST_CASE("Particles in a batch stop one by one", "[trajectory]") {
  const Scene scene = unit_scene(2, 0.1);
  const Batch engine(scene);
  Particles particles(engine, scene);
  particles.add(Query{{0.5, 0.5, 0}, {1, 0, 0}, {}});        // for ever
  particles.add(Query{{0.5, 0.25, 0}, {0.3, 0.7, 0}, {}});   // goes on
  particles.add(Query{{0, 0, 0}, {1, 0, 0}, {}});            // inside
  particles.add(Query{{0.25, 0.25, 0}, {0.3, 0.5, 0}, {}});  // until its third collision
  const auto visit = [](std::size_t i, const Particle& particle, const Collision&) {
    return i != 3 || particle.collisions < 3;
  };
  for (int n = 0; n < 10; ++n) particles.advance(kForEver, visit);
  CHECK(particles.going() == 1);
  CHECK(particles.stop(0) == Stop::never);
  CHECK(particles.stop(1) == Stop::none);
  CHECK(particles[1].collisions == 10);
  CHECK(particles.stop(2) == Stop::inside);
  CHECK(particles.stop(3) == Stop::condition);
  CHECK(particles[3].collisions == 3);
  while (particles.advance(1000, go_on) > 0) continue;
  CHECK(particles.stop(1) == Stop::time);
  CHECK(particles[1].time == 1000);
  CHECK(particles[3].collisions == 3);
  // Nothing is left of those that are cleared away.
  particles.clear();
  CHECK(particles.size() == 0);
  particles.add(Query{{0.5, 0.25, 0}, {0.3, 0.7, 0}, {}});
  CHECK(particles.going() == 1);
  CHECK(particles.stop(0) == Stop::none);
  while (particles.advance(10, go_on) > 0) continue;
  CHECK(particles.stop(0) == Stop::time);
}
