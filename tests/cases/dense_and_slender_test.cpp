// The families dense-layers and slender reach what they claim, and what is held against what there.
#include <catch2/catch.hpp>

#include <algorithm>
#include <array>

#include <lorentz/certified.hpp>
#include <lorentz/geometry.hpp>
#include <lorentz/oracle.hpp>
#include <lorentz/walk.hpp>
#include "fuzz/families/family.hpp"
#include "tests/support/support.hpp"

using namespace lorentz;
using namespace lorentz::test;
using cases::Case;

namespace {

constexpr std::uint64_t kSeed = 7;

bool has(const Case& one, const char* tag) {
  return std::find(one.tags.begin(), one.tags.end(), tag) != one.tags.end();
}

template <class Check>
void each(const char* target, std::uint64_t count, const Check& check) {
  INFO("seed " << kSeed);
  for (std::uint64_t index = 0; index < count; ++index) {
    const Case one = cases::target_named(target)->make(kSeed, index);
    INFO(target << ' ' << index << '\n' << stream(one.scene, one.query));
    check(one);
  }
}

double largest_size(const Atom& atom) {
  double size = atom.radius;
  for (const Vec& axis : atom.semiaxes) size = std::max(size, length(axis));
  return size;
}

}  // namespace

TEST_CASE("dense-layers: a radius spans many spacings, and the oracle is walk and certified there",
          "[cases][dense_and_slender]") {
  std::array<int, 3> hits_of_atom{};
  int decided = 0, cases = 0, hits = 0;
  double densest = 0, sparsest = 1e9;
  each("dense-layers", 800, [&](const Case& one) {
    const Lattice& lattice = one.scene.lattices[0];
    double size = 0;
    for (const Atom& atom : lattice.atoms) size = std::max(size, largest_size(atom));
    const double spacings = size / length(lattice.vectors[0]);
    densest = std::max(densest, spacings), sparsest = std::min(sparsest, spacings);
    const Answer exact = oracle::Oracle(one.scene).first_hit(one.query);
    REQUIRE(same(oracle::Certified(one.scene).first_hit(one.query), exact));
    ++cases;
    const Answer walked = oracle::Walk(one.scene, 200).first_hit(one.query);
    if (walked.outcome == Outcome::undecided) return;
    ++decided;
    INFO("walk:   " << line(walked, 3) << "oracle: " << line(exact, 3));
    REQUIRE(same(exact, walked));
    hits += exact.outcome == Outcome::hit;
    if (exact.outcome == Outcome::hit && lattice.atoms.size() == 3) ++hits_of_atom[exact.obstacle.atom];
  });
  CHECK(sparsest > 4);
  CHECK(densest > 20);  // 24 seen
  CHECK(decided > 0.8 * cases);
  CHECK(hits > 0.6 * cases);
  // None is always above the others.
  for (const int atom : hits_of_atom) CHECK(atom > 60);  // 80 seen at least
}

TEST_CASE("slender: flights along the long axis of slender obstacles, and no answer is wrong",
          "[cases][dense_and_slender]") {
  int lengthwise = 0, own = 0, edge = 0, undecided = 0;
  double slenderest = 1;
  each("slender", 3000, [&](const Case& one) {
    const auto& axes = one.scene.lattices[0].atoms[0].semiaxes;
    const Vec &v = one.query.v, &a = axes[0];
    const double cosine = std::fabs(v[0] * a[0] + v[1] * a[1] + v[2] * a[2]) / length(v) / length(a);
    REQUIRE(cosine > 0.99);
    lengthwise += cosine > 1 - 1e-12;
    slenderest = std::max(slenderest, length(a) / length(axes[1]));
    const Answer exact = oracle::Oracle(one.scene).first_hit(one.query);
    StageTally tally;
    REQUIRE(same(oracle::Certified(one.scene).first_hit(one.query, {}, &tally), exact));
    undecided += static_cast<int>(tally.undecided);
    if (!has(one, "at-its-edge")) return;
    ++edge;
    own += exact.outcome == Outcome::hit && exact.obstacle.cell == Cell{};
  });
  CHECK(lengthwise > 1900);  // 2 381 seen
  CHECK(slenderest > 2700);  // 3 452 seen
  CHECK(own > edge / 8);     // the obstacle aimed at is met, and passed
  CHECK(own < edge * 7 / 8);
  // Half of the scenes, whose needles overlap, are beyond the fast engine.
  CHECK(undecided < 1500);  // 1 052 seen
}
