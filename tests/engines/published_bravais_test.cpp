// The published algorithm beyond the unit lattices: transformed, circumscribed, proposed, verified.
#include <catch2/catch.hpp>

#include <lorentz/geometry.hpp>
#include <lorentz/oracle.hpp>
#include "question/starts/free_starts.hpp"
#include "src/engines/published/published.hpp"
#include "tests/support/scenes.hpp"
#include "tests/support/support.hpp"

using namespace lorentz;
using namespace lorentz::test;

namespace {

constexpr double kForEver = std::numeric_limits<double>::infinity();

Scene triangular(double r) {
  return one_atom(2, {Vec{1, 0}, Vec{0.5, std::sqrt(0.75)}}, r);
}

Scene fcc(double r) {
  return one_atom(3, {Vec{0, 0.5, 0.5}, Vec{0.5, 0, 0.5}, Vec{0.5, 0.5, 0}}, r);
}

struct Count {
  int right = 0, wrong = 0, undecided = 0;
  double worst = 0;
  Proposals proposals;
};

Count hold_against_oracle(const Scene& scene, const std::vector<Query>& queries) {
  const oracle::Oracle oracle(scene);
  const Published published(scene);
  Count count;
  for (const Query& query : queries) {
    const Answer exact = oracle.first_hit(query),
                 given = published.first_hit_counted(query, kForEver, count.proposals);
    const bool agrees = same_obstacle(exact, given);
    count.right += agrees;
    count.wrong += !agrees && given.outcome != Outcome::undecided;
    count.undecided += given.outcome == Outcome::undecided;
    if (agrees && exact.outcome == Outcome::hit)
      count.worst = std::max(count.worst, std::fabs(*given.time - *exact.time) / std::max(1.0, *exact.time));
  }
  return count;
}

Count drawn(const Scene& scene, std::uint64_t seed, std::size_t number) {
  return hold_against_oracle(scene, starts::free_starts(scene, starts::Kind::uniform, seed, number));
}

void add(Count& sum, const Count& count) {
  sum.right += count.right, sum.wrong += count.wrong, sum.undecided += count.undecided;
  sum.worst = std::max(sum.worst, count.worst);
  sum.proposals.made += count.proposals.made;
  sum.proposals.false_ellipse += count.proposals.false_ellipse;
  sum.proposals.false_tricylinder += count.proposals.false_tricylinder;
}

// In any position; the circumscribed ball is at most of this radius.
Atom ellipsoid(Draw& draw, int dimension, double radius) {
  Atom atom{draw.vec(dimension, -1, 1), 0, semiaxes_of(draw, Style::generic, dimension)};
  double square = 0;  // of the Frobenius norm, which is at least the first singular value
  for (const Vec& axis : atom.semiaxes) square += dot(axis, axis);
  for (Vec& axis : atom.semiaxes) axis = scaled(axis, radius / std::sqrt(square));
  return atom;
}

// Flights that leave the ball at the origin, `from` that ball.
std::vector<Query> leaving(int dimension, double r, std::uint64_t seed, std::size_t number) {
  return starts::free_starts(unit_scene(dimension, r), starts::Kind::surface, seed, number);
}

}  // namespace

TEST_CASE("Published in stretched cells, 2D: of drawn flights hardly one is wrong",
          "[engines][published_bravais]") {
  // Measured: none in 160 000. The skipped discs are there (below), for flights that leave a disc.
  INFO("seed 91");
  for (const double r : {0.3, 0.1, 0.01, 0.001})
    for (const Scene& scene :
         {triangular(r), one_atom(2, {Vec{1, 0}, Vec{0, 2}}, r), one_atom(2, {Vec{1, 0}, Vec{1, 1}}, 0.6 * r),
          one_atom(2, {Vec{0.8, -0.9}, Vec{0.3, 1.2}}, r)}) {
      const Count count = drawn(scene, 91, 4000);
      INFO(stream(scene, {}) << count.right << " right, " << count.wrong << " wrong");
      CHECK(count.right + count.wrong == 4000);
      CHECK(count.wrong <= 2);  // 0 seen
      CHECK(count.worst < 1e-12);
      CHECK(count.proposals.made > 6900);  // 8 657 seen at least
      // In 2D a proposal is a hit, or false.
      CHECK(count.proposals.made == count.proposals.false_ellipse + count.right + count.wrong);
      CHECK(count.proposals.false_tricylinder == 0);
    }
}

TEST_CASE("Published in stretched cells, 2D: skipped discs on flights that leave one",
          "[engines][published_bravais]") {
  INFO("seed 92");
  int right = 0, wrong = 0;
  for (const double r : {0.1, 0.2}) {
    const Count count = hold_against_oracle(triangular(r), leaving(2, r, 92, 20'000));
    right += count.right, wrong += count.wrong;
  }
  INFO(wrong << " wrong, " << right << " right");
  CHECK(wrong + right > 39'900);  // 40 000 seen
  CHECK(wrong < 200);             // 96 seen
  CHECK(wrong > 76);              // 96 seen
}

TEST_CASE("Published in stretched cells, 3D: late spheres, about one in a thousand",
          "[engines][published_bravais]") {
  // Measured at r = 0.1: 1 to 6 in 5000.
  INFO("seed 93");
  int wrong = 0, right = 0;
  for (const double r : {0.1, 0.03})
    for (const Scene& scene : {fcc(r), one_atom(3, {Vec{1, 0}, Vec{0, 2}, Vec{0, 0, 1.5}}, r),
                               one_atom(3, {Vec{1, 0}, Vec{0.3, 1}, Vec{0.2, -0.4, 1.1}}, r)}) {
      const Count count = drawn(scene, 93, 5000);
      INFO(stream(scene, {}) << count.right << " right, " << count.wrong << " wrong");
      CHECK(count.undecided == 0);
      CHECK(count.wrong < 15);  // 2 seen at most
      CHECK(count.worst < 1e-11);
      CHECK(count.proposals.false_ellipse > 5100);      // 6 449 seen at least
      CHECK(count.proposals.false_tricylinder > 1900);  // 2 482 seen at least
      CHECK(count.proposals.made >=
            count.proposals.false_ellipse + count.proposals.false_tricylinder + count.right + count.wrong);
      wrong += count.wrong, right += count.right;
    }
  INFO(wrong << " wrong, " << right << " right");
  CHECK(wrong >= 1);  // 6 seen
  CHECK(wrong < 45);  // 6 seen
}

TEST_CASE("A false proposal is counted, and passed over", "[engines][published_bravais]") {
  // The cell 1 x 4 becomes a square, the disc an ellipse of half-axes 0.2 and 0.05 in a circle of 0.2. There
  // the line has the height 0.05 + k/10 in column k. It meets the circles (1,0) and (8,1), which are 0.15
  // off, at 0.56 from the true discs, and then (9,1), at 0.19 from the disc.
  const Scene scene = one_atom(2, {Vec{1, 0}, Vec{0, 4}}, 0.2);
  Proposals proposals;
  const Answer answer = Published(scene).first_hit_counted({{0.5, 0.4}, {1, 0.4}, {}}, kForEver, proposals);
  CHECK(answer.obstacle == ObstacleId{0, 0, {Integer(9), Integer(1), Integer(0)}});
  CHECK(proposals.made == 3);
  CHECK(proposals.false_ellipse == 2);
  CHECK(*answer.time ==
        Approx(*oracle::Oracle(scene).first_hit({{0.5, 0.4}, {1, 0.4}, {}}).time).epsilon(1e-14));
  // From inside the circle of (1,0), where the search can only propose that disc again.
  proposals = {};
  CHECK(Published(scene).first_hit_counted({{1, 0.6}, {1, 0.4}, {}}, kForEver, proposals).obstacle ==
        answer.obstacle);
  CHECK(proposals.made == 3);
  // And from there towards the disc.
  CHECK(Published(scene).first_hit({{1, 0.6}, {0.1, -1}, {}}).obstacle.cell[0] == Integer(1));
  // A limit ends the flight.
  CHECK(Published(scene).first_hit({{0.5, 0.4}, {1, 0.4}, {}}, 8).outcome == Outcome::later);
}

TEST_CASE("In 3D the three planes agree on a sphere that the line misses", "[engines][published_bravais]") {
  INFO("seed 94");
  const Count count = drawn(unit_scene(3, 0.03), 94, 5000);
  // Seen along v, three cylinders of the sphere's radius leave a hexagon around its disc.
  const double share =
      static_cast<double>(count.proposals.false_tricylinder) / static_cast<double>(count.proposals.made);
  CHECK(share > 0.1);
  CHECK(share < 0.4);
  CHECK(count.proposals.false_ellipse == 0);
}

TEST_CASE("Published with several atoms is the earliest of each alone", "[engines][published_bravais]") {
  Draw draw(95);
  INFO("seed 95");
  int hits = 0, inside = 0;
  for (int i = 0; i < 500; ++i) {
    const int dimension = draw.one_in(2) ? 2 : 3;
    Scene scene = dimension == 2 ? triangular(0.1) : fcc(0.1);
    if (draw.one_in(2)) scene.lattices.push_back(unit_scene(dimension, 0.2).lattices[0]);
    for (int atoms = 0; atoms < 3; ++atoms)
      scene.lattices[0].atoms.push_back(
          {draw.vec(dimension, -1, 1), draw.between(0.01, dimension == 2 ? 0.3 : 0.2), {}});
    if (draw.one_in(2)) scene.lattices[0].atoms.back() = ellipsoid(draw, dimension, 0.2);
    const Query query{draw.vec(dimension, -2, 2), draw.vec(dimension, -1, 1), {}};
    INFO(stream(scene, query));
    Answer expected = Answer::never();
    for (int l = 0; l < static_cast<int>(scene.lattices.size()); ++l)
      for (int a = 0; a < static_cast<int>(scene.lattices[l].atoms.size()); ++a) {
        Scene alone = scene;
        alone.lattices = {scene.lattices[l]};
        alone.lattices[0].atoms = {scene.lattices[l].atoms[a]};
        Answer answer = Published(alone).first_hit(query);
        answer.obstacle.lattice = l, answer.obstacle.atom = a;
        if (expected.outcome == Outcome::inside) continue;  // the first of them
        const bool sooner = answer.outcome == Outcome::inside || expected.outcome == Outcome::never ||
                            *answer.time < *expected.time;
        if (sooner) expected = answer;
      }
    const Answer given = Published(scene).first_hit(query);
    INFO(line(expected, dimension) << line(given, dimension));
    REQUIRE(given.outcome == expected.outcome);
    REQUIRE(given.obstacle == expected.obstacle);
    if (given.time) CHECK(*given.time == Approx(*expected.time).epsilon(1e-12));
    hits += given.outcome == Outcome::hit, inside += given.outcome == Outcome::inside;
  }
  CHECK(hits > 200);   // 379 seen
  CHECK(inside > 96);  // 121 seen
}

TEST_CASE("The transformed search equals the unit lattices' own where nothing is stretched",
          "[engines][published_bravais]") {
  Draw draw(96);
  INFO("seed 96");
  int differ = 0;
  for (int i = 0; i < 10'000; ++i) {
    const int dimension = draw.one_in(2) ? 2 : 3;
    const Scene unit = unit_scene(dimension, draw.between(0.05, 0.45));
    Scene moved = unit;  // by nothing that counts: it is not the unit scene
    moved.lattices[0].atoms[0].position[0] = 0x1p-1000;
    const Query query{draw.vec(dimension, -2, 2), draw.vec(dimension, -1, 1), {}};
    Proposals of_unit, of_moved;
    const Answer expected = Published(unit).first_hit_counted(query, kForEver, of_unit),
                 given = Published(moved).first_hit_counted(query, kForEver, of_moved);
    REQUIRE(same(expected, make_engine("published", unit)->first_hit(query)));
    differ += given.outcome != expected.outcome || !(given.obstacle == expected.obstacle) ||
              of_unit.made != of_moved.made || of_unit.false_tricylinder != of_moved.false_tricylinder;
  }
  // A line that misses a disc by a rounding error is verified in the one, and believed in the other.
  CHECK(differ <= 1);  // 0 seen
}

TEST_CASE("`from` is left alone in a stretched cell, wherever the flight begins",
          "[engines][published_bravais]") {
  const Scene scene = one_atom(2, {Vec{1, 0}, Vec{0, 4}}, 0.2);
  const ObstacleId one{0, 0, {Integer(1), Integer(0), Integer(0)}};
  CHECK(Published(scene).first_hit({{0.5, 0.05}, {1, 0.01}, {}}).obstacle == one);
  CHECK(Published(scene).first_hit({{0.5, 0.05}, {1, 0.01}, one}).obstacle.cell[0] == Integer(2));
  CHECK(Published(scene).first_hit({{1.1, 0.05}, {1, 0.01}, {}}).outcome == Outcome::inside);
  CHECK(Published(scene).first_hit({{1.1, 0.05}, {1, 0.01}, one}).obstacle.cell[0] == Integer(2));
}

TEST_CASE("`from` is left alone in a stretched cell also where it is far ahead",
          "[engines][published_bravais]") {
  Draw draw(97);
  INFO("seed 97");
  int right = 0;
  for (int i = 0; i < 600; ++i) {
    const Scene scene = draw.one_in(2) ? triangular(0.05) : fcc(0.1);
    Query query{draw.vec(scene.dimension, -2, 2), draw.vec(scene.dimension, -1, 1), {}};
    const Answer first = Published(scene).first_hit(query);
    if (first.outcome != Outcome::hit) continue;
    query.from = first.obstacle;
    const Answer next = Published(scene).first_hit(query);
    INFO(stream(scene, query) << line(next, scene.dimension));
    REQUIRE(next.outcome == Outcome::hit);
    REQUIRE_FALSE(next.obstacle == first.obstacle);
    right += same_obstacle(oracle::Oracle(scene).first_hit(query), next);
  }
  INFO(right << " right");
  CHECK(right > 500);  // 564 seen
}

TEST_CASE("What published does not do beyond the unit lattices, it says", "[engines][published_bravais]") {
  const Query query{{0.5, 0.4}, {1, 0.3}, {}};
  using Catch::Contains;
  const auto message = [](const Scene& scene, const Query& one) {
    const Answer answer = make_engine("published", scene)->first_hit(one);
    CHECK(answer.unsupported);
    return answer.message;
  };
  CHECK_THAT(message(unit_scene(2, 0.6), query), Contains("half the spacing"));
  CHECK_THAT(message(one_atom(2, {Vec{1, 0}, Vec{1, 1}}, 0.31), query), Contains("circumscribed"));
  CHECK(make_engine("published", one_atom(2, {Vec{1, 0}, Vec{1, 1}}, 0.3))->first_hit(query).outcome ==
        Outcome::hit);  // sigma_1 = (1 + sqrt 5) / 2: up to r = 0.309
  CHECK_THAT(message(one_atom(2, {Vec{1, 0}, Vec{2, 0}}, 0.1), query), Contains("circumscribed"));
  CHECK_THAT(message(one_atom(2, {Vec{1e300, 0}, Vec{0, 1}}, 0.1), query), Contains("2^200"));
  CHECK_THAT(message(triangular(0.1), {{0x1p60, 0}, {1, 0.3}, {}}), Contains("too far"));
  CHECK_THAT(message(triangular(0.1), {{0, 0.3}, {1, 0}, {}}), Contains("octant"));
  const auto ellipse = [](const Vec& a, const Vec& b) {
    Scene scene = unit_scene(2, 0.1);
    scene.lattices[0].atoms[0] = {{}, 0, {a, b}};
    return scene;
  };
  CHECK(make_engine("published", ellipse({0.1, 0}, {0, 0.5}))->first_hit(query).outcome == Outcome::hit);
  CHECK_THAT(message(ellipse({0.1, 0}, {0, 0.51}), query), Contains("circumscribed"));
  CHECK_THAT(message(ellipse({0.3, 0.3}, {-0.4, 0.4}), query), Contains("circumscribed"));
  CHECK_THAT(message(ellipse({0x1p-201, 0}, {0, 0.2}), query), Contains("semiaxes"));
  CHECK_THAT(message(ellipse({0.125, 0x1p-190}, {0.125, 0x1p-190}), query), Contains("thicker"));
}

TEST_CASE("An ellipse in the square is a disc in the cell that is stretched back",
          "[engines][published_bravais]") {
  // By a power of two, so the search is the same; only the quadratic is in units of the radius.
  Draw draw(98);
  INFO("seed 98");
  const Scene stretched = one_atom(2, {Vec{1, 0}, Vec{0, 4}}, 0.25);
  Scene ellipse = unit_scene(2, 1);
  ellipse.lattices[0].atoms[0] = {{}, 0, {Vec{0.25, 0}, Vec{0, 0.0625}}};
  Proposals of_disc, of_ellipse;
  int hits = 0;
  for (int i = 0; i < 2000; ++i) {
    const Query query{draw.vec(2, -2, 2), draw.vec(2, -1, 1), {}};
    const Answer disc = Published(stretched).first_hit_counted(
                     {{query.x[0], 4 * query.x[1]}, {query.v[0], 4 * query.v[1]}, {}}, kForEver, of_disc),
                 given = Published(ellipse).first_hit_counted(query, kForEver, of_ellipse);
    REQUIRE(given.outcome == disc.outcome);
    REQUIRE(given.obstacle == disc.obstacle);
    if (given.outcome != Outcome::hit) continue;
    ++hits;
    CHECK(*given.time == Approx(*disc.time).epsilon(1e-13));
  }
  CHECK(hits > 1800);
  CHECK(of_ellipse.made == of_disc.made);
  CHECK(of_ellipse.false_ellipse == of_disc.false_ellipse);
  CHECK(of_ellipse.false_ellipse > 1000);
}

TEST_CASE("Published among ellipses and ellipsoids: of drawn flights hardly one is wrong",
          "[engines][published_bravais]") {
  INFO("seed 99");
  for (const int dimension : {2, 3})
    for (const double size : {0.45, 0.1, 0.02}) {
      Draw draw(99);
      Count sum;
      for (int i = 0; i < 20; ++i) {
        const bool unit = draw.one_in(2) || dimension == 3;
        Scene scene = unit ? unit_scene(dimension, 0.1) : triangular(0.1);
        scene.lattices[0].atoms[0] = ellipsoid(draw, dimension, size);
        add(sum, drawn(scene, 99, 400));
      }
      INFO(dimension << "D, " << size << ": " << sum.right << " right, " << sum.wrong << " wrong");
      CHECK(sum.right + sum.wrong == 8000);
      CHECK(sum.wrong <= 4);                         // 1 seen at most, in 3D
      CHECK(sum.worst < 1e-12);                      // 1.3e-14 seen
      CHECK(sum.proposals.false_ellipse > 8000);     // 10 830 seen at least
      CHECK(sum.proposals.false_ellipse < 200'000);  // 166 899 seen at most
    }
}

TEST_CASE("Published skips obstacles on flights that leave an ellipse, and none on those from an ellipsoid",
          "[engines][published_bravais]") {
  INFO("seed 100");
  for (const auto& [dimension, least, most] : {std::tuple{2, 285, 475}, {3, 0, 4}}) {
    Draw draw(100);
    Count sum;
    for (int i = 0; i < 20; ++i) {
      Scene scene = unit_scene(dimension, 0.1);
      scene.lattices[0].atoms[0] = ellipsoid(draw, dimension, 0.4);
      add(sum, hold_against_oracle(scene, starts::free_starts(scene, starts::Kind::surface, 100, 1000)));
    }
    INFO(sum.wrong << " wrong, " << sum.right << " right");
    CHECK(sum.wrong + sum.right == 20'000);
    CHECK(sum.wrong >= least);  // 380 seen in the plane, none in space
    CHECK(sum.wrong <= most);
    CHECK(sum.worst < 1e-11);  // 2.8e-13 seen
  }
}

TEST_CASE("Published in crystals and superpositions of balls and ellipsoids",
          "[engines][published_bravais]") {
  INFO("seed 101");
  for (const int dimension : {2, 3}) {
    Draw draw(101);
    Count sum;
    for (int i = 0; i < 20; ++i) {
      Scene scene = dimension == 2 ? triangular(0.1) : fcc(0.1);
      scene.lattices.push_back(unit_scene(dimension, 0.05).lattices[0]);
      for (Lattice& lattice : scene.lattices) {
        lattice.atoms.push_back(ellipsoid(draw, dimension, 0.1));
        lattice.atoms.push_back(ellipsoid(draw, dimension, 0.2));
      }
      add(sum, drawn(scene, 101, 200));
    }
    INFO(dimension << "D: " << sum.right << " right, " << sum.wrong << " wrong");
    CHECK(sum.right + sum.wrong == 4000);
    CHECK(sum.wrong <= 4);     // none seen in 2D, 1 in 3D
    CHECK(sum.worst < 1e-12);  // 4.1e-14 seen
  }
}
