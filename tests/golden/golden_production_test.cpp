// Sets of records: the same text whatever the number of threads, and however often the work was killed.
#include <sys/wait.h>
#include <unistd.h>
#include <catch2/catch.hpp>

#include <csignal>
#include <set>

#include "store/check.hpp"
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

// Makes the file in a process of its own that is killed where it reports its progress for the n-th time: the
// batch is written then, and noted.
void killed(const Order& order, const std::string& path, int n) {
  const pid_t child = fork();
  if (child == 0) {
    golden::produce_file(order, path, [&](std::uint64_t) {
      if (--n == 0) kill(getpid(), SIGKILL);
    });
    _exit(0);
  }
  int status = 0;
  REQUIRE(waitpid(child, &status, 0) == child);
  REQUIRE(WIFSIGNALED(status));
}

// What is there after a kill, whenever it came: between the write and the note a part that is longer than the
// note says; while the note was written, half of a new one.
enum class Moment { after_note, in_write, in_note };

void leave(const Folder& folder, Moment moment) {
  if (moment == Moment::after_note) return;
  std::ofstream(folder.file("set.part"), std::ios::app) << R"({"scene":{"dimension":2,"lattices":[]}})"
                                                           "\n"
                                                           R"({"id":"0123456789abcdef","tags":["x"],"x":[0)";
  if (moment == Moment::in_note) folder.write("set.part.note.new", "12345 6 7");
}

void require_made(const Folder& folder, const Order& order, const Production& whole) {
  const golden::RecordCounts counts = golden::produce_file(order, folder.file("set"), {});
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
  golden::produce_file(order, folder.file("set"), [&](std::uint64_t done) { first = std::min(first, done); });
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
      const golden::Question question = order.set->question(kSeed, index);
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
  // No set has one that does, so a part is made in which one of the second batch's came before.
  const Order order = order_of("ties", 100);
  const Production whole = produced(order);
  const Folder folder;
  killed(order, folder.file("set"), 1);
  std::string part = folder.read("set.part");
  const std::string rest = whole.text.substr(part.size());
  const std::string scene = rest.substr(0, rest.find('\n') + 1);
  std::string record = rest.substr(rest.find("{\"id\"", 3000));
  record.resize(record.find('\n') + 1);
  const std::string note = folder.read("set.part.note");
  const auto begin_of_note = [&] {
    return std::to_string(part.size()) + ' ' + std::to_string(store::check_of(part));
  };
  REQUIRE(note == begin_of_note() + " 1 32 " + between(note, " 1 32 ", "\n") + "\n");
  part += scene + record;
  folder.write("set.part", part);
  folder.write("set.part.note", begin_of_note() + " 1 33 " + between(note, " 1 32 ", "\n") + "\n");
  CHECK(golden::produce_file(order, folder.file("set"), {}).records == 100);
  const std::string text = folder.read("set");
  CHECK(text.starts_with(part));
  CHECK(lines(text) - times_in(text, "{\"scene\"") == 101);
  CHECK(text.find(record, text.find(record) + 1) == std::string::npos);
  CHECK(text.find(scene, part.size()) == std::string::npos);  // the scene in force is known
  CHECK(whole.text.ends_with(text.substr(text.size() - 1000)));
}

TEST_CASE("Golden: a production killed at any moment is gone on with, and makes the same file",
          "[golden][golden_production]") {
  Draw draw(kSeed);
  // Many scenes; one scene for all.
  for (const Order& order : {order_of("ties", 200), order_of("bad-queries", 115)}) {
    const Production whole = produced(order);
    for (const Moment moment : {Moment::after_note, Moment::in_write, Moment::in_note}) {
      const Folder folder;
      int batches = 0;
      for (int kills = 0; kills < 2; ++kills) {
        const int n = 1 + static_cast<int>(draw.below(2 - kills));
        INFO("seed " << kSeed << ", killed in batch " << n);
        killed(order, folder.file("set"), n);
        batches += n;
        leave(folder, moment);
        CHECK(names_in(folder).contains("set.part"));
        CHECK_FALSE(names_in(folder).contains("set"));
      }
      INFO(batches);
      require_made(folder, {order.set, order.count, kSeed, 1 + draw.below(3)}, whole);
    }
  }
}

TEST_CASE("Golden: what was made before the kill is not made again", "[golden][golden_production]") {
  const Order order = order_of("ties", 200);
  for (const Moment moment : {Moment::after_note, Moment::in_write, Moment::in_note}) {
    const Folder folder;
    killed(order, folder.file("set"), 4);
    leave(folder, moment);
    CHECK(records_made_anew(folder, order) == 40);
  }
}

TEST_CASE("Golden: killed before the first note, or after the last", "[golden][golden_production]") {
  const Order order = order_of("ties", 100);
  const Production whole = produced(order);
  const Folder folder;
  folder.write("set.part", whole.text.substr(0, 50));
  require_made(folder, order, whole);
  killed(order, folder.file("set"), 4);  // complete, but without its name
  CHECK((folder.read("set.part") == whole.text));
  require_made(folder, order, whole);
  killed(order, folder.file("set"), 4);
  fs::rename(folder.file("set.part"), folder.file("set"));  // named, and the note still there
  require_made(folder, order, whole);
}

TEST_CASE("Golden: a part of another order, or one that does not fit its note, is begun anew",
          "[golden][golden_production]") {
  const Order order = order_of("ties", 100);
  const Production whole = produced(order);
  const Folder folder;
  const auto begin_with = [&](const Order& other) { killed(other, folder.file("set"), 2); };
  for (const Order& other :
       {order_of("ties", 101), order_of("ties", 100, 1, kSeed + 1), order_of("crystals", 100)}) {
    begin_with(other);
    require_made(folder, order, whole);
  }
  const auto change = [&](const std::string& name, const std::function<std::string(std::string)>& to) {
    begin_with(order);
    folder.write(name, to(folder.read(name)));
    require_made(folder, order, whole);
  };
  change("set.part.note", [](const std::string& note) { return note.substr(0, note.size() - 5); });
  change("set.part.note", [](const std::string&) { return ""; });
  change("set.part.note", [](const std::string&) { return "garbage"; });
  change("set.part.note", [](const std::string& note) { return replaced(note, " 64 ", " 63 "); });
  change("set.part", [](const std::string& part) { return part.substr(0, part.size() - 1); });
  change("set.part", [](const std::string& part) { return replaced(part, "\"time\":1", "\"time\":2"); });
  change("set.part", [](const std::string& part) { return replaced(part, "{\"id\":\"", "{\"id\":\"zzzz"); });
  change("set.part", [](const std::string& part) { return part.substr(0, part.size() / 2); });
  change("set.part", [](const std::string&) { return ""; });
}

TEST_CASE("Golden: a file that is there is replaced, one that cannot be written is reported",
          "[golden][golden_production]") {
  const Order order = order_of("ties", 40);
  const Production whole = produced(order);
  const Folder folder;
  folder.write("set", "something else");
  require_made(folder, order, whole);
  folder.write("new", "made by the shell's rules");
  CHECK(fs::status(folder.file("set")).permissions() == fs::status(folder.file("new")).permissions());
  CHECK_THROWS_AS(golden::produce_file(order, folder.file("no/folder/set"), {}), FileError);
  fs::create_directory(folder.file("taken"));
  CHECK_THROWS_AS(golden::produce_file(order, folder.file("taken"), {}), FileError);
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
