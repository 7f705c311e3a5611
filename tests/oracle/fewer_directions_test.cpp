// Scenes that repeat in fewer directions than there are: single obstacles, rows, layers; also among crystals.
#include <catch2/catch.hpp>

#include <lorentz/batch.hpp>
#include <lorentz/certificate_check.hpp>
#include <lorentz/certified.hpp>
#include <lorentz/engine.hpp>
#include <lorentz/margin.hpp>
#include <lorentz/oracle.hpp>
#include <lorentz/prover.hpp>
#include <lorentz/reduction.hpp>
#include <lorentz/scene_check.hpp>
#include <lorentz/verdict.hpp>
#include <lorentz/walk.hpp>
#include "tests/support/support.hpp"

using namespace lorentz;
using test::Draw;
using test::Style;

namespace {

Scene with_rank(Scene scene, int lattice, int rank) {
  Lattice& its = scene.lattices[lattice];
  its.rank = rank;
  for (int i = rank; i < scene.dimension; ++i) its.vectors[i] = {};
  return scene;
}

Scene lone_ball(int dimension, double radius) {
  return with_rank(unit_scene(dimension, radius), 0, 0);
}

ObstacleId cell(int n0, int n1 = 0) {
  return {0, 0, {Integer(n0), Integer(n1), Integer(0)}};
}

constexpr Style kStyles[] = {Style::generic, Style::grid, Style::near_grid};

// Every rank below the dimension, in one lattice or in one of two.
Scene drawn_scene(Draw& draw, Style style, int dimension) {
  Scene scene = test::with_ellipsoids(draw, style, test::scene_of(draw, style, dimension));
  for (int l = 0; l < static_cast<int>(scene.lattices.size()); ++l)
    if (l == 0 || draw.one_in(2))
      scene = with_rank(scene, l, static_cast<int>(draw.below(static_cast<std::uint64_t>(dimension))));
  return scene;
}

// Aims at an obstacle half of the time.
Query drawn_query(Draw& draw, Style style, const Scene& scene) {
  Query query = test::query_of(draw, style, scene);
  if (draw.one_in(2)) return query;
  const Vec centre = test::centre_of(scene, test::obstacle_of(draw, scene));
  for (int k = 0; k < scene.dimension; ++k) query.v[k] = centre[k] + draw.between(-0.5, 0.5) - query.x[k];
  if (query.v == Vec{}) query.v[0] = 1;
  return query;
}

}  // namespace

TEST_CASE("One ball: entered, touched, missed, left", "[oracle][ranks]") {
  const Scene scene = lone_ball(3, 1);
  const oracle::Oracle oracle(scene);
  const Answer hit = oracle.first_hit({{-3, 0, 0}, {1, 0, 0}, {}});
  CHECK((hit.outcome == Outcome::hit && hit.time == 2.0 && hit.obstacle == cell(0)));
  CHECK(oracle.first_hit({{-0x1p60, 0.5, 0}, {0x1p-1000, 0, 0}, {}}).outcome == Outcome::hit);
  for (const Vec& x : {Vec{-3, 1, 0}, Vec{-3, 0.6, 0.8}, Vec{3, 0, 0}, Vec{-3, 0, 1.5}}) {
    INFO(x[0] << ' ' << x[1] << ' ' << x[2]);
    const bool tangent = x[1] == 0.6;  // not exactly: 0.6 and 0.8 are rounded
    CHECK((tangent || oracle.first_hit({x, {1, 0, 0}, {}}).outcome == Outcome::never));
  }
  // On the surface: inwards, outwards, along it.
  CHECK(oracle.first_hit({{-1, 0, 0}, {1, 0.5, 0}, {}}).time == 0.0);
  CHECK(oracle.first_hit({{-1, 0, 0}, {-1, 0.5, 0}, {}}).outcome == Outcome::never);
  CHECK(oracle.first_hit({{-1, 0, 0}, {0, 1, 0}, {}}).outcome == Outcome::never);
  CHECK(oracle.first_hit({{0.5, 0, 0}, {1, 0, 0}, {}}).outcome == Outcome::inside);
  CHECK(oracle.first_hit({{0.5, 0, 0}, {1, 0, 0}, cell(0)}).outcome == Outcome::never);
}

TEST_CASE("A tangent is missed, and what is nearer is hit, for Pythagorean directions", "[oracle][ranks]") {
  const oracle::Oracle plane(lone_ball(2, 5));
  for (const double far : {1.0, 16.0, 0x1p40}) {
    const Query tangent{{3 - 4 * far, 4 + 3 * far}, {4, -3}, {}};  // touches at (3, 4)
    CHECK(plane.first_hit(tangent).outcome == Outcome::never);
    Query inner = tangent;
    inner.x[1] = std::nextafter(inner.x[1], 0);
    CHECK(plane.first_hit(inner).outcome == Outcome::hit);
  }
}

TEST_CASE("A row: the gaps, along it, and far out", "[oracle][ranks]") {
  const Scene scene = with_rank(unit_scene(2, 0.25), 0, 1);
  const oracle::Oracle oracle(scene);
  CHECK(oracle.first_hit({{0.5, -3}, {0, 1}, {}}).outcome == Outcome::never);
  CHECK(oracle.first_hit({{0.25, -3}, {0, 1}, {}}).outcome == Outcome::never);
  CHECK(oracle.first_hit({{0.75 + 0x1p-50, -3}, {0, 1}, {}}).obstacle == cell(1));
  CHECK(oracle.first_hit({{0.5, 0}, {1, 0}, {}}).time == 0.25);
  CHECK(oracle.first_hit({{0.5, 0.25}, {1, 0}, {}}).outcome == Outcome::never);
  CHECK(oracle.first_hit({{0.5, 0.25}, {1, -0x1p-60}, {}}).outcome == Outcome::hit);
  CHECK(oracle.first_hit({{0.5, 0.25}, {1, 0x1p-60}, {}}).outcome == Outcome::never);
  const Answer far = oracle.first_hit({{0.5 + 0x1p50, -1}, {0x1p-3, 0x1p-3}, {}});
  CHECK(far.outcome == Outcome::never);
}

TEST_CASE("Oracle and walk agree on scenes of every rank", "[oracle][walk][ranks]") {
  for (const int dimension : {2, 3}) {
    std::size_t hits = 0, nevers = 0, undecided = 0;
    for (std::uint64_t seed = 0; seed < 300; ++seed) {
      Draw draw(seed);
      const Style style = kStyles[seed % 3];
      const Scene scene = drawn_scene(draw, style, dimension);
      const oracle::Oracle oracle(scene);
      const oracle::Walk walk(scene, 20'000);
      const oracle::Certified certified(scene);
      for (int i = 0; i < 10; ++i) {
        const Query query = drawn_query(draw, style, scene);
        const Answer exact = oracle.first_hit(query), walked = walk.first_hit(query);
        INFO(test::stream(scene, query));
        hits += exact.outcome == Outcome::hit, nevers += exact.outcome == Outcome::never;
        undecided += walked.outcome == Outcome::undecided;
        CHECK((walked.outcome == Outcome::undecided || test::same(exact, walked)));
        CHECK(test::same(exact, certified.first_hit(query)));
      }
    }
    CHECK(hits > 700);
    CHECK(nevers > 700);
    CHECK(undecided < 300);  // crystals beside them, tiny radii
  }
}

namespace {

enum class Kind { single, sparse, mixed };

Scene drawn_scene_of(Draw& draw, Style style, int dimension, Kind kind) {
  Scene scene = drawn_scene(draw, style, dimension);
  if (kind == Kind::mixed) return scene;
  for (int l = 0; l < static_cast<int>(scene.lattices.size()); ++l) {
    const int rank = kind == Kind::single ? 0 : scene.lattices[l].rank_in(dimension);
    scene = with_rank(scene, l, std::min(rank, dimension - 1));
  }
  return scene;
}

// In any unit of length.
void scale(Scene& scene, double size) {
  const auto by_size = [&](Vec& a) {
    for (double& component : a) component *= size;
  };
  for (Lattice& lattice : scene.lattices)
    std::for_each(lattice.vectors.begin(), lattice.vectors.end(), by_size);
  for_each_atom(scene, [&](Atom& atom) {
    atom.radius *= size;
    by_size(atom.position);
    std::for_each(atom.semiaxes.begin(), atom.semiaxes.end(), by_size);
  });
}

struct Decided {
  std::size_t asked = 0, undecided = 0, hits = 0, rounded = 0;
};

// Answers of one flight at a time and of a batch, against the oracle's.
void check_flights(const Scene& scene, const std::vector<Query>& queries, Decided& decided) {
  const oracle::Oracle oracle(scene);
  const Batch batch(scene);
  QueryTable table;
  for (const Query& query : queries) table.push_back(query);
  for (const Batch::Time time : {Batch::Time::close, Batch::Time::rounded}) {
    FlightTable flights;
    flights.resize(queries.size());
    batch.fly(table.columns(), flights.columns(), time);
    for (std::size_t i = 0; i < queries.size(); ++i) {
      const Answer exact = oracle.first_hit(queries[i]);
      const Flight alone = batch.one_at_a_time().fly(queries[i], HUGE_VAL, time), flight = flights[i];
      INFO(test::stream(scene, queries[i]));
      ++decided.asked, decided.undecided += alone.outcome == Outcome::undecided;
      decided.hits += alone.outcome == Outcome::hit, decided.rounded += alone.time_is_rounded;
      CHECK(alone.outcome == flight.outcome);
      CHECK(alone.time_is_rounded == flight.time_is_rounded);
      if (alone.outcome == Outcome::undecided) continue;
      CHECK(test::same_obstacle(answer_of(alone), exact));
      if (alone.outcome != Outcome::hit) continue;
      CHECK(alone.time == flight.time);
      if (alone.time_is_rounded) CHECK(alone.time == exact.time);
    }
  }
}

Decided check_kind(Kind kind, int dimension, std::uint64_t seeds) {
  Decided decided;
  for (std::uint64_t seed = 0; seed < seeds; ++seed) {
    Draw draw(seed);
    const Style style = kStyles[seed % 3];
    const Scene drawn = drawn_scene_of(draw, style, dimension, kind);
    const double size = seed % 4 == 0 ? std::exp2(draw.between(-300, 300)) : 1;
    const double speed = seed % 5 == 0 ? std::exp2(draw.between(-200, 200)) : 1;
    Scene scene = drawn;
    scale(scene, size);
    if (Reduction::beyond(scene)) continue;
    std::vector<Query> queries;
    for (int i = 0; i < 40; ++i) {
      Query query = drawn_query(draw, style, drawn);
      const double far = draw.one_in(4) ? std::exp2(draw.between(0, 50)) : 0;
      for (int k = 0; k < dimension; ++k) {
        query.x[k] = (query.x[k] - far * query.v[k]) * size;
        query.v[k] *= speed;
      }
      if (!query.from || flaw_of(query, scene)) query.from.reset();
      queries.push_back(query);
    }
    check_flights(scene, queries, decided);
  }
  return decided;
}

}  // namespace

TEST_CASE("`reduction` and batches of every rank are right wherever they decide, to the bit alike",
          "[engines][reduction][batch][ranks]") {
  for (const Kind kind : {Kind::single, Kind::sparse, Kind::mixed})
    for (const int dimension : {2, 3}) {
      const Decided decided = check_kind(kind, dimension, 200);
      INFO("kind " << static_cast<int>(kind) << ", " << dimension << "D: " << decided.undecided
                   << " undecided, " << decided.hits << " hits of " << decided.asked);
      CHECK(decided.asked > 8000);
      CHECK(decided.hits > decided.asked / 10);
      CHECK(decided.undecided < decided.asked / 20);  // ties, tangents and starts on surfaces, on grids
      CHECK(decided.rounded > 1000);
    }
}

TEST_CASE("`reduction` decides flights nearly along a row, and those that stay outside of a layer",
          "[engines][reduction][ranks]") {
  const auto check = [](const Scene& scene, const Query& query, Outcome outcome) {
    const Flight flight = Reduction(scene).fly(query);
    INFO(test::stream(scene, query));
    CHECK(flight.outcome == outcome);
    CHECK(test::same_obstacle(answer_of(flight), oracle::Oracle(scene).first_hit(query)));
  };
  const Scene row = with_rank(unit_scene(2, 0.125), 0, 1), layer = with_rank(unit_scene(3, 0.125), 0, 2);
  for (const double tilt : {1e-6, 1e-8, 1e-11, 1e-13, 1e-16}) {
    check(row, {{0.3, 0.06}, {1, -tilt}, {}}, Outcome::hit);
    check(row, {{0.3, -0.06}, {-1, -tilt}, {}}, Outcome::hit);
  }
  check(row, {{0.3, 0.16}, {1, 1e-8}, {}}, Outcome::never);
  check(layer, {{0.3, 0.2, 0.2}, {0.8, 0.61, 0}, {}}, Outcome::never);
  check(layer, {{0.3, 0.2, -0.2}, {1, 0, 0}, {}}, Outcome::never);
  check(layer, {{0.3, 0.2, 200}, {0.8, 0.61, 1e-7}, {}}, Outcome::never);
  check(layer, {{0.3, 0.2, -200}, {0.8, 0.61, -1e-7}, {}}, Outcome::never);
  // It comes nearer, however slowly, whichever axis is across the layer.
  CHECK(Reduction(layer).fly({{0.3, 0.2, 0.2}, {0.8, 0.61, -1e-7}, {}}).outcome != Outcome::never);
  for (const double slope : {1e-7, 1e-140, 1e-200, 0x1p-1000})
    for (int across = 0; across < 3; ++across) {
      Scene tilted = layer;
      auto& u = tilted.lattices[0].vectors;
      u = {};
      Query query{{0.2, 0.2, 0.2}, {0.8, 0.8, 0.8}, {}};
      u[0][(across + 1) % 3] = u[1][(across + 2) % 3] = 1, u[0][across] = slope, query.v[across] = 0;
      INFO(test::stream(tilted, query));
      CHECK(oracle::Oracle(tilted).first_hit(query).outcome == Outcome::hit);
      CHECK(Reduction(tilted).fly(query).outcome != Outcome::never);
      query.v[across] = 1e-3;
      check(tilted, query, Outcome::never);
    }
}

TEST_CASE("A row or a layer in other words is the same", "[oracle][ranks]") {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    Draw draw(seed);
    const Style style = kStyles[seed % 3];
    Scene scene = drawn_scene(draw, style, 3);
    scene.lattices.resize(1);
    const Lattice& lattice = scene.lattices[0];
    const int rank = lattice.rank_in(3);
    if (rank == 0) continue;
    // One vector doubled, and each atom twice.
    Scene coarser = scene;
    const Vec u = lattice.vectors[0];
    for (double& component : coarser.lattices[0].vectors[0]) component *= 2;
    coarser.lattices[0].atoms.clear();
    bool exact_places = true;
    for (const Atom& atom : lattice.atoms)
      for (int half = 0; half < 2; ++half) {
        Atom other = atom;
        for (int k = 0; k < 3; ++k) {
          other.position[k] += half * u[k];
          exact_places &= other.position[k] - half * u[k] == atom.position[k];
          exact_places &= other.position[k] - atom.position[k] == half * u[k];
        }
        coarser.lattices[0].atoms.push_back(other);
      }
    // The vectors turned around and, in a layer, mixed.
    Scene mixed = scene;
    for (double& component : mixed.lattices[0].vectors[0]) component = -component;
    if (rank == 2 && style == Style::grid)
      for (int k = 0; k < 3; ++k) mixed.lattices[0].vectors[1][k] += 3 * mixed.lattices[0].vectors[0][k];
    const oracle::Oracle one(scene), two(coarser), three(mixed);
    for (int i = 0; i < 10; ++i) {
      Query query = drawn_query(draw, style, scene);
      query.from.reset();
      const Answer answer = one.first_hit(query), second = two.first_hit(query),
                   third = three.first_hit(query);
      INFO(test::stream(scene, query));
      if (exact_places) CHECK((answer.outcome == second.outcome && answer.time == second.time));
      CHECK((answer.outcome == third.outcome && answer.time == third.time));
    }
  }
}

TEST_CASE("Single obstacles, rows and layers in other units and with other axes are the same",
          "[oracle][ranks]") {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    Draw draw(seed);
    const Style style = kStyles[seed % 3];
    const Scene scene = drawn_scene(draw, style, 3);
    const int exponent = static_cast<int>(draw.below(1200)) - 600,
              slower = static_cast<int>(draw.below(400)) - 200;
    const int first = static_cast<int>(draw.below(3));
    const double sign = draw.sign();
    // The axes in a circle, one mirrored, and another unit of length.
    const auto changed = [&](const Vec& a, int unit) {
      Vec image;
      for (int k = 0; k < 3; ++k) image[k] = std::ldexp(a[(k + first) % 3] * (k == 1 ? sign : 1), unit);
      return image;
    };
    Scene other = scene;
    for (Lattice& lattice : other.lattices) {
      for (Vec& u : lattice.vectors) u = changed(u, exponent);
      for (Atom& atom : lattice.atoms) {
        atom.position = changed(atom.position, exponent), atom.radius = std::ldexp(atom.radius, exponent);
        for (Vec& axis : atom.semiaxes) axis = changed(axis, exponent);
      }
    }
    const oracle::Oracle one(scene), two(other);
    for (int i = 0; i < 10; ++i) {
      const Query query = drawn_query(draw, style, scene);
      const Query same{changed(query.x, exponent), changed(query.v, slower), query.from};
      const Answer answer = one.first_hit(query), second = two.first_hit(same);
      INFO(test::stream(scene, query));
      CHECK(test::same_obstacle(answer, second));
      if (answer.outcome == Outcome::hit) CHECK(std::ldexp(*answer.time, exponent - slower) == *second.time);
    }
  }
}

TEST_CASE("Where a crystal's first hit lies in the layer cut from it, the layer's is the same",
          "[oracle][ranks]") {
  std::size_t same = 0;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    Draw draw(seed);
    const Scene crystal = unit_scene(3, draw.between(0.1, 0.4));
    const oracle::Oracle whole(crystal), layer(with_rank(crystal, 0, 2)), row(with_rank(crystal, 0, 1)),
        ball(with_rank(crystal, 0, 0));
    for (int i = 0; i < 20; ++i) {
      Query query = drawn_query(draw, Style::generic, crystal);
      query.from.reset();
      const Answer answer = whole.first_hit(query);
      if (answer.outcome == Outcome::never) continue;
      const Cell& n = answer.obstacle.cell;
      INFO(test::stream(crystal, query));
      if (!(n[2] == Integer(0))) continue;
      ++same;
      CHECK(test::same(answer, layer.first_hit(query)));
      if (n[1] == Integer(0)) CHECK(test::same(answer, row.first_hit(query)));
      if (n[1] == Integer(0) && n[0] == Integer(0)) CHECK(test::same(answer, ball.first_hit(query)));
    }
  }
  CHECK(same > 500);
}

TEST_CASE("`never` has a margin where no lattice is a crystal", "[oracle][ranks][margin]") {
  const Scene scene = lone_ball(3, 1);
  const oracle::Margins margins(scene);
  const oracle::Judge judge(scene);
  const Answer never = Answer::never(), hit = Answer::hit(cell(0), 4.0);
  for (const double above : {0.0, 0x1p-52, 0x1p-50, 0x1p-40, 0.5}) {
    const Query query{{-4, 1 + above, 0}, {1, 0, 0}, {}};
    const auto decision = margins.hardest_decision(query, never);
    INFO(above);
    REQUIRE(decision);
    // Only the second component of x (with the ulp of the size, 1, or its own) and the radius move the gap.
    const double expected = above / 0x1p-51;
    CHECK(decision->margin == Approx(std::min(expected, oracle::kLargestMargin)).margin(1e-9));
    const bool forgiven = expected <= oracle::kDefaultUlps;
    CHECK(judge.judge(query, never, hit).verdict ==
          (forgiven ? oracle::Verdict::ill_posed : oracle::Verdict::wrong));
  }
  CHECK_FALSE(oracle::Margins(unit_scene(2, 0.25)).hardest_decision({{0.5, 0}, {0, 1}, {}}, never));
}

TEST_CASE("A miss that was claimed is judged by what is entered", "[oracle][ranks][margin]") {
  const Scene row = with_rank(unit_scene(2, 0.25), 0, 1);
  const oracle::Oracle oracle(row);
  const oracle::Judge judge(row);
  const auto verdict = [&](const Query& query) {
    const Answer exact = oracle.first_hit(query);
    REQUIRE(exact.outcome == Outcome::hit);
    return judge.judge(query, exact, Answer::never()).verdict;
  };
  CHECK(verdict({{0.25 - 0x1p-53, -3}, {0, 1}, {}}) == oracle::Verdict::ill_posed);
  CHECK(verdict({{0.25 - 0x1p-48, -3}, {0, 1}, {}}) == oracle::Verdict::wrong);
  CHECK(verdict({{0, -3}, {0, 1}, {}}) == oracle::Verdict::wrong);
  // Along the row for ever, just in it: the first is grazed.
  CHECK(verdict({{0.5, 0.25 - 0x1p-54}, {1, 0}, {}}) == oracle::Verdict::ill_posed);
  CHECK(verdict({{0.5, 0.2}, {1, 0}, {}}) == oracle::Verdict::wrong);
}

TEST_CASE("Long after a flight has left a row behind, margins and verdicts know no copies of it",
          "[oracle][ranks][margin]") {
  Scene scene = with_rank(unit_scene(3, 0.25), 0, 1);
  scene.lattices.push_back(unit_scene(3, 1e-4).lattices[0]);
  scene.lattices[1].atoms[0].position = {0.5, 0.5, 0.5};
  const oracle::Oracle oracle(scene), crystal(Scene{3, {scene.lattices[1]}});
  const oracle::Margins margins(scene);
  const oracle::Judge judge(scene);
  std::size_t far = 0;
  const auto is_one = [](const ObstacleId& id) {
    return id.lattice == 1 || (id.cell[1] == Integer(0) && id.cell[2] == Integer(0));
  };
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    Draw draw(seed);
    const Query query{draw.vec(3, 0, 1), draw.vec(3, -1, 1), {}};
    const Answer exact = oracle.first_hit(query);
    if (exact.outcome != Outcome::hit || exact.obstacle.lattice == 0) continue;
    INFO(test::stream(scene, query));
    ++far;
    CHECK(exact.time == crystal.first_hit(query).time);
    const auto decision = margins.hardest_decision(query, exact);
    REQUIRE(decision);
    CHECK(is_one(decision->obstacle));
    for (const oracle::PassedObstacle& one : margins.passed(query, exact, 5)) CHECK(is_one(one.obstacle));
    Answer later = exact;
    later.obstacle.cell[0] = Integer(exact.obstacle.cell[0].int64() + 1);
    CHECK(judge.judge(query, exact, later).verdict == oracle::Verdict::wrong);
  }
  CHECK(far > 30);
}

TEST_CASE("Contacts of single obstacles, rows and layers", "[oracle][ranks]") {
  const auto contacts = [](const Scene& scene) { return oracle::contacts_in(scene, 10).found; };
  CHECK(contacts(lone_ball(3, 100)).empty());
  CHECK(contacts(with_rank(unit_scene(3, 0.5), 0, 1)).size() == 1);
  CHECK(contacts(with_rank(unit_scene(3, 0.5), 0, 2)).size() == 2);
  Scene two = lone_ball(3, 1);
  two.lattices[0].atoms.push_back({{2, 0, 0}, 1, {}});
  REQUIRE(contacts(two).size() == 1);
  CHECK_FALSE(contacts(two)[0].overlap);
  two.lattices[0].atoms[1].position[0] = 2 - 0x1p-40;
  CHECK(contacts(two)[0].overlap);
  Scene apart = lone_ball(3, 1);
  apart.lattices.push_back(apart.lattices[0]);
  apart.lattices[1].atoms[0].position = {3, 0, 0};
  CHECK(contacts(apart).empty());
  apart.lattices[1].rank = 1, apart.lattices[1].vectors[0] = {0, 1, 0};
  CHECK(contacts(apart).size() == 2);  // the row's balls overlap the next ones, and touch those after
  apart.lattices[1].vectors[0] = {2.5, 0, 0};
  REQUIRE(contacts(apart).size() == 1);  // that of the cell -1 and the other lattice's
  CHECK(contacts(apart)[0].overlap);
  // A crystal's ball somewhere overlaps the one.
  Scene impurity = lone_ball(3, 0.4);
  impurity.lattices[0].atoms[0].position = {7.5, 7.5, 7.5};
  impurity.lattices.push_back(unit_scene(3, 0.4).lattices[0]);
  CHECK(contacts(impurity).empty());
  impurity.lattices[0].atoms[0].position = {7.5, 7, 7};
  CHECK(contacts(impurity).size() == 1);
}

TEST_CASE("What does crystals only says so", "[oracle][ranks]") {
  const Scene scene = lone_ball(2, 0.25);
  const auto answer_of = [](const std::string& name, const Scene& in) {
    return make_engine(name, in)->first_hit({{-1, 0}, {1, 0}, {}});
  };
  for (const std::string name : {"classical", "published"}) {
    const Answer answer = answer_of(name, scene);
    CHECK((answer.outcome == Outcome::error && answer.unsupported));
    CHECK(answer.message.find("crystals only") != std::string::npos);
  }
  CHECK(answer_of("reduction", scene).time == 0.75);
}

TEST_CASE("Dependence and flaws of lattices with fewer vectors", "[oracle][ranks]") {
  Scene scene = with_rank(unit_scene(3, 0.25), 0, 2);
  CHECK_FALSE(flaw_of(scene));
  CHECK_FALSE(oracle::dependence_in(scene));
  scene.lattices[0].vectors[1] = {2, 0, 0};
  CHECK(oracle::dependence_in(scene));
  scene = with_rank(scene, 0, 1);
  CHECK_FALSE(oracle::dependence_in(scene));
  scene.lattices[0].vectors[0] = {};
  CHECK(oracle::dependence_in(scene));
  scene.lattices[0].vectors[2] = {0, 0, 1};
  CHECK(flaw_of(scene));  // more than it says
  scene.lattices[0].rank = 4;
  CHECK(flaw_of(scene));
  CHECK(flaw_of(Query{{}, {1, 0, 0}, cell(1)}, lone_ball(3, 1)));  // a cell of a lattice without vectors
}

TEST_CASE("A crystal's rank may be the scene's dimension, or 3 in the plane: the answers are the same",
          "[oracle][ranks]") {
  for (const int dimension : {2, 3}) {
    const Scene scene = unit_scene(dimension, 0.1);
    Scene said = scene;
    said.lattices[0].rank = dimension;
    CHECK_FALSE(flaw_of(said));
    CHECK(is_crystal(said));
    CHECK(Components(said).of_cells(0) == dimension);
    for (const Vec& v : {Vec{1, 0.0175, 0}, Vec{-0.3, 1, 0}, Vec{1, 0, 0}}) {
      const Query query{{0, 0.445, dimension == 3 ? 0.05 : 0}, v, {}};
      const Answer exact = oracle::Oracle(scene).first_hit(query),
                   same = oracle::Oracle(said).first_hit(query);
      CHECK((same.outcome == exact.outcome && same.obstacle == exact.obstacle && same.time == exact.time));
      CHECK(oracle::Walk(said).first_hit(query).outcome == oracle::Walk(scene).first_hit(query).outcome);
    }
  }
}

TEST_CASE("Fewer directions: answers are proved, and others are not", "[oracle][ranks][prover]") {
  INFO("seed 36");
  Draw draw(36);
  int by_outcome[3] = {}, next_ones = 0;
  for (int i = 0; i < 600; ++i) {
    const Style style = kStyles[draw.below(3)];
    const Scene scene = drawn_scene(draw, style, 2 + i % 2);
    const oracle::Oracle oracle(scene);
    const oracle::Prover prover(scene);
    const oracle::CertificateCheck check(scene);
    const Query query = drawn_query(draw, style, scene);
    oracle::Request request;
    request.digits = 40;
    const Answer exact = oracle.first_hit(query, request);
    INFO(test::stream(scene, query) << test::line(exact, scene));
    REQUIRE(check.refutation(query, exact, prover.prove(query, exact)).value_or("") == "");
    ++by_outcome[exact.outcome == Outcome::hit ? 0 : exact.outcome == Outcome::inside ? 1 : 2];
    if (exact.outcome == Outcome::never) continue;
    // That nothing is hit; that the next one is, which is proved where the first is left.
    const Answer never = Answer::never();
    REQUIRE(check.refutation(query, never, prover.prove(query, never)));
    const Query leaving{query.x, query.v, exact.obstacle};
    const Answer next = oracle.first_hit(leaving, request);
    if (next.outcome == Outcome::never) continue;
    const oracle::Certificate proof = prover.prove(leaving, next);
    REQUIRE(check.refutation(leaving, next, proof).value_or("") == "");
    if (query.from) continue;
    REQUIRE(check.refutation(query, next, proof));
    ++next_ones;
  }
  INFO(by_outcome[0] << ' ' << by_outcome[1] << ' ' << by_outcome[2] << ' ' << next_ones);
  CHECK((by_outcome[0] > 100 && by_outcome[1] > 30 && by_outcome[2] > 100 && next_ones > 100));
}
