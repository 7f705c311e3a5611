// Stores that something changed: refused with file, line and remedy, or the result is the same to the byte.
#include <atomic>
#include <catch2/catch.hpp>
#include <iterator>

#include <lorentz/errors.hpp>
#include "question/cases/random.hpp"
#include "report/runs/lock_file.hpp"
#include "report/runs/piece_store.hpp"
#include "tests/support/command_line.hpp"

using namespace lorentz;
using namespace lorentz::test;

namespace {

constexpr std::uint64_t kSeed = 20261201;

// One change of the file's bytes: a bit, a byte, the end cut off.
std::string edited(const std::string& text, cases::Random& random) {
  std::string out = text;
  const auto at = [&](std::size_t size) { return static_cast<std::size_t>(random.below(size)); };
  switch (random.below(4)) {
    case 0:
      return out.substr(0, at(out.size()));
    case 1:
      out[at(out.size())] = static_cast<char>(random.below(256));
      return out;
    default:
      out[at(out.size())] ^= static_cast<char>(1 << random.below(8));
      return out;
  }
}

void change(const std::string& path, const char* sql) {
  runs::Connection(path, path, SQLITE_OPEN_READWRITE).run(sql);
}

const std::vector<std::string> kRuns{"flights --count 2e5 --radius 0.3 --json",
                                     "lyapunov --collisions 1e4 --radius 0.3",
                                     "diffusion --count 256 --time 3 --radius 0.3"};

std::string without_seconds(const std::string& out) {
  const std::size_t at = out.find(",\"seconds\":");
  return at == std::string::npos ? out : out.substr(0, at);
}

}  // namespace

TEST_CASE("A store with changed bytes is refused, or the result is the same", "[cli][store]") {
  INFO("seed " << kSeed);
  int refused = 0, same = 0;
  for (const std::string& run : kRuns) {
    const Folder folder;
    const std::string command = run + " --store " + folder.file("store");
    REQUIRE(folder.lorentz(command).status == 0);
    const std::string stored = folder.read("store"), whole = without_seconds(folder.lorentz(command).out);
    CHECK(folder.read("store").size() == stored.size());
    for (int i = 0; i < 60; ++i) {
      cases::Random random(kSeed, run, static_cast<std::uint64_t>(i));
      const std::string text = edited(stored, random);
      folder.write("store", text);
      const Run again = folder.lorentz(command);
      INFO(command << ", edit " << i << '\n' << again.err);
      if (again.status == 0) {
        ++same;
        CHECK(without_seconds(again.out) == whole);
      } else {
        ++refused;
        CHECK((again.status == 2 || again.status == 3));
        CHECK(again.out.empty());
        CHECK(contains(again.err, folder.file("store") + ": "));
        CHECK(folder.read("store") == text);
      }
    }
  }
  INFO(refused << " refused, " << same << " the same");
  CHECK(refused > 50);
  CHECK(same > 10);
}

TEST_CASE("A piece that was changed, left out or moved is seen, and which", "[cli][store]") {
  for (const std::string& run : kRuns) {
    const Folder folder;
    const std::string command = run + " --store " + folder.file("store");
    REQUIRE(folder.lorentz(command).status == 0);
    const std::string stored = folder.read("store");
    std::vector<std::pair<const char*, const char*>> changes{
        {"UPDATE piece SET text = replace(text, '1', '2') WHERE number = 1", "piece 1 is damaged"},
        {"UPDATE piece SET \"check\" = '0' WHERE number = 1", "piece 1 is damaged"},
        {"UPDATE piece SET text = 7 WHERE number = 1", "piece 1 is damaged"},
        {"UPDATE plan SET value = value || ' ' WHERE place = 4", "is of another run"},
        {"DELETE FROM plan WHERE place = 4", "is of another version"}};
    if (!run.starts_with("flights")) {
      changes.emplace_back("DELETE FROM piece WHERE number = 2", "piece 2 is damaged");
      changes.emplace_back(
          "UPDATE piece SET number = 0 WHERE number = 2; UPDATE piece SET number = 2 WHERE number = 1; "
          "UPDATE "
          "piece SET number = 1 WHERE number = 0",
          "piece 1 is damaged");
    }
    for (const auto& [sql, why] : changes) {
      folder.write("store", stored);
      change(folder.file("store"), sql);
      const std::string changed = folder.read("store");
      const Run again = folder.lorentz(command);
      INFO(command << '\n' << sql << '\n' << again.err);
      CHECK(again.status == 2);
      CHECK(again.out.empty());
      CHECK(contains(again.err, folder.file("store") + ": " + why));
      CHECK(contains(again.err, "; "));
      CHECK(folder.read("store") == changed);
    }
  }
}

TEST_CASE("Text that is not a piece of the run is refused, even with the right checksum", "[cli][store]") {
  for (const std::string& run : kRuns) {
    const Folder folder;
    const std::string command = run + " --store " + folder.file("store");
    REQUIRE(folder.lorentz(command).status == 0);
    runs::Plan plan;
    {
      const runs::Connection store(folder.file("store"), folder.file("store"), SQLITE_OPEN_READONLY);
      runs::Statement row(store, "SELECT name, value FROM plan WHERE place > 2 ORDER BY place");
      while (row.step()) {
        std::string name = row.text();
        plan.emplace_back(std::move(name), row.text());
      }
    }
    const std::string kind = run.substr(0, run.find(' '));
    const std::uint64_t before = runs::PieceStore(folder.file("store"), kind, plan).size();
    for (const char* text : {"{}", "", "no JSON", "{\"a\":1}"}) {
      runs::PieceStore(folder.file("store"), kind, plan).add({text});
      const Run again = folder.lorentz(command);
      INFO(command << '\n' << text << '\n' << again.err);
      CHECK(again.status == 2);
      CHECK(contains(again.err, folder.file("store") + ": piece " + std::to_string(before + 1) + ' '));
      CHECK(contains(again.err, runs::kRemedy));
      change(folder.file("store"), ("DELETE FROM piece WHERE number > " + std::to_string(before)).c_str());
    }
    CHECK(folder.lorentz(command).status == 0);
  }
}

TEST_CASE("A store is for one process at a time, by whatever name, and no longer than that lives",
          "[cli][store]") {
  const Folder folder;
  fs::create_symlink(folder.file("store"), folder.file("link"));
  for (const std::string run :
       {"flights --count 1e12 --radius 0.3", "lyapunov --collisions 1e12", "diffusion --count 1e10"}) {
    folder.run("rm -f " + folder.file("store"));
    const std::string lock = folder.file("store.lock"), store = " --store " + folder.file("store");
    const std::string script = folder.write(
        "two.sh", LORENTZ_PROGRAM " " + run + store + " &\nfirst=$!\n" + "until [ -e " + lock +
                      " ] && grep -q \":$(stat -c %i " + lock + ") \" /proc/locks; do sleep 0.02; done\n" +
                      LORENTZ_PROGRAM " " + run + " --store " + folder.file("link") +
                      "\nstatus=$?\nkill -9 $first\nwait $first\n[ -e " + lock + " ] && rm -f " +
                      folder.file("store") + " && " + LORENTZ_PROGRAM " flights --count 1e3" + store +
                      " >/dev/null && echo third && rm " + folder.file("store") + "\nexit $status\n");
    const Run two = folder.run("sh " + script);
    INFO(run << '\n' << two.out << two.err);
    CHECK(two.status == 3);
    CHECK(contains(two.err,
                   "link: another process is writing this store; wait for it, stop it, or name another"));
    CHECK(contains(two.out, "third"));
  }
}

TEST_CASE("What stands beside a store is not written over, and not removed", "[cli][store]") {
  const Folder folder;
  const std::string store = folder.file("run"), flights = "flights --count 1000 --store " + store;
  folder.write("run.lock", "my notes\n");
  const Run kept = folder.lorentz(flights);
  CHECK(kept.status == 3);
  CHECK(contains(kept.err, "run.lock: is there and is not a lock"));
  CHECK(folder.read("run.lock") == "my notes\n");
  std::filesystem::remove(folder.file("run.lock"));
  for (const char* end : {".lock", "-wal", "-shm", "-journal"})
    CHECK(folder.lorentz(flights + " --csv " + store + end).status == 2);
  CHECK(folder.lorentz(flights).status == 0);
}

TEST_CASE("Pieces are read back by the same plan, and what differs is said", "[cli][store]") {
  const Folder folder;
  const std::string path = folder.file("store");
  const runs::Plan plan{{"scene", "a \"square\""}, {"count", "12"}};
  const std::vector<std::string> pieces{R"({"a":1})", "two\nlines", ""};
  const auto read = [](const runs::PieceStore& store) {
    std::vector<std::string> all;
    store.each([&](const std::string& piece) { all.push_back(piece); });
    return all;
  };
  runs::PieceStore(path, "flights", plan).add(pieces);
  CHECK(read(runs::PieceStore(path, "flights", plan)) == pieces);
  CHECK(read(runs::PieceStore({}, "flights", plan)).empty());
  const auto refused = [&](const runs::Plan& other, const std::string& what, const char* kind = "flights") {
    CHECK_THROWS_WITH(
        runs::PieceStore(path, kind, other),
        path + ": " + what + "; give what it was begun with, name another file, or remove this one");
  };
  refused(plan, "is a store of `lorentz flights`", "bench");
  for (std::size_t i = 0; i < plan.size(); ++i) {
    runs::Plan other = plan;
    other[i].second = "0";
    const std::string was = i == 0 ? R"(a \"square\")" : plan[i].second;
    refused(other, "is of another run: its " + plan[i].first + " is \"" + was + "\", not \"0\"");
    other[i].first = "other";
    refused(other, "is of another version of this program");
    refused({plan.begin(), plan.begin() + static_cast<std::ptrdiff_t>(i)},
            "is of another version of this program");
  }
  runs::Plan longer = plan;
  longer.emplace_back("more", "1");
  refused(longer, "is of another version of this program");
  change(path, "DELETE FROM plan");
  CHECK_THROWS_WITH(runs::PieceStore(path, "flights", longer), Catch::Contains("piece 1 is damaged"));
  fs::remove(path);
  runs::PieceStore(path, "flights", plan).add(pieces);
  runs::PieceStore(path, "flights", plan).set("alone");
  CHECK(read(runs::PieceStore(path, "flights", plan)) == std::vector<std::string>{"alone"});
}

TEST_CASE("A file that is not a store is refused, and stays as it is", "[cli][store]") {
  const Folder folder;
  folder.write("notes", "my notes\n");
  change(folder.write("mine", ""), "CREATE TABLE mine (x)");
  for (const auto& [file, why] : {std::pair{"notes", "is not a store of lorentz, nor any database"},
                                  {"mine", "is a database, but no store of a run of lorentz"}}) {
    const std::string before = folder.read(file);
    const Run run = folder.lorentz("flights --count 1000 --store " + folder.file(file));
    INFO(run.err);
    CHECK(run.status == 3);
    CHECK(contains(run.err, std::string(file) + ": " + why));
    CHECK(folder.read(file) == before);
  }
}

namespace {

std::ptrdiff_t open_files() {
  return std::distance(fs::directory_iterator("/proc/self/fd"), fs::directory_iterator());
}

}  // namespace

TEST_CASE("A lock that is refused or given back leaves nothing open", "[cli][store]") {
  const Folder folder;
  const std::string store = folder.file("store"), notes = folder.file("notes");
  folder.write("notes.lock", "my notes\n");
  const std::ptrdiff_t before = open_files();
  for (int i = 0; i < 3; ++i) {
    CHECK_THROWS_WITH(runs::LockFile(notes, "busy"),
                      Catch::Contains("notes.lock: is there and is not a lock"));
    CHECK_THROWS_WITH(runs::LockFile(folder.file("no/store"), "busy"), Catch::Contains("No such file"));
    const runs::LockFile lock(store, "busy");
    CHECK_THROWS_WITH(runs::LockFile(store, "busy"), store + ": busy");
  }
  CHECK(open_files() == before);
  CHECK_FALSE(fs::exists(store + ".lock"));
}

TEST_CASE("A lock that another removes and makes anew in between is held by one at a time", "[cli][store]") {
  const Folder folder;
  const std::ptrdiff_t before = open_files();
  std::atomic<int> holders = 0, most = 0, held = 0;
  const auto work = [&] {
    for (int i = 0; i < 8000; ++i) {
      try {
        const runs::LockFile lock(folder.file("store"), "busy");
        most = std::max(most.load(), ++holders);
        ++held;
        std::this_thread::yield();
        --holders;
      } catch (const FileError&) {
      }
    }
  };
  std::vector<std::thread> threads;
  for (int i = 0; i < 3; ++i) threads.emplace_back(work);
  for (std::thread& thread : threads) thread.join();
  CHECK(held > 0);
  CHECK(most == 1);
  CHECK(open_files() == before);
}
