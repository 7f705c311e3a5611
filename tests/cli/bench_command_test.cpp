// lorentz bench as its users call it.
#include "tests/support/command_line.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <regex>

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
  CHECK_FALSE(contains(run.out, " unsupported\n"));
  CHECK(contains(run.out, " ns; times at worst "));
  const std::string csv = folder.read("speed.csv");
  CHECK(lines(csv) == 7);
  CHECK(contains(csv, "path_mean,ill_posed,undecided_low,"));
  CHECK(contains(csv, "scene,radius,difficulty,engine,queries,ns_mean"));
  CHECK(folder.lorentz("bench --engine nobody").status == 2);
  CHECK(folder.lorentz("bench --count 3").status == 2);
  CHECK(folder.lorentz("bench --scene square --radius 0.1 --count 32 --csv /nowhere/speed.csv").status == 3);
}

TEST_CASE("bench: errors in units of the condition are errors over it, not times it",
          "[cli][bench_command]") {
  const Folder folder;
  const std::string cells = folder
                                .lorentz(
                                    "bench -e published --scene square --radius 0.01 --difficulty grazing "
                                    "--count 200 --seed 3 --json")
                                .out;
  INFO("seed 3\n" << cells);
  const auto largest = [&](const std::string& errors) {  // the next "max" after the key
    const std::string key = "\"max\":";
    return std::stod(cells.substr(cells.find(key, cells.find("\"" + errors + "\":{")) + key.size()));
  };
  REQUIRE(largest("ulps") > 100);  // grazing: the time is worse known by far than to an ulp
  CHECK(largest("conditions") < largest("ulps") / 10);
  CHECK(largest("conditions") > 0);
}

TEST_CASE("bench counts wrong times apart from wrong answers", "[cli][bench_command]") {
  const Folder folder;
  const Run run =
      folder.lorentz("bench --scene square --radius 0.01 --count 64 --engine published --difficulty drawn");
  INFO(run.out);
  CHECK(contains(run.out, "published: no wrong answer in "));
  CHECK(contains(run.out, " wrong times of right obstacles\n"));
  // What an engine does not claim it is not asked.
  const std::string solid = folder.never(R"({"engine":{"dimensions":[3]}})");
  const Run none =
      folder.lorentz("bench --scene square --radius 0.1 --count 64 --difficulty drawn -e " + solid);
  CHECK(contains(none.out, "too slow for 0 cells of this table, 1 outside of what is answered"));
}

TEST_CASE("bench asks engines what lies in their domain, and counts the rest", "[cli][bench_command]") {
  const Folder folder;
  const std::string engine =
      folder.write("engine",
                   "read -r first || { echo '{\"engine\":{\"domain\":{\"flight\":[0,5]}}}'; exit; }\n"
                   "{ echo \"$first\"; cat; } | tee -a " +
                       folder.file("asked") + " | " LORENTZ_PROGRAM " first-hit --engine certified\n");
  const std::string bench = "bench --scene square --radius 0.1 --difficulty drawn --json --count ";
  const Run run = folder.lorentz(bench + "200 -e reduction -e 'cmd:sh " + engine + "'");
  CHECK(run.status == 0);
  std::smatch counts;
  REQUIRE(std::regex_search(run.out, counts, std::regex(R"("queries":(\d+),"outside_domain":(\d+),)")));
  CHECK(std::stoi(counts[1]) + std::stoi(counts[2]) == 200);
  CHECK((std::stoi(counts[1]) > 40 && std::stoi(counts[2]) > 40));
  const std::string answers = folder.lorentz("first-hit " + folder.file("asked")).out;
  const std::regex time(R"("time":([0-9.e-]+))");
  for (std::sregex_iterator one(answers.begin(), answers.end(), time), end; one != end; ++one)
    CHECK(std::stod((*one)[1]) <= 5);
  const Run none = folder.lorentz(bench + "40 -e 'cmd:sh " + engine + "'");
  CHECK(contains(none.out, R"("queries":0,"outside_domain":)"));
}

TEST_CASE("bench fails if an engine does, at once or later", "[cli][bench_command]") {
  const Folder folder;
  const std::string bench = "bench --scene square --radius 0.1 --difficulty drawn --count ";
  const Run run = folder.lorentz(bench + "32 --engine 'cmd:exit 3'");
  CHECK(run.status == 3);
  CHECK(contains(run.out, "no answer to judge; 32 missing"));
  // A hundred lines each time that it is started; fewer are asked to see how long an answer takes.
  const std::string program = folder.write(
      "engine",
      "exec sed -u -n -e 's/^{\"id\":\\([0-9]*\\),.*/{\"id\":\\1,\"outcome\":\"never\"}/p' -e 100q\n");
  CHECK(folder.lorentz(bench + "400 --engine 'cmd:sh " + program + "'").status == 3);
}

TEST_CASE("bench takes scenes with semiaxes at their own size", "[cli][bench_command]") {
  const Folder folder;
  const Run run = folder.lorentz(
      "bench --scene ellipse --engine reduction,published-float --count 32 --csv " + folder.file("c"));
  INFO(run.out << run.err);
  CHECK(run.status == 0);
  CHECK(contains(folder.read("c"), "ellipse,own,drawn,reduction,"));
  CHECK(contains(run.out,
                 "published-float: too slow for 0 cells of this table, 3 outside of what is answered"));
  CHECK(lines(folder.read("c")) == 4);  // the time that a refusal takes is not a figure
  CHECK(folder.lorentz("bench --scene ellipse --radius 0.1 --engine reduction --count 32").status == 2);
}

TEST_CASE("bench --json: what it is, and a worst input, which its command shows", "[cli][bench_command]") {
  const Folder folder;
  const std::string out = folder
                              .lorentz(
                                  "bench --scene square --count 32 --difficulty drawn --engine "
                                  "published,published-float --radius 0.01,0.001,0.0001 --json")
                              .out;
  CHECK(out.starts_with("{\"format\":1,\"kind\":\"bench\","));
  CHECK(contains(out, "\"command\":\"lorentz bench --scene square --count 32 "));
  const std::string call =
      "lorentz compare --scene square --radius 1e-04 --queries - --engine published-float";
  std::string line = out.substr(out.rfind("echo '"));
  line.resize(line.find("\"}"));
  line.erase(std::remove(line.begin(), line.end(), '\\'), line.end());
  REQUIRE(line.ends_with(call));
  line.replace(line.size() - call.size(), 7, LORENTZ_PROGRAM);
  const Run shown = folder.run(line);
  CHECK(shown.status == 1);
  CHECK(contains(shown.out, "published-float: wrong in 1 of 1 answers"));
}

TEST_CASE("bench: no page without a name, no times without answers", "[cli][bench_command]") {
  const Folder folder;
  const std::string bench =
      LORENTZ_PROGRAM " bench --scene square --radius 0.1 --difficulty drawn --count 32";
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
