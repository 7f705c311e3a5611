// Shrinking: the failure stays, the numbers become readable.
#include "fuzz/campaign/shrink.hpp"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <set>

#include "fuzz/campaign/campaign.hpp"
#include "fuzz/campaign/examiner.hpp"
#include "question/cases/integer_vectors.hpp"
#include "tests/fuzz/campaign_support.hpp"
#include "tests/support/support.hpp"

using namespace lorentz;
using namespace lorentz::test;
using fuzz::bits_of;
using fuzz::Kind;
using fuzz::Shrunk;

namespace {

constexpr int kReadable = 12;

// Keeps what a case of the published algorithm's is.
Shrunk shrink_published(const Scene& scene, const Query& query, Kind kind, int tries) {
  const auto answerer = fuzz::answerer_maker(question::engine_named("published"))({});
  const auto kind_of = [&](const Scene& s, const Query& q) {
    if (!cases::is_sound(s) || flaw_of(q, s)) return Kind::agree;
    return fuzz::Examiner(*answerer, std::make_shared<question::Place>(s), 4).examine(q).kind;
  };
  REQUIRE(kind_of(scene, query) == kind);
  const Shrunk shrunk =
      fuzz::shrink(scene, query, [&](const Scene& s, const Query& q) { return kind_of(s, q) == kind; }, {},
                   {double(tries), {}});
  CHECK(kind_of(shrunk.scene, shrunk.query) == kind);
  CHECK(shrunk.tries <= tries);
  return shrunk;
}

}  // namespace

TEST_CASE("Significant bits of a number", "[fuzz][shrink]") {
  CHECK(bits_of(0) == 0);
  CHECK(bits_of(1) == 1);
  CHECK(bits_of(-0.5) == 1);
  CHECK(bits_of(3) == 2);
  CHECK(bits_of(0x1p-1074) == 1);
  CHECK(bits_of(0x3p-1074) == 2);
  CHECK(bits_of(0x1p1023) == 1);
  CHECK(bits_of(0.1) == 52);
  CHECK(bits_of(1 + 0x1p-52) == 53);
}

TEST_CASE("The published algorithm's faults shrink to numbers that can be read", "[fuzz][shrink]") {
  const auto check = [](const Shrunk& shrunk) {
    INFO(stream(shrunk.scene, shrunk.query));
    CHECK(fuzz::most_bits(shrunk.scene, shrunk.query) <= kReadable);
    CHECK(is_unit_scene(shrunk.scene));
  };
  SECTION("skipped disc") {
    check(shrink_published(unit_scene(2, 0.2), {{-9.0 / 205, 8.0 / 41}, {9, 5}, ObstacleId{}}, Kind::wrong,
                           2000));
    check(shrink_published(unit_scene(2, 0.05), {{-7.0 / 500, 6.0 / 125}, {8, 7}, ObstacleId{}}, Kind::wrong,
                           2000));
  }
  SECTION("late sphere") {
    check(shrink_published(unit_scene(3, 0.2), {{0.8, 0.2, 0.5}, {-25, 2, -1}, {}}, Kind::wrong, 2000));
  }
  SECTION("endless channel, at the price of its cap for each try") {
    check(shrink_published(unit_scene(2, 1.0 / 81), {{0, 0.878597}, {2, 1}, {}}, Kind::undecided, 40));
  }
}

TEST_CASE("What does not matter goes: lattices, atoms, ellipsoids, `from`, far cells", "[fuzz][shrink]") {
  const double root = 0.8660254037844386;
  Scene scene{2,
              {{{Vec{1, 0}, Vec{0.5, root}, Vec{}},
                {{{0.1, 0.2}, 0, {{0.2, 0.01}, {-0.01, 0.1}}}, {{0.5, 0.3}, 0.123, {}}}},
               {{Vec{3, 0.1}, Vec{0.2, 2}, Vec{}}, {{{0.3, 0.3}, 0.05, {}}}}}};
  const Query query{{1000.123, -77.7}, {-0.3, 0.9}, ObstacleId{1, 0, {Integer(5), Integer(-3), Integer(0)}}};
  const auto any = [](const Scene& s, const Query& q) { return cases::is_sound(s) && !flaw_of(q, s); };
  const Shrunk shrunk = fuzz::shrink(scene, query, any);
  CHECK(is_unit_scene(shrunk.scene));
  CHECK_FALSE(shrunk.query.from);
  CHECK(shrunk.query.x == Vec{});
  CHECK(fuzz::most_bits(shrunk.scene, shrunk.query) == 1);
}

TEST_CASE("What matters stays", "[fuzz][shrink]") {
  const Scene scene = unit_scene(3, 0.3);
  const Query query{
      {0.3, 0.1, 0.77}, {0.123, 0.7, -0.2}, ObstacleId{0, 0, {Integer(0), Integer(2), Integer(0)}}};
  int asked = 0;
  const auto needs = [&](const Scene& s, const Query& q) {
    ++asked;
    return !flaw_of(q, s) && q.from && q.from->cell[1] == Integer(2) && q.v[2] < 0 && q.x[0] > 0.29 &&
           s.lattices[0].atoms[0].radius > 0.26;
  };
  REQUIRE(needs(scene, query));
  asked = 0;
  const Shrunk shrunk = fuzz::shrink(scene, query, needs);
  CHECK(needs(shrunk.scene, shrunk.query));
  CHECK(shrunk.tries == asked - 1);
  CHECK(shrunk.query.v[2] == -1);
  CHECK(bits_of(shrunk.query.x[0]) <= 2);  // 1 seen
  CHECK(bits_of(shrunk.scene.lattices[0].atoms[0].radius) == 1);
  const Shrunk again = fuzz::shrink(scene, query, needs);
  CHECK(stream(again.scene, again.query) == stream(shrunk.scene, shrunk.query));
}

TEST_CASE("Tries are bounded, and no case is tried twice", "[fuzz][shrink]") {
  const Scene scene = unit_scene(2, 0.3);
  const Query query{{0.3, 0.1}, {0.123, 0.7}, {}};
  std::set<std::string> seen;
  const auto never = [&](const Scene& s, const Query& q) {
    CHECK(seen.insert(stream(s, q)).second);
    return false;
  };
  const Shrunk all = fuzz::shrink(scene, query, never);
  CHECK(all.tries == static_cast<int>(seen.size()));
  CHECK(all.tries < fuzz::kShrinkTries);
  seen.clear();
  CHECK(fuzz::shrink(scene, query, never, {}, {7, {}}).tries == 7);
  CHECK(seen.size() == 7);
}

TEST_CASE("Numbers that spread over thousands of bits cost many tries each", "[fuzz][shrink]") {
  Scene scene = unit_scene(2, 0.3);
  const Query plain{{0.3, 0.1}, {0.123, 0.7}, {}}, wide{{0.3, 0.1}, {0.123, 0x1.8p-1000}, {}};
  CHECK(fuzz::price(scene, plain) == 1);
  CHECK(fuzz::price(scene, wide) > 3.8);
  CHECK(fuzz::price(scene, wide) < 4);
  const auto wide_ones = [&](const Scene& s, const Query& q) { return fuzz::price(s, q) > 3; };
  const Shrunk shrunk = fuzz::shrink(scene, wide, wide_ones, {}, {40, {}});
  CHECK(shrunk.tries >= 10);
  CHECK(shrunk.tries < 40);  // 17 seen: some of them plain
}

TEST_CASE("Shrinking ends when its caller says that it is enough", "[fuzz][shrink]") {
  const Query query{{0.3, 0.1}, {0.123, 0.7}, {}};
  int asked = 0;
  const auto never = [&](const Scene&, const Query&) { return ++asked < 0; };
  CHECK(fuzz::shrink(unit_scene(2, 0.3), query, never, {}, {3000, [&] { return asked == 5; }}).tries == 5);
  CHECK(asked == 5);
}

TEST_CASE("A shorter flight, where it is as simple", "[fuzz][shrink]") {
  const Scene scene = unit_scene(2, 0.25);
  const oracle::Oracle oracle(scene);
  double length = 0;
  const auto hits = [&](const Scene& s, const Query& q) {
    if (flaw_of(q, s) || !is_unit_scene(s) || s.lattices[0].atoms[0].radius != 0.25 || q.v != Vec{1, 0x1p-6})
      return false;
    const Answer answer = oracle.first_hit(q);
    length = answer.time.value_or(-1);
    return answer.outcome == Outcome::hit;
  };
  const Query query{{0.5, 0.40625}, {1, 0x1p-6}, {}};
  REQUIRE(hits(scene, query));
  const double before = length;
  const Shrunk shrunk = fuzz::shrink(scene, query, hits, [&] { return length; });
  REQUIRE(hits(shrunk.scene, shrunk.query));
  CHECK(length < before);
}

TEST_CASE("Shrinking leaves out atoms before the one that `from` names, which keeps its obstacle",
          "[fuzz][shrink]") {
  Scene scene = unit_scene(2, 0.125);
  scene.lattices[0].atoms.push_back({{0.5, 0.25}, 0.1, {}});
  scene.lattices[0].atoms.push_back({{0.25, 0.75}, 0.0625, {}});
  const Query query{{0.3, 0.8}, {-0.7, -0.3}, ObstacleId{0, 2, {}}};
  const auto fails = [](const Scene& its, const Query& asked) {
    const auto& atoms = its.lattices[0].atoms;  // one more must stay
    if (std::none_of(atoms.begin(), atoms.end(), [](const Atom& one) { return one.radius == 0.1; }))
      return false;
    if (flaw_of(its) || flaw_of(asked, its) || !asked.from) return false;
    return its.lattices[asked.from->lattice].atoms[asked.from->atom].radius == 0.0625 && asked.v[0] < 0 &&
           asked.v[1] < 0;
  };
  const fuzz::Shrunk shrunk = fuzz::shrink(scene, query, fails);
  CHECK(fails(shrunk.scene, shrunk.query));
  CHECK(shrunk.scene.lattices[0].atoms.size() == 2);
  CHECK(shrunk.query.from->atom == 1);
}

TEST_CASE("Shrinking leaves out one lattice of two, before or after the one that `from` names",
          "[fuzz][shrink]") {
  const std::size_t kept = GENERATE(0, 1);
  Scene scene = unit_scene(2, 0.125);
  scene.lattices.push_back(scene.lattices[0]);
  scene.lattices[kept] = {{Vec{1, 0.25}, Vec{0, 1}, Vec{}}, {{{}, 0.0625, {}}}};
  const Query query{{0.3, 0.8}, {0.7, 0.3}, ObstacleId{static_cast<int>(kept), 0, {}}};
  // The unit lattice will not do.
  const auto fails = [](const Scene& its, const Query& asked) {
    if (flaw_of(its) || flaw_of(asked, its) || !asked.from) return false;
    const Lattice& left = its.lattices[asked.from->lattice];
    return left.atoms[0].radius == 0.0625 && left.vectors[0][1] == 0.25;
  };
  const Shrunk shrunk = fuzz::shrink(scene, query, fails);
  CHECK(fails(shrunk.scene, shrunk.query));
  CHECK(shrunk.scene.lattices.size() == 1);
}

TEST_CASE("A number that is simpler to read has a lower complexity", "[fuzz][shrink]") {
  const Scene scene = unit_scene(2, 0.25);
  const auto score = [&](double x) { return fuzz::complexity(scene, {{x, 0}, {1, 0}, {}}); };
  const double in_order[] = {0, 1, -1, 2, -2, 0x1p-2, -0x1p-2, 3, 0.1};
  for (std::size_t i = 1; i < std::size(in_order); ++i) {
    INFO(in_order[i]);
    CHECK(score(in_order[i - 1]) < score(in_order[i]));
  }
  CHECK(score(1024) == score(0x1p-10));
  const Query left{{}, {1, 0}, cases::obstacle({0, 0})}, far{{}, {1, 0}, cases::obstacle({5, 0})};
  CHECK(fuzz::complexity(scene, left) > score(0));
  CHECK(fuzz::complexity(scene, far) > fuzz::complexity(scene, left));
  Scene two = scene, ellipse = scene, lattices = scene;
  two.lattices[0].atoms.push_back(two.lattices[0].atoms[0]);
  ellipse.lattices[0].atoms[0] = {{}, 0, {{0.25, 0}, {0, 0.25}}};
  lattices.lattices.push_back(lattices.lattices[0]);
  const Query query{{}, {1, 0}, {}};
  CHECK(fuzz::complexity(scene, query) < fuzz::complexity(ellipse, query));
  CHECK(fuzz::complexity(ellipse, query) < fuzz::complexity(two, query));
  CHECK(fuzz::complexity(two, query) < fuzz::complexity(lattices, query));
}

TEST_CASE("Shrinking reflects, brings home, and makes velocities and radii small", "[fuzz][shrink]") {
  const Scene solid = unit_scene(3, 0.25);
  const Query reflected{{-0.25, 0.5, -0.75}, {-1, -2, -4}, ObstacleId{0, 0, {1, -2, 3}}};
  const auto on_same_sides = [&](const Scene& its, const Query& q) {
    if (!(its == solid) || !q.from) return false;
    for (int i = 0; i < 3; ++i) {
      const double sign = q.v[i] / reflected.v[i];
      if (std::fabs(sign) != 1 || q.x[i] != sign * reflected.x[i] ||
          double(q.from->cell[i].int64()) != sign * double(reflected.from->cell[i].int64()))
        return false;
    }
    return true;
  };
  const Query ahead = fuzz::shrink(solid, reflected, on_same_sides).query;
  CHECK(ahead.v == Vec{1, 2, 4});
  CHECK(on_same_sides(solid, ahead));

  const Scene flat = unit_scene(2, 0.25);
  for (const bool leaves : {false, true}) {
    const Query far{{5.25, -2.5}, {1, 0}, leaves ? std::optional(cases::obstacle({5, -3})) : std::nullopt};
    const auto as_far = [&](const Scene& its, const Query& q) {
      if (!(its == flat) || q.from.has_value() != leaves || q.v != far.v) return false;
      for (int i = 0; i < 2; ++i) {
        const double n = leaves ? double(q.from->cell[i].int64() - far.from->cell[i].int64())
                                : std::round(q.x[i] - far.x[i]);
        if (q.x[i] - far.x[i] != n) return false;
      }
      return true;
    };
    CHECK(fuzz::shrink(flat, far, as_far).query.x == Vec{0.25, 0.5});
  }

  const auto velocity = [&](const Vec& v) {
    const auto along = [&](const Scene&, const Query& q) {
      return q.v[0] * v[1] == q.v[1] * v[0] && q.v[0] * v[0] > 0;
    };
    return fuzz::shrink(flat, {{}, v, {}}, along).query.v;
  };
  CHECK(velocity({-4.5, 7.5}) == Vec{-0.75, 1.25});
  CHECK(velocity({0x1p40, 0x1.234567p40}) == Vec{1, 0x1.234567p0});

  const auto radius = [&](double r, double least, double most) {  // 3 * 2^k
    const auto is_three = [&](const Scene& its, const Query&) {
      const double now = its.lattices[0].atoms[0].radius;
      return now >= least && now <= most && std::frexp(now, std::array<int, 1>{}.data()) == 0.75;
    };
    return fuzz::shrink(unit_scene(2, r), {{}, {1, 0}, {}}, is_three).scene.lattices[0].atoms[0].radius;
  };
  CHECK(radius(96, 1, 100) == 1.5);
  CHECK(radius(0x3p-10, 0, 1) == 0.75);
}
