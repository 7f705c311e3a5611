// The same flights in other words: their exact answers are those of the plain ones, told in these words; and a row in
// which only an engine's fault can show. Seeds are fixed.
#include <catch2/catch.hpp>

#include <cmath>

#include <lorentz/geometry.hpp>
#include "judge/plan.hpp"
#include "report/files/scene_file.hpp"
#include "tests/support/support.hpp"

using namespace lorentz;
using namespace lorentz::test;
using namespace lorentz::judge;

namespace {

constexpr std::uint64_t kSeed = 20161115;
constexpr std::size_t kCount = 400;

std::vector<NamedPlace> places_for(const Claim& claim) {
  std::vector<NamedPlace> places;
  for (const char* name : {"square", "cubic", "ball"})
    places.push_back({name, place_for(read_scene(name, {}), claim)});
  return places;
}

std::vector<Question> all_of(Retelling how, const std::vector<NamedPlace>& places) {
  Outside outside = 0;
  const Source source = retold(places, how, kSeed, kCount, outside);
  std::vector<Question> all;
  while (auto question = source()) all.push_back(*question);
  CHECK(outside == 0);
  return all;
}

// The cell by which the start was moved; of a single obstacle the vector is the same.
std::array<std::int64_t, 3> moved_by(const Question& told, const Question& plain) {
  std::array<std::int64_t, 3> n{};
  for (std::size_t i = 0; i < 3; ++i) {
    const double difference = told.query.x[i] - plain.query.x[i];
    n[i] = static_cast<std::int64_t>(difference);
    REQUIRE(static_cast<double>(n[i]) == difference);
    REQUIRE(plain.query.x[i] + difference == told.query.x[i]);
  }
  return n;
}

void check_moved(const Question& told, const Question& plain, bool repeats) {
  const auto n = moved_by(told, plain);
  REQUIRE(told.exact.outcome == plain.exact.outcome);
  REQUIRE(told.exact.time == plain.exact.time);
  for (std::size_t i = 0; i < 3; ++i)
    REQUIRE(told.exact.obstacle.cell[i].int64() ==
            plain.exact.obstacle.cell[i].int64() + (repeats ? n[i] : 0));
}

void check_mirrored(const Question& told, const Question& plain) {
  REQUIRE(told.exact.outcome == plain.exact.outcome);
  REQUIRE(told.exact.time == plain.exact.time);
  for (std::size_t i = 0; i < 3; ++i) {
    REQUIRE(told.query.x[i] == -plain.query.x[i]);
    REQUIRE(told.query.v[i] == -plain.query.v[i]);
    REQUIRE(told.exact.obstacle.cell[i].int64() == -plain.exact.obstacle.cell[i].int64());
  }
}

void check_faster(const Question& told, const Question& plain) {
  REQUIRE(told.query.x == plain.query.x);
  REQUIRE(told.exact.outcome == plain.exact.outcome);
  REQUIRE(told.exact.obstacle == plain.exact.obstacle);
  if (!plain.exact.time) return;
  const double factor = *plain.exact.time / *told.exact.time;
  REQUIRE(std::exp2(std::round(std::log2(factor))) == factor);
  for (std::size_t i = 0; i < 3; ++i) REQUIRE(told.query.v[i] == factor * plain.query.v[i]);
}

void check_limited(const Question& told, const Question& plain) {
  REQUIRE((told.query.x == plain.query.x && told.query.v == plain.query.v));
  REQUIRE(told.exact.obstacle == plain.exact.obstacle);
  REQUIRE(told.has_limit());
  if (!plain.exact.time) return;
  REQUIRE(told.max_time >= *plain.exact.time / 4 * (1 - 1e-6));
  REQUIRE(told.max_time <= *plain.exact.time * 4);
}

}  // namespace

TEST_CASE("Exact answers to retold flights are those of the plain ones, retold", "[judge][questions]") {
  for (const NumberFormat format : {NumberFormat::binary64, NumberFormat::binary32}) {
    const auto places = places_for({.precision = format});
    const std::vector<Question> plain = all_of(Retelling::plain, places);
    REQUIRE(plain.size() > kCount * 9 / 10);
    std::size_t later = 0, far = 0;
    for (const Retelling how :
         {Retelling::moved, Retelling::mirrored, Retelling::faster, Retelling::limited}) {
      const std::vector<Question> told = all_of(how, places);
      REQUIRE(told.size() == plain.size());
      for (std::size_t i = 0; i < told.size(); ++i) {
        CAPTURE(row_words_of(how).name, i, plain[i].where);
        REQUIRE(told[i].place->has_numbers_for(told[i].query));
        const bool repeats = plain[i].where.find("ball") == std::string::npos;
        if (how == Retelling::moved)
          check_moved(told[i], plain[i], repeats), far += std::fabs(told[i].query.x[0]) > 1000;
        if (how == Retelling::mirrored) check_mirrored(told[i], plain[i]);
        if (how == Retelling::faster) check_faster(told[i], plain[i]);
        if (how == Retelling::limited) check_limited(told[i], plain[i]), later += question::is_later(told[i]);
      }
    }
    CHECK(later > kCount / 8);
    CHECK(far > 5);
  }
}

TEST_CASE("Where a flight is mirrored, so is the place of the discs", "[judge][questions]") {
  Scene scene = unit_scene(2, 0.2);
  scene.lattices[0].atoms[0].position = {0.25, 0.125, 0};
  const std::vector<NamedPlace> places{{"aside", place_for(scene, {})}};
  const auto plain = all_of(Retelling::plain, places), told = all_of(Retelling::mirrored, places);
  REQUIRE((plain.size() > kCount / 2 && told.size() == plain.size()));
  for (std::size_t i = 0; i < told.size(); ++i) {
    CAPTURE(i);
    check_mirrored(told[i], plain[i]);
    REQUIRE(plain[i].place->scene().lattices[0].atoms[0].position == scene.lattices[0].atoms[0].position);
  }
}

TEST_CASE("Retold flights stay in the claim's domain, and an engine without limits is asked none",
          "[judge][questions][claim]") {
  Claim claim;
  claim.domain.limits = false;
  claim.domain.speed = {0.25, 4};
  const auto places = places_for(claim);
  Outside outside = 0;
  CHECK_FALSE(retold(places, Retelling::limited, kSeed, 48, outside)());
  CHECK(outside > 40);
  outside = 0;
  std::size_t asked = 0;
  const Source faster = retold(places, Retelling::faster, kSeed, kCount, outside);
  for (; const auto question = faster(); ++asked) REQUIRE(claim.domain.has(question->query));
  CHECK(asked > kCount * 9 / 10);
}
