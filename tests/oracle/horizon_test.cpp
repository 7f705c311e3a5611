// The channels that a scene leaves open: against closed forms, brute force, affine images, and the oracle,
// which must answer `never` in a channel and only there.
#include <lorentz/geometry.hpp>
#include <lorentz/horizon.hpp>

#include <catch2/catch.hpp>

#include <chrono>
#include <numeric>
#include <set>

#include <lorentz/oracle.hpp>
#include "oracle/exact/root_sums.hpp"
#include "oracle/horizon/shadow.hpp"
#include "tests/support/support.hpp"

using namespace lorentz;
using namespace lorentz::test;
using oracle::Horizon;
using oracle::horizon_of;

namespace {

Scene scene_with(int dimension, std::array<Vec, 3> vectors, std::vector<Atom> atoms) {
  Scene scene;
  scene.dimension = dimension;
  scene.lattices.push_back({vectors, std::move(atoms)});
  return scene;
}

std::string key_of(const std::array<Integer, 3>& indices) {
  return indices[0].decimal() + " " + indices[1].decimal() + " " + indices[2].decimal();
}

// A vector along the channel: its own, or one in the plane, from integers in the primitive vectors.
Vec along(const oracle::Channel& channel, const Scene& scene) {
  if (scene.dimension == 2) return channel.vector;
  const auto h = channel.indices[0].int64(), k = channel.indices[1].int64(), l = channel.indices[2].int64();
  const std::array<std::int64_t, 3> n{k != 0 || h != 0 ? k : 1, k != 0 || h != 0 ? -h : 0, 0};
  Vec v{};
  for (int i = 0; i < 3; ++i)
    for (int c = 0; c < 3; ++c) v[c] += static_cast<double>(n[i]) * scene.lattices[0].vectors[i][c];
  (void)l;
  return v;
}

// Numbers of few bits, so that integer combinations of vectors are exact.
double short_number(Draw& draw, int range) {
  return draw.fraction(8, range);
}

Lattice short_lattice(Draw& draw, int dimension) {
  Lattice lattice;
  do
    for (int i = 0; i < dimension; ++i)
      for (int k = 0; k < dimension; ++k) lattice.vectors[i][k] = short_number(draw, 2);
  while (std::fabs(determinant(lattice, dimension)) < 0.25);
  return lattice;
}

Scene short_scene(Draw& draw, int dimension, std::uint64_t most_atoms, double least, double most) {
  Lattice lattice = short_lattice(draw, dimension);
  lattice.atoms.resize(1 + draw.below(most_atoms));
  for (Atom& atom : lattice.atoms) {
    for (int k = 0; k < dimension; ++k) atom.position[k] = short_number(draw, 1);
    atom.radius = std::ldexp(std::round(std::ldexp(draw.between(least, most), 6)), -6);
    if (atom.radius == 0) atom.radius = 0.125;
  }
  Scene scene;
  scene.dimension = dimension;
  scene.lattices.push_back(lattice);
  return scene;
}

Outcome outcome_along(const oracle::Oracle& oracle, const Vec& x, const Vec& v) {
  return oracle.first_hit({x, v, {}}).outcome;
}

}  // namespace

TEST_CASE("Horizon: the tail constant is a length, up to the ends of binary64", "[oracle][horizon]") {
  for (const int dimension : {2, 3})
    for (const int exponent : {-500, 500}) {
      Scene scene = unit_scene(dimension, 0.3);
      for (Vec& u : scene.lattices[0].vectors)
        for (double& component : u) component = std::scalbn(component, exponent);
      scene.lattices[0].atoms[0].radius = std::scalbn(0.3, exponent);
      CHECK(horizon_of(scene, 0, false).tail_constant ==
            std::scalbn(*horizon_of(unit_scene(dimension, 0.3), 0, false).tail_constant, exponent));
    }
}

TEST_CASE("Horizon: square and cubic lattices by their closed forms", "[oracle][horizon]") {
  struct Known {
    double radius, tail;
    std::size_t directions;
  };
  for (const Known& known : {Known{0.4, 0.0512014, 2}, Known{0.2, 0.366498, 8}, Known{0.1, 0.933643, 20}}) {
    const Horizon horizon = horizon_of(unit_scene(2, known.radius));
    CHECK(horizon.normals == known.directions);
    CHECK(horizon.channels.size() == known.directions);
    REQUIRE(horizon.tail_constant.has_value());
    CHECK(*horizon.tail_constant == Approx(known.tail).epsilon(2e-6));
    CHECK(horizon.is_infinite());
  }
  const Horizon cubic = horizon_of(unit_scene(3, 0.1), 0, false);
  CHECK(cubic.normals == 193);
  CHECK(*cubic.tail_constant == Approx(5.3055).epsilon(1e-5));
}

TEST_CASE("Horizon: the square lattice's directions, counted one by one", "[oracle][horizon]") {
  Draw draw(71);
  for (int round = 0; round < 30; ++round) {
    const double r = round < 10 ? 0.5 / std::sqrt(1 + round) : std::exp2(draw.between(-6, -1));
    std::multiset<double> widths;
    for (int p = -100; p <= 100; ++p)
      for (int q = 0; q <= 100; ++q)
        if (std::gcd(p, q) == 1 && (q > 0 || p > 0)) {
          // 4 r^2 (p^2 + q^2) < 1, in 113 bits of mantissa.
          const __float128 blocked = static_cast<__float128>(4) * r * r * (p * p + q * q);
          if (blocked < 1)
            widths.insert(static_cast<double>(1 / std::sqrt(1.0L * (p * p + q * q)) - 2.0L * r));
        }
    const Horizon horizon = horizon_of(unit_scene(2, r));
    INFO("r = " << r);
    REQUIRE(horizon.channels.size() == widths.size());
    auto expected = widths.rbegin();
    for (const auto& channel : horizon.channels) CHECK(channel.width == Approx(*expected++).margin(1e-17));
  }
}

TEST_CASE("Horizon: a width of 0 is not open, the least above it is", "[oracle][horizon]") {
  CHECK(horizon_of(unit_scene(2, 0.5)).is_finite());
  CHECK(horizon_of(unit_scene(2, std::nextafter(0.5, 1))).is_finite());
  const Horizon narrow = horizon_of(unit_scene(2, std::nextafter(0.5, 0)));
  REQUIRE(narrow.channels.size() == 2);
  CHECK(narrow.channels[0].width == 0x1p-53);
  CHECK(narrow.channels[0].inside);  // the point (0, 1/2)

  // u_1 = (1/2, e) lifts the second row by e: corridors of width e - O(e^2) beside one that is shut.
  const double e = 0x1p-1000;
  const Scene tilted =
      scene_with(2, {Vec{0.5, e}, Vec{0, 1}}, {{{0, 0.25}, 0.25, {}}, {{0.5, -0.25}, 0.25, {}}});
  const Horizon open = horizon_of(tilted);
  REQUIRE(open.channels.size() == 1);
  CHECK(open.channels[0].vector == Vec{0.5, e});
  CHECK(open.channels[0].width == 0x1p-1000);
  CHECK(open.channels[0].inside);
  const oracle::Oracle oracle(tilted);
  CHECK(outcome_along(oracle, open.channels[0].point, open.channels[0].vector) == Outcome::never);
  CHECK(outcome_along(oracle, open.channels[0].point, {-0.5, -e}) == Outcome::never);
  CHECK(outcome_along(oracle, open.channels[0].point, {0.5, 2 * e}) == Outcome::hit);
  CHECK(outcome_along(oracle, {0, 2 * e}, open.channels[0].vector) != Outcome::never);

  // Somewhere that binary64 does not reach: the channel is there, its rounded middle is not in it.
  Scene shifted = tilted;
  for (Atom& atom : shifted.lattices[0].atoms) atom.position[1] += 0.125;
  const Horizon outside = horizon_of(shifted);
  REQUIRE(outside.channels.size() == 1);
  CHECK(outside.channels[0].width == 0x1p-1000);
  CHECK_FALSE(outside.channels[0].inside);

  // Two rows that touch, in 2D and 3D, and shut out everything else.
  CHECK(horizon_of(scene_with(2, {Vec{0.25, 0}, Vec{0, 1}}, {{{0, 0.25}, 0.25, {}}, {{0, 0.75}, 0.25, {}}}))
            .is_finite());
}

TEST_CASE("Horizon: the smallest scales and the largest", "[oracle][horizon]") {
  for (const double scale : {0x1p-1000, 0x1p-500, 0x1p900}) {
    Scene scene = unit_scene(2, 0.2 * scale);
    scene.lattices[0].vectors = {Vec{scale, 0}, Vec{0, scale}};
    const Horizon horizon = horizon_of(scene), unit = horizon_of(unit_scene(2, 0.2));
    REQUIRE(horizon.channels.size() == unit.channels.size());
    for (std::size_t i = 0; i < unit.channels.size(); ++i)
      CHECK(horizon.channels[i].width == unit.channels[i].width * scale);
  }
}

TEST_CASE("Horizon: roots subtracted, their signs against 113 bits", "[oracle][horizon]") {
  Draw draw(72);
  int zeros = 0;
  for (int round = 0; round < 20000; ++round) {
    const long s = static_cast<long>(1 + draw.below(6)), i = static_cast<long>(draw.below(6)),
               j = static_cast<long>(draw.below(6)), k = static_cast<long>(draw.below(6));
    const bool near = draw.one_in(2);
    const long a = near ? i * i * s : i, b = near ? j * j * s : j, d = near ? k * k * s : k;
    long c = static_cast<long>(std::lround(std::sqrt(1.0 * a) + std::sqrt(1.0 * b) + std::sqrt(1.0 * d)));
    c += static_cast<long>(draw.below(3)) - 1;
    const long double value = c - std::sqrt(1.0L * a) - std::sqrt(1.0L * b) - std::sqrt(1.0L * d);
    const int sign = std::fabs(value) < 1e-15L ? 0 : value > 0 ? 1 : -1;
    zeros += sign == 0;
    INFO(c << " " << a << " " << b << " " << d);
    CHECK(oracle::sign_of_rest(c, a, b, d) == sign);
    const oracle::Z last = oracle::last_step(c, a, b, d, s, draw.one_in(2));
    CHECK(std::fabs(last.get_d() - static_cast<double>(std::floor(value / s))) <= 1);
    CHECK(oracle::sign_of_rest(c - last * s, a, b, d) >= 0);
  }
  CHECK(zeros > 1000);  // 1 511 seen
}

namespace {

// Widths of the gaps of a union of intervals modulo a period, in long double.
std::vector<double> gaps_by_sorting(std::vector<std::pair<long double, long double>> intervals,
                                    long double period) {
  for (auto& [low, high] : intervals) {
    const long double turns = std::floor(low / period);
    low -= turns * period;
    high -= turns * period;
  }
  std::sort(intervals.begin(), intervals.end());
  long double reach = -1e9L;
  for (const auto& [low, high] : intervals) reach = std::max(reach, high - period);
  std::vector<double> gaps;
  for (const auto& [low, high] : intervals) {
    if (low > reach + 1e-12L) gaps.push_back(static_cast<double>(low - reach));
    reach = std::max(reach, high);
  }
  return gaps;
}

}  // namespace

TEST_CASE("Horizon: drawn motifs against sorted intervals", "[oracle][horizon]") {
  Draw draw(73);
  std::size_t channels = 0, shut = 0;
  for (int round = 0; round < 60; ++round) {
    const int d = 2 + static_cast<int>(draw.below(2));
    const Scene scene = short_scene(draw, d, 4, d == 2 ? 0.05 : 0.2, 0.35);
    const Lattice& lattice = scene.lattices[0];
    const auto& u = lattice.vectors;
    const double volume = determinant(lattice, d);
    std::multiset<double> expected;
    const int reach = 60 / (d * d);
    for (int h = -reach; h <= reach; ++h)
      for (int k = -reach; k <= reach; ++k)
        for (int l = d == 2 ? 0 : -reach; l <= (d == 2 ? 0 : reach); ++l) {
          if (std::gcd(std::gcd(h, k), l) != 1) continue;
          if (h < 0 || (h == 0 && (k < 0 || (k == 0 && l < 0)))) continue;
          std::array<long double, 3> normal{};
          for (int c = 0; c < d; ++c) {
            const int c1 = (c + 1) % 3, c2 = (c + 2) % 3;
            const auto minor = [&](int i, int j) { return u[i][c1] * u[j][c2] - u[i][c2] * u[j][c1]; };
            normal[c] = d == 3 ? h * minor(1, 2) + k * minor(2, 0) + l * minor(0, 1)
                               : (c == 0 ? h * u[1][1] - k * u[0][1] : k * u[0][0] - h * u[1][0]);
          }
          const long double size =
              std::sqrt(normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]);
          std::vector<std::pair<long double, long double>> blocks;
          for (const Atom& atom : lattice.atoms) {
            long double centre = 0;
            for (int c = 0; c < d; ++c) centre += normal[c] * atom.position[c] / size;
            blocks.push_back({centre - atom.radius, centre + atom.radius});
          }
          for (double width : gaps_by_sorting(blocks, std::fabs(volume) / size)) expected.insert(width);
        }
    const Horizon horizon = horizon_of(scene, 0, false);
    std::string line;
    append_scene_line(line, scene);
    INFO(line);
    REQUIRE(horizon.channels.size() == expected.size());
    auto width = expected.rbegin();
    for (const auto& channel : horizon.channels) CHECK(channel.width == Approx(*width++).margin(1e-12));
    channels += expected.size();
    shut += expected.empty();
  }
  CHECK(channels > 540);  // 686 seen
  CHECK(shut > 0);
}

TEST_CASE("Horizon: a superposition is the lattice of its common cell", "[oracle][horizon]") {
  Draw draw(74);
  std::size_t channels = 0, several = 0;
  for (int round = 0; round < 20; ++round) {
    // Spacings p/4 and q/4 along x, common cell p q / 4; the same along y.
    const int p = 2 + static_cast<int>(draw.below(5)), q = 2 + static_cast<int>(draw.below(5));
    const double r1 = 0.015625 * static_cast<double>(1 + draw.below(8)), r2 = r1 / 2;
    Scene scene = scene_with(2, {Vec{p / 4.0, 0}, Vec{0, p / 4.0}}, {{{0, 0}, r1, {}}});
    const Vec offset{short_number(draw, 1), short_number(draw, 1)};
    scene.lattices.push_back({{Vec{q / 4.0, 0}, Vec{0, q / 4.0}}, {{offset, r2, {}}}});
    Scene common = scene_with(2, {Vec{p * q / 4.0, 0}, Vec{0, p * q / 4.0}}, {});
    for (int i = 0; i < q; ++i)
      for (int k = 0; k < q; ++k) common.lattices[0].atoms.push_back({{i * p / 4.0, k * p / 4.0}, r1, {}});
    for (int i = 0; i < p; ++i)
      for (int k = 0; k < p; ++k)
        common.lattices[0].atoms.push_back({{offset[0] + i * q / 4.0, offset[1] + k * q / 4.0}, r2, {}});
    std::set<std::pair<std::string, double>> seen, expected;
    for (const auto& channel : horizon_of(scene).channels)
      seen.insert({key_of(channel.indices), channel.width});
    for (const auto& channel : horizon_of(common).channels)
      expected.insert({key_of(channel.indices), channel.width});
    INFO(p << " " << q << " " << r1 << " at " << offset[0] << " " << offset[1]);
    CHECK(seen == expected);
    channels += seen.size();
    std::set<std::string> directions;
    for (const auto& [direction, width] : seen) directions.insert(direction);
    several += directions.size() < seen.size();
  }
  CHECK(channels > 2600);  // 3 369 seen
  CHECK(several > 14);     // 18 seen
}

TEST_CASE("Horizon: two lattices whose common period is long, by counting all shifts", "[oracle][horizon]") {
  Draw draw(75);
  std::size_t found = 0;
  for (int round = 0; round < 20; ++round) {
    // Rows 1 and 1 + 2^-17 apart: in 131073 rows they meet in every shift that is a multiple of 2^-17.
    const double step = 0x1p-17, period2 = 1 + step;
    const double r1 = 0.0078125 * static_cast<double>(26 + draw.below(32)),
                 r2 = 0.0078125 * static_cast<double>(26 + draw.below(32));
    Scene scene = scene_with(2, {Vec{0.25, 0}, Vec{0, 1}}, {{{0, 0}, r1, {}}});
    const double offset = draw.fraction(1 << 19, 1);
    scene.lattices.push_back({{Vec{0.25, 0}, Vec{0, period2}}, {{{0.125, offset}, r2, {}}}});
    const double low1 = r1, high1 = 1 - r1, low2 = offset + r2, high2 = offset + period2 - r2;
    std::int64_t count = 0, wide = 0;
    double widest = 0;
    const double least = 0.25 * (high1 - low1);
    for (int k = -(1 << 19); k <= (1 << 19); ++k) {
      const double width = std::min(high1, high2 + k * step) - std::max(low1, low2 + k * step);
      count += width > 0;
      wide += width >= least;
      widest = std::max(widest, width);
    }
    INFO(r1 << " " << r2 << " " << offset);
    const Horizon all = horizon_of(scene), some = horizon_of(scene, least);
    REQUIRE(all.channels.size() == 1);
    CHECK(all.channels[0].vector == Vec{0.25, 0});
    CHECK(all.channels[0].width == widest);
    CHECK(all.channels[0].count == Integer(count));
    REQUIRE(all.channels[0].inside);
    CHECK(outcome_along(oracle::Oracle(scene), all.channels[0].point, {1, 0}) == Outcome::never);
    REQUIRE(some.channels.size() == (wide > 0));
    if (wide > 0) CHECK(some.channels[0].count == Integer(wide));
    found += wide > 0;
  }
  CHECK(found > 15);  // 19 seen
}

TEST_CASE("Horizon: three lattices with long common periods are undecided, if no two of them shut it",
          "[oracle][horizon]") {
  Scene scene = scene_with(2, {Vec{0.25, 0}, Vec{0, 1}}, {{{0, 0}, 0.2, {}}});
  for (const double step : {0x1p-30, 0x1p-31})
    scene.lattices.push_back({{Vec{0.25, 0}, Vec{0, 1 + step}}, {{{0, 0}, 0.2, {}}}});
  const Horizon horizon = horizon_of(scene);
  CHECK(horizon.channels.empty());
  REQUIRE(horizon.undecided.size() == 1);
  CHECK(key_of(horizon.undecided[0]) == "1 0 0");
  CHECK_FALSE(horizon.is_finite());
  scene.lattices[2].atoms[0].radius = 0.6;
  CHECK(horizon_of(scene).is_finite());
}

TEST_CASE("Horizon: ellipses and ellipsoids are affine images of balls", "[oracle][horizon]") {
  Draw draw(76);
  std::size_t channels = 0, cylinders = 0, inside = 0;
  for (int round = 0; round < 60; ++round) {
    const int d = 2 + static_cast<int>(draw.below(2));
    Scene balls = short_scene(draw, d, 2, d == 2 ? 0.1 : 0.4, d == 2 ? 0.4 : 0.7), image = balls;
    for (Atom& atom : balls.lattices[0].atoms) atom.radius = balls.lattices[0].atoms[0].radius;
    const Lattice map = short_lattice(draw, d);
    const auto mapped = [&](const Vec& a) {
      Vec b{};
      for (int i = 0; i < d; ++i)
        for (int k = 0; k < d; ++k) b[k] += a[i] * map.vectors[i][k];
      return b;
    };
    for (Vec& u : image.lattices[0].vectors) u = mapped(u);
    for (std::size_t a = 0; a < balls.lattices[0].atoms.size(); ++a) {
      Atom& atom = image.lattices[0].atoms[a];
      const double r = balls.lattices[0].atoms[a].radius;
      atom = {mapped(atom.position), 0, {}};
      for (int i = 0; i < d; ++i)
        atom.semiaxes.push_back({r * map.vectors[i][0], r * map.vectors[i][1], r * map.vectors[i][2]});
    }
    const Horizon straight = horizon_of(balls), bent = horizon_of(image);
    std::string line;
    append_scene_line(line, image);
    INFO(line);
    REQUIRE(straight.channels.size() == bent.channels.size());
    // Widths in units of the planes' distance are the same. (2D: volume / |g| apart.)
    const auto relative = [&](const Horizon& horizon, const Lattice& lattice) {
      std::multiset<std::pair<std::string, long>> result;
      for (const auto& c : horizon.channels) {
        const double planes =
            d == 2 ? length(c.vector) / std::fabs(determinant(lattice, 2)) : length(c.vector);
        result.insert({key_of(c.indices), std::lround(1e9 * c.width * planes)});
      }
      return result;
    };
    CHECK(relative(straight, balls.lattices[0]) == relative(bent, image.lattices[0]));
    std::set<std::string> holes, bent_holes;
    for (const auto& c : straight.cylinders) holes.insert(key_of(c.direction));
    for (const auto& c : bent.cylinders) bent_holes.insert(key_of(c.direction));
    CHECK(holes == bent_holes);
    for (const auto& c : bent.cylinders) inside += c.inside;
    CHECK(straight.families.size() == bent.families.size());
    channels += bent.channels.size();
    cylinders += holes.size();
  }
  CHECK(channels > 280);    // 361 seen
  CHECK(cylinders > 3700);  // 4 668 seen
  CHECK(inside > cylinders / 10 * 9);
}

TEST_CASE("Horizon: the oracle flies for ever in a channel, and nowhere else", "[oracle][horizon]") {
  Draw draw(77);
  std::size_t in_channels = 0, in_cylinders = 0, never = 0, hits = 0, finite = 0;
  for (int round = 0; round < 60; ++round) {
    const int d = 2 + static_cast<int>(draw.below(2));
    const Scene scene = short_scene(draw, d, 3, d == 2 ? 0.1 : 0.3, 0.6);
    const oracle::Oracle oracle(scene);
    const Horizon horizon = horizon_of(scene);
    std::string line;
    append_scene_line(line, scene);
    INFO(line);
    std::set<std::string> directions;
    for (const auto& channel : horizon.channels) {
      directions.insert(key_of(channel.indices));
      if (!channel.inside) continue;
      CHECK(outcome_along(oracle, channel.point, along(channel, scene)) == Outcome::never);
      ++in_channels;
    }
    for (const auto& cylinder : horizon.cylinders) {
      directions.insert(key_of(cylinder.direction));
      if (!cylinder.inside) continue;
      CHECK(cylinder.radius > 0);
      CHECK(outcome_along(oracle, cylinder.point, cylinder.vector) == Outcome::never);
      ++in_cylinders;
    }
    finite += horizon.is_finite();
    // Rays along short lattice vectors from anywhere: if one never ends, its direction must have been named.
    for (int shot = 0; shot < 300; ++shot) {
      std::array<int, 3> n{};
      for (int i = 0; i < d; ++i) n[i] = static_cast<int>(draw.below(7)) - 3;
      const int divisor = std::gcd(std::gcd(n[0], n[1]), n[2]);
      if (divisor == 0) continue;
      const bool negative = std::array<int, 3>{} > n;
      std::array<Integer, 3> g;
      Vec v{};
      for (int i = 0; i < d; ++i) {
        n[i] = n[i] / divisor * (negative ? -1 : 1);
        g[i] = n[i];
        for (int k = 0; k < d; ++k) v[k] += n[i] * scene.lattices[0].vectors[i][k];
      }
      const Outcome outcome = outcome_along(oracle, draw.vec(d, -1, 1), v);
      hits += outcome == Outcome::hit;
      if (outcome != Outcome::never) continue;
      ++never;
      bool named = directions.contains(key_of(g));
      const auto in_plane = [&](const std::array<Integer, 3>& k) {
        return k[0].int64() * n[0] + k[1].int64() * n[1] + k[2].int64() * n[2] == 0;
      };
      if (d == 3) {
        for (const auto& channel : horizon.channels) named |= in_plane(channel.indices);
        for (const auto& family : horizon.families) named |= family.infinite && in_plane(family.indices);
      }
      INFO("along " << key_of(g));
      CHECK(named);
    }
  }
  CHECK(in_channels > 200);    // 257 seen
  CHECK(in_cylinders > 5800);  // 7 309 seen
  CHECK(never > 1500);         // 1 880 seen
  CHECK(hits > 6500);          // 8 245 seen
  CHECK(finite > 5);           // 7 seen
}

TEST_CASE("Horizon: simple, face-centred and body-centred cubic near close packing", "[oracle][horizon]") {
  const std::array<Vec, 3> fcc{Vec{0, 0.5, 0.5}, Vec{0.5, 0, 0.5}, Vec{0.5, 0.5, 0}},
      bcc{Vec{-0.5, 0.5, 0.5}, Vec{0.5, -0.5, 0.5}, Vec{0.5, 0.5, -0.5}};
  const auto with = [](const std::array<Vec, 3>& vectors, double r) {
    return horizon_of(scene_with(3, vectors, {{{}, r, {}}}));
  };
  // Planar channels: the widest planes are (100), sqrt(1/3), sqrt(1/2) apart.
  CHECK(horizon_of(unit_scene(3, std::nextafter(0.5, 0))).channels.size() == 3);
  CHECK(horizon_of(unit_scene(3, 0.5)).channels.empty());
  CHECK(with(fcc, 0.2886).channels.size() == 4);
  CHECK(with(fcc, 0.2887).channels.empty());
  CHECK(with(bcc, 0.3535).channels.size() == 6);
  CHECK(with(bcc, 0.3536).channels.empty());
  // Cylindrical: fcc along <110> up to r = 3/8, <100> to sqrt(1/8); bcc along <100> to 1/2, <111> to
  // sqrt(2)/3, <110> to sqrt(3)/4, where the balls touch.
  CHECK(with(fcc, 0.35).cylinders.size() == 9);
  CHECK(with(fcc, 0.3535).cylinders.size() == 9);
  CHECK(with(fcc, 0.3536).cylinders.size() == 6);
  CHECK(with(fcc, 0.375).is_finite());
  CHECK(with(bcc, 0.433).cylinders.size() == 13);
  CHECK(with(bcc, 0.4331).cylinders.size() == 7);
  CHECK(with(bcc, 0.4715).cylinders.size() == 3);
  CHECK(with(bcc, 0.5).is_finite());
  // sc at r = 1/2: the planes touch, and infinitely many directions in them are open, ever less so.
  const Horizon touching = horizon_of(unit_scene(3, 0.5));
  CHECK(touching.families.size() == 3);
  CHECK(touching.cylinders.empty());
  CHECK(touching.is_infinite());
  // A little more: very many, which are not all searched.
  const Horizon nearly = horizon_of(unit_scene(3, 0.5 + 0x1p-40));
  REQUIRE(nearly.families.size() == 3);
  CHECK_FALSE(nearly.families[0].infinite);
  CHECK(nearly.families[0].directions > 1e9);
  CHECK(nearly.is_infinite());
  CHECK(nearly.cylinders.size() > 2300);  // 2 937 seen
  CHECK(horizon_of(unit_scene(3, std::sqrt(0.5))).is_finite());
}

TEST_CASE("Horizon: a shadow of equal discs has a hole where the circumradius says so", "[oracle][horizon]") {
  Draw draw(78);
  int holes = 0, covered = 0;
  for (int round = 0; round < 400; ++round) {
    Scene scene = short_scene(draw, 3, 1, 0.2, 1);
    const oracle::ChannelScene<3> exact(scene, 0);
    const auto& lattice = exact.lattices[0];
    const auto &u = lattice.vectors[0], &v = lattice.vectors[1], &w = lattice.vectors[2];
    const oracle::Shadow shadow(lattice, u, v, w);
    std::size_t work = 0;
    const bool by_radius = oracle::hole_of_largest(shadow).has_value();
    CHECK(oracle::hole_of_all(shadow, work).has_value() == by_radius);
    (by_radius ? holes : covered)++;
  }
  CHECK(holes > 220);   // 285 seen
  CHECK(covered > 90);  // 115 seen
}

TEST_CASE("Horizon: shadows whose discs just touch, or just close", "[oracle][horizon]") {
  const auto hole = [](std::array<Vec, 3> vectors, std::vector<Atom> atoms) {
    const oracle::ChannelScene<3> exact(scene_with(3, vectors, std::move(atoms)), 0);
    const auto& lattice = exact.lattices[0];
    oracle::Shadow shadow(lattice, lattice.vectors[2], lattice.vectors[0], lattice.vectors[1]);
    shadow.see(lattice, lattice.obstacles.size());
    std::size_t work = 0;
    return oracle::hole_of_all(shadow, work).has_value();
  };
  const std::array<Vec, 3> unit{Vec{1, 0, 0}, Vec{0, 1, 0}, Vec{0, 0, 1}};
  // Between discs that touch there is a hole, all of whose corners are cusps.
  CHECK(hole(unit, {{{}, 0.5, {}}}));
  CHECK(hole(unit, {{{}, 0.25, {}}}));  // no two circles meet
  // Circumradius 5: at r = 5 four circles meet in one free point, which is no hole.
  const std::array<Vec, 3> seven{Vec{7, 1, 0}, Vec{-1, 7, 0}, Vec{0, 0, 1}};
  CHECK_FALSE(hole(seven, {{{}, 5, {}}}));
  CHECK(hole(seven, {{{}, std::nextafter(5.0, 0), {}}}));
  // A smaller ball in that hole: it fills it, or not, or touches from within.
  CHECK(hole(unit, {{{}, 0.5, {}}, {{0.5, 0.5, 0}, 0.25, {}}}));
  CHECK_FALSE(hole(unit, {{{}, 0.5, {}}, {{0.5, 0.5, 0}, 0.5, {}}}));
  CHECK_FALSE(hole(unit, {{{}, 0.75, {}}, {{0.25, 0, 0}, 0.5, {}}}));
  CHECK(hole(unit, {{{}, 0.5, {}}, {{0.25, 0, 0}, 0.25, {}}}));
  // All corners of the hole are on three circles.
  CHECK(hole(unit, {{{}, 0.5, {}}, {{0.25, 0, 0}, 0.25, {}}, {{0, 0.25, 0}, 0.25, {}}}));
  // The same ball twice in one line of sight.
  CHECK(hole(unit, {{{}, 0.5, {}}, {{0, 0, 0.5}, 0.5, {}}}));
  CHECK_FALSE(hole(seven, {{{}, 5, {}}, {{0, 0, 0.5}, 5, {}}}));
}

TEST_CASE("Horizon: what is not done is said, and nothing hangs", "[oracle][horizon]") {
  CHECK_THROWS_AS(horizon_of(unit_scene(2, 1e-9)), oracle::TooManyChannels);
  CHECK_THROWS_AS(horizon_of(unit_scene(3, 1e-9)), oracle::TooManyChannels);
  CHECK(horizon_of(unit_scene(2, 1e-9), 0.2).normals == 20);
  const Horizon wide = horizon_of(unit_scene(3, 1e-9), 0.25);
  CHECK(wide.normals > 85);  // 109 seen
  for (const auto& channel : wide.channels) CHECK(channel.width >= 0.25);
  CHECK_FALSE(wide.no_cylinders.empty());
  for (const int d : {2, 3}) CHECK(horizon_of(unit_scene(d, 1e6)).is_finite());

  // A least width equal to a channel's keeps it.
  CHECK(horizon_of(unit_scene(2, 0.25), 0.5).channels.size() == 2);
  CHECK(horizon_of(unit_scene(2, 0.25), std::nextafter(0.5, 1)).channels.empty());

  Draw draw(79);
  for (const int d : {2, 3}) {
    Scene crowd = unit_scene(d, 0.01);
    crowd.lattices[0].atoms.resize(10000);
    for (Atom& atom : crowd.lattices[0].atoms) atom = {draw.vec(d, 0, 1), d == 2 ? 0.01 : 0.05, {}};
    CHECK(horizon_of(crowd, 0, false).channels.empty());
  }
  const Scene sliver = scene_with(2, {Vec{1, 1}, Vec{1 + 0x1p-40, 1}}, {{{}, 0.1, {}}});
  CHECK(horizon_of(sliver).channels.size() == 1);
  Scene two = unit_scene(3, 0.2);
  two.lattices.push_back(two.lattices[0]);
  two.lattices[1].vectors[0] = {1, 0.5, 0};
  CHECK_FALSE(horizon_of(two).no_cylinders.empty());
  two.lattices[1].vectors[0] = {1, 0, 0};
  CHECK(horizon_of(two).no_cylinders.empty());
  two.lattices[1].atoms[0].semiaxes = {Vec{0.2, 0, 0}, Vec{0, 0.2, 0}, Vec{0, 0, 0.3}};
  CHECK_FALSE(horizon_of(two).no_cylinders.empty());
}

namespace {

// Directions and radii of the cylinders.
std::vector<std::pair<std::string, double>> cylinders_of(const Horizon& horizon) {
  std::vector<std::pair<std::string, double>> result;
  for (const auto& cylinder : horizon.cylinders)
    result.push_back({key_of(cylinder.direction), cylinder.radius});
  std::sort(result.begin(), result.end());
  return result;
}

}  // namespace

TEST_CASE("Horizon: too many directions are counted, not begun, in slender cells too", "[oracle][horizon]") {
  // The ball of candidates has a volume of some hundred cells, and four million points in one plane.
  const Scene slender = scene_with(3, {Vec{1, 0, 0}, Vec{0, 1, 0}, Vec{0.3, 0.7, 1e-9}}, {{{}, 1e-4, {}}});
  std::size_t steps = 0;
  const auto count = [&](const std::string&, std::size_t, std::size_t) { ++steps; };
  CHECK_THROWS_AS(horizon_of(slender, 0, false, count), oracle::TooManyChannels);
  CHECK_THROWS_AS(horizon_of(slender, 0, true, count), oracle::TooManyChannels);
  CHECK(steps == 0);
  const Horizon wide = horizon_of(slender, 0.2);
  CHECK(wide.normals == 1);
  CHECK_FALSE(wide.no_cylinders.empty());

  // A search that is begun is heard of, to its end.
  std::size_t last = 0, total = 0;
  horizon_of(unit_scene(2, 0.01), 0, true, [&](const std::string& what, std::size_t done, std::size_t all) {
    CHECK(what == "directions");
    CHECK(done >= last);
    last = done, total = all;
  });
  CHECK(total > 3700);  // pi / (4 r^2) / 2, and those on the axis
  CHECK(total < 4100);
  CHECK(last + 64 > total);
}

TEST_CASE("Horizon: semiaxes in any order, with any signs, or turned among themselves are one shape",
          "[oracle][horizon]") {
  const Vec a{0.25, 0.125, 0}, b{-0.0625, 0.375, 0.125}, c{0, 0.125, 0.4375};
  const auto minus = [](const Vec& v) { return Vec{-v[0], -v[1], -v[2]}; };
  const std::array<Vec, 3> unit{Vec{1, 0, 0}, Vec{0, 1, 0}, Vec{0, 0, 1}};
  const auto with = [&](std::vector<Vec> first, std::vector<Vec> second) {
    return horizon_of(
        scene_with(3, unit, {{{}, 0, std::move(first)}, {{0.5, 0.5, 0.5}, 0, std::move(second)}}));
  };
  const Horizon same = with({a, b, c}, {a, b, c});
  REQUIRE(same.no_cylinders.empty());
  REQUIRE(same.cylinders.size() > 5);
  for (const auto& second :
       {std::vector{b, c, a}, std::vector{b, a, c}, std::vector{minus(c), b, minus(a)}}) {
    const Horizon other = with({a, b, c}, second), both = with(second, second);
    CHECK(other.no_cylinders.empty());
    REQUIRE(other.cylinders.size() == same.cylinders.size());
    REQUIRE(both.cylinders.size() == same.cylinders.size());
    for (std::size_t i = 0; i < same.cylinders.size(); ++i) {
      CHECK(cylinders_of(other)[i].first == cylinders_of(same)[i].first);
      CHECK(cylinders_of(other)[i].second == Approx(cylinders_of(same)[i].second));
      CHECK(cylinders_of(both)[i].first == cylinders_of(same)[i].first);
    }
    for (const auto& cylinder : other.cylinders) CHECK(cylinder.inside);
  }
  // Nearly the same is another shape.
  CHECK_FALSE(with({a, b, c}, {b, a, {0, 0.125, std::nextafter(0.4375, 1)}}).no_cylinders.empty());

  // Balls of radius 5/16, the second one written with 3-4-5 semiaxes.
  const std::vector<Vec> turned{{0, 0.1875, -0.25}, {-0.3125, 0, 0}, {0, 0.25, 0.1875}};
  const Horizon balls = horizon_of(
      scene_with(3, unit, {{{}, 0.375, {}}, {{0.5, 0.5, 0.5}, 0.3125, {}}, {{0.5, 0, 0}, 0.0625, {}}}));
  const Horizon written = horizon_of(
      scene_with(3, unit, {{{}, 0.375, {}}, {{0.5, 0.5, 0.5}, 0, turned}, {{0.5, 0, 0}, 0.0625, {}}}));
  CHECK(written.no_cylinders.empty());
  CHECK(written.cylinders.size() > 10);
  CHECK(cylinders_of(written) == cylinders_of(balls));
}

TEST_CASE("Horizon: the radius of a cylinder is above 0 however small the hole", "[oracle][horizon]") {
  // Between four balls of a square: sqrt(1/2) - r. A second ball in each line of sight changes nothing.
  const std::array<Vec, 3> unit{Vec{1, 0, 0}, Vec{0, 1, 0}, Vec{0, 0, 1}};
  const double r = 0.7071067811865475;
  const __float128 rest = 0.5 - static_cast<__float128>(r) * r;
  const double expected = static_cast<double>(rest / (2 * static_cast<__float128>(r) + rest / 1.5));
  const Horizon one = horizon_of(unit_scene(3, r));
  REQUIRE(one.cylinders.size() == 3);
  for (const auto& cylinder : one.cylinders) CHECK(cylinder.radius == Approx(expected).epsilon(1e-14));
  const Horizon two =
      horizon_of(scene_with(3, unit, {{{}, r, {}}, {{0, 0, 0.5}, r, {}}, {{0.25, 0.25, 0.25}, 0.0625, {}}}));
  REQUIRE(two.cylinders.size() == 1);
  CHECK(two.cylinders[0].radius == Approx(expected).epsilon(1e-9));
  CHECK(two.cylinders[0].inside);

  // Four discs of radius 5 about the point (3, 4), one of them moved away by 5 e: next to two discs that
  // touch there, the cusp has room for a circle of radius (5 e)^2 / 10, or, around the corner, less yet.
  const double e = 0x1p-100;
  const Horizon cusp = horizon_of(scene_with(
      3, {Vec{14, 2, 0}, Vec{-2, 14, 0}, Vec{0, 0, 1}},
      {{{-3 * e, -4 * e, 0}, 5, {}}, {{7, 1, 0}, 5, {}}, {{-1, 7, 0}, 5, {}}, {{6, 8, 0}, 5, {}}}));
  REQUIRE(cusp.cylinders.size() == 1);
  CHECK(cusp.cylinders[0].radius > 0);
  CHECK(cusp.cylinders[0].radius < 3 * e * e);

  // A cylinder of that radius fits: no ball is nearer to the line, as binary64 sees it.
  Draw draw(80);
  std::size_t seen = 0;
  for (int round = 0; round < 20; ++round) {
    const Scene scene = short_scene(draw, 3, 3, 0.3, 0.5);
    const auto& u = scene.lattices[0].vectors;
    for (const auto& cylinder : horizon_of(scene).cylinders) {
      const Vec& g = cylinder.vector;
      double least = 1e9;
      for (const Atom& atom : scene.lattices[0].atoms)
        for (int n = 0; n < 9 * 9 * 9; ++n) {
          Vec arm{};
          for (int k = 0; k < 3; ++k)
            arm[k] = atom.position[k] + (n % 9 - 4) * u[0][k] + (n / 9 % 9 - 4) * u[1][k] +
                     (n / 81 - 4) * u[2][k] - cylinder.point[k];
          const Vec across = cross(arm, g);
          least = std::min(least, std::sqrt(dot(across, across) / dot(g, g)) - atom.radius);
        }
      CHECK(least >= cylinder.radius - 1e-14);
      seen += least < cylinder.radius + 1e-9;
    }
  }
  CHECK(seen > 500);
}

TEST_CASE("Horizon: no planar channel, no tail like 1/t", "[oracle][horizon]") {
  CHECK(horizon_of(unit_scene(2, 0.5)).tail_constant == 0.0);
  CHECK(horizon_of(unit_scene(3, 0.5)).tail_constant == 0.0);   // touching planes
  CHECK(horizon_of(unit_scene(3, 0.55)).tail_constant == 0.0);  // cylinders; overlaps are no matter
  CHECK_FALSE(horizon_of(unit_scene(2, 0.5), 0.1).tail_constant.has_value());
  CHECK_FALSE(horizon_of(unit_scene(2, 0.25), 0.9).tail_constant.has_value());
}
