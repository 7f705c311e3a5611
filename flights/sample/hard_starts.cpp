#include "flights/sample/hard_starts.hpp"

#include <lorentz/geometry.hpp>
#include "cases/hard_moves.hpp"
#include "cases/integer_vectors.hpp"
#include "cases/ulps.hpp"

namespace lorentz::flights {

using cases::Random;

Vec near_rational_direction(Random& random, const Scene& scene) {
  constexpr std::int64_t kRange = 9, kUlps = 3;
  const int d = scene.dimension;
  const Lattice& lattice = scene.lattices[random.below(scene.lattices.size())];
  Vec v = cases::cartesian(lattice, cases::drawn_primitive(random, d, kRange));
  if (random.one_in(2)) {
    cases::jitter(random, v, d, kUlps);
    return v;
  }
  const Vec aside = cases::cartesian(lattice, cases::drawn_primitive(random, d, kRange));
  return sum(v, scaled(aside, random.sign() * random.octave(-52, -40)));
}

bool move_to_graze(Random& random, const Scene& scene, const oracle::Oracle& oracle, Query& start) {
  return cases::move_to_edge(random.sign() * random.octave(-52, -40), scene, oracle, start);
}

}  // namespace lorentz::flights
