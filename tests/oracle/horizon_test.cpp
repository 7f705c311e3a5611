// The channels that a scene leaves open: against closed forms, brute force, affine images, and the oracle,
// which must answer `never` in a channel and only there.
#include <lorentz/geometry.hpp>
#include <lorentz/horizon.hpp>

#include <catch2/catch.hpp>

#include <cmath>
#include <numeric>
#include <set>

#include <lorentz/oracle.hpp>
#include "oracle/exact/root_sums.hpp"
#include "src/problem/scene_geometry.hpp"
#include "tests/oracle/horizon_support.hpp"
#include "tests/support/support.hpp"

using namespace lorentz;
using namespace lorentz::test;
using oracle::Horizon;
using oracle::horizon_of;

namespace {

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

Outcome outcome_along(const oracle::Oracle& oracle, const Vec& x, const Vec& v) {
  return oracle.first_hit({x, v, {}}).outcome;
}

}  // namespace

TEST_CASE("Horizon: the tail constant is a length, up to the ends of binary64", "[oracle][horizon]") {
  for (const int dimension : {2, 3})
    for (const int exponent : {-500, 500})
      CHECK(horizon_of(scaled(unit_scene(dimension, 0.3), exponent), 0, false).tail_constant ==
            std::scalbn(*horizon_of(unit_scene(dimension, 0.3), 0, false).tail_constant, exponent));
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
  CHECK_FALSE(horizon.tail_constant);
  scene.lattices[2].atoms[0].radius = 0.6;
  CHECK(horizon_of(scene).is_finite());
}

TEST_CASE("Horizon: three lattices are undecided if but one gap of the first meets the second's",
          "[oracle][horizon]") {
  // The line y = +-height is free. The first lattice's other gap is half a step from every gap of the second.
  const double step = 0x1p-17, thin = 0x1p-31, height = 0.25 + step / 2, period = 1 + step;
  const Vec along{0.25, 0};
  for (const double way : {1, -1}) {  // either gap is the last
    Scene scene =
        scene_with(2, {along, Vec{0, 1}}, {{{0, 0}, 0.1875, {}}, {{0, way * 0.625}, 0.1875 - thin, {}}});
    scene.lattices.push_back(
        {{along, Vec{0, period}}, {{{0, way * (height + period / 2)}, (period - thin) / 2, {}}}});
    scene.lattices.push_back({{along, Vec{0, 1 + step / 2}}, {{{0, way * 0.75}, 0.2, {}}}});
    REQUIRE(outcome_along(oracle::Oracle(scene), {0, way * height}, along) == Outcome::never);
    const Horizon horizon = horizon_of(scene);
    CHECK(horizon.channels.empty());
    CHECK(horizon.undecided.size() == 1);
    CHECK_FALSE(horizon.is_finite());
  }
}

TEST_CASE("Horizon: three lattices are undecided if two of them meet in one shift alone",
          "[oracle][horizon]") {
  // A gap of 2^-31 about y = 0 in either of the first two.
  const double thin = 0x1p-31;
  const Vec along{0.25, 0};
  Scene scene = scene_with(2, {along, Vec{0, 1}}, {{{0, 0.5}, (1 - thin) / 2, {}}});
  const double period = 1 + 0x1p-17;
  scene.lattices.push_back({{along, Vec{0, period}}, {{{0, period / 2}, (period - thin) / 2, {}}}});
  scene.lattices.push_back({{along, Vec{0, 1 + 0x1p-18}}, {{{0, 0.5}, 0.2, {}}}});
  REQUIRE(outcome_along(oracle::Oracle(scene), {0, 0}, along) == Outcome::never);
  const Horizon horizon = horizon_of(scene);
  CHECK(horizon.undecided.size() == 1);
  CHECK_FALSE(horizon.is_finite());
}

TEST_CASE("Horizon: of unequal discs the widest of many meetings is found", "[oracle][horizon]") {
  // Rows 1 and 1 + 2^-17 apart, each with a gap from a large disc to a small one, or from a small to a large.
  const double step = 0x1p-17, unit = 0x1p-6;
  const Vec along{0.125, 0};
  Scene scene = scene_with(2, {along, Vec{0, 1}}, {{{0, 0}, 19 * unit, {}}, {{0, 39 * unit}, 15 * unit, {}}});
  scene.lattices.push_back(
      {{along, Vec{0, 1 + step}}, {{{0, 7 * unit}, 15 * unit, {}}, {{0, 47 * unit}, 19 * unit, {}}}});
  const Horizon horizon = horizon_of(scene);  // gaps of 5 and 6 units
  REQUIRE(horizon.channels.size() == 1);
  CHECK(horizon.channels[0].width == 5 * unit);
  CHECK(horizon.channels[0].count == Integer{11 * (1 << 11) - 1});
  CHECK(horizon.channels[0].inside);
  // Half a common period is as far as one has to go.
  CHECK(std::fabs(horizon.channels[0].point[1]) < (1 << 16) + 2);
}

TEST_CASE("Horizon: of gaps equally wide the nearest shift is the widest meeting", "[oracle][horizon]") {
  const double step = 0x1p-17, wide = 0.25;
  for (const double share : {0.25, 0.75}) {  // of a step, from one gap's middle to the other's
    Scene scene = scene_with(2, {Vec{0.125, 0}, Vec{0, 1}}, {{{0, 0.5}, (1 - wide) / 2, {}}});
    scene.lattices.push_back({{Vec{0.125, 0}, Vec{0, 1 + step}},
                              {{{0, (1 + step) / 2 + share * step}, (1 + step - wide) / 2, {}}}});
    const Horizon horizon = horizon_of(scene);
    REQUIRE(horizon.channels.size() == 1);
    CHECK(horizon.channels[0].width == wide - step / 4);
    CHECK(horizon.channels[0].count == Integer(1 << 16));  // shifts by less than 1/4 either way
  }
}

TEST_CASE("Horizon: of a corridor's translates the one nearest to the origin is shown", "[oracle][horizon]") {
  const Scene scene =
      scene_with(2, {Vec{0.125, 0}, Vec{0, 1}}, {{{0, 0.25}, 0.1875, {}}, {{0, 0.75}, 0.0625, {}}});
  std::set<double> heights;
  for (const auto& channel : horizon_of(scene).channels) heights.insert(channel.point[1]);
  CHECK(heights == std::set{-0.4375, -0.0625});
}

TEST_CASE("Horizon: what two lattices shut is shut, whatever the third leaves open", "[oracle][horizon]") {
  const Vec along{0.25, 0};
  const auto rows = [&](double period, std::vector<double> heights) {
    Lattice lattice{{along, Vec{0, period}}, {}};
    for (const double height : heights) lattice.atoms.push_back({{0, height}, 0.3, {}});
    return lattice;
  };
  // Rows of one period, and of periods that have a short one in common.
  for (const Lattice& other : {rows(1, {0.5}), rows(2, {0.5, 1.5})})
    for (const double third : {1.0, 3.0, 1 + 0x1p-40}) {
      std::vector<Lattice> lattices{rows(1, {0}), other, rows(third, {0})};
      for (int turn = 0; turn < 3; ++turn) {
        CHECK(horizon_of({2, lattices}).is_finite());
        std::rotate(lattices.begin(), lattices.begin() + 1, lattices.end());
      }
    }
}

TEST_CASE("Horizon: three lattices in another order leave the same open", "[oracle][horizon]") {
  // The second's period is a short one in common with the first's only if the third has shut most gaps.
  const double thin = 0x1p-10, period = 1 + 0x1p-11, height = 0x1p-7;
  const Vec along{0x1p-8, 0};
  Lattice many{{along, Vec{0, 1}}, {}};
  for (int i = 0; i < 64; ++i) many.atoms.push_back({{0, i / 64.0}, height - thin / 2, {}});
  const Lattice second{{along, Vec{0, period}}, {{{0, height + period / 2}, (period - thin) / 2, {}}}},
      third{{along, Vec{0, 2}}, {{{0, height + 1}, 1 - 0x1p-8, {}}}};
  const Horizon one = horizon_of({2, {many, second, third}}), other = horizon_of({2, {many, third, second}});
  CHECK(one.channels.size() == 3);  // shifted by -1, 0, 1 steps
  REQUIRE(one.channels.size() == other.channels.size());
  for (std::size_t i = 0; i < one.channels.size(); ++i) {
    CHECK(one.channels[i].width == other.channels[i].width);
    CHECK(one.channels[i].count == Integer(1));
  }
}

TEST_CASE("Horizon: two lattices with a short common period are one, wherever the third stands",
          "[oracle][horizon]") {
  const double periods[] = {1 + 0x1p-30, 1, 1.5};
  for (const auto& [a, b, c] : {std::array{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}}) {
    Scene scene{2, {}};
    for (const int i : {a, b, c})
      scene.lattices.push_back({{Vec{1, 0}, Vec{0, periods[i]}}, {{{0, 0}, 0.3, {}}}});
    const Horizon horizon = horizon_of(scene);
    CHECK(horizon.channels.size() == 3);
    CHECK(horizon.undecided.empty());
  }
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

TEST_CASE("Horizon: the tail constant counts each atom, and touching ones do not overlap",
          "[oracle][horizon]") {
  for (const int d : {2, 3}) {
    const Scene one = unit_scene(d, 0.2);
    Scene doubled = one;
    doubled.lattices[0].vectors[0][0] = 2;
    doubled.lattices[0].atoms.push_back({{1, 0, 0}, 0.2, {}});
    CHECK(*horizon_of(doubled, 0, false).tail_constant ==
          Approx(*horizon_of(one, 0, false).tail_constant).epsilon(1e-12));
  }
  // Among corridors of one width, those along short vectors come first.
  Scene two = unit_scene(2, 0.2);
  two.lattices[0].vectors[0][0] = 2;
  two.lattices[0].atoms.push_back({{1, 0, 0}, 0.2, {}});
  CHECK(horizon_of(two).channels[0].vector == Vec{0, 1, 0});
  Scene touching = unit_scene(2, 0.5);
  touching.lattices[0].vectors[1][1] = 1.5;  // a corridor of width 1/2 beside each row
  CHECK(*horizon_of(touching).tail_constant == Approx(0.25 / (M_PI * (1.5 - M_PI / 4))).epsilon(1e-12));
  touching.lattices[0].vectors[0][0] = std::nextafter(1, 0);
  CHECK_FALSE(horizon_of(touching).tail_constant);
}

TEST_CASE("Horizon: the tail constant of ellipses is of their widths and their area", "[oracle][horizon]") {
  // Corridors of 0.6 and 0.1 along the axes, two along the diagonals.
  const double a = 0.45, b = 0.2, diagonal = std::sqrt(0.5) - std::sqrt(2 * (a * a + b * b));
  const double expected =
      (0.36 + 0.01 + 2 * std::sqrt(2) * diagonal * diagonal) / (M_PI * (1 - M_PI * a * b));
  const auto constant = [](const Vec& u, const std::vector<Vec>& axes) {
    return horizon_of(scene_with(2, {u, Vec{-u[1], u[0]}}, {{{}, 0, axes}})).tail_constant.value();
  };
  CHECK(constant({1, 0}, {{a, 0}, {0, b}}) == Approx(expected));
  CHECK(constant({1, 0}, {{0, b}, {-a, 0}}) == Approx(expected));
  CHECK(constant({1, 0}, {{0.6 * a, 0.8 * b}, {-0.8 * a, 0.6 * b}}) ==
        Approx(expected));                                                             // of the same ellipse
  CHECK(constant({3, 4}, {{3 * a, 4 * a}, {-4 * b, 3 * b}}) == Approx(5 * expected));  // all turned, 3-4-5
}

TEST_CASE("Horizon: no planar channel, no tail like 1/t", "[oracle][horizon]") {
  CHECK(horizon_of(unit_scene(2, 0.5)).tail_constant == 0.0);
  CHECK(horizon_of(unit_scene(3, 0.5)).tail_constant == 0.0);   // touching planes
  CHECK(horizon_of(unit_scene(3, 0.55)).tail_constant == 0.0);  // cylinders; overlaps do not matter
  CHECK_FALSE(horizon_of(unit_scene(2, 0.5), 0.1).tail_constant.has_value());
  CHECK_FALSE(horizon_of(unit_scene(2, 0.25), 0.9).tail_constant.has_value());
}

TEST_CASE("Horizon: of very many superposed lattices a few pairs are looked at", "[oracle][horizon]") {
  Scene scene = unit_scene(2, 1e-4);
  for (int i = 1; i < 20'000; ++i) {
    scene.lattices.push_back(scene.lattices[0]);
    scene.lattices.back().atoms[0].position = {std::fmod(0.61803 * i, 1), std::fmod(0.7548 * i, 1), 0};
  }
  // All 2e8 pairs would take a quarter of an hour.
  CHECK_THROWS_AS(oracle::horizon_of(scene), oracle::TooManyChannels);
}

TEST_CASE("Horizon: finite is what is known to have nothing open", "[oracle][horizon]") {
  Horizon horizon;
  CHECK(horizon.is_finite());
  horizon.families = {{}};
  CHECK_FALSE(horizon.is_finite());
  CHECK_FALSE(horizon.is_infinite());
  horizon.families.push_back({{}, true, 0});
  CHECK(horizon.is_infinite());
  CHECK_FALSE(horizon.is_finite());
  horizon.families.clear();
  horizon.undecided = {{}};
  CHECK_FALSE(horizon.is_finite());
  horizon.undecided.clear();
  horizon.no_cylinders = "not asked for";
  CHECK_FALSE(horizon.is_finite());
  CHECK_FALSE(horizon.is_infinite());
}
