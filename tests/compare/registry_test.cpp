// The table of answerers: it names every engine, and says what each is like.
#include "compare/registry.hpp"

#include <catch2/catch.hpp>

#include <lorentz/engine.hpp>

using namespace lorentz;
using namespace lorentz::compare;

namespace {

std::vector<std::string> names_with(bool Traits::*trait) {
  std::vector<std::string> names;
  for (const std::string& name : answerer_names())
    if (traits_of(name).*trait) names.push_back(name);
  return names;
}

using Names = std::vector<std::string>;

}  // namespace

TEST_CASE("The engines come first among the answerers, in their order", "[compare][registry]") {
  const Names all = answerer_names(), engines = engine_names();
  REQUIRE(all.size() >= engines.size());
  CHECK(Names(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(engines.size())) == engines);
}

TEST_CASE("Answerers are told apart by their traits, of another program nothing is known",
          "[compare][registry]") {
  CHECK(names_with(&Traits::is_exact) == Names{"certified", "certified-batch", "oracle", "walk"});
  CHECK(names_with(&Traits::knows_digits) == Names{"oracle"});
  CHECK(names_with(&Traits::leaves_undecided) == Names{"reduction", "batch"});
  CHECK(names_with(&Traits::uses_reduction) == Names{"reduction", "certified", "batch", "certified-batch"});
  CHECK(names_with(&Traits::in_bulk) == Names{"batch", "certified-batch"});
  const Traits other = traits_of("cmd:./reduction");
  CHECK_FALSE((other.is_exact || other.knows_digits || other.leaves_undecided || other.uses_reduction));
}

TEST_CASE("Whoever is in the table answers in a scene", "[compare][registry]") {
  const Scene scene = unit_scene(2, 0.25);
  for (const std::string& name : answerer_names()) {
    INFO(name);
    Answer answer;
    make_first_hit(name, scene)({{0.5, 0.5, 0}, {1, 1, 0}, {}}, {}, answer);
    CHECK(answer.outcome == Outcome::hit);
    CHECK(answer.obstacle.cell == Cell{1, 1, 0});
  }
}
