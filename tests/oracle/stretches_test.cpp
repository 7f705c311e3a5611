// Lattice points in a stretch of a cylinder, against all points of a box.
#include "oracle/exact/stretches.hpp"

#include <catch2/catch.hpp>

#include <map>
#include <optional>
#include <set>

#include "tests/support/support.hpp"

using namespace lorentz::oracle;
using lorentz::test::Draw;

namespace {

constexpr std::uint64_t kSeed = 9001;

template <std::size_t D>
using Ints = std::array<long, D>;

// Everything small, so that 64 bits hold it.
template <std::size_t D>
struct Problem {
  std::array<Ints<D>, D> basis;  // rows
  Ints<D> offset, v;
  long reach2, low, high;

  Ints<D> point(const Ints<D>& n) const {
    Ints<D> p = offset;
    for (std::size_t i = 0; i < D; ++i)
      for (std::size_t k = 0; k < D; ++k) p[k] += n[i] * basis[i][k];
    return p;
  }
};

template <std::size_t D>
long product(const Ints<D>& a, const Ints<D>& b) {
  long sum = 0;
  for (std::size_t i = 0; i < D; ++i) sum += a[i] * b[i];
  return sum;
}

long determinant_of(const std::array<Ints<2>, 2>& b) {
  return b[0][0] * b[1][1] - b[0][1] * b[1][0];
}
long determinant_of(const std::array<Ints<3>, 3>& b) {
  long sum = 0;
  for (int i = 0; i < 3; ++i)
    sum += b[0][i] * (b[1][(i + 1) % 3] * b[2][(i + 2) % 3] - b[1][(i + 2) % 3] * b[2][(i + 1) % 3]);
  return sum;
}

template <std::size_t D>
Ints<D> drawn(Draw& draw, long range) {
  Ints<D> a;
  for (long& component : a) component = static_cast<long>(draw.below(2 * range + 1)) - range;
  return a;
}

template <std::size_t D>
long across2(const Problem<D>& problem, const Ints<D>& p) {
  const long s = product(problem.v, p);
  return product(problem.v, problem.v) * product(p, p) - s * s;
}

// Small lattices, flights along axes, diagonals and anywhere, and radii that some centre is at exactly.
template <std::size_t D>
Problem<D> drawn_problem(Draw& draw) {
  Problem<D> problem;
  do
    for (auto& b : problem.basis) b = drawn<D>(draw, 3);
  while (determinant_of(problem.basis) == 0);
  problem.offset = drawn<D>(draw, 4);
  do problem.v = drawn<D>(draw, draw.one_in(3) ? 1 : 4);
  while (product(problem.v, problem.v) == 0);
  if (draw.one_in(6)) {  // at right angles, and the flight along one of the vectors
    problem.basis = {};
    for (std::size_t i = 0; i < D; ++i) problem.basis[i][i] = 1 + static_cast<long>(draw.below(3));
    problem.v = problem.basis[draw.below(D)];
  }
  const long v2 = product(problem.v, problem.v);
  problem.reach2 = draw.one_in(2) ? static_cast<long>(draw.below((D == 2 ? 150 : 40) * v2))
                                  : across2(problem, problem.point(drawn<D>(draw, 1)));
  const long length = static_cast<long>(draw.below(D == 2 ? 40 : 6)) * (draw.one_in(4) ? 1 : v2);
  problem.low = static_cast<long>(draw.below(20)) - 10 - length / 3;
  problem.high = problem.low + length;
  return problem;
}

// The coordinates n of a point, if it is one of the lattice: Cramer's rule.
template <std::size_t D>
std::optional<Ints<D>> coordinates(const Problem<D>& problem, const Ints<D>& p) {
  const long det = determinant_of(problem.basis);
  Ints<D> n, q;
  for (std::size_t i = 0; i < D; ++i) q[i] = p[i] - problem.offset[i];
  for (std::size_t i = 0; i < D; ++i) {
    auto rows = problem.basis;
    rows[i] = q;
    const long numerator = determinant_of(rows);
    if (numerator % det != 0) return std::nullopt;
    n[i] = numerator / det;
  }
  return n;
}

// All centres of the stretch, from a box that holds it: n and s.
template <std::size_t D>
std::map<Ints<D>, long> brute_force(const Problem<D>& problem) {
  const long v2 = product(problem.v, problem.v);
  const long farthest2 =
      (std::max(problem.low * problem.low, problem.high * problem.high) + problem.reach2) / v2;
  const long side = static_cast<long>(std::sqrt(static_cast<double>(farthest2))) + 2;
  std::map<Ints<D>, long> found;
  Ints<D> p;
  const std::function<void(std::size_t)> walk = [&](std::size_t i) {
    if (i < D) {
      for (p[i] = -side; p[i] <= side; ++p[i]) walk(i + 1);
      return;
    }
    const long s = product(problem.v, p);
    if (s < problem.low || s > problem.high || across2(problem, p) >= problem.reach2) return;
    if (const auto n = coordinates(problem, p)) found[*n] = s;
  };
  walk(0);
  return found;
}

// The n of those with low <= s <= high.
template <std::size_t D>
std::set<Ints<D>> between(const std::map<Ints<D>, long>& all, const Z& low, const Z& high) {
  std::set<Ints<D>> some;
  for (const auto& [n, s] : all)
    if (low <= s && s <= high) some.insert(n);
  return some;
}

template <std::size_t D>
ZVec<D> big(const Ints<D>& a) {
  ZVec<D> result;
  for (std::size_t i = 0; i < D; ++i) result[i] = a[i];
  return result;
}

template <std::size_t D>
View<D> view_of(const Problem<D>& problem) {
  View<D> view;
  view.velocity = {big<D>(problem.v), product(problem.v, problem.v)};
  for (std::size_t i = 0; i < D; ++i) {
    view.basis[i].p = big<D>(problem.basis[i]);
    for (std::size_t k = 0; k < D; ++k) view.basis[i].n[k] = i == k ? 1 : 0;
  }
  view.offset.p = big<D>(problem.offset);
  return view;
}

// Any basis of the same lattice: some steps from the given one.
template <std::size_t D>
Basis<D> some_basis(Draw& draw, Basis<D> basis) {
  for (std::uint64_t steps = draw.below(5); steps > 0; --steps) {
    const std::size_t i = draw.below(D), k = draw.below(D);
    if (i != k) basis[i].add_multiple(static_cast<long>(draw.below(5)) - 2, basis[k]);
    std::swap(basis[draw.below(D)], basis[draw.below(D)]);
    if (draw.one_in(2)) basis[i].negate();
  }
  return basis;
}

// Is v normal to the planes of the first two vectors?
bool is_head_on(const ExactVelocity<2>&, const Basis<2>&) {
  return false;
}
bool is_head_on(const ExactVelocity<3>& velocity, const Basis<3>& basis) {
  return dot(velocity.v, basis[0].p) == 0 && dot(velocity.v, basis[1].p) == 0;
}

// Visits a stretch; each centre once, and where it says that it is.
template <std::size_t D>
std::set<Ints<D>> visited(const Problem<D>& problem, const Stretches<D>& stretches,
                          const RowStretch<D>& stretch) {
  std::set<Ints<D>> found;
  const bool stopped =
      stretches.visit(stretch, [&](const LatticePoint<D>& first, const LatticePoint<D>& step, const Z& last) {
        REQUIRE(last >= 0);
        LatticePoint<D> point = first;
        for (Z k = 0; k <= last; ++k, point.add_multiple(1, step)) {
          Ints<D> n;
          for (std::size_t i = 0; i < D; ++i) n[i] = point.n[i].get_si();
          REQUIRE(found.insert(n).second);
          REQUIRE(point.p == big<D>(problem.point(n)));
        }
        return false;
      });
  REQUIRE_FALSE(stopped);
  return found;
}

template <std::size_t D>
std::string text(const Problem<D>& problem) {
  std::ostringstream out;
  for (const auto& row : problem.basis)
    for (const long component : row) out << component << ' ';
  out << "offset";
  for (const long component : problem.offset) out << ' ' << component;
  out << " v";
  for (const long component : problem.v) out << ' ' << component;
  out << " reach2 " << problem.reach2 << ", " << problem.low << " to " << problem.high;
  return out.str();
}

// How many of the problems had something in them, and several stretches.
struct Met {
  int centres = 0, cuts = 0, head_on = 0;
};

template <std::size_t D>
Met hold(std::uint64_t seed, int cases) {
  Draw draw(seed);
  Met met;
  for (int i = 0; i < cases; ++i) {
    const Problem<D> problem = drawn_problem<D>(draw);
    const View<D> view = view_of(problem);
    const Stretches<D> stretches(view, problem.reach2);
    INFO("seed " << seed << ", case " << i << ": " << text(problem));
    const auto found = brute_force(problem);
    const auto all = between<D>(found, problem.low, problem.high);
    met.centres += !all.empty();
    const Basis<D> basis = some_basis(draw, view.basis);
    met.head_on += is_head_on(view.velocity, basis);
    REQUIRE((visited<D>(problem, stretches, {problem.low, problem.high, basis}) == all));
    // Cut up, the stretches follow each other without gaps, and their centres are the same.
    Z end = problem.low;
    std::set<Ints<D>> together;
    int pieces = 0;
    const bool stopped = stretches.cut(problem.low, problem.high, [&](const RowStretch<D>& stretch) {
      ++pieces;
      REQUIRE(stretch.low == end);
      REQUIRE(stretch.high >= stretch.low);
      end = stretch.high;
      REQUIRE(abs(determinant(stretch.basis)) == std::labs(determinant_of(problem.basis)));
      const auto part = visited<D>(problem, stretches, stretch);
      REQUIRE((part == between<D>(found, stretch.low, stretch.high)));
      together.insert(part.begin(), part.end());
      return false;
    });
    REQUIRE_FALSE(stopped);
    REQUIRE(end == problem.high);
    REQUIRE((together == all));
    met.cuts += pieces > 1;
  }
  return met;
}

}  // namespace

TEST_CASE("Stretches hold the centres that a box holds, 2D", "[oracle][stretches]") {
  const Met met = hold<2>(kSeed, 600);
  CHECK(met.centres > 400);  // 551 seen
  CHECK(met.cuts > 25);      // 33 seen
}

TEST_CASE("Stretches hold the centres that a box holds, 3D", "[oracle][stretches]") {
  const Met met = hold<3>(kSeed + 1, 300);
  CHECK(met.centres > 200);  // 258 seen
  CHECK(met.cuts > 30);      // 43 seen
  CHECK(met.head_on > 10);   // 20 seen
}

TEST_CASE("Stretches: a visitor that has enough ends the visit, and one of stretches the cuts",
          "[oracle][stretches]") {
  Draw draw(kSeed + 2);
  int stops = 0, cuts = 0;
  for (int i = 0; i < 60; ++i) {
    const Problem<3> problem = drawn_problem<3>(draw);
    const View<3> view = view_of(problem);
    const Stretches<3> stretches(view, problem.reach2);
    int visits = 0;
    const bool any = !brute_force(problem).empty();
    const auto once = [&](const LatticePoint<3>&, const LatticePoint<3>&, const Z&) { return ++visits > 0; };
    CHECK(stretches.visit({problem.low, problem.high, view.basis}, once) == any);
    CHECK(visits == any);
    stops += any;
    int seen = 0;
    CHECK(stretches.cut(problem.low, problem.high, [&](const RowStretch<3>&) { return ++seen > 0; }));
    CHECK(seen == 1);
    ++cuts;
  }
  CHECK(stops > 30);  // 54 seen
  CHECK(cuts == 60);
}

TEST_CASE("Stretches: of a long row the ends and the points nearest to the line are visited",
          "[oracle][stretches]") {
  const ExactVelocity<2> velocity{{Z(1), Z(0)}, Z(1)};
  const auto visits = [&](long x, long y, long dx, long dy, long last) {
    LatticePoint<2> first{{Z(x), Z(y)}, {Z(0), Z(0)}}, step{{Z(dx), Z(dy)}, {Z(1), Z(0)}};
    std::set<long> seen;
    visit_extremes<2>(velocity, first, step, last, [&](LatticePoint<2> point, long more) {
      for (; more >= 0; --more, point.add_multiple(1, step)) seen.insert(point.n[0].get_si());
    });
    return seen;
  };
  const auto range = [](long begin, long end) {
    std::set<long> all;
    for (; begin <= end; ++begin) all.insert(begin);
    return all;
  };
  CHECK(visits(0, 5, 1, 0, 0) == range(0, 0));
  CHECK(visits(0, -9, 1, 1, 63) == range(0, 63));
  // Nearest to the line, y = 0, at k = 500; at the beginning; beyond the end; everywhere.
  const auto expect = [&](std::initializer_list<std::set<long>> parts) {
    std::set<long> all;
    for (const auto& part : parts) all.insert(part.begin(), part.end());
    return all;
  };
  CHECK(visits(0, -500, 1, 1, 1000) == expect({range(0, 16), range(484, 516), range(984, 1000)}));
  CHECK(visits(0, 5, 1, 1, 1000) == expect({range(0, 16), range(984, 1000)}));
  CHECK(visits(0, -2000, 1, 1, 1000) == expect({range(0, 16), range(984, 1000)}));
  CHECK(visits(0, 5, 1, 0, 1000) == expect({range(0, 16), range(984, 1000)}));
}
