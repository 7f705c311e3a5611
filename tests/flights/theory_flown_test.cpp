// The limit laws against flights among small obstacles. All draws follow from the seed 20261122.
#include "statistics/theory/fit.hpp"
#include "statistics/theory/laws.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

#include <lorentz/certified.hpp>
#include <lorentz/geometry.hpp>
#include "question/cases/random.hpp"
#include "src/problem/scene_geometry.hpp"

using namespace lorentz;
using namespace lorentz::flights;

namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kFlights = 200'000;

// Somewhere in a box much wider than a common period of the lattices in sight.
Query uniform_start(cases::Random& random) {
  return {{random.between(-3e4, 3e4), random.between(-3e4, 3e4), 0}, random.direction(2), {}};
}

// On an obstacle, chosen by the perimeter per volume; all points of it alike, directions by the cosine law.
Query surface_start(const Scene& scene, cases::Random& random) {
  std::vector<double> surfaces;
  double all = 0;
  for (const Lattice& lattice : scene.lattices)
    surfaces.push_back(all += surface_of(lattice.atoms[0], 2) / cell_volume(lattice, 2));
  const double at = all * random.uniform();
  ObstacleId from;
  while (from.lattice + 1 < static_cast<int>(surfaces.size()) && at >= surfaces[from.lattice]) ++from.lattice;
  const Lattice& lattice = scene.lattices[from.lattice];
  Vec centre = lattice.atoms[0].position;
  for (int k = 0; k < 2; ++k) {
    const std::int64_t n = random.integer(-30'000, 30'000);
    from.cell[k] = n;
    centre = sum(centre, scaled(lattice.vectors[k], static_cast<double>(n)));
  }
  // x = A u, u on the unit circle, its perimeter |A u'|: by rejection. The normal is A^-T u.
  const auto axes = semiaxes_of(lattice.atoms[0], 2);
  const double longest = principal_semiaxes(lattice.atoms[0], 2)[0];
  double angle, length;
  Vec along;
  do {
    angle = 2 * kPi * random.uniform();
    along = sum(scaled(axes[0], -std::sin(angle)), scaled(axes[1], std::cos(angle)));
    length = std::sqrt(dot(along, along));
  } while (random.uniform() * longest > length);
  const Vec point = sum(scaled(axes[0], std::cos(angle)), scaled(axes[1], std::sin(angle)));
  along = scaled(along, 1 / length);
  Vec normal{along[1], -along[0], 0};
  if (dot(normal, point) < 0) normal = scaled(normal, -1);
  const double sine = 2 * random.uniform() - 1;
  return {sum(centre, point), sum(scaled(normal, std::sqrt(1 - sine * sine)), scaled(along, sine)), from};
}

ChiSquared flown(const Scene& scene, Ensemble ensemble, const std::string& name) {
  const oracle::Certified engine(scene);
  const Law law = law_of(scene, ensemble).value();
  std::vector<double> edges;
  for (int k = -6; k < 5; ++k)
    for (int j = 0; j < 8; ++j) edges.push_back(law.scale * std::ldexp(1 + j / 8.0, k));
  std::vector<std::uint64_t> counts(edges.size() + 1);
  Answer answer;
  for (std::uint64_t i = 0; i < kFlights; ++i) {
    cases::Random random(20261122, name, i);
    engine.first_hit(ensemble == Ensemble::uniform ? uniform_start(random) : surface_start(scene, random), {},
                     answer);
    REQUIRE((answer.outcome == Outcome::hit || answer.outcome == Outcome::inside));
    const double path = answer.outcome == Outcome::hit ? *answer.time : 0;
    ++counts[static_cast<std::size_t>(std::upper_bound(edges.begin(), edges.end(), path) - edges.begin())];
  }
  return chi_squared(edges, counts, kFlights, law.survival);
}

void check_flown(const Scene& scene, const std::string& name) {
  for (const auto ensemble : {Ensemble::uniform, Ensemble::surface}) {
    const std::string whole = name + (ensemble == Ensemble::uniform ? ", U" : ", C");
    const ChiSquared fit = flown(scene, ensemble, whole);
    INFO(whole << ": chi-squared " << fit.statistic << " / " << fit.degrees);
    CHECK(fit.degrees > 60);
    CHECK(fit.p_value.value() > 1e-4);
  }
}

Scene superposition(std::size_t lattices) {
  Scene scene = unit_scene(2, 2e-5);
  const double angles[] = {0, kPi / 5, kPi / 7}, sizes[] = {1, 0.9, 1.3};
  for (std::size_t i = 1; i < lattices; ++i) {
    Lattice next = scene.lattices[0];
    const double c = sizes[i] * std::cos(angles[i]), s = sizes[i] * std::sin(angles[i]);
    next.vectors = {{{c, s, 0}, {-s, c, 0}}};
    next.atoms[0].radius = i == 1 ? 4e-5 : 2e-5;
    scene.lattices.push_back(next);
  }
  return scene;
}

}  // namespace

TEST_CASE("Flown: one lattice, two, three, from both ensembles", "[flights][flown]") {
  for (const std::size_t lattices : {1, 2, 3})
    check_flown(superposition(lattices), std::to_string(lattices) + " lattices");
}

TEST_CASE("Flown: ellipses, and superposed with discs", "[flights][flown]") {
  Scene ellipses = superposition(1), both = superposition(2);
  ellipses.lattices[0].atoms[0] = {{}, 0, {{1e-4, 3e-5, 0}, {-5e-6, 1e-5, 0}}};
  both.lattices[0] = ellipses.lattices[0];
  check_flown(ellipses, "ellipses");
  check_flown(both, "ellipses and discs");
}
