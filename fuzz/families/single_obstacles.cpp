// ball-2d, ball-3d, ellipsoid-alone: a ray and one obstacle, the question of ray tracers, physics engines and
// transport codes, where binary64 does not suffice.
//
// A case is made beside the ball of radius w around the origin, in numbers of few bits. w is an integer with
// many integer points (a, b, c) on its surface. So a start that is meant to be on the surface, or a line that
// is meant to touch, is exactly that. A line along an axis at the height w, tilted by 2^-k, passes the edge
// as nearly as 10^-30 radii. Then everything is scaled by a power of two, and moved by integers. An ellipsoid
// { p + A y : |y| < 1 } takes the line x + t v beside the unit ball to p + A x + t A v; this is exact if A is
// a diagonal of powers of two.
#include <algorithm>
#include <cmath>

#include <lorentz/geometry.hpp>
#include "fuzz/families/family.hpp"
#include "question/cases/integer_vectors.hpp"
#include "question/cases/scenes.hpp"
#include "question/cases/ulps.hpp"

namespace lorentz::cases {
namespace {

// A point on the surface of the ball of radius w, and a tangent direction there.
struct Touching {
  double w;
  Vec n, tangent;
};

// (a, b, c, d) with a^2 + b^2 + c^2 = d^2, or with c = 0.
Touching drawn_touching(Random& drawn, Random& random, int dimension) {
  static constexpr double kCirclePoints[][3] = {
      {3, 4, 5}, {5, 12, 13}, {16, 63, 65}, {36, 77, 85}, {264, 23, 265}};
  const auto& [x, y, size] = kCirclePoints[drawn.below(5)];
  const Symmetry symmetry(random, dimension);
  if (dimension == 2) return {size, symmetry(Vec{x, y, 0}), symmetry(Vec{-y, x, 0})};
  // The rows of a rotation by quaternions have the length of its norm: here (x, y, 0) in a tilted plane.
  const double tilt = random.one_in(2) ? 0 : 3, up = tilt == 0 ? 5 : 4;
  return {5 * size, symmetry(Vec{5 * x, up * y, tilt * y}), symmetry(Vec{-5 * y, up * x, tilt * x})};
}

// A ray beside the ball of radius w around the origin.
struct Ray {
  Vec x, v;
  bool on_obstacle = false;  // then `from` may name it
  std::vector<std::string> tags;
};

// A ray from the distance `far`, past the centre at the distance `beside`, up to rounding, in any direction.
Ray aimed(Random& random, int dimension, double far, double beside) {
  const Vec v = random.direction(dimension);
  return {sum(scaled(drawn_across(random, v, dimension), beside), scaled(v, -far)), v, false, {}};
}

Ray plain(Random& random, int dimension, double w) {
  const double beside = w * random.between(0, 2);
  Ray ray = aimed(random, dimension, w * random.between(1.5, 10), beside);
  ray.tags = {"plain"};
  return ray;
}

// Constants that depend on the precision of the case's numbers.
struct RayRange {
  explicit RayRange(NumberFormat its_precision)
      : precision(its_precision), is_wide(its_precision == NumberFormat::binary64) {}

  const NumberFormat precision;
  const bool is_wide;
  const int bits = bits_of(precision);
  const int farthest = is_wide ? 50 : 21;                       // of a start: 2^this radii
  const int least_depth = is_wide ? -100 : -40;                 // past the edge by 2^this radii
  const double depth_of_numbers = is_wide ? 0x1p-48 : 0x1p-19;  // a rounded start still resolves such depths
  const int tangent_bits = is_wide ? 20 : 9;
  const int smallest = is_wide ? -600 : -90, largest = is_wide ? 600 : 80;  // of a unit: 2^this
  const int ordinary = is_wide ? 40 : 20;                                   // units up to 2^this either way
};

// A ray past the edge by 10^-30 (in binary32 10^-12) to 1 radii, on either side, and from any distance.
Ray past_edge(Random& random, const RayRange& range, int dimension, double w, bool far_away) {
  const double far = far_away ? w * random.octave(10, range.farthest) : std::round(w * random.between(2, 20));
  const double depth = random.octave(range.least_depth, 0) * random.sign();
  Ray ray;
  if (std::fabs(depth) > range.depth_of_numbers) {
    ray = aimed(random, dimension, far, w * (1 - depth));
  } else {
    const Symmetry symmetry(random, dimension);
    ray.x = symmetry(Vec{-far, w, 0});
    ray.v = symmetry(Vec{1, -depth * w / far, 0});
  }
  ray.tags = {"grazing"};
  if (far_away) ray.tags.push_back("far-origin");
  return ray;
}

Ray tangent(Random& random, const RayRange& range, const Touching& touching) {
  const double steps = random.one_in(4) ? 0 : random.whole(1, std::int64_t{1} << range.tangent_bits);
  Ray ray{sum(touching.n, scaled(touching.tangent, -steps)), touching.tangent, steps == 0, {"tangent"}};
  if (steps == 0) ray.tags.push_back("self-intersection");
  return ray;
}

// A start on the surface, or a few ulps to 10^-3 radii off it; flights inwards, outwards, along it or nearly
// so.
Ray at_surface(Random& random, const RayRange& range, int dimension, const Touching& touching) {
  const auto& [w, n, along] = touching;
  Ray ray{n, {}, true, {"self-intersection"}};
  const std::uint64_t start = random.below(3);
  if (start == 1) jitter(random, ray.x, dimension, 4, range.precision);
  if (start == 2) ray.x = scaled(n, 1 + random.octave(3 - range.bits, -10) * random.sign());
  const Vec inward = scaled(n, -1);
  const std::uint64_t way = random.below(4);
  if (way < 2) ray.v = plus(way == 0 ? inward : n, random.between(-2, 2), along);
  if (way == 2) ray.v = plus(along, random.octave(-range.bits, -4) * random.sign(), inward);
  if (way == 3) ray.v = random.direction(dimension);
  return ray;
}

Ray from_inside(Random& random, const RayRange& range, int dimension, double w) {
  return {random.vector(dimension,
                        w * (random.one_in(2) ? random.uniform() : 1 - random.octave(1 - range.bits, -2))),
          random.direction(dimension),
          true,
          {"inside"}};
}

Ray far_origin(Random& random, const RayRange& range, int dimension, double w) {
  const double beside = w * random.between(0, 1.5);
  Ray ray = aimed(random, dimension, w * random.octave(10, range.farthest), beside);
  ray.tags = {"far-origin"};
  return ray;
}

Ray ray_beside(Random& random, const RayRange& range, int dimension, const Touching& touching) {
  const double w = touching.w;
  const std::uint64_t kind = random.below(10);
  if (kind == 0) return plain(random, dimension, w);
  if (kind <= 2) return past_edge(random, range, dimension, w, false);
  if (kind == 3) return tangent(random, range, touching);
  if (kind <= 5) return at_surface(random, range, dimension, touching);
  if (kind == 6) return from_inside(random, range, dimension, w);
  if (kind == 7) return past_edge(random, range, dimension, w, true);
  return far_origin(random, range, dimension, w);
}

// Does b^2 - a c, of the quadratic a t^2 + 2 b t + c, lose half of its bits or more?
bool cancels(const Ray& ray, const RayRange& range, double w) {
  const double a = dot(ray.v, ray.v), b = dot(ray.x, ray.v), c = dot(ray.x, ray.x) - w * w;
  return std::fabs(b * b - a * c) < std::ldexp(b * b, -range.bits / 2);
}

// Multiplies v by a power of two, which matters only to its square.
void stretch(Random& random, const RayRange& range, Ray& ray) {
  if (!random.one_in(8)) return;
  const bool longer = random.one_in(2), subnormal = !longer && random.one_in(2);
  ray.tags.push_back(longer ? "long-direction" : subnormal ? "subnormal-direction" : "short-direction");
  const int about = range.is_wide ? (longer      ? 900
                                     : subnormal ? -1040
                                                 : -900)
                                  : (longer      ? 100
                                     : subnormal ? -132
                                                 : -90);
  const int give_or_take = range.is_wide ? 20 : subnormal ? 5 : 10;
  const auto exponent = about + random.exponent(-give_or_take, give_or_take);
  ray.v =
      scaled(ray.v, std::ldexp(1.0, exponent - std::ilogb(std::max({std::fabs(ray.v[0]), std::fabs(ray.v[1]),
                                                                    std::fabs(ray.v[2])}))));
}

Scene alone(int dimension, Atom atom) {
  Scene scene{dimension, {Lattice{}}};
  scene.lattices[0].rank = 0;
  scene.lattices[0].atoms = {std::move(atom)};
  return scene;
}

// The ray beside the ball of radius w, with its tags and `from`.
Ray finished_ray(Random& random, const RayRange& range, int dimension, const Touching& touching, Case& made) {
  Ray ray = ray_beside(random, range, dimension, touching);
  if (cancels(ray, range, touching.w)) ray.tags.push_back("cancellation");
  if (ray.on_obstacle && random.one_in(3)) {
    ray.tags.push_back("leaving");
    made.query.from = ObstacleId{};
  }
  stretch(random, range, ray);
  made.tags = ray.tags;
  return ray;
}

void ball_case(Source& source, int dimension, Case& made) {
  Random& drawn = source.scene;
  const RayRange range(source.precision);
  const int size = drawn.one_in(2) ? 0 : drawn.exponent(range.smallest, range.largest);
  const double shift = drawn.one_in(2) ? 0 : drawn.whole(1, 1 << 12);
  const Touching touching = drawn_touching(drawn, source.random, dimension);
  const double unit = std::ldexp(1.0, size);
  Vec centre{};
  for (int i = 0; i < dimension; ++i) centre[i] = shift * drawn.whole(-5, 5);
  made.scene = alone(dimension, Atom{scaled(centre, unit), touching.w * unit, {}});
  const Ray ray = finished_ray(source.random, range, dimension, touching, made);
  made.query.x = scaled(sum(centre, ray.x), unit);
  made.query.v = ray.v;
  if (size < -range.ordinary) made.tags.push_back("tiny-ball");
  if (size > range.ordinary) made.tags.push_back("huge-ball");
}

// Semiaxes at right angles to each other, or along the axes and powers of two; the longest is up to 2^8 times
// the shortest.
std::vector<Vec> semiaxes_alone(Random& drawn, int dimension, bool aligned) {
  std::vector<Vec> semiaxes(static_cast<std::size_t>(dimension), Vec{});
  for (int i = 0; i < dimension; ++i) semiaxes[i][i] = 1;
  if (!aligned) {
    const auto frame = drawn_frame(drawn, drawn.direction(dimension), dimension);
    std::copy_n(frame.begin(), dimension, semiaxes.begin());
    if (dimension == 2) semiaxes[1] = scaled(semiaxes[1], 1 / length(semiaxes[1]));
  }
  for (Vec& axis : semiaxes)
    axis = scaled(axis, aligned ? std::ldexp(1.0, drawn.exponent(-8, 0)) : drawn.octave(-8, 0));
  return semiaxes;
}

void ellipsoid_case(Source& source, Case& made) {
  Random& drawn = source.scene;
  const int dimension = drawn.one_in(3) ? 2 : 3;
  const bool aligned = drawn.one_in(2), moved = drawn.one_in(2);
  const std::vector<Vec> semiaxes = semiaxes_alone(drawn, dimension, aligned);
  Vec centre{};
  if (moved)
    for (int i = 0; i < dimension; ++i) centre[i] = drawn.whole(-64, 64);
  const Touching touching = drawn_touching(drawn, source.random, dimension);
  // The ray was made beside the ball of radius w.
  Atom atom{centre, 0, semiaxes};
  for (Vec& axis : atom.semiaxes) axis = scaled(axis, touching.w);
  made.scene = alone(dimension, std::move(atom));
  const Ray ray = finished_ray(source.random, RayRange(source.precision), dimension, touching, made);
  made.query.x = sum(centre, image(semiaxes, ray.x));
  made.query.v = image(semiaxes, ray.v);
  if (made.query.v == Vec{}) made.query.v[0] = 1;  // a subnormal v vanished
  made.tags.push_back(aligned ? "axis-aligned" : "rotated");
}

std::vector<Tag> ray_tags() {
  return {{"plain", "some radii away, well off the edge"},
          {"grazing", "passes the edge by 10^-30 to 1 radii, on either side",
           "passes the edge by 10^-12 to 1 radii, on either side"},
          {"tangent", "touches, exactly where nothing was rounded: which is not a hit"},
          {"self-intersection", "starts on the surface, exactly, or within 10^-3 radii of it"},
          {"inside", "starts inside, perhaps by a roundoff"},
          {"far-origin", "starts 10^3 to 10^15 radii away", "starts 10^3 to 10^6 radii away"},
          {"cancellation", "the discriminant of the quadratic loses half of its bits, or all"},
          {"leaving", "`from` is the obstacle, which is ignored: a ray that leaves it"},
          {"long-direction", "v has a length of about 2^900, whose square is not a binary64",
           "v has a length of about 2^100, whose square is not a binary32"},
          {"short-direction", "v has a length of about 2^-900, whose square is 0",
           "v has a length of about 2^-90, whose square is 0"},
          {"subnormal-direction", "the components of v are subnormal"}};
}

std::vector<Tag> with(std::vector<Tag> tags, std::initializer_list<Tag> more) {
  tags.insert(tags.end(), more);
  return tags;
}

const Tag kTiny{"tiny-ball", "a radius of 2^-600 to 2^-30", "a radius of 2^-90 to 2^-10"},
    kHuge{"huge-ball", "a radius of 2^40 to 2^612", "a radius of 2^20 to 2^92"};

}  // namespace

Family ball_2d() {
  return {"ball-2d", "A ray and one disc: far, grazing, on the surface, tiny and huge.",
          with(ray_tags(), {kTiny, kHuge}), [](Source& source, Case& made) { ball_case(source, 2, made); }};
}

Family ball_3d() {
  return {"ball-3d", "A ray and one ball: far, grazing, on the surface, tiny and huge.",
          with(ray_tags(), {kTiny, kHuge}), [](Source& source, Case& made) { ball_case(source, 3, made); }};
}

Family ellipsoid_alone() {
  return {
      "ellipsoid-alone", "A ray and one ellipse or ellipsoid: far, grazing, on the surface.",
      with(ray_tags(), {{"axis-aligned", "semiaxes along the axes: what is exact for a ball is exact here"},
                        {"rotated", "semiaxes in any direction"}}),
      ellipsoid_case};
}

}  // namespace lorentz::cases
