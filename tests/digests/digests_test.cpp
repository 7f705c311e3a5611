// The digests of seeded flights are those that the sources have: this build computes the same bits as others.
#include <catch2/catch.hpp>

#include "tests/digests/digests.hpp"

using namespace lorentz::digests;

TEST_CASE("The digests of seeded flights are the known ones", "[digests]") {
  const std::vector<Digest> found = digests(kKnownFlights), known = known_digests();
  REQUIRE(found.size() == 98);
  REQUIRE(found.size() == known.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    INFO(found[i].name);
    CHECK(found[i].name == known[i].name);
    CHECK(found[i].value == known[i].value);
  }
}

TEST_CASE("Digests are of the families that are asked for", "[digests]") {
  const std::vector<Digest> all = digests(2);
  std::vector<Digest> starts;
  for (const Digest& one : all)
    if (one.name.starts_with("starts ")) starts.push_back(one);
  CHECK(starts.size() == 5);
  CHECK(digests(2, "starts ") == starts);
  CHECK(digests(2, "no such family").empty());
}
