// Sets of records: the same text whatever the number of threads.
#include <catch2/catch.hpp>

#include <set>

#include "tests/golden/golden_support.hpp"

using namespace lorentz;
using namespace lorentz::test;
using golden::Order;

namespace {

constexpr std::uint64_t kSeed = 7002;

Order order_of(const char* set, std::uint64_t count, std::uint64_t jobs = 1, std::uint64_t seed = kSeed) {
  return {golden::set_named(set), count, seed, jobs};
}

struct Production {
  std::string text;
  golden::RecordCounts counts;
};

Production produced(const Order& order) {
  Production made;
  made.counts = golden::produce(order, [&](std::string_view text) { made.text += text; }, {});
  return made;
}

}  // namespace

TEST_CASE("Golden: a set is the same whatever the number of threads, and no id comes twice",
          "[golden][golden_production]") {
  for (const char* name : {"crystals", "published-faults", "bad-queries"}) {
    INFO(name << ", seed " << kSeed);
    constexpr std::uint64_t count = 90;
    const Production one = produced(order_of(name, count));
    for (const std::uint64_t jobs : {2, 5}) {
      const Production other = produced(order_of(name, count, jobs));
      CHECK((one.text == other.text));
      CHECK(one.counts.walked == other.counts.walked);
    }
    const golden::RecordCounts& a = one.counts;
    CHECK(a.records == count);
    CHECK(a.hits + a.insides + a.nevers + a.errors == count);
    CHECK((a.errors == 0) == (name != std::string("bad-queries")));
    const Folder folder;
    golden::Reader reader(folder.write("set", one.text));
    CHECK(reader.header().count == count);
    CHECK(reader.header().name == name);
    CHECK(contains(reader.header().generator, std::string("golden make --set ") + name));
    std::set<std::string> ids;
    std::string scene;
    std::size_t scenes = 0;
    for (golden::ReadRecord read; reader.next(read); scene = reader.scene_line()) {
      ids.insert(read.record.id);
      // A scene's line stands only where the scene changes.
      if (reader.scene_number() != scenes) CHECK(scene != reader.scene_line());
      scenes = reader.scene_number();
    }
    CHECK(ids.size() == count);
  }
}

TEST_CASE("Golden: what was made is counted", "[golden][golden_production]") {
  for (const char* name : {"boundary-starts", "never", "bad-queries"}) {
    const Order order = order_of(name, 70);
    const Production made = produced(order);
    INFO(name << ", seed " << kSeed);
    const golden::RecordCounts& a = made.counts;
    CHECK(a.records == 70);
    const std::pair<const char*, std::uint64_t> outcomes[] = {
        {"hit", a.hits}, {"inside", a.insides}, {"never", a.nevers}, {"error", a.errors}};
    for (const auto& [outcome, counted] : outcomes)
      CHECK(counted == count_of(made.text, std::string("\"expect\":{\"outcome\":\"") + outcome + '"'));
    std::uint64_t walked = 0;
    for (std::uint64_t index = 0; index < 70; ++index) {
      const golden::SetQuestion question = order.set->question(kSeed, index);
      walked += golden::Maker(question.scene).make(question.text, question.query).walked;
    }
    CHECK(a.walked == walked);
  }
}

TEST_CASE("Golden: another seed makes other records, and a longer set begins like a shorter one",
          "[golden][golden_production]") {
  const auto records = [](const Order& order) {
    const std::string text = produced(order).text;
    return text.substr(text.find('\n') + 1);
  };
  const std::string some = records(order_of("crystals", 100)), more = records(order_of("crystals", 130));
  CHECK(more.starts_with(some));
  CHECK((records(order_of("crystals", 100, 1, kSeed + 1)) != some));
}

TEST_CASE("Golden: a question that comes again adds its tags to its own record",
          "[golden][golden_production]") {
  golden::GivenQuestions given{golden::Header{}};
  const auto add = [&](const char* text, const char* tag) {
    return given.add({unit_scene(2, 0.25), text, std::nullopt, {tag}});
  };
  CHECK(add("one", "a"));
  CHECK(add("two", "b"));
  CHECK_FALSE(add("two", "c"));
  CHECK_FALSE(add("two", "b"));
  REQUIRE(given.questions.size() == 2);
  CHECK(given.questions[0].tags == std::vector<std::string>{"a"});
  CHECK(given.questions[1].tags == std::vector<std::string>{"b", "c"});
}

TEST_CASE("Golden: an exception while writing ends the production", "[golden][golden_production]") {
  int writes = 0;
  CHECK_THROWS_AS(golden::produce(order_of("ties", 300, 3),
                                  [&](std::string_view) {
                                    if (++writes == 3) throw std::runtime_error("full");
                                  },
                                  {}),
                  std::runtime_error);
  CHECK(writes == 3);
}

TEST_CASE("Golden: given questions are records once each", "[golden]") {
  const Folder elsewhere;
  golden::GivenQuestions given(
      {.name = "given", .version = "0", .tags = {{"one", "a tag"}, {"two", "a tag"}}});
  given.look = true;
  const auto add = [&](const Scene& scene, const Query& query, const std::string& id, const char* tag) {
    given.add({scene, golden::question_of(query, scene), query, {tag}, id});
  };
  for (int i = 0; i < 150; ++i)
    add(unit_scene(i < 100 ? 2 : 3, 0.2), {{0.5, 0.3 + 1e-3 * i, 0}, {1, 0.25, 0}, {}}, std::to_string(i),
        "one");
  add(unit_scene(2, 0.2), {{0.5, 0.3, 0}, {1, 0.25, 0}, {}}, "150", "two");  // the first once more
  given.add({unit_scene(2, 0.2), "\"x\":[0,0],\"v\":[0,0]", {}, {"one"}, "\"bad\""});
  REQUIRE(given.questions.size() == 151);
  CHECK(given.questions[0].tags == std::vector<std::string>{"one", "two"});
  const Order order{.count = given.questions.size(), .given = &given};
  const Production whole = produced(order);
  CHECK((whole.counts.records == 151 && whole.counts.errors == 1));
  CHECK(contains(whole.text, "\"count\":151,"));
  CHECK(contains(whole.text, "\"tags\":[\"one\",\"invalid\"]"));
  CHECK(contains(whole.text, "\"source_id\":\"bad\""));
  CHECK(elsewhere.lorentz("golden verify " + elsewhere.write("whole", whole.text)).status == 0);
}

TEST_CASE("Golden: a question whose proof no checker goes through is left out, and counted once",
          "[golden][golden_production]") {
  // A layer of balls, each a thousand cells large: a million obstacles are near the ray.
  Scene layer = unit_scene(3, 1000);
  layer.lattices[0].rank = 2;
  layer.lattices[0].vectors[2] = {};
  golden::GivenQuestions given({.name = "given", .version = "0"});
  const auto add = [&](const Scene& scene, const Query& query) {
    given.add({scene, golden::question_of(query, scene), query, {}, ""});
  };
  // Three batches, and one such question in each of two: none of them may come again in another batch.
  const std::uint64_t all = 2 * cases::kCasesPerScene + 8;
  for (std::uint64_t i = 0; i < all; ++i) {
    if (i == 0 || i == cases::kCasesPerScene + 3)
      add(layer, {{0.5, 0.25, 2000 + static_cast<double>(i)}, {0.1, 0.3, -1}, {}});
    else
      add(unit_scene(2, 0.2), {{0.5, 0.3 + 1e-3 * static_cast<double>(i), 0}, {1, 0.25, 0}, {}});
  }
  const Production made = produced({.count = given.questions.size(), .given = &given});
  CHECK(made.counts.left_out == 2);
  CHECK(made.counts.records == all - 2);
  CHECK(contains(made.text, fmt::format("\"count\":{},", all - 2)));
  CHECK_FALSE(contains(made.text, scene_line(layer)));
}
