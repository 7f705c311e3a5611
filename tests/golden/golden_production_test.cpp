// Sets of records: the same text whatever the number of threads, and however often the work was killed.
#include <sys/wait.h>
#include <unistd.h>
#include <catch2/catch.hpp>

#include <csignal>
#include <set>

#include "report/runs/piece_store.hpp"
#include "src/exchange/json_piece.hpp"
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

std::set<std::string> names_in(const Folder& folder) {
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder.file(""))) names.insert(entry.path().filename());
  return names;
}

// As the command makes a file, of which the batches are kept in FILE.part.
golden::RecordCounts produce_file(const Order& order, const std::string& path,
                                  const golden::OnProgress& progress = {}) {
  std::string text;
  golden::RecordCounts counts;
  {
    runs::PieceStore kept(path + ".part", "golden make", golden::plan_of(order));
    counts = golden::produce(
        order, [&](std::string_view more) { text += more; }, progress, &kept);
  }
  std::ofstream(path, std::ios::binary) << text;
  fs::remove(path + ".part");
  return counts;
}

// In a process of its own that is killed where it reports its progress for the n-th time: the batch is kept then.
void killed(const Order& order, const std::string& path, int n) {
  const pid_t child = fork();
  if (child == 0) {
    produce_file(order, path, [&](std::uint64_t) {
      if (--n == 0) kill(getpid(), SIGKILL);
    });
    _exit(0);
  }
  int status = 0;
  REQUIRE(waitpid(child, &status, 0) == child);
  REQUIRE(WIFSIGNALED(status));
}

void require_made(const Folder& folder, const Order& order, const Production& whole) {
  const golden::RecordCounts counts = produce_file(order, folder.file("set"));
  CHECK((folder.read("set") == whole.text));
  CHECK(names_in(folder) == std::set<std::string>{"set"});
  CHECK(counts.records == whole.counts.records);
  CHECK(counts.walked == whole.counts.walked);
  CHECK(counts.hits == whole.counts.hits);
  CHECK(counts.insides == whole.counts.insides);
  CHECK(counts.nevers == whole.counts.nevers);
  CHECK(counts.errors == whole.counts.errors);
}

std::size_t times_in(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

// How many records a resumed production makes itself.
std::uint64_t records_made_anew(const Folder& folder, const Order& order) {
  std::uint64_t first = order.count;
  produce_file(order, folder.file("set"), [&](std::uint64_t done) { first = std::min(first, done); });
  return order.count - first;
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
      CHECK(counted == times_in(made.text, std::string("\"expect\":{\"outcome\":\"") + outcome + '"'));
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

TEST_CASE("Golden: a question that comes twice is left out, and another made in its place",
          "[golden][golden_production]") {
  // No set has one that does, so a batch is kept in which one of the second batch's came before.
  const Order order = order_of("ties", 100);
  const Production whole = produced(order);
  const Folder folder;
  killed(order, folder.file("set"), 1);
  std::string first;
  const auto store = [&] {
    return runs::PieceStore(folder.file("set.part"), "golden make", golden::plan_of(order));
  };
  store().each([&](const std::string& piece) { first = piece; });
  std::vector<std::uint64_t> counts;
  std::string made;
  json::read_piece(first, std::tie(counts, made));
  const std::string part = whole.text.substr(0, whole.text.find('\n') + 1) + made;
  REQUIRE(whole.text.starts_with(part));
  const std::string rest = whole.text.substr(part.size());
  const std::string scene = rest.substr(0, rest.find('\n') + 1);
  std::string record = rest.substr(rest.find("{\"id\"", 3000));
  record.resize(record.find('\n') + 1);
  REQUIRE(counts[0]++ == 32);
  made += scene + record;
  store().set(json::piece_of(std::tie(counts, made)));
  CHECK(produce_file(order, folder.file("set")).records == 100);
  const std::string text = folder.read("set");
  CHECK(text.starts_with(part + scene + record));
  CHECK(lines(text) - times_in(text, "{\"scene\"") == 101);
  CHECK(text.find(record, text.find(record) + 1) == std::string::npos);
  CHECK(text.find(scene, part.size() + scene.size()) == std::string::npos);  // the scene in force is known
  CHECK(whole.text.ends_with(text.substr(text.size() - 1000)));
}

TEST_CASE("Golden: a production killed at any moment is gone on with, and makes the same file",
          "[golden][golden_production]") {
  Draw draw(kSeed);
  // Many scenes; one scene for all.
  for (const Order& order : {order_of("ties", 200), order_of("bad-queries", 115)}) {
    const Production whole = produced(order);
    const Folder folder;
    for (int kills = 0; kills < 2; ++kills) {
      const int n = 1 + static_cast<int>(draw.below(2 - kills));
      INFO("seed " << kSeed << ", killed in batch " << n);
      killed(order, folder.file("set"), n);
      CHECK(names_in(folder).contains("set.part"));
      CHECK_FALSE(names_in(folder).contains("set"));
    }
    require_made(folder, {order.set, order.count, kSeed, 1 + draw.below(3)}, whole);
  }
}

TEST_CASE("Golden: what was made before the kill is not made again", "[golden][golden_production]") {
  const Order order = order_of("ties", 200);
  const Folder folder;
  killed(order, folder.file("set"), 4);
  CHECK(records_made_anew(folder, order) == 40);
  killed(order_of("ties", 100), folder.file("set"), 4);  // complete, but without its name
  require_made(folder, order_of("ties", 100), produced(order_of("ties", 100)));
}

TEST_CASE("Golden: a part of another order, or one that was changed, is refused, and stays",
          "[golden][golden_production]") {
  const Order order = order_of("ties", 100);
  const Folder folder;
  const std::string set = folder.file("set");
  for (const Order& other :
       {order_of("ties", 101), order_of("ties", 100, 1, kSeed + 1), order_of("crystals", 100)}) {
    killed(other, set, 2);
    CHECK_THROWS_WITH(produce_file(order, set),
                      Catch::StartsWith(set + ".part: is of another run: its header is "));
    CHECK(produce_file(other, set).records == other.count);
  }
  const auto refused = [&](const char* sql, const std::string& why) {
    killed(order, set, 2);
    runs::Connection(set + ".part", set + ".part", SQLITE_OPEN_READWRITE).run(sql);
    CHECK_THROWS_WITH(produce_file(order, set), Catch::Contains(set + ".part: " + why));
    CHECK(names_in(folder).contains("set.part"));
    fs::remove(set + ".part");
  };
  refused("UPDATE piece SET text = replace(text, '\\\"time\\\":1', '\\\"time\\\":2') WHERE number = 1",
          "piece 1 is damaged");
  refused("UPDATE piece SET text = '' WHERE number = 2", "piece 2 is damaged");
  refused("DELETE FROM piece WHERE number = 1", "piece 1 is damaged");
  // With the right checksum, too.
  killed(order, set, 2);
  runs::PieceStore(set + ".part", "golden make", golden::plan_of(order)).add({"what is this?"});
  CHECK_THROWS_WITH(produce_file(order, set),
                    Catch::Contains(set + ".part: piece 3 is not a piece of such a run"));
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

TEST_CASE("Golden: given questions are records once each, and a killed order goes on", "[golden]") {
  const Folder folder, elsewhere;
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
  killed(order, folder.file("set"), 3);
  require_made(folder, order, whole);
  // Another order of the same name does not go on there.
  killed(order, folder.file("set"), 2);
  given.questions[5].tags = {"two"};
  CHECK_THROWS_WITH(produce_file(order, folder.file("set")), Catch::Contains("is of another run"));
}
