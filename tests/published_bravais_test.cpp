// The published algorithm beyond the unit lattices: transformed, circumscribed, proposed, verified.
#include <catch2/catch.hpp>

#include "draw.hpp"
#include "oracle.hpp"
#include "published.hpp"
#include "support.hpp"
#include "verdict.hpp"

using namespace lorentz;
using namespace lorentz::test;

namespace {

constexpr double kForEver = std::numeric_limits<double>::infinity();

Scene scene_of_vectors(int dimension, std::array<Vec, 3> vectors, double radius) {
  Scene scene = unit_scene(dimension, radius);
  scene.lattices[0].vectors = vectors;
  return scene;
}

Scene triangular(double r) {
  return scene_of_vectors(2, {Vec{1, 0}, Vec{0.5, std::sqrt(0.75)}}, r);
}

Scene fcc(double r) {
  return scene_of_vectors(3, {Vec{0, 0.5, 0.5}, Vec{0.5, 0, 0.5}, Vec{0.5, 0.5, 0}}, r);
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
    const auto verdict = oracle::judge(exact, given).verdict;
    const bool agrees = verdict == oracle::Verdict::agree;
    count.right += agrees;
    count.wrong += verdict == oracle::Verdict::wrong;
    count.undecided += verdict == oracle::Verdict::undecided;
    if (agrees && exact.outcome == Outcome::hit)
      count.worst = std::max(count.worst, std::fabs(*given.time - *exact.time) / std::max(1.0, *exact.time));
  }
  return count;
}

Count drawn(const Scene& scene, std::uint64_t seed, std::size_t number) {
  return hold_against_oracle(scene, cli::draw_queries(scene, oracle::Oracle(scene), seed, number));
}

}  // namespace

TEST_CASE("probe", "[.]") {
  const auto show = [](const char* name, const Count& c) {
    WARN(name << ": right " << c.right << " wrong " << c.wrong << " undecided " << c.undecided << " worst "
              << c.worst << " made " << c.proposals.made << " ellipse " << c.proposals.false_ellipse
              << " tri " << c.proposals.false_tricylinder);
  };
  for (const double r : {0.3, 0.1, 0.01, 0.001}) {
    show("tri", drawn(triangular(r), 91, 10000));
    show("rect 2", drawn(scene_of_vectors(2, {Vec{1, 0}, Vec{0, 2}}, r), 91, 10000));
    show("shear 1", drawn(scene_of_vectors(2, {Vec{1, 0}, Vec{1, 1}}, 0.6 * r), 91, 10000));
    show("rect 8", drawn(scene_of_vectors(2, {Vec{1, 0}, Vec{0, 8}}, r), 91, 10000));
  }
  for (const double r : {0.1, 0.03}) {
    show("fcc", drawn(fcc(r), 91, 5000));
    show("rect 2", drawn(scene_of_vectors(3, {Vec{1, 0}, Vec{0, 2}, Vec{0, 0, 1.5}}, r), 91, 5000));
    show("cubic2", drawn(scene_of_vectors(3, {Vec{2, 0}, Vec{0, 2}, Vec{0, 0, 2}}, r), 91, 5000));
    show("cubic", drawn(scene_of_vectors(3, {Vec{1, 0}, Vec{0, 1}, Vec{0, 0, 1}}, r), 91, 5000));
  }
}
