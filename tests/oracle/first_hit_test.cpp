// Cases that can be checked by hand, for both oracles: what the words of the specification mean.
#include <boost/multiprecision/mpfr.hpp>
#include <catch2/catch.hpp>

#include <lorentz/geometry.hpp>
#include <lorentz/oracle.hpp>
#include <lorentz/walk.hpp>
#include "tests/support/support.hpp"

using namespace lorentz;
using namespace lorentz::test;

namespace {

// Both oracles, which must agree; `walk` may be left out where it cannot go.
Answer first_hit(const Scene& scene, const Query& query, bool walk_too = true) {
  const Answer answer = oracle::Oracle(scene).first_hit(query);
  if (walk_too) {
    INFO(stream(scene, query));
    REQUIRE(same(answer, oracle::Walk(scene).first_hit(query)));
  }
  return answer;
}

ObstacleId at(std::int64_t n1, std::int64_t n2, std::int64_t n3 = 0) {
  return {0, 0, {Integer(n1), Integer(n2), Integer(n3)}};
}

const Scene kQuarter = unit_scene(2, 0.25);

}  // namespace

TEST_CASE("Head on, from outside", "[oracle][first_hit]") {
  const Answer answer = first_hit(kQuarter, {{0.5, 0}, {1, 0}, {}});
  CHECK(answer.obstacle == at(1, 0));
  CHECK(answer.time == 0.25);
  CHECK(first_hit(kQuarter, {{0.5, 0}, {4, 0}, {}}).time == 0.0625);
}

TEST_CASE("A tangent is not a hit", "[oracle][first_hit]") {
  CHECK(first_hit(kQuarter, {{0.5, 0.25}, {1, 0}, {}}).outcome == Outcome::never);
  const Answer answer = first_hit(kQuarter, {{0.5, std::nextafter(0.25, 0)}, {1, 0}, {}});
  CHECK(answer.obstacle == at(1, 0));
}

TEST_CASE("On a boundary: inwards hits at 0, outwards and along the tangent do not", "[oracle][first_hit]") {
  const Vec on_top{0, 0.25};
  const Answer inwards = first_hit(kQuarter, {on_top, {0, -1}, {}});
  CHECK(inwards.outcome == Outcome::hit);
  CHECK(inwards.obstacle == at(0, 0));
  CHECK(inwards.time == 0.0);
  CHECK_FALSE(std::signbit(*inwards.time));
  const Answer outwards = first_hit(kQuarter, {on_top, {0, 1}, {}});
  CHECK(outwards.obstacle == at(0, 1));
  CHECK(outwards.time == 0.5);
  CHECK(first_hit(kQuarter, {on_top, {1, 0}, {}}).outcome == Outcome::never);
  // (3, 4, 5) / 20 lies exactly on the circle of radius 1/4; not in binary64, but scaled by 20 it does.
  Scene scene = unit_scene(2, 5);
  scene.lattices[0].vectors = {Vec{20, 0}, Vec{0, 20}, Vec{}};
  CHECK(first_hit(scene, {{3, 4}, {-3, -4}, {}}).time == 0.0);
  CHECK(first_hit(scene, {{3, 4}, {4, -3}, {}}).outcome != Outcome::inside);
  CHECK_FALSE(first_hit(scene, {{3, 4}, {4, -3}, {}}).obstacle == at(0, 0));
}

TEST_CASE("Inside is the open obstacle, of several the smallest", "[oracle][first_hit]") {
  CHECK(first_hit(kQuarter, {{0.24, 0}, {1, 0}, {}}).outcome == Outcome::inside);
  CHECK(first_hit(kQuarter, {{0.25, 0}, {1, 0}, {}}).outcome == Outcome::hit);
  const Answer answer = first_hit(unit_scene(2, 0.75), {{0.5, 0.5}, {1, 0}, {}});
  CHECK(answer.outcome == Outcome::inside);
  CHECK(answer.obstacle == at(0, 0));
  CHECK(first_hit(unit_scene(3, 2.5), {{0, 0, 0}, {1, 0, 0}, {}}).obstacle == at(-2, -1, -1));
}

TEST_CASE("`from` is ignored, wherever x lies", "[oracle][first_hit]") {
  const Query inside{{0.1, 0.1}, {1, 0}, at(0, 0)};
  CHECK(first_hit(kQuarter, inside).obstacle == at(1, 0));
  const Query ahead{{0.5, 0}, {1, 0}, at(1, 0)};
  CHECK(first_hit(kQuarter, ahead).obstacle == at(2, 0));
  const Query on_surface{{0, 0.25}, {0, -1}, at(0, 0)};
  CHECK(first_hit(kQuarter, on_surface).obstacle == at(0, -1));
  // With a second obstacle around x, that one counts.
  const Query two{{0.5, 0.5}, {1, 0}, at(0, 0)};
  CHECK(first_hit(unit_scene(2, 0.75), two).outcome == Outcome::inside);
  CHECK(first_hit(unit_scene(2, 0.75), two).obstacle == at(0, 1));
  const Query elsewhere{
      {0.5, 0},
      {1, 0},
      ObstacleId{0, 0, {*Integer::from_decimal("100000000000000000000"), Integer(0), Integer(0)}}};
  CHECK(first_hit(kQuarter, elsewhere).obstacle == at(1, 0));
}

TEST_CASE("Ties go to the smallest lattice, atom, cell", "[oracle][first_hit]") {
  // Radius 5/8 at distance 1: x in the middle below, both discs entered at the same time.
  const Answer answer = first_hit(unit_scene(2, 0.625), {{0.5, 0.5}, {0, -1}, {}});
  CHECK(answer.outcome == Outcome::hit);
  CHECK(answer.obstacle == at(0, 0));
  CHECK(first_hit(unit_scene(2, 0.625), {{0.5, 0.5}, {-1, 0}, {}}).obstacle == at(0, 0));
  CHECK(first_hit(unit_scene(2, 0.625), {{0.5, 0.5}, {1, 0}, {}}).obstacle == at(1, 0));
  // The same obstacle twice: as two atoms, as two lattices.
  Scene twins = kQuarter;
  twins.lattices[0].atoms.push_back(twins.lattices[0].atoms[0]);
  CHECK(first_hit(twins, {{0.5, 0}, {1, 0}, {}}).obstacle == at(1, 0));
  CHECK(first_hit(twins, {{0.5, 0}, {1, 0}, at(1, 0)}).obstacle == ObstacleId{0, 1, at(1, 0).cell});
  Scene two = kQuarter;
  two.lattices.push_back(two.lattices[0]);
  CHECK(first_hit(two, {{0.5, 0}, {1, 0}, {}}).obstacle.lattice == 0);
  CHECK(first_hit(two, {{0.5, 0}, {1, 0}, at(1, 0)}).obstacle == ObstacleId{1, 0, at(1, 0).cell});
}

TEST_CASE("Primitive vectors as skewed as may be", "[oracle][first_hit]") {
  // The unit cube in other clothes: u_1 = (1, 10^8, -10^17), cells mapped back by hand.
  Scene scene = unit_scene(3, 0.1);
  scene.lattices[0].vectors = {Vec{1, 1e8, -1e17}, Vec{0, 1, 0}, Vec{0, 0, 1}};
  const Query query{{0.3, 0.4, 0.2}, {1, 0.3, 0.2}, {}};
  const Answer plain = oracle::Oracle(unit_scene(3, 0.1)).first_hit(query),
               skewed = oracle::Oracle(scene).first_hit(query);
  REQUIRE(plain.time == skewed.time);
  const std::int64_t n = plain.obstacle.cell[0].int64();
  CHECK(skewed.obstacle.cell == Cell{Integer(n), Integer(plain.obstacle.cell[1].int64() - n * 100'000'000),
                                     Integer(plain.obstacle.cell[2].int64() + n * 100'000'000'000'000'000)});
}

TEST_CASE("The paper's example, 1 degree", "[oracle][first_hit]") {
  const Answer answer =
      first_hit(unit_scene(2, 0.1), {{0, 0.445}, {0.9998476951563913, 0.01745240643728351}, {}});
  CHECK(answer.obstacle == at(27, 1));
}

TEST_CASE("A scene of two lattices: the earlier of their hits", "[oracle][first_hit]") {
  Scene scene = kQuarter;
  scene.lattices.push_back(unit_scene(2, 0.125).lattices[0]);
  scene.lattices[1].atoms[0].position = {0.5, 0.5};
  CHECK(first_hit(scene, {{0.25, 0.5}, {1, 0}, {}}).obstacle == ObstacleId{1, 0, at(0, 0).cell});
  CHECK(first_hit(scene, {{0.5, 0}, {1, 0}, {}}).obstacle == at(1, 0));
}

TEST_CASE("Times of a ball and an ellipsoid are compared as times, also where a plane has many rows",
          "[oracle][first_hit]") {
  // The wall's ball is found first. In the ellipsoid's own coordinates times are longer by v^2, and the
  // search of its rows must not end for that.
  const Scene scene{
      3,
      {{{Vec{0.0625, 0, 0}, Vec{0, 0.078125, 0}, Vec{0, 0, 2}},
        {{{}, 1, {}}, {{0, 0.03125, 0x1p-11}, 0, {{1, 0.5, 0}, {0, 1, 0}, {-0.5, -0.015625, 1}}}}}}};
  const Answer answer = oracle::Oracle(scene).first_hit({{0, -0.0234375, 1}, {0, 0, -1}, {}});
  CHECK(answer.outcome == Outcome::hit);
  CHECK(answer.obstacle == ObstacleId{0, 1, {Integer(8), Integer(0), Integer(0)}});
  CHECK(*answer.time == 0.0002681065563184844);
}

TEST_CASE("An invalid query yields an error that says why", "[oracle][first_hit]") {
  const oracle::Oracle oracle(kQuarter);
  CHECK(oracle.first_hit({{0, 0.5}, {0, 0}, {}}).message.find("v is zero") != std::string::npos);
  CHECK(oracle.first_hit({{0, NAN}, {1, 0}, {}}).message.find("x is not finite") != std::string::npos);
  CHECK(oracle.first_hit({{0, 0.5}, {1, INFINITY}, {}}).message.find("v is not finite") != std::string::npos);
  CHECK(oracle.first_hit({{0, 0.5}, {1, 0}, ObstacleId{0, 1, {}}}).message.find("atom 1") !=
        std::string::npos);
}

TEST_CASE("A time limit is compared with the exact time", "[oracle][first_hit]") {
  const oracle::Oracle oracle(kQuarter);
  oracle::Request request;
  const auto outcome = [&](double max_time, Query query) {
    request.max_time = max_time;
    return oracle.first_hit(query, request).outcome;
  };
  const Query head_on{{0.5, 0}, {1, 0}, {}};
  CHECK(outcome(0.25, head_on) == Outcome::later);  // entered at, not before
  CHECK(outcome(std::nextafter(0.25, 1), head_on) == Outcome::hit);
  CHECK(outcome(1e9, {{0, 0.5}, {1, 0}, {}}) == Outcome::later);
  CHECK(outcome(1, {{0, 0}, {1, 0}, {}}) == Outcome::inside);
}

TEST_CASE("Details are correctly rounded", "[oracle][first_hit]") {
  oracle::Request request;
  request.detail = true;
  request.digits = 30;
  // Disc of radius 5 in a cell of 20, line at height 3: point (20 - 4, 3), normal (-4, 3) / 5, impact
  // parameter 3.
  Scene scene = unit_scene(2, 5);
  scene.lattices[0].vectors = {Vec{20, 0}, Vec{0, 20}, Vec{}};
  const Answer answer = oracle::Oracle(scene).first_hit({{10, 3}, {2, 0}, {}}, request);
  REQUIRE(answer.detail.has_value());
  CHECK(answer.time == 3.0);
  CHECK(answer.time_decimal == "3.00000000000000000000000000000");
  CHECK(answer.detail->point == Vec{16, 3});
  CHECK(answer.detail->normal == Vec{-0.8, 0.6});
  CHECK(answer.detail->impact_parameter == 3.0);
}

TEST_CASE(
    "Times, points, normals and impact parameters of entry and exit are correctly rounded: MPFR at 400 "
    "digits says the "
    "same",
    "[oracle][first_hit]") {
  using Big = boost::multiprecision::number<boost::multiprecision::mpfr_float_backend<400>>;
  using BigVec = std::array<Big, 3>;
  const auto inner = [](const BigVec& a, const BigVec& b) {
    return Big(a[0] * b[0] + a[1] * b[1] + a[2] * b[2]);
  };
  const auto outer = [](const BigVec& a, const BigVec& b) {
    return BigVec{Big(a[1] * b[2] - a[2] * b[1]), Big(a[2] * b[0] - a[0] * b[2]),
                  Big(a[0] * b[1] - a[1] * b[0])};
  };
  oracle::Request request;
  request.detail = true;
  Draw draw(51);
  INFO("seed 51");
  int hits = 0, insides = 0;
  for (int i = 0; i < 600; ++i) {
    const int d = draw.one_in(2) ? 2 : 3;
    const Style style = draw.one_in(2) ? Style::generic : Style::near_grid;
    Scene scene = scene_of(draw, style, d);
    if (draw.one_in(2)) scene = with_ellipsoids(draw, style, scene);
    const Query query = query_of(draw, Style::generic, scene);
    const Answer hit = oracle::Oracle(scene).first_hit(query, request);
    if (hit.outcome != Outcome::hit && hit.outcome != Outcome::inside) continue;
    const bool is_hit = hit.outcome == Outcome::hit;
    ++(is_hit ? hits : insides);
    const Lattice& lattice = scene.lattices[hit.obstacle.lattice];
    const Atom& atom = lattice.atoms[hit.obstacle.atom];
    BigVec x, v, arm;  // arm: from x to the centre
    for (int k = 0; k < 3; ++k) {
      x[k] = query.x[k], v[k] = query.v[k], arm[k] = Big(atom.position[k]) - x[k];
      for (int n = 0; n < d; ++n) arm[k] += Big(hit.obstacle.cell[n].decimal()) * lattice.vectors[n][k];
    }
    // The dual of the semiaxes: y_i = dual_i . (place - centre), |y| = 1 on the surface, gradient sum y_i
    // dual_i.
    BigVec axes[3], dual[3];
    for (int n = 0; n < 3; ++n)
      for (int k = 0; k < 3; ++k)
        axes[n][k] = n < d && !atom.is_ball() ? atom.semiaxes[n][k] : n != k ? 0 : n < d ? atom.radius : 1;
    const Big volume = inner(axes[0], outer(axes[1], axes[2]));
    BigVec w, c;  // velocity and centre in coordinates y
    for (int n = 0; n < 3; ++n) {
      dual[n] = outer(axes[(n + 1) % 3], axes[(n + 2) % 3]);
      for (Big& component : dual[n]) component /= volume;
      w[n] = inner(dual[n], v), c[n] = inner(dual[n], arm);
    }
    const Big w2 = inner(w, w), s = inner(w, c), root = sqrt(Big(s * s - w2 * (inner(c, c) - 1)));
    const Big times[2] = {(s - root) / w2, (s + root) / w2};
    const Big along = inner(v, arm), v2 = inner(v, v), h2 = v2 * inner(arm, arm) - along * along;
    INFO(stream(scene, query));
    REQUIRE(hit.detail->impact_parameter == Big(sqrt(Big(h2 / v2))).convert_to<double>());
    REQUIRE(hit.time.has_value() == is_hit);
    for (int end = is_hit ? 0 : 1; end < 2; ++end) {
      const Big& t = times[end];
      BigVec normal{};
      for (int n = 0; n < 3; ++n)
        for (int k = 0; k < 3; ++k) normal[k] += (t * w[n] - c[n]) * dual[n][k];
      const Big length = sqrt(inner(normal, normal));
      const Vec& point = end == 0 ? hit.detail->point : hit.detail->exit_point;
      const Vec& outward = end == 0 ? hit.detail->normal : hit.detail->exit_normal;
      REQUIRE(*(end == 0 ? hit.time : hit.exit_time) == t.convert_to<double>());
      for (int k = 0; k < d; ++k) {
        REQUIRE(point[k] == Big(x[k] + t * v[k]).convert_to<double>());
        REQUIRE(outward[k] == Big(normal[k] / length).convert_to<double>());
      }
    }
  }
  CHECK(hits > 200);  // 259 seen
  CHECK(insides > 100);
}

namespace {

constexpr StartInside kRules[] = {StartInside::miss, StartInside::zero, StartInside::exit};

// An obstacle as a scene of its own.
Scene alone(const Scene& scene, const ObstacleId& id) {
  const Lattice& lattice = scene.lattices[id.lattice];
  Atom atom = lattice.atoms[id.atom];
  for (int i = 0; i < lattice.rank_in(scene.dimension); ++i)
    for (int k = 0; k < 3; ++k)
      atom.position[k] += static_cast<double>(id.cell[i].int64()) * lattice.vectors[i][k];
  Scene one{scene.dimension, {}};
  one.lattices.push_back({.vectors = {}, .atoms = {atom}, .rank = 0});
  return one;
}

// What the rule says of single obstacles, from what the oracle says by the usual rule of each of them, or of some.
Answer by_single_obstacles(const Scene& scene, const std::vector<ObstacleId>& ids, const Query& query,
                           StartInside rule) {
  Scene others{scene.dimension, {}};
  std::vector<ObstacleId> left;
  std::optional<Answer> first;
  for (const ObstacleId& id : ids) {
    const Scene one = alone(scene, id);
    if (query.from == id) continue;
    oracle::Request request;
    request.detail = true;
    const Answer answer = oracle::Oracle(one).first_hit({query.x, query.v, {}}, request);
    if (answer.outcome != Outcome::inside) {
      others.lattices.push_back(one.lattices[0]), left.push_back(id);
    } else if (rule == StartInside::zero) {
      if (!first) first = Answer::hit(id, 0);
    } else if (rule == StartInside::exit && (!first || *answer.exit_time < *first->time)) {
      first = Answer::hit(id, *answer.exit_time);
    }
  }
  if (first) return *first;
  if (others.lattices.empty()) return Answer::never();
  Answer answer = oracle::Oracle(others).first_hit({query.x, query.v, {}});
  if (answer.outcome == Outcome::hit)
    answer.obstacle = left[static_cast<std::size_t>(answer.obstacle.lattice)];
  return answer;
}

}  // namespace

TEST_CASE("A start inside by another rule: single obstacles are taken away, or looked at one by one",
          "[oracle][first_hit]") {
  Draw draw(6701);
  INFO("seed 6701");
  int around = 0, free = 0;
  for (int i = 0; i < 300; ++i) {
    const int d = draw.one_in(2) ? 2 : 3;
    Scene scene{d, {}};
    std::vector<ObstacleId> ids;
    for (int n = 0; n < 8; ++n) {
      const Atom atom{draw.vec(d, -1, 1), draw.between(0.2, 1), {}};
      scene.lattices.push_back({.vectors = {}, .atoms = {atom}, .rank = 0});
      ids.push_back({n, 0, {}});
    }
    Query query{draw.vec(d, -1, 1), draw.vec(d, -3, 3), {}};
    if (draw.one_in(3)) query.from = ids[draw.below(8)];
    const oracle::Oracle oracle(scene);
    INFO(stream(scene, query));
    ++(oracle.first_hit(query).outcome == Outcome::inside ? around : free);
    for (const StartInside rule : kRules) {
      INFO(name_of(rule));
      oracle::Request request;
      request.start = rule;
      REQUIRE(same(oracle.first_hit(query, request), by_single_obstacles(scene, ids, query, rule)));
    }
  }
  CHECK(around > 100);
  CHECK(free > 30);
}

TEST_CASE("A start inside that misses: the lattice as single obstacles says the same",
          "[oracle][first_hit]") {
  Draw draw(6702);
  INFO("seed 6702");
  int around = 0, many = 0;
  for (int i = 0; i < 200; ++i) {
    const int d = i % 8 == 0 ? 3 : 2, reach = d == 2 ? 6 : 4;
    Scene scene = unit_scene(d, draw.between(0.5, d == 2 ? 2 : 1.2));
    for (int k = 0; k < d; ++k)  // dyadic, so that positions of cells are exact
      for (int m = 0; m < d; ++m)
        scene.lattices[0].vectors[k][m] += static_cast<double>(draw.below(9)) / 32 - 0.125;
    const Query query{draw.vec(d, -0.5, 0.5), draw.vec(d, -1, 1), {}};
    std::vector<ObstacleId> ids;
    for (int a = -reach; a <= reach; ++a)
      for (int b = -reach; b <= reach; ++b)
        for (int c = d == 3 ? -reach : 0; c <= (d == 3 ? reach : 0); ++c) ids.push_back({0, 0, {a, b, c}});
    const oracle::Oracle oracle(scene);
    INFO(stream(scene, query));
    const bool is_inside = oracle.first_hit(query).outcome == Outcome::inside;
    around += is_inside, many += is_inside && scene.lattices[0].atoms[0].radius > 1.2;
    for (const StartInside rule : kRules) {
      INFO(name_of(rule));
      oracle::Request request;
      request.start = rule;
      const Answer answer = oracle.first_hit(query, request);
      if (rule == StartInside::miss && (!answer.time || *answer.time * length(query.v) > 1))
        continue;  // beyond reach
      REQUIRE(same(answer, by_single_obstacles(scene, ids, query, rule)));
    }
  }
  CHECK(around > 100);
  CHECK(many > 30);
}

TEST_CASE("A start inside balls of very many cells is no question by the rules that pass them",
          "[oracle][first_hit]") {
  const oracle::Oracle oracle(unit_scene(2, 1e20));
  for (const StartInside rule : {StartInside::miss, StartInside::exit}) {
    oracle::Request request;
    request.start = rule;
    const Answer answer = oracle.first_hit({{0.25, 0.5}, {1, 0.5}, {}}, request);
    CHECK((answer.outcome == Outcome::error && answer.unsupported));
  }
}

// What is left of a flight that ends at once is short, however large the obstacle is at which it ends. The fine
// lattice had been searched as far as the centre of the ball, row by row: years.
TEST_CASE("A large ball is hit at once, from between very many small ones", "[oracle][first_hit]") {
  const double step = 0x1p-45;
  for (const int dimension : {2, 3}) {
    Scene scene = unit_scene(dimension, step / 8);
    for (Vec& vector : scene.lattices[0].vectors)
      for (double& component : vector) component *= step;
    scene.lattices.insert(scene.lattices.begin(), Lattice{{}, {Atom{{}, 1, {}}}, 0});
    const Vec v{1, 0.2, dimension == 3 ? 0.3 : 0};
    const Answer answer = first_hit(scene, {{-1 - step / 2, step / 2, dimension == 3 ? step / 2 : 0}, v, {}});
    CHECK(answer.outcome == Outcome::hit);
    CHECK(answer.obstacle.lattice == 0);
    CHECK(*answer.time == Approx(step / 2).margin(0).epsilon(1e-9));
  }
}

TEST_CASE("Subnormal and huge velocities and places", "[oracle][first_hit]") {
  CHECK(first_hit(kQuarter, {{0.5, 0}, {0x1p-1000, 0}, {}}, false).time == 0x1p998);
  CHECK(std::isinf(*first_hit(kQuarter, {{0.5, 0}, {0x1p-1074, 0}, {}}, false).time));
  CHECK(first_hit(kQuarter, {{0.5, 0}, {0x1p1023, 0}, {}}).time == 0x1p-1025);
  CHECK(first_hit(kQuarter, {{0.5, 0x1p-1074}, {1, 0}, {}}).obstacle == at(1, 0));
  const Answer off_axis = first_hit(kQuarter, {{0.5, 0.5}, {1, 0x1p-1074}, {}}, false);
  CHECK(off_axis.outcome == Outcome::hit);
  CHECK(off_axis.obstacle.cell[1] == Integer(1));
  CHECK(std::isinf(*off_axis.time));
  const Answer far = first_hit(kQuarter, {{0x1p1000, 0}, {0, 1}, {}}, false);
  CHECK(far.outcome == Outcome::inside);
}
