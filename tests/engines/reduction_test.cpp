// The reduction engine against the oracle: where it answers it is right, it says when it does not know, and
// it gives the same bits however it is run.
#include <lorentz/reduction.hpp>

#include <boost/multiprecision/mpfr.hpp>
#include <catch2/catch.hpp>

#include <algorithm>
#include <limits>

#include <lorentz/certified.hpp>
#include <lorentz/geometry.hpp>
#include <lorentz/oracle.hpp>
#include "src/engines/reduction/bravais.hpp"
#include "tests/engines/reduction_support.hpp"

using namespace lorentz;
using namespace lorentz::test;

namespace {

bool too_flat(const Scene& scene) {
  for (const Lattice& lattice : scene.lattices)
    if (std::fabs(determinant(lattice, scene.dimension)) < 0.05) return true;
  return false;
}

// A scene that the engine does: the radii of a drawn one, often scaled down, log-uniformly to the smallest.
Scene supported_scene(Draw& draw, Style style, int dimension) {
  for (;;) {
    Scene scene = scene_of(draw, style, dimension);
    const double shrink = draw.one_in(2)   ? 1
                          : draw.one_in(2) ? 0.3
                                           : std::exp2(draw.between(dimension == 2 ? -38 : -21, -1));
    for_each_atom(scene, [&](Atom& atom) { atom.radius *= shrink; });
    if (!too_flat(scene) && !Reduction::beyond(scene)) return scene;
  }
}

using Real = boost::multiprecision::number<boost::multiprecision::mpfr_float_backend<60>>;

// The distance of a ball's centre from the line of flight in a unit scene, rounded to binary64.
double distance_from_line(const Query& query, const ObstacleId& id) {
  Real d[3], v2 = 0, cross2 = 0;
  for (int i = 0; i < 3; ++i) {
    d[i] = Real(id.cell[i].int64()) - Real(query.x[i]);
    v2 += Real(query.v[i]) * query.v[i];
  }
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    const Real c = Real(query.v[j]) * d[k] - Real(query.v[k]) * d[j];
    cross2 += c * c;
  }
  return static_cast<double>(sqrt(cross2 / v2));
}

// Grazing hits: the radius within 2^-54 to 2^-20 of the distance at which the ball is passed that a larger
// one would hit, log-uniformly.
Count grazing_campaign(std::uint64_t seed, long cases, double smallest_2d, double smallest_3d) {
  Count count;
  Draw draw(seed);
  while (count.cases < cases) {
    const int dimension = draw.one_in(2) ? 2 : 3;
    double r = std::exp2(draw.between(dimension == 2 ? smallest_2d : smallest_3d, -1.1));
    Query query{draw.vec(dimension, 0, 1), draw.vec(dimension, -1, 1), {}};
    const Answer larger = oracle::Oracle(unit_scene(dimension, r)).first_hit(query);
    if (larger.outcome != Outcome::hit) continue;
    r = distance_from_line(query, larger.obstacle) * (1 + draw.tiny(-54, -20));
    const Scene scene = unit_scene(dimension, r);
    if (!Reduction::beyond(scene)) check(scene, query, count);
  }
  return count;
}

Scene square(double r) {
  return unit_scene(2, r);
}
Scene cubic(double r) {
  return unit_scene(3, r);
}

}  // namespace

TEST_CASE("The reduction engine agrees with the oracle on drawn and constructed cases",
          "[engines][reduction]") {
  const Count count = campaign(20'161'115, 6000, supported_scene);
  CHECK(count.hit > 15'000);                  // 19 203 seen
  CHECK(count.never > 2'000);                 // 2 577 seen
  CHECK(count.inside > 3'000);                // INSIDE seen
  CHECK(count.stages.binary64 > 25'000);      // 30 825 seen
  CHECK(count.stages.double_double > 2'700);  // 3 441 seen
  CHECK(count.stages.undecided < 1'000);      // 633 seen
}

TEST_CASE("Grazing hits: every stage decides, and none wrongly", "[engines][reduction]") {
  // With kHeight, kRho and kScale of bounds.hpp divided by 50 this goes red (planted, and seen).
  const Count count = grazing_campaign(7, 20'000, -12, -8);
  CHECK(count.stages.binary64 > 10'000);      // 14 707 seen
  CHECK(count.stages.double_double > 4'200);  // 5 293 seen
  CHECK(count.stages.undecided == 0);
  // Among tiny balls double-double errs by more than an ulp of the radius: 449 are decided without rounding.
  const Count tiny = grazing_campaign(8, 5'000, -36, -20);
  CHECK(tiny.stages.undecided == 0);
}

TEST_CASE("The reduction engine agrees with the oracle, long", "[engines][reduction][long]") {
  const Count drawn = campaign(1, 300'000, supported_scene), grazing = grazing_campaign(2, 700'000, -36, -20);
  CHECK(drawn.stages.undecided < static_cast<std::uint64_t>(drawn.cases) / 10);
  CHECK(grazing.stages.double_double > 20'000);
  WARN("worst error of a time: " << drawn.worst_ulps << " ulps (drawn), " << grazing.worst_ulps
                                 << " (grazing)");
}

TEST_CASE("Nothing is undecided on drawn queries, down to the smallest radii", "[engines][reduction]") {
  Draw draw(3);
  for (const int dimension : {2, 3})
    for (const double r : {0.4999, 0.3, 0.1, 1e-3, 1e-6, 1e-7, 1e-9, 1e-12}) {
      if (dimension == 3 && r < 1e-7) continue;
      const Scene scene = unit_scene(dimension, r);
      const Reduction engine(scene);
      const oracle::Oracle exact(scene);
      for (int i = 0; i < 3000; ++i) {
        const Query query{draw.vec(dimension, 0, 1), draw.vec(dimension, -1, 1), {}};
        const Flight flight = engine.fly(query);
        INFO(stream(scene, query));
        const Answer truth = exact.first_hit(query);
        if (flight.outcome ==
            Outcome::undecided) {  // a direction with few bits, so that the flight is a closed line
          REQUIRE(truth.outcome == Outcome::never);
          continue;
        }
        REQUIRE(answer_of(flight).outcome == truth.outcome);
        REQUIRE(answer_of(flight).obstacle == truth.obstacle);
      }
    }
}

TEST_CASE("Radii and cells beyond the engine are named, certified does them all the same",
          "[engines][reduction]") {
  CHECK_FALSE(Reduction::beyond(square(0.4999)));
  CHECK_FALSE(Reduction::beyond(square(0.5)));
  CHECK_FALSE(Reduction::beyond(square(1e-12)));
  CHECK_FALSE(Reduction::beyond(cubic(1e-7)));
  CHECK_FALSE(Reduction::beyond(square(4)));
  CHECK(Reduction::beyond(square(4.001)).value() ==
        "does not do obstacles that reach over as many cells as this one");
  CHECK(Reduction::beyond(square(9e-13)).value() ==
        "does radii from 1e-12 of the shortest lattice vector only");
  CHECK(Reduction::beyond(cubic(9e-8)).value() == "does radii from 1e-7 of the shortest lattice vector only");
  CHECK_THROWS_AS(Reduction(square(5)), UnsupportedError);
  Scene flat = square(0.1);
  flat.lattices[0].vectors[1] = {1e9, 1, 0};
  CHECK(Reduction::beyond(flat));
  Scene large = square(1e200);
  for (Vec& u : large.lattices[0].vectors)
    for (double& component : u) component *= 1e201;
  CHECK(Reduction::beyond(large));
  for (const Scene& scene : {square(5), square(9e-13), cubic(9e-8), flat, large}) {
    const Query query{
        {0.5, 0.5, scene.dimension == 3 ? 0.45 : 0}, {0.3, 0.7, scene.dimension == 3 ? 0.2 : 0}, {}};
    CHECK(make_engine("reduction", scene)->first_hit(query).unsupported);
    StageTally tally;
    CHECK(
        same(oracle::Certified(scene).first_hit(query, {}, &tally), oracle::Oracle(scene).first_hit(query)));
    CHECK(tally.undecided == 1);
  }
}

TEST_CASE("The smallest model that serves a scene is what runs", "[engines][reduction]") {
  CHECK(Reduction(square(0.1)).model() == std::string("unit"));
  CHECK(Reduction(cubic(0.1)).model() == std::string("unit"));
  Scene scene = square(0.1);
  scene.lattices[0].atoms[0].position = {0.25, 0, 0};
  CHECK(Reduction(scene).model() == std::string("one atom"));
  scene.lattices[0].atoms.push_back(Atom{{0.5, 0.5, 0}, 0.2, {}});
  CHECK(Reduction(scene).model() == std::string("several atoms"));
}

TEST_CASE("Starts up to 2^40 cells from the origin lose nothing on the unit lattices",
          "[engines][reduction]") {
  Draw draw(4);
  Count count;
  for (int i = 0; i < 2000; ++i) {
    const int dimension = draw.one_in(2) ? 2 : 3;
    const Scene scene = unit_scene(dimension, draw.between(0.001, 0.45));
    Query query{draw.vec(dimension, 0, 1), draw.vec(dimension, -1, 1), {}};
    for (int k = 0; k < dimension; ++k)
      query.x[k] += draw.sign() * std::exp2(40) + static_cast<double>(draw.below(1000));
    check(scene, query, count);
  }
  CHECK(count.stages.undecided == 0);
}

TEST_CASE("Starts within ulps of the middle between two cells are seen exactly", "[engines][reduction]") {
  Count count;
  Draw draw(31);
  for (const int dimension : {2, 3})
    for (const double middle : {0.5, -0.5, 1.5, -7.5, 0x1p40 + 0.5})
      for (int i = 0; i < 40; ++i) {
        const Scene scene = unit_scene(dimension, i % 2 ? 0.5 : draw.between(0.4, 0.5));
        Query query{
            {draw.between(-1, 1), middle, 0.3}, {draw.between(-1, 1), draw.between(-1e-9, 1e-9), 0}, {}};
        if (dimension == 2) query.x[2] = 0;
        for (int ulps = i % 4; ulps > 0; --ulps) query.x[1] = std::nextafter(query.x[1], 0);
        check(scene, query, count);
      }
  CHECK(count.hit > 200);  // 397 seen
}

TEST_CASE("Exactly rational directions: never is known, and so is the hit", "[engines][reduction]") {
  const Query corridor{{0, 0.445, 0}, {1, 0, 0}, {}}, diagonal{{0.5, 0, 0}, {1, 1, 0}, {}};
  CHECK(Reduction(square(0.1)).fly(corridor).outcome == Outcome::never);
  CHECK(Reduction(square(0.1)).fly(diagonal).outcome == Outcome::never);
  CHECK(Reduction(square(1e-6)).fly({{0, 0.25, 0}, {7, 5, 0}, {}}).outcome == Outcome::never);
  CHECK(Reduction(cubic(0.1)).fly({{0.5, 0.5, 0.5}, {0, 0, -1}, {}}).outcome == Outcome::never);
  CHECK(Reduction(cubic(0.1)).fly({{0.5, 0.25, 0.5}, {0, 1, 0.25}, {}}).outcome == Outcome::never);
  CHECK(Reduction(cubic(1e-5)).fly({{0.1, 0.2, 0.3}, {3, 4, 12}, {}}).outcome == Outcome::never);
  // A component too small for the engine is not taken for zero.
  CHECK(Reduction(square(0.1)).fly({{0, 0.445, 0}, {1, 1e-200, 0}, {}}).outcome == Outcome::undecided);
  CHECK(Reduction(square(0.1)).fly({{0, 0.445, 0}, {1, 1e-310, 0}, {}}).outcome == Outcome::undecided);
}

TEST_CASE("Slow drifts out of corridors and plane channels: hits at all distances that 64 bits hold",
          "[engines][reduction]") {
  Count count;
  for (int k = 1; k <= 44; ++k) {
    check(square(0.1), {{0, 0.5, 0}, {1, std::ldexp(1, -k), 0}, {}}, count);
    check(square(0.4999), {{0.5, 0.5, 0}, {1, std::ldexp(1, -k), 0}, {}}, count);
  }
  CHECK(count.stages.undecided == 0);
  for (int k = 10; k <= 60; ++k) {
    if (k == 53) CHECK(count.stages.undecided == 0);  // from there on the cells are beyond 2^53
    check(cubic(0.1), {{0, 0, 0.5}, {1, 0.618, std::ldexp(1, -k)}, {}}, count);
    check(cubic(0.1), {{0.5, 0.5, 0.5}, {0.53, 0.618, std::ldexp(1, -k)}, {}}, count);
  }
}

TEST_CASE("Directions a few ulps from rational ones", "[engines][reduction]") {
  Draw draw(5);
  Count count;
  for (int i = 0; i < 4000; ++i) {
    const int dimension = draw.one_in(2) ? 2 : 3;
    Query query{draw.vec(dimension, 0, 1), {}, {}};
    const double speed = draw.one_in(2) ? 1 : draw.between(0.5, 1);  // rounds each component by itself
    for (int k = 0; k < dimension; ++k) {
      query.v[k] = draw.fraction(1, 4) * speed;
      for (auto ulps = draw.below(4); ulps > 0; --ulps)
        query.v[k] = std::nextafter(query.v[k], draw.sign() * 10);
    }
    if (query.v == Vec{}) continue;
    check(unit_scene(dimension, draw.between(0.05, 0.45)), query, count);
  }
  CHECK(count.stages.binary64 + count.stages.double_double > 2'500);  // 2 925 seen
}

TEST_CASE("Several atoms: the earliest of their hits, whichever atom has it", "[engines][reduction]") {
  // On one line, from the left: the balls of three atoms, the last of another lattice. Each is ahead of a
  // start with the others behind it; and in each order of the atoms it is the earliest all the same.
  constexpr double kRadii[] = {0.1, 0.2, 0.3};
  std::array<int, 3> order{0, 1, 2};
  Count count;
  do {
    Scene scene = unit_scene(2, 1);
    scene.lattices[0].vectors = {Vec{3, 0, 0}, Vec{0, 3, 0}, Vec{}};
    scene.lattices.push_back(scene.lattices[0]);
    std::array<std::pair<int, int>, 3> place;  // lattice and atom of the ball at this third of the period
    for (int i = 0; i < 3; ++i) {
      scene.lattices[i / 2].atoms.resize(i % 2 + 1);
      scene.lattices[i / 2].atoms[i % 2] = Atom{{double(order[i]), 0, 0}, kRadii[order[i]], {}};
      place[order[i]] = {i / 2, i % 2};
    }
    for (int third = 0; third < 3; ++third) {
      const Query query{{third - 0.5, 0.05, 0}, {1, 0, 0}, {}};
      const Flight flight = Reduction(scene).fly(query);
      INFO(stream(scene, query));
      CHECK(std::pair(flight.lattice, flight.atom) == place[third]);
      CHECK(flight.time < 0.5);
      check(scene, query, count);
    }
  } while (std::next_permutation(order.begin(), order.end()));
  CHECK(count.hit == 18);
}

TEST_CASE("Several atoms: of two that are entered at once the smaller name counts", "[engines][reduction]") {
  // Mirror images are entered at the same time.
  Scene tie = square(0.1);
  tie.lattices[0].vectors = {Vec{4, 0, 0}, Vec{0, 4, 0}, Vec{}};
  tie.lattices[0].atoms[0].position = {1, 0.05, 0};
  tie.lattices[0].atoms.push_back(Atom{{1, -0.05, 0}, 0.1, {}});
  const Query head_on{{0, 0, 0}, {1, 0, 0}, {}};
  for (const double first : {0.05, -0.05}) {
    for (int a : {0, 1}) tie.lattices[0].atoms[a].position[1] = a == 0 ? first : -first;
    CHECK(Reduction(tie).fly(head_on).outcome == Outcome::hit);
    CHECK(Reduction(tie).fly(head_on).atom == 0);
  }
  std::swap(tie.lattices[0].atoms[0], tie.lattices[0].atoms[1]);
  // An ulp apart is not together.
  tie.lattices[0].atoms[1].position[1] = std::nextafter(-0.05, 0);
  CHECK(Reduction(tie).fly(head_on).atom == 1);
  CHECK(Reduction(tie).fly(head_on).stage == Stage::double_double);
}

TEST_CASE("A time limit only cuts the search short", "[engines][reduction]") {
  Draw draw(6);
  for (int i = 0; i < 3000; ++i) {
    const int dimension = draw.one_in(2) ? 2 : 3;
    const Scene scene = supported_scene(draw, Style::generic, dimension);
    const Query query = query_of(draw, Style::generic, scene);
    const double limit = std::exp2(draw.between(-3, 12));
    oracle::Request request;
    request.max_time = limit;
    INFO(stream(scene, query) << "limit " << limit);
    const Answer exact = oracle::Oracle(scene).first_hit(query, request);
    const Answer given = make_engine("reduction", scene)->first_hit(query, limit);
    if (given.outcome != Outcome::undecided) REQUIRE(given.outcome == exact.outcome);
    REQUIRE(same(oracle::Certified(scene).first_hit(query, request), exact));
  }
}

TEST_CASE("certified is the oracle, to the bit", "[engines][reduction]") {
  for (const int dimension : {2, 3})
    for (const Style style : {Style::generic, Style::grid, Style::near_grid}) {
      Draw draw(8 + 10 * dimension + static_cast<int>(style));
      StageTally tally;
      for (int i = 0; i < 2000; ++i) {
        const Scene scene =
            draw.one_in(2) ? supported_scene(draw, style, dimension) : scene_of(draw, style, dimension);
        const Query query = draw.one_in(2) ? hard_query(draw, style, scene) : query_of(draw, style, scene);
        INFO(stream(scene, query));
        REQUIRE(same(oracle::Certified(scene).first_hit(query, {}, &tally),
                     oracle::Oracle(scene).first_hit(query)));
      }
      CHECK(tally.binary64 > 840);      // 1 057 seen at least
      CHECK(tally.double_double > 99);  // 124 seen at least
      CHECK(tally.undecided > 20);      // 28 seen at least
    }
}

TEST_CASE("Two radii in one lattice: the second atom's short basis is the first's, reduced on",
          "[engines][reduction]") {
  Scene fcc = unit_scene(3, 0x1p-12), three = fcc;
  fcc.lattices[0].vectors = {Vec{0, 0.5, 0.5}, Vec{1, 0, 0.5}, Vec{0.5, 0.5, 0}};
  fcc.lattices[0].atoms.push_back({{}, 0x1p-15, {}});
  three.lattices[0].vectors = {Vec{0.75, 0.5, 1}, Vec{1, -0.5, -0.75}, Vec{0, -0.75, 0.5}};
  three.lattices[0].atoms = {{{-1, -0.25, 0.75}, 1.0902520244131204e-06, {}},
                             {{0, 0, 0}, 8.176890183098403e-07, {}},
                             {{-0.5, -1, 0.5}, 1.0902520244131204e-06, {}}};
  Count count;
  check(fcc, {{1, 0, 0}, {0.4144180417060852, 1.5, 0.4144180417060852}, {}}, count);
  check(three, {{-546723.75, -8944, 220979.5}, {-7.25459323277305e-07, -1.75, 2}, {}}, count);
  Draw draw(73);
  for (int i = 0; i < 4000; ++i) {
    Query query = query_of(draw, Style::grid, fcc);
    query.v[draw.below(3)] *= draw.uniform();
    check(i % 2 ? fcc : three, query, count);
  }
  CHECK(count.hit > 500);  // 815 seen
}

TEST_CASE(
    "A lattice plane that is passed at nearly the radius: the slivers that are left of its balls are found",
    "[engines][reduction]") {
  // Beside the plane y = 0 at the height (1 - e) r a ball is a disc of the radius r sqrt(2 e), and of a
  // flight along the plane only the width of that section says which are met.
  Count count;
  check(unit_scene(3, 0.5),
        {{0.8632337152957916, 0.4999999999999727, 0.3692743228748441},
         {1.7690900713205338, 0, 0.4915317893028261},
         {}},
        count);
  Draw draw(74);
  for (int i = 0; i < 6000; ++i) {
    const double r = std::exp2(draw.between(-17, -1));
    Query query{{draw.uniform(), r * (1 - std::exp2(-draw.between(10, 52))), draw.uniform()},
                {draw.between(-2, 2), 0, draw.between(-2, 2)},
                {}};
    if (draw.one_in(2)) query.v[1] = std::exp2(-draw.between(40, 1000));
    const std::size_t turn = draw.below(3);
    std::swap(query.x[1], query.x[turn]), std::swap(query.v[1], query.v[turn]);
    check(unit_scene(3, r), query, count);
  }
  CHECK(count.hit > 4000);  // 5 772 seen
}

TEST_CASE("certified: a time that vanishes in other units is rounded by the oracle", "[engines][reduction]") {
  const Scene scene = unit_scene(3, 7.719446386253216e-05);
  const Query query{{0x1p-59, 0, -7.71944638627542e-05}, {0, 0, 0x1p1023}, {}};
  CHECK(oracle::Oracle(scene).first_hit(query).time == 0x1p-1074);
  CHECK(oracle::Certified(scene).first_hit(query).time == 0x1p-1074);
}

TEST_CASE("Starts in a corner of two obstacles, or of four: any of them left, in any direction",
          "[engines][reduction]") {
  // Balls that overlap: a corner lies on all of them, a quarter of a cell from the middle. What the start
  // moves into is hit at once, the smallest name first; what the particle leaves, or moves away from, is not.
  struct Corner {
    Scene scene;
    Vec x;
    std::vector<ObstacleId> obstacles;
  };
  Scene wide = unit_scene(2, 1), superposed = unit_scene(2, 0.625);
  wide.lattices[0].vectors[0][0] = 2, wide.lattices[0].atoms = {{{}, 0, {{1.25, 0, 0}, {0, 0.625, 0}}}};
  superposed.lattices[0].vectors[0][0] = 2;
  superposed.lattices.push_back({superposed.lattices[0].vectors, {{{1, 0, 0}, 0.625, {}}}});
  Scene motif = superposed;
  motif.lattices[0].atoms.push_back(motif.lattices[1].atoms[0]), motif.lattices.pop_back();
  for (const Corner& corner : std::vector<Corner>{
           {unit_scene(2, 0.625), {0.5, 0.375, 0}, {{0, 0, {}}, {0, 0, {1}}}},
           {unit_scene(3, 0.75), {0.5, 0.5, 0.25}, {{0, 0, {}}, {0, 0, {0, 1}}, {0, 0, {1}}, {0, 0, {1, 1}}}},
           {wide, {1, 0.375, 0}, {{0, 0, {}}, {0, 0, {1}}}},
           {superposed, {0.5, 0.375, 0}, {{0, 0, {}}, {1, 0, {}}}},
           {motif, {0.5, 0.375, 0}, {{0, 0, {}}, {0, 1, {}}}}}) {
    const Scene& scene = corner.scene;
    const int d = scene.dimension;
    const oracle::Oracle oracle(scene);
    const oracle::Certified certified(scene);
    const auto reduction = make_engine("reduction", scene);
    for (int code = 0; code < (d == 3 ? 343 : 49); ++code)
      for (std::size_t left = 0; left <= corner.obstacles.size(); ++left) {
        Query query{corner.x, {code % 7 - 3.0, code / 7 % 7 - 3.0, d == 3 ? code / 49 - 3.0 : 0}, {}};
        if (query.v == Vec{}) continue;
        if (left > 0) query.from = corner.obstacles[left - 1];
        const ObstacleId* entered = nullptr;
        for (const ObstacleId& obstacle : corner.obstacles) {
          const Atom& atom = scene.lattices[obstacle.lattice].atoms[obstacle.atom];
          Vec offset = sum(query.x, scaled(centre_of(scene, obstacle), -1));
          if (!atom.is_ball())  // its inverse square of semiaxes along the axes
            for (int k = 0; k < d; ++k) offset[k] /= atom.semiaxes[k][k] * atom.semiaxes[k][k];
          if (!entered && obstacle != query.from && dot(offset, query.v) < 0) entered = &obstacle;
        }
        INFO(stream(scene, query));
        const Answer exact = oracle.first_hit(query);
        CHECK(exact.outcome == Outcome::hit);
        CHECK((exact.time == 0) == (entered != nullptr));
        if (entered) CHECK(exact.obstacle == *entered);
        for (const Answer& answer : {certified.first_hit(query), reduction->first_hit(query)}) {
          if (answer.outcome == Outcome::undecided || answer.outcome == Outcome::error) continue;
          CHECK(answer.outcome == exact.outcome);
          CHECK(answer.obstacle == exact.obstacle);
          if (exact.outcome == Outcome::hit) CHECK(*answer.time == Approx(*exact.time).margin(1e-15));
        }
      }
  }
}
