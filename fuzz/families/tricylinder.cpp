// tricylinder: lines that meet the three shadows of a sphere but not the sphere.
//
// With d = c - x and h = v x d, the line meets the disc that is the sphere's shadow in the plane across axis
// i iff |h_i| < r sqrt(v^2 - v_i^2), and the sphere iff |h| < r |v|. Seen along v the three conditions are
// strips about the disc's centre whose edges touch the disc. They cut out a hexagon around it, and an
// algorithm that works in projections takes the hexagon's corners for hits. Here h lies on a ray from the
// centre, drawn until the ray leaves the hexagon farther out than the disc. The relative distance from the
// disc's edge is in a drawn decade, down to 1e-14; one in three is just inside, as a hit.
// x = c - (h x v) / v^2 - s v.
#include <cmath>

#include <lorentz/geometry.hpp>
#include "fuzz/families/family.hpp"
#include "question/cases/integer_vectors.hpp"

namespace lorentz::cases {
namespace {

constexpr const char* kMisses[] = {"miss-1e-2",  "miss-1e-4",  "miss-1e-6", "miss-1e-8",
                                   "miss-1e-10", "miss-1e-12", "miss-1e-14"};
constexpr double kTop[] = {0.6, 1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12};
constexpr double kBottom[] = {1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12, 1e-14};

// A line relative to a ball: its direction, the unit direction of h, and how far the hexagon reaches along h,
// in units of r |v|.
struct HexagonRay {
  Vec v, h;
  double reach;
};

HexagonRay drawn_ray(Random& random) {
  HexagonRay ray{};
  for (int tries = 0; tries < 50; ++tries) {
    ray.v = random.direction(3);
    ray.h = cross(ray.v, random.direction(3));
    const double size = length(ray.h);
    if (size < 0.1) continue;
    ray.h = scaled(ray.h, 1 / size);
    ray.reach = 10;
    for (int i = 0; i < 3; ++i)
      if (ray.h[i] != 0)
        ray.reach = std::min(ray.reach, std::sqrt(1 - ray.v[i] * ray.v[i]) / std::fabs(ray.h[i]));
    if (ray.reach > 1.02) break;
  }
  return ray;
}

void make_tricylinder(Source& source, Case& made) {
  Random &drawn = source.scene, &random = source.random;
  const double r = drawn.one_in(2) ? drawn.between(0.05, 0.3) : drawn.octave(-9, -2);
  made.scene = unit_scene(3, r);
  const bool cell = tagged(made.tags, drawn.one_in(4), "other-cell");
  if (cell)  // the transformed sphere is an ellipsoid, and its shadows are wider still
    made.scene.lattices[0].vectors = {Vec{1, 0, 0}, Vec{0.25, 1, 0}, Vec{-0.125, 0.25, 1.125}};
  const HexagonRay ray = drawn_ray(random);
  // Decades that an ulp of the position does not blur: 2^-53 and 2^-24.
  const std::uint64_t decade = random.below(source.is_wide() ? 7 : 3);
  const double margin =
      kBottom[decade] + (kTop[decade] - kBottom[decade]) * random.uniform() * random.uniform();
  const bool hit = random.one_in(3);
  double out = 1 + std::min(margin, 0.98 * (ray.reach - 1));
  if (out < 1 + kBottom[decade]) out = 1 + kBottom[decade];
  if (hit) out = 1 - margin * 0.9;
  tagged(made.tags, hit, "hit", kMisses[decade]);
  const double along = r * random.between(0.5, 1.5);
  const Vec across = scaled(cross(ray.h, ray.v), r * out);  // v x (h x v) = h for unit v
  const Vec centre = cell ? Vec{} : to_vec(drawn_integers(random, 3, 2));
  made.query = {plus(centre, -1, plus(across, along, ray.v)), ray.v, {}};
}

}  // namespace

Family tricylinder() {
  return {"tricylinder",
          "Lines that meet the three projected discs of a sphere, and miss the sphere or just hit it.",
          {{"miss-1e-2", "missed by 1e-2 r or more: about 15 % of what meets three projections at random"},
           {"miss-1e-4", "missed by 1e-4 to 1e-2 r"},
           {"miss-1e-6", "missed by 1e-6 to 1e-4 r",
            "missed by 1e-6 to 1e-4 r, before rounding: some ulps of the position"},
           {"miss-1e-8", "missed by 1e-8 to 1e-6 r", ""},
           {"miss-1e-10", "missed by 1e-10 to 1e-8 r", ""},
           {"miss-1e-12", "missed by 1e-12 to 1e-10 r", ""},
           {"miss-1e-14", "missed by 1e-14 to 1e-12 r: a few ulps of the position", ""},
           {"hit", "hit, by as little"},
           {"other-cell", "a triclinic cell, where projections along its vectors see ellipses"}},
          make_tricylinder};
}

}  // namespace lorentz::cases
