// Starts in no obstacle: exactly, of every kind, and as hard as they are said to be. Seeds are fixed.
#include <catch2/catch.hpp>

#include <cmath>
#include <map>

#include <lorentz/errors.hpp>
#include <lorentz/geometry.hpp>
#include <lorentz/margin.hpp>
#include <lorentz/oracle.hpp>
#include "question/starts/candidates.hpp"
#include "question/starts/free_starts.hpp"
#include "src/problem/scene_geometry.hpp"
#include "tests/support/support.hpp"

using namespace lorentz;
using namespace lorentz::starts;
using namespace lorentz::test;

namespace {

constexpr std::uint64_t kSeed = 20161115;
constexpr Kind kKinds[] = {Kind::uniform, Kind::surface, Kind::near_rational, Kind::grazing};

double sine(const Vec& a, const Vec& b) {
  return length(cross(a, b)) / length(a) / length(b);
}

}  // namespace

TEST_CASE("Sampled starts lie in no obstacle, among overlapping ones, too", "[flights][sample]") {
  const auto scenes = all_scenes();
  for (const char* name :
       {"square", "triangular", "ellipses-mixed", "overlapping", "overlapping-3d", "ellipsoids-mixed",
        "superposition-pi-7", "two-balls", "grating", "film", "impurity"}) {
    const Scene& scene = scenes.at(name);
    const oracle::Oracle oracle(scene);
    for (const Kind kind : kKinds) {
      CAPTURE(name, kind_names()[static_cast<std::size_t>(kind)]);
      const FreeStarts starts(scene, kind, kSeed);
      Query start;
      for (std::uint64_t i = 0; i < 200; ++i) {
        starts.draw(i, start);
        REQUIRE_FALSE(flaw_of(start, scene));
        REQUIRE(start.from.has_value() == (kind == Kind::surface));
        REQUIRE(oracle.first_hit(start).outcome != Outcome::inside);
      }
    }
  }
}

TEST_CASE("Starts in binary32 are free, and as hard in its ulps as others in theirs",
          "[flights][starts][claim]") {
  std::map<std::pair<Kind, NumberFormat>, int> hard;
  for (const char* name : {"square", "cubic", "triangular", "ellipsoid", "two-balls", "layer"})
    for (const NumberFormat format : {NumberFormat::binary64, NumberFormat::binary32}) {
      const Scene scene = rounded(all_scenes().at(name), format);
      const oracle::Oracle oracle(scene);
      const oracle::Margins margins(scene, format);
      for (const Kind kind : kKinds) {
        CAPTURE(name, kind_names()[static_cast<std::size_t>(kind)]);
        const FreeStarts starts(scene, kind, kSeed, format);
        for (std::uint64_t i = 0; i < 60; ++i) {
          const Query start = starts[i];
          REQUIRE_FALSE(flaw_of(start, scene));
          REQUIRE(consists_of(start, format));
          const Answer exact = oracle.first_hit(start);
          REQUIRE(exact.outcome != Outcome::inside);
          const auto decision = margins.hardest_decision(start, exact);
          hard[{kind, format}] += decision && decision->margin < 16;
        }
      }
    }
  for (const Kind kind : {Kind::near_rational, Kind::grazing}) {
    const int in_double = hard[{kind, NumberFormat::binary64}],
              in_single = hard[{kind, NumberFormat::binary32}];
    CAPTURE(kind_names()[static_cast<std::size_t>(kind)], in_double, in_single);
    CHECK(in_double > 20);
    CHECK(in_single > in_double * 3 / 4);
  }
}

TEST_CASE("Half of the near-rational directions in binary32 are within 3 of its ulps of integers",
          "[flights][starts][claim]") {
  const FreeStarts starts(unit_scene(3, 0.1), Kind::near_rational, kSeed, NumberFormat::binary32);
  int near = 0, exact = 0;
  for (std::uint64_t i = 0; i < 400; ++i) {
    double most = 0;  // of the components, in ulps
    for (const double component : starts[i].v)
      most = std::max(most,
                      std::fabs(component - std::round(component)) / ulp(component, NumberFormat::binary32));
    near += most <= 6, exact += most == 0;  // below a power of two an ulp is half of what it is above
  }
  CAPTURE(near, exact);
  CHECK((near > 160 && near < 300));
  CHECK(exact < near / 2);
}

TEST_CASE("A start that rounding puts into an obstacle is drawn again", "[flights][starts][claim]") {
  // The unit lattice in a basis in which starts lie so far out that binary32 has every other integer there.
  Scene scene = unit_scene(2, 0.25);
  scene.lattices[0].vectors = {Vec{1, 0, 0}, Vec{0x1p25, 1, 0}};
  const oracle::Oracle oracle(scene);
  const FreeStarts starts(scene, Kind::uniform, kSeed, NumberFormat::binary32);
  for (std::uint64_t i = 0; i < 200; ++i) {
    const Query start = starts[i];
    CHECK(consists_of(start, NumberFormat::binary32));
    CHECK(oracle.first_hit(start).outcome != Outcome::inside);
  }
}

TEST_CASE("Grazing starts are found in any unit", "[flights][starts]") {
  for (const int exponent : {-900, -530, 0, 530, 900}) {
    const Scene scene = scaled(unit_scene(2, 0.1), exponent);
    const FreeStarts starts(scene, Kind::grazing, kSeed);
    const Query start = starts[3];
    CHECK(std::isfinite(start.x[0]));
    CHECK(std::ldexp(start.x[0], -exponent) < 1e3);
  }
}

TEST_CASE("Grazing starts are found where most of space is empty", "[flights][starts]") {
  for (const char* name : {"ball", "two-balls", "row", "layer"}) {
    Scene scene = all_scenes().at(name);
    for_each_atom(scene, [](Atom& atom) { atom.radius = 1e-6; });
    const oracle::Margins margins(scene);
    const oracle::Oracle oracle(scene);
    const FreeStarts starts(scene, Kind::grazing, kSeed);
    std::size_t hits = 0;
    for (std::uint64_t i = 0; i < 100; ++i) {
      const Query start = starts[i];
      const Answer answer = oracle.first_hit(start);
      if (answer.outcome != Outcome::hit) continue;
      ++hits;
      CHECK(std::fabs(margins.approach(start, answer.obstacle).gap) < 0x1p-9);
    }
    INFO(name);
    CHECK(hits > 30);  // the others pass
  }
}

TEST_CASE("Sampled starts are the first free candidates", "[flights][sample]") {
  const Scene scene = all_scenes().at("overlapping");
  const oracle::Oracle oracle(scene);
  for (const auto& [kind, ensemble] :
       {std::pair{Kind::uniform, Ensemble::uniform}, std::pair{Kind::surface, Ensemble::surface}}) {
    const FreeStarts starts(scene, kind, kSeed);
    const Candidates candidates(scene, ensemble, kSeed);
    std::uint64_t rejected = 0;
    Query start, candidate;
    for (std::uint64_t i = 0; i < 500; ++i) {
      starts.draw(i, start);
      std::uint64_t attempt = 0;
      for (;; ++attempt) {
        candidates.draw(i, attempt, candidate);
        if (oracle.first_hit(candidate).outcome != Outcome::inside) break;
      }
      rejected += attempt;
      REQUIRE(start.x == candidate.x);
      REQUIRE(start.v == candidate.v);
      REQUIRE(start.from == candidate.from);
    }
    CHECK(rejected > 50);  // 90 seen at least
  }
}

TEST_CASE("Near-rational directions are within 2^-36 of a small lattice vector's", "[flights][sample]") {
  const Scene scene = all_scenes().at("oblique");
  const FreeStarts starts(scene, Kind::near_rational, kSeed);
  int exact = 0;
  Query start;
  for (std::uint64_t i = 0; i < 500; ++i) {
    starts.draw(i, start);
    double least = 1;
    for (int a = -9; a <= 9; ++a)
      for (int b = 0; b <= 9; ++b) {
        const auto& u = scene.lattices[0].vectors;
        if (a != 0 || b != 0) least = std::min(least, sine(sum(scaled(u[0], a), scaled(u[1], b)), start.v));
      }
    REQUIRE(least < 0x1p-36);
    exact += least == 0;
  }
  CHECK(exact < 250);
}

TEST_CASE("Grazing lines pass or meet an obstacle within 2^-9 of its size", "[flights][sample]") {
  const Scene scene = all_scenes().at("triangular");  // of finite horizon: what is met is near
  const auto& [u1, u2, none] = scene.lattices[0].vectors;
  const double radius = scene.lattices[0].atoms[0].radius;
  const FreeStarts starts(scene, Kind::grazing, kSeed);
  Query start;
  int met = 0;
  for (std::uint64_t i = 0; i < 500; ++i) {
    starts.draw(i, start);
    double least = 1;
    for (int a = -9; a <= 9; ++a)
      for (int b = -9; b <= 9; ++b) {
        const Vec d = sum(sum(scaled(u1, a), scaled(u2, b)), scaled(start.x, -1));
        if (dot(d, start.v) < 0) continue;
        const double off = std::fabs(cross(d, start.v)[2]) / radius - 1;
        if (std::fabs(off) >= std::fabs(least)) continue;
        least = off;
      }
    REQUIRE(std::fabs(least) < 0x1p-9);
    met += least < 0;
  }
  CHECK(met > 200);
  CHECK(met < 300);
}

TEST_CASE("Where obstacles leave nothing free it is said, and soon", "[flights][sample]") {
  for (const Kind kind : kKinds) {
    Query start;
    CHECK_THROWS_WITH(FreeStarts(unit_scene(2, 0.9), kind, kSeed).draw(0, start),
                      Catch::Matchers::StartsWith("no free start in 100000 draws"));
  }
}
