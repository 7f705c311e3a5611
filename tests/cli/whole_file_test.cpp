// Files that are put in their place when they are whole.
#include "report/files/whole_file.hpp"

#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <set>

#include <lorentz/errors.hpp>
#include "tests/support/command_line.hpp"

using namespace lorentz;
using test::contains;
using test::Folder;
using test::Run;

namespace {

std::size_t entries(const Folder& folder) {
  return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(folder.file("")), {}));
}

}  // namespace

TEST_CASE("Until a file is whole the old one stands", "[cli][whole_file]") {
  const Folder folder;
  const std::string path = folder.write("f", "old,\n");
  {
    WholeFile file(path);
    file.write("half of the ne");
    CHECK(folder.read("f") == "old,\n");
  }  // given up
  CHECK(folder.read("f") == "old,\n");
  CHECK(entries(folder) == 1);
  {
    WholeFile file(path);
    file.write("new\n");
    file.commit();
  }
  CHECK(folder.read("f") == "new\n");
  CHECK(entries(folder) == 1);
}

TEST_CASE("A file is put where a link points to, with the permissions of the old one", "[cli][whole_file]") {
  const Folder folder;
  const std::string path = folder.write("f", "old,\n"), link = folder.file("link");
  std::filesystem::create_symlink("f", link);
  std::filesystem::permissions(path,
                               std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
  WholeFile file(link);
  file.write("new\n");
  file.commit();
  CHECK(folder.read("f") == "new\n");
  CHECK(std::filesystem::is_symlink(link));
  CHECK(std::filesystem::status(path).permissions() ==
        (std::filesystem::perms::owner_read | std::filesystem::perms::owner_write));
}

TEST_CASE("Devices are written as they are, and a full one is a failure", "[cli][whole_file]") {
  WholeFile null("/dev/null");
  null.write("text");
  CHECK_NOTHROW(null.commit());
  WholeFile full("/dev/full");
  full.write("text");
  CHECK_THROWS_AS(full.commit(), FileError);
  CHECK_THROWS_AS(WholeFile("/no/such/folder/f"), FileError);
}

TEST_CASE("compare that is killed leaves the file of disagreements as it was", "[cli][whole_file]") {
  const Folder folder;
  const std::string path = folder.write("d", "old\n");
  folder.run("timeout -s KILL 0.3 " LORENTZ_PROGRAM " compare --count 100000000 --disagreements " + path);
  CHECK(folder.read("d") == "old\n");
}

TEST_CASE("The name of a file that is not whole cannot be foreseen, and no link leads out of it",
          "[cli][whole_file]") {
  const Folder folder;
  const std::string path = folder.file("f");
  const auto beside = [&] {
    for (const auto& entry : std::filesystem::directory_iterator(folder.file("")))
      if (entry.path() != path) return entry.path().filename().string();
    return std::string();
  };
  std::set<std::string> names;
  for (int i = 0; i < 20; ++i) {
    WholeFile file(path);
    const std::string name = beside();
    CHECK(name.size() == std::string("f.0123456789abcdef.new").size());
    names.insert(name);
    file.commit();
  }
  CHECK(names.size() == 20);
  CHECK(entries(folder) == 1);
  // What an earlier version, and the process id, would have made of it.
  const std::string victim = folder.write("victim", "precious\n");
  std::filesystem::create_symlink(victim, path + '.' + std::to_string(::getpid()) + ".new");
  write_whole(path, "new\n");
  CHECK(folder.read("victim") == "precious\n");
}

TEST_CASE("A new file has the permissions of any new file, whatever its name's length", "[cli][whole_file]") {
  const Folder folder;
  const mode_t before = ::umask(027);
  const std::string name(255, 'x');
  write_whole(folder.file(name), "text");
  ::umask(before);
  CHECK(folder.read(name) == "text");
  CHECK(entries(folder) == 1);
  CHECK((std::filesystem::status(folder.file(name)).permissions() & std::filesystem::perms::all) ==
        static_cast<std::filesystem::perms>(0640));
}

TEST_CASE("Files of another kind are left as they are", "[cli][whole_file]") {
  const Folder folder;
  const std::string queries = folder.write("queries", "{\"x\":[0,0],\"v\":[1,0]}\n"),
                    store = folder.file("store"), source = folder.write("engine.py", "import sys\n"),
                    old = folder.write("old", "<svg/>");
  REQUIRE(folder.lorentz("flights --count 100 --store " + store).status == 0);
  const auto require_left = [&](const std::string& words, const std::string& name, const std::string& why) {
    const std::string before = folder.read(name);
    const Run run = folder.lorentz(words + folder.file(name));
    INFO(words << name << run.err);
    CHECK(run.status == 2);
    CHECK(contains(run.err, why));
    CHECK(folder.read(name) == before);
  };
  for (const std::string option : {"--csv ", "--html "}) {
    require_left("flights --count 10 " + option, "store", ", and is left as it is");
    require_left("flights --count 10 " + option, "queries", ", and is left as it is");
  }
  require_left("flights --count 10 --csv ", "old", "is not a CSV table");
  require_left("judge --engine reduction --time 1 --junit ", "queries", "is not a report of JUnit");
  require_left("compare --count 5 -e 'cmd:python3 " + source + " -u' --disagreements ", "engine.py",
               "--engine reads");
  CHECK(folder.lorentz("scene draw square -o " + old).status == 0);
  CHECK(contains(folder.read("old"), "radius"));
  require_left("golden make --set ties --count 1 -o ", "queries", "is not a golden set");
}

TEST_CASE("`-` is standard output where that makes sense, and no file", "[cli][whole_file]") {
  const Folder folder;
  for (const std::string words : {"flights --count 10 --csv -", "flights --count 10 --store -",
                                  "judge --engine reduction --golden -"}) {
    const Run run = folder.lorentz(words);
    INFO(words << run.err);
    CHECK(run.status == 2);
    CHECK(contains(run.err, "needs a file, and not -"));
  }
  CHECK_FALSE(std::filesystem::exists("-"));
}

TEST_CASE("A link is followed, whether or not its target is there", "[cli][whole_file]") {
  const Folder folder;
  const std::string target = folder.file("target"), link = folder.file("link");
  std::filesystem::create_symlink("target", link);
  for (const char* text : {"first", "second"}) {
    write_whole(link, text);
    CHECK(std::filesystem::is_symlink(link));
    CHECK(folder.read("target") == text);
  }
  std::filesystem::create_symlink("round", folder.file("round"));
  CHECK_THROWS_AS(write_whole(folder.file("round"), "text"), FileError);
}

TEST_CASE("The running program is refused as an output", "[cli][whole_file]") {
  const Folder folder;
  const Run run = folder.lorentz("flights --count 10 --csv /proc/self/exe");
  CHECK(run.status == 2);
  CHECK(contains(run.err, "/proc/self/exe is what the running program reads"));
}

TEST_CASE("Two options that name one file are refused, whatever they call it", "[cli][whole_file]") {
  const Folder folder;
  const std::string path = folder.write("f", "old,\n"), other = folder.file("g");
  std::filesystem::create_symlink(path, folder.file("link"));
  std::filesystem::create_hard_link(path, folder.file("hard"));
  const std::string start = folder.write("start", R"({"x":["1/2","1/7"],"v":[1,2]})");
  const auto path_of = [&](const std::string& options) {
    return folder.lorentz("trajectory --scene square --radius 1/3 --collisions 5 " + options + " " + start);
  };
  const auto refused = [&](const std::string& options) {
    const Run run = path_of(options);
    INFO(options << ": " << run.err);
    CHECK(run.status == 2);
    CHECK(contains(run.err, "give each its own"));
    CHECK(folder.read("f") == "old,\n");
  };
  CHECK(contains(path_of("--csv " + path + " --svg " + path).err,
                 "--csv and --svg name the same file: " + path + "; give each its own"));
  refused("--csv " + path + " --svg " + folder.file("./f"));
  refused("--csv " + path + " --svg " + folder.file("link"));
  refused("--csv " + path + " --svg " + folder.file("hard"));
  refused("--csv " + other + " --svg " + folder.file("./g"));  // there is none yet
  CHECK(contains(path_of("--csv ''").err, "--csv: the name is empty"));
  CHECK(path_of("--csv /dev/null --svg /dev/null").status == 0);
  CHECK(path_of("--csv " + path + " --svg " + other).status == 0);
  CHECK(folder.read("f") != "old,\n");
}
