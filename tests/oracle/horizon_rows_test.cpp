// The directions that rows of obstacles close: against closed forms, drawn directions looked at one by one, the
// same row in other words, and the oracle, which must hit along them.
#include <lorentz/horizon.hpp>

#include <catch2/catch.hpp>

#include <cmath>
#include <limits>

#include <lorentz/errors.hpp>
#include <lorentz/oracle.hpp>
#include "tests/oracle/horizon_support.hpp"
#include "tests/support/support.hpp"

using namespace lorentz;
using namespace lorentz::test;
using oracle::ClosedArc;
using oracle::horizon_of;

namespace {

constexpr double kRow = std::numeric_limits<double>::infinity();
using Cotangents = std::vector<std::pair<double, double>>;

Scene row_with(const Vec& u, std::vector<Atom> atoms) {
  Scene scene = scene_with(2, {u}, std::move(atoms));
  scene.lattices[0].missing = 1;
  return scene;
}

std::vector<ClosedArc> arcs_of(const Scene& scene) {
  return horizon_of(scene).closed.value();
}

Cotangents closed_in(const Scene& scene) {
  Cotangents result;
  for (const ClosedArc& arc : arcs_of(scene)) result.push_back({arc.from.cotangent, arc.to.cotangent});
  return result;
}

// Numbers of few bits: roots that are not equal differ by far more than 113 bits of mantissa leave.
using Real128 = __float128;
constexpr Real128 kNothing = 1e-24;

Real128 root_of(Real128 a) {
  if (a == 0) return 0;
  Real128 root = std::sqrt(static_cast<double>(a));
  for (int i = 0; i < 3; ++i) root = (root + a / root) / 2;
  return root;
}

struct Span {
  Real128 centre, half;
};

// Along t u + u', u the first row's vector: N.x of the obstacle's centre, N = u - t u', and half its width.
Span span_of(const Scene& scene, const Atom& atom, double t) {
  const Vec& u = scene.lattices[0].vectors[0];
  const Real128 n[2] = {u[0] + static_cast<Real128>(t) * u[1], u[1] - static_cast<Real128>(t) * u[0]};
  const auto seen = [&](const Vec& a) { return n[0] * a[0] + n[1] * a[1]; };
  Real128 half2 = 0;
  for (const Vec& axis : atom.semiaxes) half2 += seen(axis) * seen(axis);
  if (atom.is_ball()) half2 = (n[0] * n[0] + n[1] * n[1]) * atom.radius * atom.radius;
  return {seen(atom.position), root_of(half2)};
}

struct Seen {
  Real128 width = 0;   // of the widest gap
  Real128 middle = 0;  // of it
  bool touching = false;
};

// The widest gap along one row, or several with the same vector.
Seen look_along(const Scene& scene, double t) {
  const Vec& u = scene.lattices[0].vectors[0];
  const Real128 period = static_cast<Real128>(u[0]) * u[0] + static_cast<Real128>(u[1]) * u[1];
  std::vector<Span> spans;
  for_each_atom(scene, [&](const Atom& atom) { spans.push_back(span_of(scene, atom, t)); });
  Seen seen;
  for (const Span& span : spans) {
    // The next obstacle that reaches beyond this one's end, if none that does covers the end.
    const Real128 end = span.centre + span.half;
    Real128 gap = period;
    for (const Span& other : spans) {
      const Real128 ahead = other.centre + other.half - end;
      const double turns = std::floor(static_cast<double>(ahead / period));
      for (double k = turns - 1; k <= turns + 1; ++k)
        if (const Real128 beyond = ahead - static_cast<Real128>(k) * period; beyond > kNothing)
          gap = std::min(gap, beyond - 2 * other.half);
    }
    seen.touching |= gap <= kNothing && gap >= -kNothing;
    if (gap > kNothing && gap > seen.width) seen.width = gap, seen.middle = end + gap / 2;
  }
  return seen;
}

bool is_listed(const Cotangents& arcs, double t) {
  return std::any_of(arcs.begin(), arcs.end(),
                     [t](const auto& arc) { return arc.first >= t && t >= arc.second; });
}

Scene drawn_row(Draw& draw, std::uint64_t most_atoms) {
  Vec u{};
  while (u == Vec{}) u = {short_number(draw, 1), short_number(draw, 1), 0};
  const bool grid = draw.one_in(4);  // where much touches, seen straight on
  if (grid) u = {1, 0, 0};
  Scene scene = row_with(u, std::vector<Atom>(1 + draw.below(most_atoms)));
  const double size = std::hypot(u[0], u[1]);
  for (Atom& atom : scene.lattices[0].atoms) {
    atom.position = {short_number(draw, 2), short_number(draw, 2), 0};
    const auto length = [&] {
      return std::ldexp(std::ceil(std::ldexp(size * draw.between(0.02, 0.4), 8)), -8);
    };
    if (grid)
      atom.radius = static_cast<double>(1 + draw.below(6)) / 16;
    else if (draw.one_in(2))
      atom.radius = length();
    else
      atom.semiaxes = {{length(), draw.sign() * length() / 4, 0}, {-length() / 4, length(), 0}};
  }
  return scene;
}

Atom shifted(Atom atom, const Vec& by) {
  for (int k = 0; k < 2; ++k) atom.position[k] += by[k];
  return atom;
}

// Each atom a row of its own, the last one with twice the vector and the other way.
Scene each_a_row(const Scene& scene) {
  const Vec& u = scene.lattices[0].vectors[0];
  Scene rows = scene;
  rows.lattices.clear();
  for (const Atom& atom : scene.lattices[0].atoms) rows.lattices.push_back({{u}, {atom}, 1});
  Lattice& last = rows.lattices.back();
  last = {{Vec{-2 * u[0], -2 * u[1], 0}}, {last.atoms[0], shifted(last.atoms[0], u)}, 1};
  return rows;
}

std::string text_of(const Scene& scene) {
  std::string line;
  append_scene_line(line, scene);
  return line;
}

// All ends, and points between neighbours, of drawn directions, and far out.
std::vector<double> directions_to_try(Draw& draw, const Cotangents& arcs) {
  std::vector<double> ends{-1e3, 0, 1e3}, tried;
  for (const auto& [from, to] : arcs)
    for (const double end : {from, to})
      if (std::isfinite(end)) ends.push_back(end);
  for (int i = 0; i < 60; ++i) ends.push_back(std::round(16 * std::tan(draw.between(-1.5, 1.5))) / 16);
  std::sort(ends.begin(), ends.end());
  for (std::size_t i = 1; i < ends.size(); ++i) {
    tried.push_back(ends[i]);
    tried.push_back((ends[i] + ends[i - 1]) / 2);
  }
  return tried;
}

}  // namespace

TEST_CASE("Horizon: a row of discs or ellipses is closed by its closed form", "[oracle][horizon]") {
  // |u| sin(angle) <= 2 r
  for (const double r : {0.25, 0.1, 1e-9, 0.4999}) {
    const auto arcs = arcs_of(row_with({1, 0}, {{{}, r, {}}}));
    REQUIRE(arcs.size() == 2);
    CHECK(arcs[0].from.angle == 0);
    CHECK(arcs[0].to.angle == Approx(std::asin(2 * r)).epsilon(1e-14));
    CHECK(arcs[1].from.angle == Approx(M_PI - std::asin(2 * r)).epsilon(1e-14));
    CHECK(arcs[1].to.angle == M_PI);
    CHECK(arcs[0].to.between == std::vector<ObstacleId>{{0, 0, {0}}, {0, 0, {1}}});
    CHECK(arcs[0].from.between.empty());
    CHECK(arcs[0].from.vector == Vec{1, 0});
    CHECK(arcs[1].to.vector == Vec{-1, 0});
  }
  CHECK(closed_in(row_with({5, 0}, {{{}, 1.5, {}}})) == Cotangents{{kRow, 4.0 / 3}, {-4.0 / 3, -kRow}});
  // Touching discs close all but their own direction; so do larger ones.
  for (const double r : {0.5, 0.75})
    CHECK(closed_in(row_with({0, 1}, {{{}, r, {}}})) == Cotangents{{kRow, -kRow}});
  CHECK(closed_in(row_with({0, 1}, {{{}, std::nextafter(0.5, 0), {}}})).size() == 2);
  // tan(angle)^2 <= 4 b^2 / (u^2 - 4 a^2)
  CHECK(closed_in(row_with({10, 0}, {{{}, 0, {{3, 0}, {0, 2}}}})) == Cotangents{{kRow, 2}, {-2, -kRow}});
  CHECK(closed_in(row_with({10, 0}, {{{}, 0, {{0, -2}, {3, 0}}}})) == Cotangents{{kRow, 2}, {-2, -kRow}});
  CHECK(closed_in(row_with({10, 0}, {{{}, 0, {{3, 1}, {4, 1}}}})) == Cotangents{{kRow, 7}, {0, -kRow}});
}

TEST_CASE("Horizon: rows of two discs are closed by their closed forms", "[oracle][horizon]") {
  // On one line: sin(angle) is at most the wider gap's closing, or one disc alone does it.
  Draw draw(91);
  for (int i = 0; i < 100; ++i) {
    const double a = draw.between(0.01, 0.3), b = draw.between(0.01, 0.3), c = draw.uniform();
    const double sine = std::min(1.0, std::max({2 * a, 2 * b, (a + b) / std::max(c, 1 - c)}));
    const auto arcs = arcs_of(row_with({1, 0}, {{{}, a, {}}, {{c, 0}, b, {}}}));
    if (sine == 1) {
      CHECK(arcs.size() == 1);
    } else {
      REQUIRE(arcs.size() == 2);
      CHECK(arcs[0].to.angle == Approx(std::asin(sine)).epsilon(1e-12));
      CHECK(arcs[1].from.angle == Approx(M_PI - std::asin(sine)).epsilon(1e-12));
    }
  }
  // Seen straight on the discs just touch, and seen aslant they leave a gap on one side.
  const auto arcs = arcs_of(row_with({1, 0}, {{{}, 0.3125, {}}, {{0.5, 0.25}, 0.1875, {}}}));
  REQUIRE(arcs.size() == 3);
  CHECK(arcs[1].from.cotangent == 0);
  CHECK(arcs[1].to.cotangent == 0);
  CHECK(arcs[1].from.vector == Vec{0, 1});
  CHECK(arcs[1].from.between == std::vector<ObstacleId>{{0, 0, {0}}, {0, 1, {-1}}});
  CHECK(arcs[1].to.between == std::vector<ObstacleId>{{0, 0, {0}}, {0, 1, {0}}});
}

TEST_CASE("Horizon: the closed directions of rows, by looking at drawn ones", "[oracle][horizon]") {
  INFO("seed 92");
  Draw draw(92);
  int closed = 0, open = 0, ends = 0, several = 0, touching = 0;
  for (int round = 0; round < 300; ++round) {
    const Scene scene = drawn_row(draw, 3);
    const Cotangents arcs = closed_in(scene);
    INFO(text_of(scene));
    several += arcs.size() > 2;
    REQUIRE(arcs.front().first == kRow);
    REQUIRE(arcs.back().second == -kRow);
    for (const double t : directions_to_try(draw, arcs)) {
      const Seen seen = look_along(scene, t);
      // Next to an end, but for its rounding.
      bool end = false;
      for (const auto& [from, to] : arcs)
        for (const double e : {from, to}) end |= std::isfinite(e) && std::fabs(t - e) <= 4e-16 * std::fabs(e);
      ends += end;
      touching += seen.width == 0 && seen.touching;
      if (end && !seen.touching) {
        CHECK(seen.width < 1e-12);
        continue;
      }
      INFO("cotangent " << t);
      CHECK(is_listed(arcs, t) == (seen.width == 0));
      ++(seen.width == 0 ? closed : open);
    }
  }
  INFO(closed << " closed, " << open << " open, " << ends << " ends, " << several << " rows of several arcs, "
              << touching << " touching");
  CHECK(closed > 10000);
  CHECK(open > 10000);
  CHECK(ends > 600);
  CHECK(several > 50);
  CHECK(touching > 10);
}

TEST_CASE("Horizon: an arc's ends are between obstacles that touch there", "[oracle][horizon]") {
  INFO("seed 93");
  Draw draw(93);
  int ends = 0;
  for (int round = 0; round < 200; ++round) {
    const Scene row = drawn_row(draw, 3), scene = draw.one_in(2) ? row : each_a_row(row);
    INFO(text_of(scene));
    for (const ClosedArc& arc : arcs_of(scene))
      for (const auto* end : {&arc.from, &arc.to}) {
        const double t = end->cotangent;
        REQUIRE(end->between.size() == (std::isfinite(t) ? 2 : 0));
        CHECK(end->angle == std::atan2(1, t));
        const Vec &u = scene.lattices[0].vectors[0], &v = end->vector;
        CHECK(std::atan2(u[0] * v[1] - u[1] * v[0], u[0] * v[0] + u[1] * v[1]) == Approx(end->angle));
        if (!std::isfinite(t)) continue;
        std::vector<Span> spans;
        for (const ObstacleId& id : end->between) {
          Atom atom = scene.lattices[id.lattice].atoms[id.atom];
          atom.position = centre_of(scene, id);
          spans.push_back(span_of(scene, atom, t));
        }
        const double apart = std::fabs(static_cast<double>(spans[1].centre - spans[0].centre));
        CHECK(apart == Approx(static_cast<double>(spans[0].half + spans[1].half)).epsilon(1e-13));
        ++ends;
      }
  }
  CHECK(ends > 500);
}

TEST_CASE("Horizon: the oracle hits along closed directions, and flies for ever in gaps",
          "[oracle][horizon]") {
  INFO("seed 94");
  Draw draw(94);
  int hits = 0, never = 0;
  for (int round = 0; round < 60; ++round) {
    const Scene scene = drawn_row(draw, 3);
    const Cotangents arcs = closed_in(scene);
    const oracle::Oracle oracle(scene);
    INFO(text_of(scene));
    const Vec& u = scene.lattices[0].vectors[0];
    for (int k = 0; k < 4; ++k) {
      const double t = short_number(draw, 3);
      const Seen seen = look_along(scene, t);
      const Vec v{t * u[0] - u[1], t * u[1] + u[0], 0};  // exact
      // The point with N.x = level that is nearest to the origin, and then back.
      const auto start = [&](double level) {
        const double n2 = v[0] * v[0] + v[1] * v[1];
        return Vec{v[1] * level / n2 - 1000 * v[0], -v[0] * level / n2 - 1000 * v[1], 0};
      };
      if (seen.width > 1e-8) {
        CHECK_FALSE(is_listed(arcs, t));
        CHECK(oracle.first_hit({start(static_cast<double>(seen.middle)), v, {}}).outcome == Outcome::never);
        ++never;
      } else if (seen.width == 0) {
        CHECK(is_listed(arcs, t));
        for (int flight = 0; flight < 200; ++flight, ++hits)
          REQUIRE(oracle.first_hit({start(draw.between(-5, 5)), v, {}}).outcome == Outcome::hit);
      }
    }
  }
  CHECK(hits > 10000);
  CHECK(never > 50);
}

TEST_CASE("Horizon: the same row in other words has the same closed directions", "[oracle][horizon]") {
  INFO("seed 95");
  Draw draw(95);
  for (int round = 0; round < 60; ++round) {
    const Scene scene = drawn_row(draw, 3);
    const Cotangents arcs = closed_in(scene);
    INFO(text_of(scene));
    const auto changed = [&](auto change) {
      Scene other = scene;
      change(other.lattices[0]);
      return closed_in(other);
    };
    const auto mapped = [&](auto map) {
      return changed([&](Lattice& row) {
        row.vectors[0] = map(row.vectors[0]);
        for (Atom& atom : row.atoms) {
          if (atom.is_ball()) atom.semiaxes = {{atom.radius, 0, 0}, {0, atom.radius, 0}};
          atom.position = map(atom.position);
          for (Vec& axis : atom.semiaxes) axis = map(axis);
        }
      });
    };
    const Vec u = scene.lattices[0].vectors[0], minus{-u[0], -u[1], 0}, twice{2 * u[0], 2 * u[1], 0};
    CHECK(changed([&](Lattice& row) { row.vectors[0] = minus; }) == arcs);
    CHECK(changed([&](Lattice& row) {
            const std::vector<Atom> once = row.atoms;
            for (const Atom& atom : once) row.atoms.push_back(shifted(atom, u));
            row.vectors[0] = twice;
          }) == arcs);
    CHECK(changed([&](Lattice& row) {
            row.atoms[0] = shifted(row.atoms[0], twice);
            std::reverse(row.atoms.begin(), row.atoms.end());
          }) == arcs);
    for (const int k : {-300, 40})
      CHECK(mapped([k](const Vec& a) { return Vec{std::ldexp(a[0], k), std::ldexp(a[1], k), 0}; }) == arcs);
    CHECK(mapped([](const Vec& a) { return Vec{3 * a[0] + 4 * a[1], -4 * a[0] + 3 * a[1], 0}; }) == arcs);
    // In a mirror from the other end.
    Cotangents mirrored;
    for (const auto& [from, to] : arcs) mirrored.insert(mirrored.begin(), {-to, -from});
    CHECK(mapped([](const Vec& a) { return Vec{a[1], a[0], 0}; }) == mirrored);

    // A ball beside rows shuts no gap.
    Scene rows = each_a_row(scene);
    rows.lattices.insert(rows.lattices.begin(), {{}, {{{0.25, 3}, 100, {}}}, 2});
    CHECK(closed_in(rows) == arcs);
  }
}

TEST_CASE("Horizon: rows in space close no direction", "[oracle][horizon]") {
  Scene scene = scene_with(3, {Vec{1, 0, 0}}, {{{}, 0.75, {}}});
  scene.lattices[0].missing = 2;
  scene.lattices.push_back(scene.lattices[0]);
  scene.lattices[1].vectors[0] = {0, 1, 0};
  scene.lattices.push_back({{}, {{{}, 5, {}}}, 3});
  const oracle::Horizon horizon = horizon_of(scene);
  CHECK(horizon.closed.value().empty());
  CHECK(horizon.is_infinite());
  CHECK_FALSE(horizon.is_finite());
  CHECK_FALSE(horizon_of(unit_scene(2, 0.1)).closed);
}

TEST_CASE("Horizon: which scenes of fewer directions are unsupported", "[oracle][horizon]") {
  const auto refused = [](const Scene& scene, const std::string& why, double min_width = 0) {
    CHECK_THROWS_WITH(horizon_of(scene, min_width), Catch::Contains(why));
    CHECK_THROWS_AS(horizon_of(scene, min_width), InputError);
  };
  Scene balls = unit_scene(2, 0.1);
  balls.lattices[0] = {{}, {{{}, 0.1, {}}}, 2};
  refused(balls, "unsupported for single obstacles");
  Scene layer = unit_scene(3, 0.1);
  layer.lattices[0].vectors[2] = {};
  layer.lattices[0].missing = 1;
  refused(layer, "unsupported for layers");
  Scene row = row_with({1, 0}, {{{}, 0.1, {}}}), mixed = row;
  mixed.lattices.push_back(unit_scene(2, 0.1).lattices[0]);
  refused(mixed, "unsupported for crystals among");
  refused(row, "min_width", 0.1);
  Scene crossed = row;
  crossed.lattices.push_back({{Vec{1, 0x1p-50}}, {{{}, 0.1, {}}}, 1});
  refused(crossed, "different directions");
  Scene long_period = row;
  long_period.lattices.push_back({{Vec{1 + 0x1p-40, 0}}, {{{}, 0.1, {}}}, 1});
  refused(long_period, "more than 20000 pairs");
  refused(row_with({1, 0}, {{{}, 1e-6, {}}, {{0.5, 1}, 1e-6, {}}}), "more than 20000 pairs");
  // One disc touches only its own translates, however small it is.
  CHECK(closed_in(row_with({1, 0}, {{{}, 1e-300, {}}})).size() == 2);
}
