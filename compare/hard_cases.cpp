#include "compare/hard_cases.hpp"

#include "cases/hard_moves.hpp"
#include "cases/random.hpp"

namespace lorentz::compare {

const char* name_of(Difficulty difficulty) {
  switch (difficulty) {
    case Difficulty::drawn:
      return "drawn";
    case Difficulty::near_rational:
      return "near-rational";
    case Difficulty::grazing:
      return "grazing";
  }
  return "";
}

std::vector<Query> hard_queries(Difficulty difficulty, const Scene& scene, const oracle::Oracle& oracle,
                                std::uint64_t seed, std::size_t count, const Listener& listener) {
  std::vector<Query> queries = draw_queries(scene, oracle, seed, count, listener);
  if (difficulty == Difficulty::drawn) return queries;
  for (std::size_t i = 0; i < queries.size(); ++i) {
    cases::Random random(seed, "hard queries", i);
    if (difficulty == Difficulty::near_rational) {
      queries[i].v = cases::near_integer_direction(random, scene.dimension);
      continue;
    }
    for (int tries = 0; tries < 100; ++tries) {
      Query moved = queries[i];
      if (!cases::move_to_edge(random, scene, oracle, moved)) continue;
      queries[i] = moved;
      break;
    }
  }
  return queries;
}

}  // namespace lorentz::compare
