// Starts are the same however they are drawn, and have the distribution that they are said to have. All seeds
// are fixed; bounds are 4 standard deviations.
#include <hwy/targets.h>

#include <bit>
#include <catch2/catch.hpp>
#include <cstring>
#include <numbers>
#include <numeric>
#include <set>

#include <lorentz/errors.hpp>
#include <lorentz/geometry.hpp>
#include "question/starts/candidates.hpp"
#include "src/problem/scene_geometry.hpp"
#include "tests/support/scenes.hpp"
#include "tests/support/support.hpp"

using namespace lorentz;
using namespace lorentz::flights;
using namespace lorentz::starts;
using namespace lorentz::test;

namespace {

constexpr double kSigmas = 4;
constexpr std::uint64_t kSeed = 20161115;

// Starts in columns are those of one index after the other, to the bit.
bool same(const QueryRows& columns, std::size_t i, const Query& query, int dimension) {
  for (int k = 0; k < dimension; ++k)
    if (std::bit_cast<std::uint64_t>(columns.x[k][i]) != std::bit_cast<std::uint64_t>(query.x[k]) ||
        std::bit_cast<std::uint64_t>(columns.v[k][i]) != std::bit_cast<std::uint64_t>(query.v[k]))
      return false;
  if (!query.from) return columns.from_lattice.empty();
  for (int k = 0; k < dimension; ++k)
    if (columns.from_cell[k][i] != query.from->cell[k].int64()) return false;
  return columns.from_lattice[i] == query.from->lattice && columns.from_atom[i] == query.from->atom;
}

// The starts [first, first + count).
const QueryRows& drawn(const Candidates& starts, std::uint64_t first, std::size_t count, QueryRows& rows,
                       std::uint64_t attempt = 0) {
  std::vector<std::uint64_t> indices(count);
  std::iota(indices.begin(), indices.end(), first);
  starts.draw(indices, attempt, rows);
  return rows;
}

// How far counts are from what was expected, in standard deviations of chi squared.
double deviation(const std::vector<double>& counts, const std::vector<double>& expected) {
  double chi2 = 0, all = 0, all_expected = 0;
  for (const double n : counts) all += n;
  for (const double n : expected) all_expected += n;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const double e = expected[i] / all_expected * all;
    chi2 += (counts[i] - e) * (counts[i] - e) / e;
  }
  const double degrees = static_cast<double>(counts.size()) - 1;
  return std::fabs(chi2 - degrees) / std::sqrt(2 * degrees);
}

double deviation(const std::vector<double>& counts) {
  return deviation(counts, std::vector<double>(counts.size(), 1.0));
}

// Counts of numbers in [0, 1), in cells of equal width.
class Histogram {
 public:
  explicit Histogram(std::size_t bins) : counts_(bins) {}
  void add(double share) {
    REQUIRE(share > -1e-9);
    REQUIRE(share < 1 + 1e-9);
    const double place = std::min(std::max(share, 0.0), 1 - 1e-16) * static_cast<double>(counts_.size());
    ++counts_[static_cast<std::size_t>(place)];
  }
  const std::vector<double>& counts() const { return counts_; }

 private:
  std::vector<double> counts_;
};

double turn(double y, double x) {
  const double turns = std::atan2(y, x) / (2 * std::numbers::pi);
  return turns < 0 ? turns + 1 : turns;
}

// Two ellipses that nothing makes round, and a disc.
Scene flat_motif() {
  Scene scene = one_atom(2, {Vec{1.5, 0.25, 0}, Vec{0.5, 1, 0}}, 0.125, {0.25, 0.5, 0});
  scene.lattices[0].atoms.push_back({{0.9, 0.9, 0}, 0, {{0.25, 0, 0}, {0.125, 0.0625, 0}}});
  return scene;
}

Scene solid_motif() {
  Scene scene = one_atom(3, {Vec{1.5, 0.25, 0}, Vec{0.5, 1, 0}, Vec{0.125, 0, 1.25}}, 0.125);
  scene.lattices[0].atoms.push_back(
      {{0.7, 0.6, 0.6}, 0, {{0.375, 0, 0}, {0.125, 0.25, 0}, {0, 0.0625, 0.0625}}});
  return scene;
}

Scene superposition(int dimension) {
  Scene scene = unit_scene(dimension, 0.125);
  Lattice other = unit_scene(dimension, 0.0625).lattices[0];
  other.vectors[0] = {0.6, 0.3, 0}, other.vectors[1] = {-0.3, 0.6, 0};
  other.atoms[0].position = {0.1, 0.2, 0};
  scene.lattices.push_back(other);
  return scene;
}

std::vector<Scene> some_scenes() {
  return {unit_scene(2, 0.25), unit_scene(3, 0.25), flat_motif(),
          solid_motif(),       superposition(2),    superposition(3)};
}

}  // namespace

TEST_CASE("Starts are the same one at a time and in columns, however they are split", "[flights][starts]") {
  constexpr std::size_t kCount = 500;
  for (const Scene& scene : some_scenes())
    for (const Ensemble ensemble : {Ensemble::uniform, Ensemble::surface}) {
      const Candidates starts(scene, ensemble, kSeed);
      QueryRows all, part;
      REQUIRE(drawn(starts, 7, kCount, all).count == kCount);
      Query query;
      for (std::size_t i = 0; i < kCount; ++i) {
        starts.draw(7 + i, 0, query);
        REQUIRE(same(all, i, query, scene.dimension));
        CHECK_FALSE(flaw_of(query, scene));
      }
      for (std::size_t begin = 0, length = 1; begin < kCount; begin += length, length = 2 * length + 1) {
        drawn(Candidates(scene, ensemble, kSeed), 7 + begin, length, part);
        for (std::size_t i = 0; i < length && begin + i < kCount; ++i) {
          starts.draw(7 + begin + i, 0, query);
          REQUIRE(same(part, i, query, scene.dimension));
        }
      }
    }
}

TEST_CASE("Starts have the same bits with every set of instructions", "[flights][starts]") {
  constexpr std::size_t kCount = 131;  // some full rounds of lanes, and a rest
  std::vector<Scene> scenes = some_scenes();
  for (const auto& [name, scene] : all_scenes()) scenes.push_back(scene);
  std::size_t compared = 0, others = 0;
  QueryRows rows;
  Query query;
  for (const std::int64_t instructions : hwy::SupportedAndGeneratedTargets()) {
    hwy::SetSupportedTargetsForTest(instructions);
    for (const Scene& scene : scenes)
      for (const Ensemble ensemble : {Ensemble::uniform, Ensemble::surface})
        for (const std::uint64_t attempt : {0, 3}) {
          const Candidates starts(scene, ensemble, kSeed);
          drawn(starts, 7, kCount, rows, attempt);
          for (std::size_t i = 0; i < kCount; ++i, ++compared) {
            starts.draw(7 + i, attempt, query);
            others += !same(rows, i, query, scene.dimension);
          }
        }
  }
  hwy::SetSupportedTargetsForTest(0);
  CHECK(compared > 0);
  CHECK(others == 0);
}

TEST_CASE("Another seed, index, attempt or ensemble is another start", "[flights][starts]") {
  const Scene scene = unit_scene(2, 0.25);
  const Candidates starts(scene, Ensemble::uniform, kSeed), other(scene, Ensemble::uniform, kSeed + 1);
  Query first, query;
  starts.draw(0, 0, first);
  other.draw(0, 0, query);
  CHECK(query.x != first.x);
  starts.draw(1, 0, query);
  CHECK(query.x != first.x);
  starts.draw(0, 1, query);
  CHECK(query.x != first.x);
  CHECK(query.v != first.v);
  // Every bit of index, attempt and seed counts; columns count on beyond 2^32 and 2^53.
  std::set<double> seen{first.x[0]};
  QueryRows columns;
  for (int bit = 0; bit < 64; ++bit) {
    const std::uint64_t number = std::uint64_t{1} << bit;
    starts.draw(number, 0, query);
    CHECK(seen.insert(query.x[0]).second);
    Candidates(scene, Ensemble::uniform, kSeed ^ number).draw(0, 0, query);
    CHECK(seen.insert(query.x[0]).second);
    starts.draw(0, number, query);
    CHECK(seen.insert(query.x[0]).second);
    drawn(starts, number - 1, 2, columns);
    starts.draw(number, 0, query);
    CHECK(columns.x[0][1] == query.x[0]);
  }
}

// FNV-1a of the bits of some starts: a change of any is a change of every statistic that was published with
// its seed.
TEST_CASE("The starts of a seed stay what they are, to the bit", "[flights][starts]") {
  std::uint64_t hash = 0xcbf29ce484222325;
  const auto add = [&hash](double number) {
    std::uint64_t bits;
    std::memcpy(&bits, &number, sizeof bits);
    for (int byte = 0; byte < 8; ++byte) hash = (hash ^ (bits >> 8 * byte & 255)) * 0x100000001b3;
  };
  for (const Scene& scene : some_scenes())
    for (const Ensemble ensemble : {Ensemble::uniform, Ensemble::surface}) {
      const Candidates starts(scene, ensemble, kSeed);
      Query query;
      for (std::uint64_t i = 0; i < 1000; ++i) {
        starts.draw(i, i % 3, query);
        for (int k = 0; k < 3; ++k) add(query.x[k]), add(query.v[k]);
      }
    }
  CHECK(hash == 0x6e6fdcd5e9f6fb07);
}

TEST_CASE("Columns that are large enough are not allocated anew", "[flights][starts]") {
  const Candidates starts(superposition(3), Ensemble::surface, kSeed);
  QueryRows rows;
  const double* const before = drawn(starts, 0, 100, rows).x[2].data();
  const std::int64_t* const cells = rows.from_cell[2].data();
  drawn(starts, 100, 60, rows);
  CHECK(rows.count == 60);
  drawn(starts, 160, 100, rows);
  CHECK(rows.x[2].data() == before);
  CHECK(rows.from_cell[2].data() == cells);
}

TEST_CASE("Uniform starts are uniform in the cell, or in the box", "[flights][starts]") {
  constexpr std::uint64_t kCount = 200'000;
  for (const Scene& scene : some_scenes()) {
    const int d = scene.dimension;
    const Vec sides = scene.lattices.size() == 1 ? Vec{1, 1, 1} : d == 2 ? Vec{40, 25, 1} : Vec{10, 10, 10};
    const auto dual = dual_of(scene.lattices[0].vectors, d);
    const std::size_t steps = d == 2 ? 16 : 6;
    std::vector<double> counts(d == 2 ? 256 : 216);
    const Candidates starts(scene, Ensemble::uniform, kSeed);
    Query query;
    for (std::uint64_t i = 0; i < kCount; ++i) {
      starts.draw(i, 0, query);
      CHECK_FALSE(query.from);
      const Vec place = coordinates(dual, query.x);
      std::size_t bin = 0;
      for (int k = 0; k < d; ++k) {
        const double share = place[k] / sides[k];
        REQUIRE(share > -1e-12);
        REQUIRE(share < 1 + 1e-12);
        bin =
            bin * steps +
            std::min(steps - 1, static_cast<std::size_t>(std::max(0.0, share) * static_cast<double>(steps)));
      }
      ++counts[bin];
    }
    CHECK(deviation(counts) < kSigmas);
  }
}

TEST_CASE("Directions are isotropic, and of unit length but for rounding", "[flights][starts]") {
  constexpr std::uint64_t kCount = 400'000;
  for (const int d : {2, 3}) {
    const Candidates starts(unit_scene(d, 0.25), Ensemble::uniform, kSeed);
    Histogram around(200), up(200), across(200);
    Query query;
    for (std::uint64_t i = 0; i < kCount; ++i) {
      starts.draw(i, 0, query);
      REQUIRE(std::fabs(length(query.v) - 1) < 6e-16);
      around.add(turn(query.v[1], query.v[0]));
      up.add((query.v[2] + 1) / 2);
      across.add(turn(query.v[2], query.v[0]));
    }
    CHECK(deviation(around.counts()) < kSigmas);
    if (d == 2) continue;
    CHECK(deviation(up.counts()) < kSigmas);
    CHECK(deviation(across.counts()) < kSigmas);
  }
}

TEST_CASE("The series of sine and cosine are those", "[flights][starts]") {
  for (int i = -1000; i <= 1000; ++i) {
    const double a = i * (std::numbers::pi / 4 / 1000);
    CHECK(std::fabs(turned(a)[0] - std::cos(a)) < 2e-16);
    CHECK(std::fabs(turned(a)[1] - std::sin(a)) < 2e-16);
  }
}

// In coordinates y in which the obstacle is the unit ball, cells of the ball's surface (in 2D of the circle),
// each with the length or area that it has in space, by quadrature.
TEST_CASE("Points are uniform on the surface of ellipses and ellipsoids", "[flights][starts]") {
  constexpr std::uint64_t kCount = 400'000;
  for (const Scene& scene : {flat_motif(), solid_motif()}) {
    const int d = scene.dimension;
    const Atom& atom = scene.lattices[0].atoms[1];
    const auto dual = dual_of(semiaxes_of(atom, d), d);
    const Surface surface(atom, d);
    const std::size_t rings = d == 2 ? 1 : 16, sectors = d == 2 ? 200 : 16, parts = 20;
    std::vector<double> counts(rings * sectors), areas(rings * sectors);
    const auto bin_of = [&](const Vec& y) {
      const auto ring =
          d == 2 ? 0
                 : std::min(rings - 1, static_cast<std::size_t>((y[2] + 1) / 2 * static_cast<double>(rings)));
      return ring * sectors +
             std::min(sectors - 1, static_cast<std::size_t>(turn(y[1], y[0]) * static_cast<double>(sectors)));
    };
    const auto normal_at = [&](const Vec& y) {  // its length: of the surface for one of the ball's
      Vec normal{};
      for (int i = 0; i < d; ++i) normal = sum(normal, scaled(dual[i], y[i]));
      return normal;
    };
    for (std::size_t i = 0; i < rings * (d == 2 ? 1 : parts); ++i)
      for (std::size_t k = 0; k < sectors * parts; ++k) {
        const double z =
            d == 2 ? 0 : 2 * (static_cast<double>(i) + 0.5) / static_cast<double>(rings * parts) - 1;
        const double a =
            2 * std::numbers::pi * (static_cast<double>(k) + 0.5) / static_cast<double>(sectors * parts);
        const double width = std::sqrt(1 - z * z);
        const Vec y{width * std::cos(a), width * std::sin(a), z};
        areas[bin_of(y)] += length(normal_at(y));
      }
    for (std::uint64_t i = 0; i < kCount; ++i) {
      cases::Random random(kSeed, "test of surfaces", i);
      const SurfacePoint point = surface.point(random);
      Vec y = coordinates(dual, point.offset);
      if (d == 2) y[2] = 0;
      REQUIRE(std::fabs(length(y) - 1) < 1e-14);
      ++counts[bin_of(y)];
      const Vec normal = normal_at(y);
      REQUIRE(length(sum(point.normal, scaled(normal, -1 / length(normal)))) < 1e-13);
    }
    CHECK(deviation(counts, areas) < kSigmas);
  }
}

TEST_CASE("Directions off a surface follow the cosine law", "[flights][starts]") {
  constexpr std::uint64_t kCount = 1'000'000;
  for (const int d : {2, 3}) {
    const Vec normal = d == 2 ? Vec{0.6, -0.8, 0} : Vec{2.0 / 7, -3.0 / 7, 6.0 / 7};
    const Vec across = d == 2 ? Vec{0.8, 0.6, 0} : Vec{3.0 / std::sqrt(13), 2.0 / std::sqrt(13), 0};
    const Vec third = cross(normal, across);
    double mean = 0, mean2 = 0;
    Histogram angle(200), around(200);
    for (std::uint64_t i = 0; i < kCount; ++i) {
      cases::Random random(kSeed, "test of the cosine law", i);
      const Vec v = cosine_law(random, normal, d);
      const double cosine = dot(v, normal);
      REQUIRE(std::fabs(length(v) - 1) < 1e-15);
      REQUIRE(cosine > -1e-15);
      mean += cosine / kCount, mean2 += cosine * cosine / kCount;
      angle.add(d == 2 ? (dot(v, across) + 1) / 2 : cosine * cosine);  // what is uniform then
      around.add(turn(dot(v, third), dot(v, across)));
    }
    const double expected = d == 2 ? std::numbers::pi / 4 : 2.0 / 3;
    CAPTURE(d, mean, expected);
    CHECK(std::fabs(mean - expected) < kSigmas * std::sqrt((mean2 - mean * mean) / kCount));
    CHECK(deviation(angle.counts()) < kSigmas);
    if (d == 3) CHECK(deviation(around.counts()) < kSigmas);
  }
}

TEST_CASE("Obstacles are chosen by their surface, and stand all over the box", "[flights][starts]") {
  constexpr std::uint64_t kCount = 200'000;
  for (const Scene& scene : {flat_motif(), solid_motif(), superposition(2), superposition(3)}) {
    const int d = scene.dimension;
    const bool in_box = scene.lattices.size() > 1;
    const Vec sides = d == 2 ? Vec{40, 25, 1} : Vec{10, 10, 10};
    const auto dual = dual_of(scene.lattices[0].vectors, d);
    const auto shares = shares_of(scene);
    const std::vector<double> expected = shares->surfaces;
    std::vector<double> counts(2);
    Histogram first(10), second(5);
    const Candidates starts(scene, Ensemble::surface, kSeed);
    Query query;
    for (std::uint64_t i = 0; i < kCount; ++i) {
      starts.draw(i, 0, query);
      REQUIRE(query.from);
      ++counts[static_cast<std::size_t>(query.from->lattice + query.from->atom)];
      const Lattice& lattice = scene.lattices[static_cast<std::size_t>(query.from->lattice)];
      const Atom& atom = lattice.atoms[static_cast<std::size_t>(query.from->atom)];
      Vec off = sum(query.x, scaled(atom.position, -1));
      for (int k = 0; k < d; ++k)
        off = sum(off, scaled(lattice.vectors[k], -static_cast<double>(query.from->cell[k].int64())));
      Vec y = coordinates(dual_of(semiaxes_of(atom, d), d), off);
      if (d == 2) y[2] = 0;
      REQUIRE(std::fabs(length(y) - 1) < 1e-12);  // on it
      if (!in_box) {
        REQUIRE(query.from->cell == Cell{});
        continue;
      }
      if (query.from->lattice == 0) {  // whose cells are those of the box
        first.add((static_cast<double>(query.from->cell[0].int64()) + 0.5) / sides[0]);
        second.add((static_cast<double>(query.from->cell[1].int64()) + 0.5) / sides[1]);
      } else {  // the corner of its cell lies in it, or nearly
        const Vec corner = coordinates(dual, sum(query.x, scaled(off, -1)));
        for (int k = 0; k < d; ++k) {
          REQUIRE(corner[k] > -2);
          REQUIRE(corner[k] < sides[k] + 2);
        }
      }
    }
    CHECK(deviation(counts, expected) < kSigmas);
    if (!in_box) continue;
    CHECK(deviation(first.counts()) < kSigmas);
    CHECK(deviation(second.counts()) < kSigmas);
  }
}

TEST_CASE("A superposition's box has about as many cells as asked for", "[flights][starts]") {
  struct Row {
    std::uint64_t cells;
    int dimension;
    Vec sides;
  };
  for (const Row& row : {Row{1000, 2, {40, 25, 1}}, Row{1000, 3, {10, 10, 10}}, Row{1, 2, {1, 1, 1}},
                         Row{100'000'000, 2, {12649, 7906, 1}}, Row{1'000'000'000, 3, {1000, 1000, 1000}}})
    CHECK(cases::Box::of(superposition(row.dimension), row.cells).cells == row.sides);
  CHECK(cases::Box::of(unit_scene(2, 0.1), 1000).cells == Vec{1, 1, 1});
}

TEST_CASE("An obstacle of next to no surface among others is not chosen, wherever it stands",
          "[flights][starts]") {
  for (const std::size_t small : {0u, 1u}) {
    Scene scene = unit_scene(2, 0.25);
    scene.lattices[0].atoms.push_back({{0.5, 0.5, 0}, 0.25, {}});
    scene.lattices[0].atoms[small].radius = 1e-30;
    const Candidates starts(scene, Ensemble::surface, kSeed);
    Query query;
    for (std::uint64_t i = 0; i < 1000; ++i) {
      starts.draw(i, 0, query);
      REQUIRE(static_cast<std::size_t>(query.from->atom) == 1 - small);
    }
  }
}

TEST_CASE("Any unit of length will do, where binary64 ends it is said", "[flights][starts]") {
  const auto in_units = [](double unit) {
    Scene scene = superposition(3);
    for (Lattice& lattice : scene.lattices) {
      for (Vec& u : lattice.vectors) u = scaled(u, unit);
      for (Atom& atom : lattice.atoms) atom.radius *= unit, atom.position = scaled(atom.position, unit);
    }
    return scene;
  };
  Query query, here;
  for (const double unit : {0x1p-900, 0x1p900})
    for (const Ensemble ensemble : {Ensemble::uniform, Ensemble::surface})
      for (std::uint64_t i = 0; i < 100; ++i) {
        Candidates(in_units(unit), ensemble, kSeed).draw(i, 0, query);
        Candidates(in_units(1), ensemble, kSeed).draw(i, 0, here);
        REQUIRE(query.x == scaled(here.x, unit));
        REQUIRE(query.v == here.v);
        REQUIRE(query.from == here.from);
      }
  CHECK_THROWS_AS(Candidates(in_units(0x1p1010), Ensemble::uniform, kSeed), InputError);
  for (const int dimension : {2, 3})
    for (int axis = 0; axis < dimension; ++axis) {
      Scene far = unit_scene(dimension, 0.1);
      far.lattices[0].atoms.push_back(far.lattices[0].atoms[0]);
      far.lattices[0].atoms[1].position[axis] = 0x1p1001;
      CHECK_THROWS_AS(Candidates(far, Ensemble::uniform, kSeed), InputError);
    }
  Scene speck = unit_scene(3, 1e-320);
  CHECK_THROWS_AS(Candidates(speck, Ensemble::surface, kSeed), InputError);
  CHECK_NOTHROW(Candidates(speck, Ensemble::uniform, kSeed));
  Scene uneven = superposition(2);
  for (Vec& u : uneven.lattices[1].vectors) u = scaled(u, 1e-20);
  CHECK_THROWS_AS(Candidates(uneven, Ensemble::surface, kSeed), InputError);
}
