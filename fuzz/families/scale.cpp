// scale: ordinary flights in extraordinary units. The answer depends neither on the unit of length nor on
// that of time. But an absolute tolerance depends on them, and so does a square that overflows or vanishes,
// or a cell number that no longer fits a type. So the whole scene is multiplied by 2^k, k up to 300 either
// way. Velocities go from the smallest subnormal to the largest binary64. Radii are at the limits that
// engines state (1e-12 and 1e-7 of the cell, 1/2 of it). Starts are up to 2^52 cells away, where the place in
// the cell is in the last bits.
#include <cmath>

#include <lorentz/geometry.hpp>
#include "fuzz/families/family.hpp"
#include "question/cases/drawn_flights.hpp"
#include "question/cases/integer_vectors.hpp"
#include "question/cases/scenes.hpp"
#include "question/cases/ulps.hpp"

namespace lorentz::cases {
namespace {

constexpr double kTinyFlat = 1e-12, kTinySolid = 1e-7;

void set_limit_radius(Random& drawn, NumberFormat precision, Case& made) {
  const double tiny = made.scene.dimension == 2 ? kTinyFlat : kTinySolid;
  const std::string_view size =
      drawn_tag(drawn, made.tags, {"tiny-radius", "half-radius", "ordinary-radius"});
  if (size == "tiny-radius")
    return set_radius(made.scene, moved(tiny, drawn.integer(-2, 2), precision) *
                                      (drawn.one_in(2) ? 1 : drawn.between(1, 10)));
  set_radius(made.scene,
             size == "half-radius" ? moved(0.5, drawn.integer(-2, 2), precision) : drawn.octave(-10, -1));
}

void set_velocity(Source& source, int dimension, Case& made) {
  Random& random = source.random;
  const bool is_wide = source.is_wide();
  const int subnormal_bits = is_wide ? 30 : 20, smallest = is_wide ? -1074 : -149;
  Vec& v = made.query.v;
  v = random.direction(dimension);
  const std::string_view kind = drawn_tag(
      random, made.tags, {"subnormal-velocity", "huge-velocity", "uneven-velocity", "unit-velocity"});
  if (kind == "subnormal-velocity")
    for (double& component : v)
      component = std::ldexp(std::round(std::ldexp(component, subnormal_bits)), smallest);
  if (kind == "huge-velocity") v = scaled(v, is_wide ? random.octave(1000, 1023) : random.octave(110, 127));
  if (kind == "uneven-velocity") {
    double& component = v[random.axis(dimension)];
    component = std::ldexp(component, -random.exponent(1, is_wide ? 1060 : 135));
  }
  if (v == Vec{}) v[0] = std::ldexp(1, smallest);
}

void set_far_start(Source& source, int dimension, Case& made) {
  Random& random = source.random;
  made.query.x = point_in_cell(random, made.scene);
  if (!tagged(made.tags, random.one_in(2), "far-start")) return;
  const int exponent = source.is_wide() ? random.exponent(10, 52) : random.exponent(4, 23);
  const IntVec cell = drawn_integers(random, dimension, std::int64_t{1} << exponent);
  made.query.x = sum(made.query.x, cartesian(made.scene.lattices[0], cell));
}

void make_scale(Source& source, Case& made) {
  Random& drawn = source.scene;
  const int dimension = drawn.one_in(3) ? 3 : 2;
  const bool unit = drawn.one_in(2);
  made.scene = unit ? unit_scene(dimension, 0.25) : drawn_crystal(drawn, dimension).scene;
  if (unit) set_limit_radius(drawn, source.precision, made);
  set_far_start(source, dimension, made);
  set_velocity(source, dimension, made);
  if (tagged(made.tags, drawn.one_in(2), "scaled-scene")) {
    const std::int64_t most = source.is_wide() ? 300 : 80;
    const double factor = std::ldexp(1, drawn.exponent(-most, most));  // products with it are exact
    scale_places(made.scene, factor);
    scale_obstacles(made.scene, factor);
    made.query.x = scaled(made.query.x, factor);
  }
}

}  // namespace

Family scale() {
  return {"scale",
          "Ordinary flights in extraordinary units: sizes, speeds and distances at the ends of the range.",
          {{"tiny-radius", "at the smallest radius that engines do"},
           {"half-radius", "within ulps of half the cell: obstacles touch, or nearly"},
           {"ordinary-radius", "2^-10 to 1/2"},
           {"subnormal-velocity", "every component is subnormal"},
           {"huge-velocity", "components beyond 2^1000, whose squares overflow"},
           {"uneven-velocity", "one component 2^-1 to 2^-1060 of the other"},
           {"unit-velocity", "of length 1"},
           {"far-start", "2^10 to 2^52 cells away: the place in the cell has few bits left"},
           {"scaled-scene", "every length times 2^-300 to 2^300"}},
          make_scale};
}

}  // namespace lorentz::cases
