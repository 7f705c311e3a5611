#include <lorentz/collision.hpp>

#include <catch2/catch.hpp>

#include <limits>
#include <tuple>

#include <lorentz/engine.hpp>
#include <lorentz/geometry.hpp>
#include <lorentz/oracle.hpp>
#include "src/problem/scene_geometry.hpp"
#include "tests/support/support.hpp"

using namespace lorentz;
using namespace lorentz::test;

namespace {

Vec minus(const Vec& a, const Vec& b) {
  return plus(a, -1, b);
}

double distance(const Vec& a, const Vec& b) {
  return length(minus(a, b));
}

// |A^-1 a|^2 by Cramer's rule, the matrix in columns: not by the code under test.
double form(const Atom& atom, int dimension, const Vec& a) {
  Lattice matrix;
  for (int i = 0; i < dimension; ++i) matrix.vectors[i] = atom.semiaxes[i];
  double sum = 0;
  for (int i = 0; i < dimension; ++i) {
    Lattice replaced = matrix;
    replaced.vectors[i] = a;
    const double y = determinant(replaced, dimension) / determinant(matrix, dimension);
    sum += y * y;
  }
  return sum;
}

Scene one_ellipsoid(int dimension, std::vector<Vec> semiaxes) {
  Scene scene = unit_scene(dimension, 1);
  for (int i = 0; i < dimension; ++i) scene.lattices[0].vectors[i][i] = 100;
  scene.lattices[0].atoms[0] = Atom{{}, 0, std::move(semiaxes)};
  return scene;
}

}  // namespace

TEST_CASE("An answer that held another one is as a new one", "[engines]") {
  const auto everything = [] {
    Answer answer = Answer::hit({3, 2, {7, 8, 9}}, 5.5);
    answer.time_decimal = "5.5", answer.detail = Detail{}, answer.message = "none", answer.unsupported = true;
    return answer;
  };
  const auto parts = [](const Answer& a) {
    return std::tuple(a.outcome, a.obstacle, a.time, a.time_decimal, a.detail.has_value(), a.message,
                      a.unsupported);
  };
  const double endless = std::numeric_limits<double>::infinity();
  for (const char* name : {"classical", "published", "golse", "reduction"}) {
    const auto engine = make_engine(name, unit_scene(2, 0.1));
    for (const Query& query : {Query{{0.3, 0.2, 0}, {0.61, 0.23, 0}, {}}, Query{{0.5, 0.5, 0}, {1, 0, 0}, {}},
                               Query{{0.05, 0, 0}, {1, 0.3, 0}, {}}, Query{{0, 0.5, 0}, {0, 0, 0}, {}}})
      for (const double limit : {1e-3, endless}) {
        Answer answer = everything();
        engine->first_hit(query, limit, answer);
        INFO(name << ", limit " << limit);
        CHECK((parts(answer) == parts(engine->first_hit(query, limit))));
      }
  }
}

TEST_CASE("Collision detail of balls is the oracle's, which is correctly rounded", "[engines][collision]") {
  Draw draw(1301);
  INFO("seed 1301");
  int hits = 0;
  for (int i = 0; i < 1000; ++i) {
    const int dimension = draw.one_in(2) ? 2 : 3;
    const Scene scene = scene_of(draw, Style::generic, dimension);
    const Query query{draw.vec(dimension, 0, 1), draw.vec(dimension, -2, 2), {}};
    oracle::Request request;
    request.detail = true;
    const Answer exact = oracle::Oracle(scene).first_hit(query, request);
    if (exact.outcome != Outcome::hit) continue;
    ++hits;
    const Detail given = collision_detail(scene, query, exact);
    INFO(stream(scene, query));
    const double r = scene.lattices[exact.obstacle.lattice].atoms[exact.obstacle.atom].radius;
    const double error = 1e-13 * (1 + *exact.time * length(query.v));
    CHECK(distance(given.point, exact.detail->point) < error);
    CHECK(distance(given.normal, exact.detail->normal) < error / r);
    CHECK(std::fabs(given.impact_parameter - exact.detail->impact_parameter) < error);
    // An exit beside a grazed edge is as uncertain as the chord is short.
    const double chord = distance(exact.detail->point, exact.detail->exit_point);
    const double exit_error = error * (1 + 4 * r / chord);
    CHECK(distance(given.exit_point, exact.detail->exit_point) < exit_error);
    CHECK(distance(given.exit_normal, exact.detail->exit_normal) < exit_error / r);
    CHECK(std::fabs(exit_time(scene, query, exact) - *exact.exit_time) < exit_error / length(query.v));
  }
  CHECK(hits > 300);  // 508 seen
}

TEST_CASE("A reflection keeps the speed and turns the normal component", "[engines][collision]") {
  Draw draw(1302);
  INFO("seed 1302");
  for (int i = 0; i < 1000; ++i) {
    const int dimension = draw.one_in(2) ? 2 : 3;
    const Vec v = draw.vec(dimension, -3, 3), arm = draw.vec(dimension, -1, 1);
    const Vec normal{arm[0] / length(arm), arm[1] / length(arm), arm[2] / length(arm)};
    const Vec after = reflected(v, normal);
    CHECK(length(after) == Approx(length(v)).epsilon(1e-14));
    CHECK(dot(after, normal) == Approx(-dot(v, normal)).margin(1e-14));
    CHECK(distance(reflected(after, normal), v) < 1e-14);
  }
}

TEST_CASE("What is aimed at one focus of an ellipse goes on as if it came from the other",
          "[engines][collision]") {
  Draw draw(1303);
  INFO("seed 1303");
  for (int i = 0; i < 500; ++i) {
    const double a = draw.between(0.5, 2), b = a * draw.between(0.1, 0.99), c = std::sqrt(a * a - b * b);
    const double turn = draw.between(0, 7), at = draw.between(0, 7);
    const Vec along{std::cos(turn), std::sin(turn)}, across{-std::sin(turn), std::cos(turn)};
    const auto place = [&](double p, double q) {
      return Vec{p * along[0] + q * across[0], p * along[1] + q * across[1]};
    };
    const Scene scene = one_ellipsoid(2, {place(a, 0), place(0, b)});
    const Vec focus = place(c, 0), other = place(-c, 0), point = place(a * std::cos(at), b * std::sin(at));
    Query query;
    query.v = minus(focus, point);  // the line of flight meets the ellipse at `point`
    query.x = plus(point, -draw.between(1, 3), query.v);
    Answer answer = Answer::hit({}, 0);
    answer.time = distance(point, query.x) / length(query.v);
    const Detail detail = collision_detail(scene, query, answer);
    const Vec after = reflected(query.v, detail.normal), from_other = minus(point, other);
    INFO(stream(scene, query));
    CHECK(distance(detail.point, point) < 1e-13);
    CHECK(after[0] * from_other[1] - after[1] * from_other[0] == Approx(0).margin(1e-11));
    CHECK(dot(after, from_other) > 0);
    // The line passes through the focus: its distance from the centre is Euclidean, not the ellipse's.
    CHECK(detail.impact_parameter ==
          Approx(std::fabs(focus[0] * query.v[1] - focus[1] * query.v[0]) / length(query.v)).margin(1e-12));
  }
}

TEST_CASE("An ellipsoid's normal is the gradient of its quadratic form, by finite differences",
          "[engines][collision]") {
  Draw draw(1304);
  INFO("seed 1304");
  for (int i = 0; i < 500; ++i) {
    const int dimension = draw.one_in(2) ? 2 : 3;
    Lattice axes;
    do
      for (int k = 0; k < dimension; ++k) axes.vectors[k] = draw.vec(dimension, -1, 1);
    while (std::fabs(determinant(axes, dimension)) < 0.05);
    Scene scene = one_ellipsoid(dimension, {axes.vectors.begin(), axes.vectors.begin() + dimension});
    Atom& atom = scene.lattices[0].atoms[0];
    atom.position = draw.vec(dimension, -1, 1);
    Vec arm = draw.vec(dimension, -1, 1);
    const double stretch = 1 / std::sqrt(form(atom, dimension, arm));
    for (double& component : arm) component *= stretch;
    Query query;
    query.v = draw.vec(dimension, -1, 1);
    query.x = minus(sum(atom.position, arm), query.v);
    const Detail detail = collision_detail(scene, query, Answer::hit({}, 1));
    Vec differences{};
    constexpr double kStep = 1e-5;
    for (int k = 0; k < dimension; ++k) {
      Vec ahead = arm, behind = arm;
      ahead[k] += kStep, behind[k] -= kStep;
      differences[k] = form(atom, dimension, ahead) - form(atom, dimension, behind);
    }
    INFO(stream(scene, query));
    CHECK(length(detail.normal) == Approx(1).epsilon(1e-14));
    for (int k = 0; k < 3; ++k)
      CHECK(detail.normal[k] == Approx(differences[k] / length(differences)).margin(1e-6));
    const double along = dot(arm, query.v) / length(query.v);
    CHECK(detail.impact_parameter ==
          Approx(std::sqrt(std::max(0.0, dot(arm, arm) - along * along))).margin(1e-7));
  }
}

TEST_CASE("Exits of slender ellipses: across, and at both ends", "[engines][collision]") {
  for (const int p : {100, 255, 256, 400, 500}) {
    const double large = std::ldexp(1, p), small = std::ldexp(1, -p);
    const Scene scene = one_ellipsoid(2, {{large, 0, 0}, {0, small, 0}});
    const Query across{{0, -4 * small, 0}, {0, small, 0}, {}}, along{{-4 * large, 0, 0}, {large, 0, 0}, {}};
    INFO(p);
    for (const Query& query : {across, along}) {
      CHECK(exit_time(scene, query, Answer::hit({}, 3)) == 5);
      CHECK(collision_detail(scene, query, Answer::hit({}, 3)).exit_normal ==
            (query.v[0] > 0 ? Vec{1, 0, 0} : Vec{0, 1, 0}));
    }
  }
}

TEST_CASE("Collision detail has the same bits at any size and speed", "[engines][collision]") {
  Draw draw(1305);
  INFO("seed 1305");
  for (int i = 0; i < 400; ++i) {
    const int dimension = draw.one_in(2) ? 2 : 3;
    std::vector<Vec> axes;
    for (int k = 0; k < dimension; ++k) axes.push_back(draw.vec(dimension, -1, 1));
    Scene scene = draw.one_in(2) ? one_ellipsoid(dimension, axes) : unit_scene(dimension, 2);
    const Vec centre = scene.lattices[0].atoms[0].position = draw.vec(dimension, -1, 1);
    const Query query{plus(centre, 0.4, sum(axes[0], axes[1])), draw.vec(dimension, -1, 1), {}};
    const Answer answer = draw.one_in(2) ? Answer::hit({}, 1) : Answer::inside({});
    const Detail detail = collision_detail(scene, query, answer);
    for (const auto& [size, speed] : {std::pair(0, 600), {0, -600}, {600, 0}, {-600, 0}, {-600, -700}}) {
      const Scene other = scaled(scene, size);
      const Query scaled{times_power_of_two(query.x, size), times_power_of_two(query.v, speed), {}};
      Answer its = answer;
      if (its.time) its.time = std::scalbn(*its.time, size - speed);
      const Detail found = collision_detail(other, scaled, its);
      INFO(stream(other, scaled));
      CHECK(found.point == times_power_of_two(detail.point, size));
      CHECK(found.normal == detail.normal);
      CHECK(found.exit_point == times_power_of_two(detail.exit_point, size));
      CHECK(found.exit_normal == detail.exit_normal);
      CHECK(found.impact_parameter == std::scalbn(detail.impact_parameter, size));
      CHECK(exit_time(other, scaled, its) == std::scalbn(exit_time(scene, query, answer), size - speed));
    }
  }
}
