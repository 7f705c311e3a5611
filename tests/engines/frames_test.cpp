// The same questions in frames in which programs do not look: starts many cells out, skewed cells, components
// at the ends of the number range, rows nearly parallel to the flight. `reduction` in all ways, and
// `certified`, against the oracle.
#include <catch2/catch.hpp>

#include <lorentz/certified.hpp>
#include <lorentz/geometry.hpp>
#include "src/engines/base/double_double.hpp"
#include "tests/engines/reduction_support.hpp"
#include "tests/support/scenes.hpp"

using namespace lorentz;
using test::Draw, test::one_atom;

namespace {

// The first hit as `reduction`, `certified` and the oracle see it; then the one after it, leaving the first.
void check_frame(const Scene& scene, Query query, test::Count& count) {
  const Answer exact = oracle::Oracle(scene).first_hit(query);
  INFO(test::stream(scene, query));
  REQUIRE(test::same(oracle::Certified(scene).first_hit(query), exact));
  if (!Reduction::beyond(scene)) test::check(scene, query, count);
  const bool named = exact.outcome == Outcome::hit || exact.outcome == Outcome::inside;
  if (query.from || !named) return;
  query.from = exact.obstacle;
  check_frame(scene, query, count);
}

// A cell whose shortest vector is about 1, in any direction.
Lattice cell(Draw& draw, int dimension) {
  Lattice lattice;
  do
    for (int i = 0; i < dimension; ++i) lattice.vectors[i] = draw.vec(dimension, -1, 1);
  while (std::fabs(test::determinant(lattice, dimension)) < 0.1);
  if (draw.one_in(3)) {  // square or cubic, of a spacing that is not a binary fraction
    const double spacing = draw.between(0.5, 2);
    lattice.vectors = {};
    for (int i = 0; i < dimension; ++i) lattice.vectors[i][i] = spacing;
  }
  return lattice;
}

Vec shortest_of(const Lattice& lattice, int dimension) {
  Vec shortest{1e300, 0, 0};
  const int last = dimension == 3 ? 2 : 0;
  for (int a = -2; a <= 2; ++a)
    for (int b = -2; b <= 2; ++b)
      for (int c = -last; c <= last; ++c) {
        Vec sum{};
        for (int k = 0; k < 3; ++k)
          sum[k] = a * lattice.vectors[0][k] + b * lattice.vectors[1][k] + c * lattice.vectors[2][k];
        if ((a || b || c) && length(sum) < length(shortest)) shortest = sum;
      }
  return shortest;
}

// The same lattice in another basis: `steps` times, a multiple of another vector is added to a vector.
void skew(Draw& draw, Lattice& lattice, int dimension, int steps, int bits) {
  for (int step = 0; step < steps; ++step) {
    const auto i = draw.below(dimension), j = (i + 1 + draw.below(dimension - 1)) % dimension;
    const double k = draw.sign() * std::floor(std::exp2(draw.between(0, bits)));
    for (int c = 0; c < dimension; ++c) lattice.vectors[i][c] += k * lattice.vectors[j][c];
  }
}

Vec point_of(const Lattice& lattice, const Vec& coordinates) {
  Vec x{};
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) x[k] += coordinates[i] * lattice.vectors[i][k];
  return x;
}

}  // namespace

TEST_CASE("Starts 10^13 cells out, about midway between two balls that nearly touch", "[engines][frames]") {
  test::Count count;
  Draw draw(1301);
  for (int i = 0; i < 12'000; ++i) {
    const int dimension = draw.one_in(3) ? 2 : 3;
    const Lattice lattice = cell(draw, dimension);
    const Vec shortest = shortest_of(lattice, dimension);
    const double radius =
        length(shortest) * (draw.one_in(4) ? draw.between(0.4, 0.5) : draw.between(0.496, 0.4995));
    const Vec centre = draw.one_in(2) ? Vec{} : draw.vec(dimension, -1, 1);
    Vec n{};
    for (int k = 0; k < dimension; ++k)
      n[k] = draw.one_in(2) ? draw.fraction(1, 4) : std::floor(draw.tiny(40, 43.9));
    Query query{point_of(lattice, n), draw.vec(dimension, -1, 1), {}};
    const double share = 0.5 + draw.between(-0.004, 0.004);
    for (int k = 0; k < dimension; ++k) query.x[k] += centre[k] + share * shortest[k];
    check_frame(one_atom(dimension, lattice.vectors, radius, centre), query, count);
  }
  CHECK(count.inside > 3'000);            // 3 777 seen
  CHECK(count.hit > 15'000);              // 18 805 seen
  CHECK(count.stages.undecided < 2'000);  // 1 222 seen
}

TEST_CASE("Skewed cells, many cells out, leaving the obstacle that was hit", "[engines][frames]") {
  test::Count count;
  Draw draw(1302);
  for (int i = 0; i < 8'000; ++i) {
    const int dimension = draw.one_in(2) ? 2 : 3;
    Lattice lattice;  // on a grid, so that a skewed basis is exactly the same lattice
    do
      for (int k = 0; k < dimension; ++k)
        lattice.vectors[k] = test::vec_of(draw, test::Style::grid, dimension, 2);
    while (std::fabs(test::determinant(lattice, dimension)) < 0.05);
    const double radius = length(shortest_of(lattice, dimension)) * draw.between(0.05, 0.499);
    skew(draw, lattice, dimension, 2, 19);
    Query query{draw.vec(dimension, -1, 1), draw.vec(dimension, -1, 1), {}};
    const int far = static_cast<int>(draw.between(0, 43));
    for (int k = 0; k < dimension; ++k) query.x[k] += std::floor(draw.tiny(far, far + 1));
    check_frame(one_atom(dimension, lattice.vectors, radius), query, count);
  }
  CHECK(count.hit > 10'000);            // 11 526 seen
  CHECK(count.inside > 600);            // 846 seen
  CHECK(count.stages.undecided < 100);  // 38 seen
}

TEST_CASE("Lattice vectors with components at the lower end of the range", "[engines][frames]") {
  test::Count count;
  Draw draw(1303);
  for (int i = 0; i < 1'500; ++i) {
    const int dimension = draw.one_in(2) ? 2 : 3;
    Lattice lattice;
    const int size = draw.one_in(2) ? 0 : static_cast<int>(draw.between(-399, 399));
    for (int k = 0; k < dimension; ++k)
      for (int c = 0; c < dimension; ++c) {
        if (c == k)
          lattice.vectors[k][c] = std::ldexp(1 + static_cast<double>(draw.below(3)), size);
        else if (draw.one_in(2))
          lattice.vectors[k][c] = std::ldexp(draw.sign(), size - static_cast<int>(draw.between(20, 1100)));
      }
    const double radius = std::ldexp(0.125 * static_cast<double>(1 + draw.below(4)), size);
    Query query;
    for (int k = 0; k < dimension; ++k) {
      query.x[k] = std::ldexp(draw.fraction(8, 2), size);
      query.v[k] = static_cast<double>(draw.below(3)) - 1;
      if (draw.one_in(8)) query.x[k] = std::ldexp(draw.sign(), static_cast<int>(draw.between(-1074, size)));
      if (draw.one_in(8)) query.v[k] = std::ldexp(draw.sign(), static_cast<int>(draw.between(-1074, 0)));
    }
    if (query.v == Vec{}) query.v[0] = 1;
    check_frame(one_atom(dimension, lattice.vectors, radius), query, count);
  }
  CHECK(count.hit > 450);    // 475 seen
  CHECK(count.never > 80);   // 122 seen; 461 of 6 000
  CHECK(count.inside > 80);  // 110 seen; 458 of 6 000
}

TEST_CASE("Rows nearly parallel to the flight, whose heights are known less well than their own size",
          "[engines][frames]") {
  test::Count count;
  Draw draw(1304);
  for (int i = 0; i < 20'000; ++i) {
    const Lattice lattice = cell(draw, 2);
    const double radius = length(shortest_of(lattice, 2)) * std::exp2(draw.between(-21, -10));
    const double reach = std::exp2(draw.between(0, 10));
    const Vec row = point_of(
        lattice, {std::floor(draw.between(-reach, reach)), std::floor(draw.between(1, reach + 1)), 0});
    Query query;
    double best = 1e300;
    for (int tries = 0; tries < 64;
         ++tries) {  // of multiples of the row the one that rounding leaves most parallel
      const double k = draw.between(0.5, 2);
      const Wide height = Wide::product(k * row[0], row[1]) - Wide::product(k * row[1], row[0]);
      if (std::fabs(height.value()) >= best || height.value() == 0) continue;
      best = std::fabs(height.value());
      query.v = {k * row[0], k * row[1], 0};
    }
    if (query.v == Vec{}) continue;
    const double along = draw.between(-0.4, 0.4) / length(row),
                 across = draw.sign() * radius * (1 + draw.tiny(-30, 0)) / length(row);
    query.x = {along * row[0] - across * row[1], along * row[1] + across * row[0], 0};
    check_frame(one_atom(2, lattice.vectors, radius), query, count);
  }
  CHECK(count.hit > 20'000);                  // 27 568 seen
  CHECK(count.stages.double_double > 2'000);  // 2 905 seen
  CHECK(count.stages.undecided < 12'000);     // 8 862 seen
}
