// published-faults: queries on which the efficient algorithm of Kraemer, Kryukov and Sanders (2016), as
// published, goes wrong (docs/published.md). The examples given there come first, then constructions of each
// kind.
//
// Skipped disc: a flight leaves the disc (0, 0), and passes the column of its own centre at the height b,
// with r < b < eps = r sqrt(1 + m^2), m the slope. The first step's tolerance is 2b instead of eps + b. So a
// disc at the convergent (q, p) with 2b < p - q m < eps + b is met but passed over. Therefore m = (p - t) / q
// for a drawn t between the two.
#include <cmath>

#include <lorentz/geometry.hpp>
#include "fuzz/families/family.hpp"
#include "question/cases/drawn_flights.hpp"
#include "question/cases/integer_vectors.hpp"
#include "question/cases/scenes.hpp"
#include "question/cases/ulps.hpp"

namespace lorentz::cases {
namespace {

struct FaultExample {
  int dimension;
  double radius;
  Vec x, v;
  bool leaving;
  const char* tag;
  std::int64_t ulps_off = 0;  // ulps by which x is moved to the left and upwards, off the disc
};

const FaultExample kExamples[] = {
    {2, 0.2, {-9.0 / 205, 8.0 / 41}, {9, 5}, true, "skipped-disc"},
    {2, 0.05, {-7.0 / 500, 6.0 / 125}, {8, 7}, true, "skipped-disc"},
    {2, 0.2, {-9.0 / 205, 8.0 / 41}, {9, 5}, false, "skipped-disc", 1},
    {2, 0.05, {-7.0 / 500, 6.0 / 125}, {8, 7}, false, "skipped-disc", 1},
    {2, 1.0 / 81, {0, 0.878597}, {2, 1}, false, "endless-channel"},
    {2, 1.0 / 81, {0, 0.378597}, {2, 1}, false, "endless-channel"},
    {2, 1e-3, {0, 0.3}, {1, 2.5 * 1e-3}, false, "slow-drift"},
    {2, 1e-7, {0, 0.3}, {1, 2.5 * 1e-7}, false, "slow-drift"},
    {3, 0.2, {0.8, 0.2, 0.5}, {-25, 2, -1}, false, "late-sphere"},
    {2, 0.1, {0.5, 0.3}, {1, 0}, false, "along-axis"},
    {3, 0.1, {0.5, 0.3, 0.2}, {1, 0.5, 0}, false, "along-axis"},
};
constexpr std::uint64_t kExampleCount = sizeof kExamples / sizeof kExamples[0];

void example(std::uint64_t index, NumberFormat precision, Case& made) {
  const FaultExample& one = kExamples[index];
  made = {unit_scene(one.dimension, one.radius), {one.x, one.v, {}}, {"example", one.tag}};
  Vec& x = made.query.x;
  if (one.ulps_off != 0) x = {moved(x[0], -one.ulps_off, precision), moved(x[1], one.ulps_off, precision)};
  if (one.leaving) made.query.from = ObstacleId{};
}

Query skipped_disc(Random& random, NumberFormat precision, double r) {
  const double q = random.whole(1, 4), p = random.whole(1, static_cast<std::int64_t>(q));
  double slope = p / q, b = 0;
  for (int step = 0; step < 3; ++step) {  // eps depends weakly on the slope
    const double eps = r * std::sqrt(1 + slope * slope);
    b = r + (eps - r) * random.between(0.05, 0.95);
    slope = (p - random.between(2 * b, eps + b)) / q;
  }
  // Where y = b + m x leaves the disc.
  const double m2 = 1 + slope * slope;
  const double x = (-b * slope + std::sqrt(std::max(0.0, r * r * m2 - b * b))) / m2;
  Query query{{x, b + slope * x}, {1, slope}, {}};
  if (random.one_in(2))
    query.from = ObstacleId{};
  else
    query.x = {moved(query.x[0], -2, precision), moved(query.x[1], 2, precision)};  // x_1 < 0 < x_2: outwards
  query.v = scaled(query.v, random.octave(-3, 3));
  return query;
}

// A flight along a small integer vector, in an open corridor.
Query endless_channel(Random& random, double r) {
  IntVec g;
  do g = {random.integer(1, 7), random.integer(1, 7), 0};
  while (content_of(g) != 1 || r * std::sqrt(static_cast<double>(dot(g, g))) > 0.49);
  const double edge = r * std::sqrt(static_cast<double>(dot(g, g)));  // rows at whole numbers, in g x .
  const double height = edge + (1 - 2 * edge) * random.uniform();
  const double x0 = random.one_in(2) ? 0.0 : random.uniform();
  return {{x0, (height + static_cast<double>(g[1]) * x0) / static_cast<double>(g[0])}, to_vec(g), {}};
}

Query late_sphere(Random& random, const Scene& scene) {
  Query query = free_flight(random, scene);
  if (random.one_in(2))  // nearly along an axis, past many spheres
    query.v = {random.whole(5, 40), random.between(-3, 3), random.between(-3, 3)};
  return query;
}

Query along_axis(Random& random, const Scene& scene) {
  Query query = free_flight(random, scene);
  query.v[random.axis(scene.dimension)] = 0;
  return query;
}

void make_published(Source& source, Case& made) {
  if (source.index < kExampleCount) return example(source.index, source.precision, made);
  Random &drawn = source.scene, &random = source.random;
  const std::string_view kind = drawn_tag(
      drawn, made.tags,
      {"skipped-disc", "skipped-disc", "endless-channel", "slow-drift", "late-sphere", "along-axis"});
  const double r = kind == "endless-channel" ? drawn.octave(-6, -4)
                   : kind == "slow-drift"    ? drawn.octave(source.is_wide() ? -24 : -16, -6)
                                             : drawn.between(0.05, kind == "late-sphere" ? 0.3 : 0.2);
  const bool in_space = kind == "late-sphere" || (kind == "along-axis" && drawn.one_in(2));
  made.scene = unit_scene(in_space ? 3 : 2, r);
  Query& query = made.query;
  if (kind == "skipped-disc")
    query = skipped_disc(random, source.precision, r);
  else if (kind == "endless-channel")
    query = endless_channel(random, r);
  else if (kind == "slow-drift")
    query = {{0, random.between(0.26, 0.45)}, {1, r * random.between(2.1, 3)}, {}};
  else if (kind == "late-sphere")
    query = late_sphere(random, made.scene);
  else
    query = along_axis(random, made.scene);
  query = Symmetry(random, made.scene.dimension)(query);
}

}  // namespace

Family published_faults() {
  return {
      "published-faults",
      "Known faults of the published efficient algorithm: the examples, and constructions like them.",
      {{"example", "one of the smallest examples known"},
       {"skipped-disc", "leaves a disc so that the first step's tolerance, too small, passes over the next"},
       {"endless-channel", "a channel in which the map does not come back to its start"},
       {"slow-drift", "a slope of about 2.5 r: 0.28 / r passes, no bound of r^(-1/2)"},
       {"late-sphere", "a step of 1 - 2r past a missed sphere lands inside the next"},
       {"along-axis", "a zero component, for which there is no octant"}},
      make_published};
}

}  // namespace lorentz::cases
