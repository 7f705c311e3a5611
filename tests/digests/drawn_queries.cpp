#include "tests/digests/drawn_queries.hpp"

#include <cmath>

#include <lorentz/geometry.hpp>
#include "question/cases/box.hpp"
#include "tests/digests/scenes.hpp"

namespace lorentz::digests {
namespace {

using cases::Random;

Query uniform(Random& random, const Scene& scene) {
  return {cases::Box::of(scene).point(random), random.direction(scene.dimension), {}};
}

// Directions a few ulps from a lattice vector with small coefficients.
Query nearly_rational(Random& random, const Scene& scene) {
  Query query = uniform(random, scene);
  query.v = {};
  for (int i = 0; i < scene.dimension; ++i) {
    const auto n = static_cast<double>(random.integer(i == 0 ? 1 : -20, 20));
    query.v = sum(query.v, scaled(scene.lattices[0].vectors[i], n));
  }
  for (int i = 0; i < scene.dimension; ++i)
    query.v[i] *= 1 + static_cast<double>(random.integer(-8, 8)) * 0x1p-52;
  return query;
}

// A random vector orthogonal to `d`, with the same length.
Vec across(Random& random, const Vec& d, int dimension) {
  if (dimension == 2) return scaled({-d[1], d[0], 0}, random.sign());
  const Vec normal = cross(d, random.direction(3));
  return scaled(normal, length(d) / length(normal));
}

// A flight that touches a ball about ten cells away, up to rounding: it hits or passes.
Query grazing(Random& random, const Scene& scene) {
  Query query = uniform(random, scene);
  const Lattice& lattice = scene.lattices[0];
  Vec d = sum(lattice.atoms[0].position, scaled(query.x, -1));
  for (int i = 0; i < scene.dimension; ++i)
    d = sum(d, scaled(lattice.vectors[i], static_cast<double>(random.integer(-10, 10))));
  const double sine = lattice.atoms[0].radius / length(d);
  if (!(sine < 1)) return query;
  query.v = sum(scaled(d, std::sqrt(1 - sine * sine)), scaled(across(random, d, scene.dimension), sine));
  return query;
}

// A start so far away that few digits are left for the place within a cell.
Query far(Random& random, const Scene& scene) {
  Query query = uniform(random, scene);
  for (int i = 0; i < scene.dimension; ++i)
    query.x =
        sum(query.x, scaled(scene.lattices[0].vectors[i], std::round(random.sign() * random.octave(10, 40))));
  query.v = scaled(query.v, random.octave(-600, 600));
  return query;
}

}  // namespace

Query QueryFamily::query(std::uint64_t index) const {
  Random random(kSeed, name, index);
  return draw(random, scene);
}

const std::vector<QueryFamily>& query_families() {
  static const std::vector<QueryFamily> families{
      {"discs", square(0.1), uniform},
      {"small-discs", square(1e-5), uniform},
      {"discs-near-rational", square(0.01), nearly_rational, false},
      {"discs-grazing", square(0.1), grazing},
      {"discs-far", square(0.05), far},
      {"oblique-motif", oblique_motif(), uniform},
      {"superposition", superposition(), uniform},
      {"ellipses", leaning_ellipses(), uniform, false},
      {"ellipses-near-rational", leaning_ellipses(), nearly_rational, false},
      {"spheres", unit_scene(3, 0.1), uniform},
      {"small-spheres", unit_scene(3, 1e-4), uniform, false},
      {"spheres-near-rational", unit_scene(3, 0.05), nearly_rational, false},
      {"spheres-grazing", unit_scene(3, 0.1), grazing},
      {"spheres-far", unit_scene(3, 0.1), far},
      {"close-packing", close_packing(), uniform},
      {"close-packing-grazing", close_packing(), grazing},
      {"ellipsoids", leaning_ellipsoids(), uniform, false},
      {"ellipsoids-near-rational", leaning_ellipsoids(), nearly_rational, false},
  };
  return families;
}

}  // namespace lorentz::digests
