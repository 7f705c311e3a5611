// boundary-starts: particles on an obstacle's surface, and ulps from it.
//
// x - c is exactly on the sphere if r = w 2^-m and x - c = (a, b, c) 2^-m with a^2 + b^2 + c^2 = w^2. In the
// plane, a w with many prime factors of the kind 4k + 1 has many such points; in space, rows of a
// quaternion's matrix are such points. From there a flight inwards hits at t = 0; one outwards or along the
// tangent does not hit this obstacle at all. An ulp inwards the start is inside; an ulp outwards the hit
// comes at t > 0. In other lattices the start is the binary64 vector nearest to a point of the surface, and
// is as likely inside as outside. `from` excludes one obstacle from the question, wherever x is: on it, in
// it, or far from it.
#include <cmath>

#include <lorentz/geometry.hpp>
#include "fuzz/families/family.hpp"
#include "question/cases/integer_vectors.hpp"
#include "question/cases/scenes.hpp"
#include "question/cases/ulps.hpp"

namespace lorentz::cases {
namespace {

// An integer point of the circle of radius w, searched upwards from a drawn one; (w, 0) ends the search.
IntVec circle_point(Random& random, std::int64_t w) {
  for (std::int64_t a = random.integer(0, w);; ++a) {
    const auto b = static_cast<std::int64_t>(std::sqrt(static_cast<double>(w * w - a * a)));
    if (a * a + b * b == w * w) return {a, b, 0};
  }
}

IntVec sphere_point(Random& random, const std::array<std::int64_t, 4>& quaternion) {
  const auto rows = std::apply(rotation_of, quaternion);
  const std::uint64_t i = random.below(6);
  return i < 3 ? rows[i] : IntVec{rows[0][i - 3], rows[1][i - 3], rows[2][i - 3]};
}

// A velocity at a surface point with the outward normal n.
Vec drawn_velocity(Source& source, const Vec& n, int dimension, std::vector<std::string>& tags) {
  Random& random = source.random;
  Vec tangent = cross(n, dimension == 2 ? Vec{0, 0, 1} : to_vec(drawn_primitive(random, 3, 5)));
  if (tangent == Vec{}) tangent = cross(n, n[0] == 0 ? Vec{1, 0, 0} : Vec{-n[1], n[0], 1});  // n was drawn
  const double side = random.sign();
  const std::string_view way =
      drawn_tag(random, tags, {"inwards", "outwards", "tangential", "nearly-tangential"});
  if (way == "inwards") return plus(scaled(n, -1), random.between(-2, 2), tangent);
  if (way == "outwards") return plus(n, random.between(-2, 2), tangent);
  const Vec along = scaled(tangent, side);
  if (way == "tangential") return along;
  return plus(along, random.octave(-bits_of(source.precision), -4) * random.sign(), n);
}

// Draws `from`, or leaves it empty; `own` is the obstacle that x is on.
void set_from(Random& random, const ObstacleId& own, const Vec& n, int dimension, Case& made) {
  const std::uint64_t kind = random.below(6);
  if (kind < 2) {
    made.tags.push_back("leaving");
    made.query.from = own;
  } else if (kind == 2) {
    made.tags.front() = "from-around-x";  // instead of the tag of x's distance from the surface
    made.query.from = own;
    made.query.x = plus(made.query.x, -random.between(0, 1), n);
  } else if (kind == 3) {
    made.tags.push_back("from-elsewhere");
    const std::int64_t far = random.one_in(2) ? 2 : std::int64_t{1} << random.integer(20, 60);
    made.query.from = obstacle(drawn_integers(random, dimension, far), own.atom);
  }
}

// Puts x on the surface around `centre`, or ulps from it.
void set_start(Source& source, const Vec& centre, const Vec& n, int dimension, bool exact, Case& made) {
  Random& random = source.random;
  made.query.x = sum(centre, n);
  const bool off = random.one_in(2);
  tagged(made.tags, exact && !off, "on-surface", "near-surface");
  if (!off) return;
  for (int i = 0; i < dimension; ++i)
    if (random.one_in(2)) made.query.x[i] = moved(made.query.x[i], random.integer(-4, 4), source.precision);
}

// A flight from the obstacle `own` around `centre`; n is a radius of it.
void set_flight(Source& source, const ObstacleId& own, const Vec& centre, const Vec& n, bool exact,
                Case& made) {
  const int dimension = made.scene.dimension;
  set_start(source, centre, n, dimension, exact, made);
  made.query.v = drawn_velocity(source, n, dimension, made.tags);
  set_from(source.random, own, n, dimension, made);
}

void make_exact(Source& source, Case& made) {
  static constexpr std::int64_t kRich[] = {65, 85, 325, 425, 1105, 5525};
  Random &drawn = source.scene, &random = source.random;
  const int dimension = drawn.one_in(2) ? 3 : 2;
  std::array<std::int64_t, 4> quaternion{1, 1, 1, 0};
  for (std::int64_t& component : quaternion) component += drawn.integer(0, 12);
  std::int64_t w = kRich[drawn.below(6)];
  if (dimension == 3) {
    w = 0;
    for (const std::int64_t component : quaternion) w += component * component;
  }
  const int exponent = std::ilogb(static_cast<double>(w)) + drawn.exponent(3, source.is_wide() ? 9 : 7);
  made.scene = unit_scene(dimension, std::ldexp(static_cast<double>(w), -exponent));
  const IntVec point = dimension == 2 ? circle_point(random, w) : sphere_point(random, quaternion);
  const Symmetry symmetry(random, dimension);
  const Vec n = scaled(symmetry(to_vec(point)), std::ldexp(1, -exponent));
  const IntVec cell = drawn_integers(random, dimension, 9);
  set_flight(source, obstacle(cell), to_vec(cell), n, true, made);
}

void make_rounded(Source& source, Case& made) {
  Random &drawn = source.scene, &random = source.random;
  made.scene = drawn_crystal(drawn, drawn.one_in(2) ? 3 : 2).scene;
  scale_obstacles(made.scene, drawn.one_in(2) ? 1 : drawn.octave(-14, 0));
  const Lattice& lattice = made.scene.lattices[0];
  const auto which = static_cast<int>(random.below(lattice.atoms.size()));
  const Atom& atom = lattice.atoms[which];
  const IntVec cell = drawn_integers(random, made.scene.dimension, 3);
  const Vec n = scaled(random.direction(made.scene.dimension), atom.radius);
  set_flight(source, obstacle(cell, which), sum(atom.position, cartesian(lattice, cell)), n, false, made);
}

}  // namespace

Family boundary_starts() {
  return {
      "boundary-starts",
      "Starts on an obstacle's surface, exactly or within ulps; with and without `from`.",
      {{"on-surface", "exactly on the surface, which belongs to no open obstacle"},
       {"near-surface", "within ulps of it: inside or outside, and the time 0 or tiny"},
       {"inwards", "hits at once, at t = 0 if it starts on the surface"},
       {"outwards", "does not hit the obstacle that it starts on"},
       {"tangential", "touches, which is no hit"},
       {"nearly-tangential", "a slope of 2^-4 to 2^-53 against the tangent: a chord of any shortness",
        "a slope of 2^-4 to 2^-24 against the tangent: a chord of any shortness"},
       {"leaving", "`from` is the obstacle that x is on"},
       {"from-around-x", "`from` contains x, and is ignored all the same"},
       {"from-elsewhere", "`from` is another obstacle, near or 2^60 cells away"}},
      [](Source& source, Case& made) { (source.scene.one_in(3) ? make_rounded : make_exact)(source, made); }};
}

}  // namespace lorentz::cases
