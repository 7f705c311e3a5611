// Margins are promises about perturbed inputs, and are tested as such: by perturbing the inputs and asking
// the oracle.
#include <lorentz/margin.hpp>

#include <catch2/catch.hpp>

#include <lorentz/oracle.hpp>
#include "question/starts/free_starts.hpp"
#include "tests/support/support.hpp"

using namespace lorentz;
using namespace lorentz::test;
using oracle::kLargestMargin;

namespace {

double ulp(double value) {
  return std::nextafter(std::fabs(value), INFINITY) - std::fabs(value);
}

struct Problem {
  Scene scene;
  Query query;
};

// The problem with each input moved by `ulps` of its ulps, upwards or downwards by a bit of `corner`: radii,
// then the components of x and v.
Problem moved(Problem problem, double ulps, unsigned corner) {
  const auto move = [&](double& value, double unit) {
    value += (corner & 1 ? ulps : -ulps) * unit;
    corner >>= 1;
  };
  double size = 0;
  for (Lattice& lattice : problem.scene.lattices) {
    for (const Vec& u : lattice.vectors)
      for (const double component : u) size = std::max(size, std::fabs(component));
    for (Atom& atom : lattice.atoms) {
      if (atom.is_ball()) {
        move(atom.radius, ulp(atom.radius));
        continue;
      }
      const double factor = 1 + (corner & 1 ? ulps : -ulps) * 0x1p-52;
      corner >>= 1;
      for (Vec& axis : atom.semiaxes)
        for (double& component : axis) component *= factor;
    }
  }
  for (int i = 0; i < problem.scene.dimension; ++i) {
    move(problem.query.x[i], std::max(ulp(problem.query.x[i]), ulp(size)));
    if (problem.query.v[i] != 0) move(problem.query.v[i], ulp(problem.query.v[i]));
  }
  return problem;
}

Answer truth(const Problem& problem) {
  return oracle::Oracle(problem.scene).first_hit(problem.query);
}

unsigned inputs_of(const Problem& problem) {
  unsigned count = 2 * problem.scene.dimension;
  for (const Lattice& lattice : problem.scene.lattices) count += lattice.atoms.size();
  return count;
}

struct Tally {
  int cases = 0, small = 0, curved = 0, capped = 0, corners = 0;
  std::map<oracle::DecisionKind, int> by_kind;
};

// Margins below this are not tested here: inputs move by whole ulps, and of an ellipsoid each semiaxis is
// rounded.
double least_testable(const Problem& problem) {
  for (const Lattice& lattice : problem.scene.lattices)
    for (const Atom& atom : lattice.atoms)
      if (!atom.is_ball()) return 200;
  return 20;
}

// In space the distance of a line from a point is not a linear function of the line; a margin is one to
// first order. It promises nothing where inputs moved by that margin move the line by a good part of the
// radius.
bool is_curved(const Problem& problem, const Answer& exact, double margin) {
  const Vec& v = problem.query.v;
  const double moved = margin * 0x1p-51 * (1 + exact.time.value_or(0) * std::hypot(v[0], v[1], v[2]));
  double least = INFINITY;
  for_each_atom(problem.scene, [&](const Atom& atom) {
    if (atom.is_ball()) least = std::min(least, atom.radius);
  });
  return problem.scene.dimension == 3 && moved > 0.01 * std::min(least, 0.1);
}

void hold(Draw& draw, const Problem& problem, int corners, Tally& tally) {
  const Answer exact = truth(problem);
  const auto decision = oracle::Margins(problem.scene).hardest_decision(problem.query, exact);
  REQUIRE(decision.has_value() == (exact.outcome == Outcome::hit || exact.outcome == Outcome::inside));
  if (!decision) return;
  ++tally.cases;
  INFO(stream(problem.scene, problem.query)
       << line(exact, problem.scene.dimension) << "margin " << decision->margin << " by decision "
       << static_cast<int>(decision->kind) << " about cell " << decision->obstacle.cell[0].decimal() << ", "
       << decision->obstacle.cell[1].decimal());
  const double least = least_testable(problem), margin = decision->margin;
  if (margin < least) {
    ++tally.small;
    return;
  }
  if (is_curved(problem, exact, margin)) {
    ++tally.curved;
    return;
  }
  const unsigned all = 1u << inputs_of(problem);
  const double within = std::floor(margin * (1 - 0.5 / least));
  for (int i = 0; i < corners; ++i) {
    const auto corner = static_cast<unsigned>(draw.below(all));
    const Answer there = truth(moved(problem, within, corner));
    INFO("moved by " << within << " ulps, corner " << corner << ": " << line(there, problem.scene.dimension));
    REQUIRE(same_obstacle(there, exact));
    ++tally.corners;
  }
  if (margin >= kLargestMargin) {
    ++tally.capped;
    return;
  }
  ++tally.by_kind[decision->kind];
  bool changes = false;
  for (unsigned corner = 0; corner < all && !changes; ++corner)
    changes = !same_obstacle(truth(moved(problem, std::ceil(2 * margin), corner)), exact);
  INFO("no corner at twice the margin changes the answer");
  REQUIRE(changes);
}

// Drawn cases, and ones that graze.
Tally grazing_campaign(std::uint64_t seed, int dimension, int cases, int corners) {
  INFO("seed " << seed);
  Draw draw(seed);
  Tally tally;
  for (const double radius : {0.3, 0.1, 0.01, 1e-3}) {
    const Scene scene = unit_scene(dimension, radius);
    const oracle::Oracle oracle(scene);
    for (const auto kind : {starts::Kind::uniform, starts::Kind::grazing})
      for (const Query& query : starts::free_starts(scene, kind, seed, cases / 8))
        hold(draw, {scene, query}, corners, tally);
  }
  return tally;
}

// Motifs, superpositions, overlaps, starts beside surfaces.
Tally grid_campaign(std::uint64_t seed, int dimension, int cases, int corners, bool ellipsoids) {
  INFO("seed " << seed);
  Draw draw(seed);
  Tally tally;
  for (int i = 0; i < cases; ++i) {
    Scene scene = scene_of(draw, Style::near_grid, dimension);
    if (ellipsoids) scene = with_ellipsoids(draw, Style::near_grid, scene);
    hold(draw, {scene, query_of(draw, Style::near_grid, scene)}, corners, tally);
  }
  return tally;
}

void require_variety(const Tally& tally) {
  CHECK(tally.capped > tally.cases / 20);
  CHECK(tally.curved <
        tally.cases / 5);  // in space at r = 1e-3 margins reach that far in a third of all cases
  int decided = 0;
  for (const auto& [kind, count] : tally.by_kind) decided += count;
  CHECK(decided > tally.cases / 200);
}

}  // namespace

TEST_CASE("Inputs moved by less than the margin give the same answer, moved by twice it some give another",
          "[oracle][margin]") {
  require_variety(grazing_campaign(5001, 2, 1600, 6));
  require_variety(grid_campaign(5002, 2, 1500, 6, false));
  require_variety(grid_campaign(5003, 2, 500, 6, true));
  grazing_campaign(5004, 3, 300, 6);
  grid_campaign(5005, 3, 300, 6, false);
  grid_campaign(5006, 3, 100, 6, true);
}

TEST_CASE("Inputs moved by less than the margin, long", "[oracle][margin][long]") {
  require_variety(grazing_campaign(6001, 2, 40'000, 12));
  require_variety(grid_campaign(6002, 2, 30'000, 12, false));
  require_variety(grid_campaign(6003, 2, 10'000, 12, true));
  require_variety(grazing_campaign(6004, 3, 12'000, 12));
  require_variety(grid_campaign(6005, 3, 6'000, 12, false));
  require_variety(grid_campaign(6006, 3, 2'000, 12, true));
}
