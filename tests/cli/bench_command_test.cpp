// lorentz bench as its users call it.
#include "runs/sqlite.hpp"
#include "tests/support/command_line.hpp"

#include <catch2/catch.hpp>

using namespace lorentz::test;

TEST_CASE("bench --precision: rounded scenes and queries, and commands that say so", "[cli][bench_command]") {
  const Folder folder;
  const Run run = folder.lorentz(
      "bench -e published --scene square --radius 0.1 --difficulty grazing --count 64 --precision binary32 "
      "--json");
  CHECK(run.status == 0);
  CHECK(contains(run.out, R"("precision":"binary32","time_tolerance":null})"));
  CHECK(contains(run.out, R"(\"radius\":0.10000000149011612}]}]}}\u000a)"));
  CHECK(contains(run.out, "lorentz compare --queries - --precision binary32 --engine published"));
  CHECK(contains(
      folder.lorentz("bench -e reduction --scene square --radius 0.1 --count 64 --time-tolerance inf").out,
      ", times not judged)"));
}

TEST_CASE("bench measures, concludes, and writes its figures", "[cli][bench_command]") {
  const Folder folder;
  const Run run =
      folder.lorentz("bench --scene square --radius 0.1 --count 64 --engine reduction,certified --csv " +
                     folder.file("speed.csv"));
  CHECK(run.status == 0);
  CHECK(contains(run.out, "square, r = 0.1, near-rational"));
  CHECK(contains(run.out, "reduction: "));
  CHECK(contains(run.out, "no wrong answer in 192"));
  const std::string csv = folder.read("speed.csv");
  CHECK(lines(csv) == 7);
  CHECK(contains(csv, "path_mean,ill_posed,undecided_low,"));
  CHECK(contains(csv, "scene,radius,difficulty,engine,queries,ns_mean"));
  CHECK(folder.lorentz("bench --engine nobody").status == 2);
  CHECK(folder.lorentz("bench --count 3").status == 2);
  CHECK(folder.lorentz("bench --scene square --radius 0.1 --count 32 --csv /nowhere/speed.csv").status == 3);
}

TEST_CASE("bench counts wrong times apart from wrong answers", "[cli][bench_command]") {
  const Folder folder;
  const Run run =
      folder.lorentz("bench --scene square --radius 0.01 --count 64 --engine published --difficulty drawn");
  INFO(run.out);
  CHECK(contains(run.out, "published: no wrong answer in "));
  CHECK(contains(run.out, " wrong times of right obstacles\n"));
}

TEST_CASE("bench takes scenes with semiaxes at their own size", "[cli][bench_command]") {
  const Folder folder;
  const Run run = folder.lorentz("bench --scene ellipse --engine reduction,published --count 32 --csv " +
                                 folder.file("c"));
  INFO(run.out << run.err);
  CHECK(run.status == 0);
  CHECK(contains(folder.read("c"), "ellipse,own,drawn,reduction,"));
  CHECK(contains(run.out, "published: too slow for 0 cells of this table, 3 unsupported"));
  CHECK(lines(folder.read("c")) == 4);  // the time that a refusal takes is not a figure
  CHECK(folder.lorentz("bench --scene ellipse --radius 0.1 --engine reduction --count 32").status == 2);
}

namespace {

// The text between the first `before` and the next `after`.
std::string between(const std::string& text, const std::string& before, const std::string& after) {
  const std::size_t begin = text.find(before) + before.size();
  return text.substr(begin, text.find(after, begin) - begin);
}

std::string last_cell(const std::string& out) {
  return out.substr(out.rfind("\"difficulty\":", out.find("\"fits\":")));
}

std::vector<std::string> pieces_in(const std::string& path) {
  const lorentz::runs::Connection store(path, path, SQLITE_OPEN_READONLY);
  lorentz::runs::Statement row(store, "SELECT text FROM piece ORDER BY number");
  std::vector<std::string> pieces;
  while (row.step()) pieces.push_back(row.text());
  return pieces;
}

}  // namespace

TEST_CASE("bench goes on with what its store has, and refuses that of another run", "[cli][bench_command]") {
  const Folder folder;
  const std::string
      options = "bench --scene square --count 32 --difficulty drawn --engine published,published-float",
      radii = " --radius 0.01,0.001,0.0001", store = " --json --store " + folder.file("cells");
  const Run first = folder.lorentz(options + radii + store);
  INFO(first.err);
  REQUIRE(first.status == 0);
  const std::vector<std::string> kept = pieces_in(folder.file("cells"));
  REQUIRE(kept.size() == 7);  // with what it was measured, and six cells
  CHECK(folder.lorentz(options + radii + store).out == first.out);  // times and all: nothing is done again

  // Killed while the last group was measured: its two cells are missing, or one of them.
  for (std::size_t missing = 1; missing <= 2; ++missing) {
    lorentz::runs::Connection(folder.file("cells"), folder.file("cells"), SQLITE_OPEN_READWRITE)
        .run(("DELETE FROM piece WHERE number > " + std::to_string(kept.size() - missing)).c_str());
    const Run rest = folder.lorentz(options + radii + store);
    CHECK(rest.status == 0);
    const std::vector<std::string> again = pieces_in(folder.file("cells"));
    REQUIRE(again.size() == kept.size());
    for (std::size_t i = 0; i + missing < kept.size(); ++i) CHECK(again[i] == kept[i]);
    for (const char* key : {"\"wrong\":{", "\"ulps\":{", "\"worst\":{"})
      CHECK(between(last_cell(rest.out), key, "}") == between(last_cell(first.out), key, "}"));
  }
  const Run other = folder.lorentz(options + " --radius 0.01" + store);
  CHECK(other.status == 2);
  CHECK(contains(other.err, "is of another run: its cells is"));
  folder.write("cells", "not this\n");
  const Run foreign = folder.lorentz(options + radii + store);
  CHECK(foreign.status == 3);
  CHECK(contains(foreign.err, "cells: is not a store of lorentz, nor any database"));
  CHECK(folder.read("cells") == "not this\n");
  CHECK(folder.lorentz(options + radii + " --store /nowhere/cells").status == 3);

  // The report: what it is, the fit of three radii, and a worst input, which its command shows.
  CHECK(first.out.starts_with("{\"format\":1,\"kind\":\"bench\","));
  CHECK(contains(first.out,
                 "\"fits\":[\n{\"scene\":\"square\",\"engine\":\"published\",\"difficulty\":\"drawn\","));
  CHECK(contains(first.out, "\"command\":\"lorentz bench --scene square --count 32 "));
  const std::string call =
      "lorentz compare --scene square --radius 1e-04 --queries - --engine published-float";
  std::string line = first.out.substr(first.out.rfind("echo '"));
  line.resize(line.find("\"}"));
  line.erase(std::remove(line.begin(), line.end(), '\\'), line.end());
  REQUIRE(line.ends_with(call));
  line.replace(line.size() - call.size(), 7, LORENTZ_PROGRAM);
  const Run shown = folder.run(line);
  CHECK(shown.status == 1);
  CHECK(contains(shown.out, "published-float: wrong in 1 of 1 answers"));
}

TEST_CASE("bench: one process at a time writes a store, no page without a name, no times without answers",
          "[cli][bench_command]") {
  const Folder folder;
  const std::string bench =
                        LORENTZ_PROGRAM " bench --scene square --radius 0.1 --difficulty drawn --count 32",
                    store = " --store " + folder.file("cells");
  // The first waits for a program that says nothing, until it is told to end, and leaves nothing behind.
  const std::string script = folder.write(
      "two.sh", bench + store + " --csv " + folder.file("csv") +
                    " --engine 'cmd:exec sleep 60' &\nfirst=$!\n" + "n=0\nuntil [ -e " +
                    folder.file("cells.lock") + " ] || [ $n = 200 ]; do n=$((n + 1)); sleep 0.05; done\n" +
                    bench + store +
                    " --engine reduction\nstatus=$?\nsleep 0.5\nkill $first\nwait $first\nexit $status\n");
  const Run two = folder.run("sh " + script);
  INFO(two.out << two.err);
  CHECK(two.status == 3);
  CHECK(contains(two.err,
                 "cells: another process is writing this store; wait for it, stop it, or name another file"));
  CHECK(folder.run("ls " + folder.file("") + " | grep csv").status == 1);
  CHECK(folder.run(bench + " --engine reduction --html ''").status == 2);
  // A program that dies is not slow, however long that takes.
  for (const std::string& engine :
       {std::string("cmd:false"), "cmd:sh " + folder.write("dies.sh", "sleep 0.1; exit 1")}) {
    const Run mute = folder.run(bench + " --engine '" + engine + "'");
    INFO(mute.out);
    CHECK(contains(mute.out, engine + ": no answer to judge"));
    CHECK(contains(mute.out, "no times, for it broke"));
    CHECK_FALSE(contains(mute.out, "ulps off"));
  }
}
