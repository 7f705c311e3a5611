// The table of answerers: it names every engine, and says what each is like.
#include "question/engines.hpp"

#include <catch2/catch.hpp>

#include <lorentz/engine.hpp>
#include <lorentz/exchange.hpp>
#include "question/engines.hpp"
#include "src/exchange/nearest_name.hpp"

using namespace lorentz;
using namespace lorentz::question;

namespace {

std::vector<std::string> names_with(auto Traits::*trait) {
  std::vector<std::string> names;
  for (const EngineInfo& engine : own_engines())
    if (engine.traits.*trait) names.push_back(engine.name);
  return names;
}

using Names = std::vector<std::string>;

}  // namespace

TEST_CASE("The engines come first among the answerers, in their order", "[compare][engines]") {
  const Names all = own_names();
  REQUIRE(all.size() > 4);
  CHECK(Names(all.begin(), all.begin() + 4) == Names{"classical", "published", "golse", "reduction"});
}

TEST_CASE("Answerers are told apart by their traits, of another program nothing is known",
          "[compare][engines]") {
  CHECK(names_with(&Traits::is_exact) == Names{"certified", "certified-batch", "gpu", "oracle", "walk"});
  CHECK(names_with(&Traits::knows_digits) == Names{"oracle"});
  CHECK(names_with(&Traits::leaves_undecided) == Names{"reduction", "batch"});
  CHECK(names_with(&Traits::uses_reduction) ==
        Names{"reduction", "certified", "batch", "certified-batch", "gpu"});
  CHECK(names_with(&Traits::takes_limits) ==
        Names{"reduction", "certified", "batch", "certified-batch", "gpu", "oracle", "walk"});
  CHECK(names_with(&Traits::together) == Names{"batch", "certified-batch", "gpu"});
  const Traits other = engine_named("cmd:./reduction").traits;
  CHECK_FALSE((other.is_exact || other.knows_digits || other.leaves_undecided || other.uses_reduction));
}

TEST_CASE("Names of programs and libraries may hold commas, and are taken", "[compare][engines]") {
  CHECK_THROWS_WITH(engines_named({"lib:/nowhere/a,b.so"}),
                    Catch::StartsWith("lib:/nowhere/a,b.so: there is no such file"));
  CHECK(names_of(engines_named({"cmd:a,b", "classical,walk"})) == Names{"cmd:a,b", "classical", "walk"});
  for (const char* name : {"cmd:a", "lib:a.so", "walk"})
    CHECK_THROWS_AS(guest_engine(name, nullptr), InputError);
}

TEST_CASE("Every engine in the table answers in a scene", "[compare][engines]") {
  const Scene scene = unit_scene(2, 0.25);
  for (const EngineInfo& engine : own_engines()) {
    if (engine.traits.needs_card) continue;  // tests/gpu asks it
    INFO(engine.name);
    Reply reply;
    engine.in(scene).ask({{0.5, 0.5, 0}, {1, 1, 0}, ObstacleId{}}, {}, reply);
    CHECK(reply.answer.outcome == Outcome::hit);
    CHECK(reply.answer.obstacle.cell == Cell{1, 1, 0});
  }
}

TEST_CASE("Names come in lists, none of them empty, and a command is taken whole", "[compare][engines]") {
  const auto items = [](const std::string& list) {
    return items_of(list, "--engine", [](std::string_view rest) { return rest.starts_with("cmd:"); });
  };
  CHECK(items("oracle") == Names{"oracle"});
  CHECK(items("walk,batch") == Names{"walk", "batch"});
  CHECK(items("cmd:a,,b,") == Names{"cmd:a,,b,"});
  CHECK(items("oracle,cmd:a,b,") == Names{"oracle", "cmd:a,b,"});
  for (const char* bad : {"", ",", "oracle,", ",walk", "oracle,,walk", ",cmd:a"})
    CHECK_THROWS_WITH(items(bad), Catch::Contains("--engine: ") && Catch::Contains("empty"));
}

TEST_CASE("Columns: each row leaves its own obstacle, also one in a far cell of a skewed lattice",
          "[compare][columns]") {
  // (0, k) is k (2^70, 1) - k 2^70 (1, 0), whose number needs more than 64 bits.
  Scene scene = unit_scene(2, 0.25);
  scene.lattices[0].vectors[1] = {0x1p70, 1, 0};
  QueryRows rows;
  rows.count = 5;
  for (const double k : {1.0, 2.0, 3.0, 4.0, 5.0}) {
    rows.x[0].push_back(0.125), rows.x[1].push_back(k);
    rows.v[0].push_back(1), rows.v[1].push_back(0);
  }
  rows.large_from = {{1, {0, 0, {*Integer::from_decimal("-2361183241434822606848"), 2, 0}}},
                     {3, {0, 0, {*Integer::from_decimal("-4722366482869645213696"), 4, 0}}}};
  for (const char* name : {"certified", "certified-batch", "oracle"}) {
    INFO(name);
    AnswerRows answers;
    answers.resize(rows.count, 2);
    engine_named(name).in(scene).answer(rows, answers);
    for (std::size_t i = 0; i < 5; ++i) {
      INFO(i);
      CHECK(answers.outcome[i] == (i % 2 == 0 ? Outcome::inside : Outcome::hit));
    }
    CHECK(answers.time[3] == 0.625);
  }
  // A batch does not fly what leaves such a one: that row is asked alone, and has no stage.
  rows.x[0].assign(5, 0.5), rows.x[1].assign(5, 0);
  AnswerRows answers;
  answers.resize(rows.count, 2);
  engine_named("batch").in(unit_scene(2, 0.25)).answer(rows, answers);
  for (std::size_t i = 0; i < 5; ++i) {
    CHECK((answers.stage[i] == AnswerRows::kNoStage) == (i % 2 == 1));
    CHECK(answers.time[i] == 0.25);
  }
}

TEST_CASE("An engine that answers many at a time does so scene by scene, and soon", "[compare][engines]") {
  const std::vector<Scene> scenes{unit_scene(2, 0.25), unit_scene(3, 0.3), unit_scene(2, 0.1)};
  for (const bool detail : {false, true})
    for (const auto& [name, alone] : {std::pair{"batch", "reduction"}, {"certified-batch", "certified"}}) {
      AnswererOptions options;
      options.request.detail = detail;
      const auto together = engine_named(name).answerer(options),
                 single = engine_named(alone).answerer(options);
      std::vector<std::string> lines[2];
      int dimension = 2;
      together->on_reply(
          [&](Reply& reply) { append_answer_line(lines[0].emplace_back(), "1", reply.answer, dimension); });
      single->on_reply(
          [&](Reply& reply) { append_answer_line(lines[1].emplace_back(), "1", reply.answer, dimension); });
      for (const Scene& scene : scenes) {
        together->set_scene(scene), single->set_scene(scene);  // answers what was asked before
        CHECK(lines[0] == lines[1]);
        dimension = scene.dimension;
        for (int i = 0; i < 5; ++i) {
          const double in_space = dimension - 2;
          const Query query{{0.5, 0.5, 0.5 * in_space}, {1, 0.1 * i, 0.01 * i * in_space}, {}};
          together->ask("1", query), single->ask("1", query);
        }
      }
      together->drain();
      CHECK(lines[0] == lines[1]);
      CHECK(lines[0].size() == 15);
    }
  const auto together = engine_named("batch").answerer({});
  std::size_t answered = 0;
  together->on_reply([&](Reply&) { ++answered; });
  together->set_scene(scenes[0]);
  for (int i = 1; i < 8192; ++i) together->ask("1", {{0.5, 0.5, 0}, {1, 0, 0}, {}});
  CHECK(answered == 0);
  together->ask("1", {{0.5, 0.5, 0}, {1, 0, 0}, {}});
  CHECK(answered == 8192);
}
