// long-flight: slow drifts out of corridors, planar channels and cylindrical ones.
//
// v = (1, 2^-k) in a corridor along the first axis leaves it after about 2^k times its width. The disc that
// is hit is the first of the next row that reaches into the strip that is left: no walk can get there, and
// all of the 2^k cells count. k goes up to 100 (in binary32 46), so times go up to 1e30. Near the end the
// line is so nearly parallel to the row that it meets the first disc near its highest point: the entry is the
// square root of a difference that has cancelled.
#include <cmath>

#include <lorentz/geometry.hpp>
#include "fuzz/families/family.hpp"
#include "question/cases/integer_vectors.hpp"
#include "question/cases/scenes.hpp"

namespace lorentz::cases {
namespace {

double drawn_drift(Random& random, NumberFormat precision) {
  const int k = random.exponent(8, precision == NumberFormat::binary64 ? 100 : 46);
  return random.sign() * (random.one_in(2) ? std::ldexp(1, -k) : random.octave(-k, -k + 1));
}

// A lattice whose rows along the first axis are 1 apart, turned or not; the axis is a lattice direction.
std::array<Vec, 3> drawn_rows(Random& random, std::vector<std::string>& tags) {
  const std::uint64_t kind = random.below(3);
  if (kind == 0) return {Vec{1, 0}, Vec{0, 1}, Vec{}};
  if (tagged(tags, kind == 1, "oblique", "turned"))
    return {Vec{random.between(0.8, 2), 0}, Vec{random.uniform(), 1}, Vec{}};
  IntVec a{};
  while (a[0] == 0 || a[1] == 0) a = drawn_primitive(random, 2, 4);
  const Vec p = to_vec(a);
  return {p, Vec{-p[1], p[0]}, Vec{}};
}

void make_long(Source& source, Case& made) {
  Random &drawn = source.scene, &random = source.random;
  const std::uint64_t kind = drawn.below(4);
  const int least = source.is_wide() ? -30 : -16;
  Vec &x = made.query.x, &v = made.query.v;
  x[0] = random.between(-2, 2);
  if (kind < 2) {
    made.tags.push_back("corridor-drift");
    const auto vectors = drawn_rows(drawn, made.tags);
    const double r = drawn.one_in(3) ? 0.5 * (1 - drawn.octave(least, -4)) : drawn.between(0.01, 0.39);
    made.scene = lattice_scene(2, vectors, r);
    x[1] = random.whole(-2, 2) + 0.5 + (0.5 - r) * 0.9 * random.between(-1, 1);
    v = {random.sign(), drawn_drift(random, source.precision)};
  } else if (kind == 2) {
    made.tags.push_back("plane-drift");
    const double r = drawn.one_in(3) ? 0.5 * (1 - drawn.octave(least, -4)) : drawn.between(0.01, 0.49);
    made.scene = unit_scene(3, r);
    x[1] = random.uniform();
    x[2] = 0.5 + (0.5 - r) * 0.9 * random.between(-1, 1);
    v = {random.sign(), random.one_in(3) ? std::ldexp(random.whole(-16, 16), -4) : random.between(-1, 1),
         drawn_drift(random, source.precision)};
  } else {
    made.tags.push_back("cylinder-drift");
    const double r = drawn.between(0.5, 0.7), room = (std::sqrt(0.5) - r) * 0.6;
    made.scene = unit_scene(3, r);
    x[1] = 0.5 + room * random.between(-1, 1);
    x[2] = 0.5 + room * random.between(-1, 1);
    v = {random.sign(), drawn_drift(random, source.precision),
         random.one_in(3) ? 0.0 : drawn_drift(random, source.precision)};
  }
  if (random.one_in(3)) v = scaled(v, random.octave(-20, 20));
}

}  // namespace

Family long_flight() {
  return {"long-flight",
          "Slow drifts out of corridors and channels: flights of up to 10^30.",
          {{"corridor-drift", "2^-8 to 2^-100 off a corridor's axis: cells beyond 2^53, beyond 2^63",
            "2^-8 to 2^-46 off a corridor's axis: cells beyond 2^24, beyond 2^31"},
           {"oblique", "rows shifted against each other: the cell is not the nearest integer"},
           {"turned", "the corridor's axis is no primitive vector, but a long sum of them"},
           {"plane-drift", "the same out of a plane channel: a window that grows holds ever more rows"},
           {"cylinder-drift", "the same out of a cylindrical channel between overlapping spheres"}},
          make_long,
          "Slow drifts out of corridors and channels: flights of up to 10^14."};
}

}  // namespace lorentz::cases
