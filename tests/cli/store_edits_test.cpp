// Stores that something changed: refused with file, line and remedy, or the result is the same to the byte.
#include <atomic>
#include <catch2/catch.hpp>
#include <iterator>

#include <lorentz/errors.hpp>
#include "cases/random.hpp"
#include "store/check.hpp"
#include "store/lock_file.hpp"
#include "store/pieces.hpp"
#include "tests/support/command_line.hpp"

using namespace lorentz;
using namespace lorentz::test;

namespace {

constexpr std::uint64_t kSeed = 20261201;

std::vector<std::string> lines_of(const std::string& text) {
  std::istringstream in(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line + '\n');
  return lines;
}

// One change, of a byte, a digit, a piece of text, or a line.
std::string edited(const std::string& text, cases::Random& random) {
  std::string out = text;
  const auto at = [&](std::size_t size) { return static_cast<std::size_t>(random.below(size)); };
  std::vector<std::string> lines = lines_of(text);
  switch (random.below(8)) {
    case 0:  // a bit
      out[at(out.size())] ^= static_cast<char>(1 << random.below(8));
      return out;
    case 1:
      return out.erase(at(out.size()), 1 + random.below(3));
    case 2:
      return out.insert(at(out.size()), 1, "0123456789abcdef,:[]{}\"-. \n"[random.below(27)]);
    case 3:  // cut off
      return out.substr(0, at(out.size()));
    case 4: {  // a line twice
      const std::string line = lines[at(lines.size())];
      return out + line;
    }
    case 5: {  // a line less
      const std::size_t gone = at(lines.size());
      out.clear();
      for (std::size_t i = 0; i < lines.size(); ++i) out += i == gone ? "" : lines[i];
      return out;
    }
    default: {  // a digit
      std::vector<std::size_t> digits;
      for (std::size_t i = 0; i < out.size(); ++i)
        if (std::isxdigit(static_cast<unsigned char>(out[i]))) digits.push_back(i);
      char& digit = out[digits[at(digits.size())]];
      digit = digit == '7' ? '3' : '7';
      return out;
    }
  }
}

}  // namespace

TEST_CASE("A store that was changed is refused, or the result is the same", "[cli][store]") {
  INFO("seed " << kSeed);
  const std::vector<std::string> runs{
      "flights --count 2e5 --radius 0.3 --json", "lyapunov --collisions 1e4 --radius 0.3",
      "diffusion --count 256 --time 3 --radius 0.3",
      "bench --scene square --radius 0.3,0.2 -e reduction --count 40 --difficulty drawn --json"};
  int refused = 0, same = 0;
  for (const std::string& run : runs) {
    const Folder folder;
    const std::string command = run + " --store " + folder.file("store");
    const auto without_seconds = [](std::string out) {
      const std::size_t at = out.find(",\"seconds\":");
      return at == std::string::npos ? out : out.substr(0, at);
    };
    REQUIRE(folder.lorentz(command).status == 0);
    const std::string stored = folder.read("store"), whole = without_seconds(folder.lorentz(command).out);
    CHECK(folder.read("store") == stored);
    for (int i = 0; i < (run.starts_with("bench") ? 20 : 40); ++i) {
      cases::Random random(kSeed, run, static_cast<std::uint64_t>(i));
      const std::string text = edited(stored, random);
      folder.write("store", text);
      const Run again = folder.lorentz(command);
      INFO(command << ", edit " << i << ":\n" << text.substr(0, 2000) << '\n' << again.err);
      if (again.status == 0) {
        ++same;
        const bool is_measured = run.starts_with("bench");  // a missing cell is measured anew
        if (!is_measured) CHECK(without_seconds(again.out) == whole);
        if (!is_measured) CHECK(lines_of(folder.read("store")).size() == lines_of(stored).size());
        CHECK((text == stored || lines(text) < lines(stored)));
      } else {
        ++refused;
        CHECK(again.status == 2);
        CHECK(again.out.empty());
        CHECK(contains(again.err, folder.file("store") + ": line "));
        CHECK(contains(again.err, "; "));
        CHECK(folder.read("store") == text);
      }
    }
  }
  INFO(refused << " refused, " << same << " the same");
  CHECK(refused > 100);
  CHECK(same > 0);
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

TEST_CASE("A line that is left out of a store, or moved, is seen", "[cli][store]") {
  const Folder folder;
  const std::string store = folder.file("cells");
  const std::string bench =
      "bench --scene square --radius 0.2,0.3 --count 32 -e reduction --difficulty drawn --store ";
  REQUIRE(folder.lorentz(bench + store).status == 0);
  const std::vector<std::string> lines = lines_of(folder.read("cells"));
  REQUIRE(lines.size() >= 4);  // the header, the manifest, two cells
  for (const auto& [kept, refused] : {std::pair{lines[0] + lines[2] + lines[3], "line 2"},
                                      {lines[0] + lines[1] + lines[3] + lines[2], "line 3"},
                                      {lines[0] + lines[1] + lines[1], "line 3"}}) {
    const std::string file = folder.write("changed", kept);
    const Run run = folder.lorentz(bench + file);
    INFO(run.err);
    CHECK(run.status == 2);
    CHECK(contains(run.err, std::string("changed: ") + refused + " is damaged"));
    CHECK(folder.read("changed") == kept);
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

TEST_CASE("The text of a run in pieces is read back by the same plan, and what differs is said",
          "[cli][store]") {
  const store::Plan plan{{"version", "1"}, {"scene", "a \"square\""}, {"count", "12"}};
  const std::vector<std::string> pieces{R"({"a":1})", R"({"b":[2,3]})", "{}"};
  const std::string text = store::text_of("flights", plan, pieces);
  CHECK(store::pieces_in(text, "flights", plan) == pieces);
  CHECK(store::pieces_in(store::text_of("x", {}, {}), "x", {}).empty());
  const auto refused = [&](const store::Plan& other, const std::string& what, const char* kind = "flights") {
    CHECK_THROWS_WITH(store::pieces_in(text, kind, other),
                      "line 1 " + what + "; give what it was begun with, or name another file");
  };
  refused(plan, "is a store of `lorentz flights`", "bench");
  for (std::size_t i = 0; i < plan.size(); ++i) {
    store::Plan other = plan;
    other[i].second = "0";
    const std::string was = i == 1 ? R"(a \"square\")" : plan[i].second;
    refused(other, "is of another run: its " + plan[i].first + " is \"" + was + "\", not \"0\"");
    other[i].first = "other";
    refused(other, "is of another version of this program");
    refused({plan.begin(), plan.begin() + static_cast<std::ptrdiff_t>(i)},
            "is of another version of this program");
  }
  store::Plan longer = plan;
  longer.emplace_back("more", "1");
  refused(longer, "is of another version of this program");
}

TEST_CASE("What is no piece is refused, also with the right checksum", "[cli][store]") {
  const store::Plan plan{{"version", "1"}};
  const std::string header = store::text_of("flights", plan, {});
  const auto with_line = [&](const std::string& line) {
    const std::uint64_t check = store::check_of(line, store::check_of(header.substr(0, header.size() - 1)));
    char digits[17];
    std::snprintf(digits, sizeof digits, "%016llx", static_cast<unsigned long long>(check));
    return store::pieces_in(header + line + ",\"check\":\"" + digits + "\"}\n", "flights", plan);
  };
  CHECK(with_line(R"({"piece":{"a":1})") == std::vector<std::string>{R"({"a":1})"});
  for (const auto& [line, why] : {std::pair{R"({"peace":{"a":1})", "line 2 is not a piece of a run"},
                                  {R"({"a":1)", "line 2 is not a piece of a run"},
                                  {R"({"piece":{"a":1} {})", "line 2 is more than one piece"},
                                  {R"({"piece":{"a":tru})", "line 2 is not JSON: "},
                                  {R"({"piece":)", "line 2 is not JSON: "}}) {
    INFO(line);
    CHECK_THROWS_WITH(with_line(line), Catch::StartsWith(why) && Catch::EndsWith(store::kRemedy));
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
    CHECK_NOTHROW(store::LockFile(store, false, "busy"));  // nobody writes: it makes no file
    CHECK_FALSE(fs::exists(store + ".lock"));
    CHECK_THROWS_WITH(store::LockFile(notes, true, "busy"),
                      Catch::Contains("notes.lock: is there and is not a lock"));
    CHECK_THROWS_WITH(store::LockFile(folder.file("no/store"), true, "busy"),
                      Catch::Contains("No such file"));
    const store::LockFile lock(store, true, "busy");
    for (const bool writes : {false, true})
      CHECK_THROWS_WITH(store::LockFile(store, writes, "busy"), store + ": busy");
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
        const store::LockFile lock(folder.file("store"), true, "busy");
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
