// lorentz trajectory, as its users call it.
#include <catch2/catch.hpp>
#include <regex>

#include "report/page.hpp"
#include "tests/support/command_line.hpp"

using namespace lorentz;
using namespace lorentz::test;

namespace {

const std::string kChallenge = R"({"id":"siam","x":["1/2","1/10"],"v":[1,0]})"
                               "\n";

std::string last_line(const std::string& text) {
  return text.substr(text.rfind('\n', text.size() - 2) + 1);
}

}  // namespace

TEST_CASE("trajectory: a line a collision, and the end", "[cli][trajectory]") {
  const Folder folder;
  const std::string starts = folder.write("starts", kChallenge);
  const Run run = folder.lorentz("trajectory --scene square --radius 1/3 --time 10 --digits 30 " + starts);
  CHECK(run.status == 0);
  CHECK(lines(run.out) == 15);
  CHECK(run.out.starts_with(
      R"({"id":"siam","collision":1,"lattice":0,"atom":0,"cell":[1,0],"time":"0.182020266194351450282459471326","bits":)"));
  const std::string end = last_line(run.out);
  CHECK(end.starts_with(R"({"id":"siam","end":"time","collisions":14,"bits":)"));
  CHECK(contains(end, R"("x":["-0.736292698609618310775737171866",)"));
  CHECK(contains(end, R"("distance":"0.995262919443354160890311809427"})"));
}

TEST_CASE("trajectory --x --v follows one start, exactly", "[cli][trajectory]") {
  const Folder folder;
  const std::string scene = "trajectory --scene square --radius 1/3 --collisions 20 --detail ";
  const Run asked = folder.lorentz(scene + "--x 1/2,0.1 --v 1,golden");
  CHECK(asked.status == 0);
  CHECK(lines(asked.out) == 21);
  CHECK(asked.out ==
        folder.lorentz(scene + folder.write("q", R"({"x":["1/2","1/10"],"v":[1,"golden"]})")).out);
  CHECK(asked.out != folder.lorentz(scene + folder.write("q", R"({"x":[0.5,0.1],"v":[1,"golden"]})")).out);
  for (const auto& [options, why] : {std::pair{"--x 1/2,0.1", "--x: needs --v"},
                                     {"--x 1/2,0.1 --v 1,golden q", "leave them out, or the file q"},
                                     {"--x 1/2 --v 1,golden", "x: has 1 components"},
                                     {"--x 1/2,1/0 --v 1,golden", "is not a rational number"}}) {
    const Run refused = folder.lorentz(scene + options);
    INFO(options << refused.err);
    CHECK(refused.status == 2);
    CHECK(contains(refused.err, why));
  }
}

TEST_CASE("trajectory: a radius below all of binary64 is a radius", "[cli][trajectory]") {
  const Folder folder;
  const std::string starts = folder.write("starts", R"({"x":["1/2",0],"v":[1,0]})");
  const Run run = folder.lorentz("trajectory --scene square --radius 1e-400 --collisions 1 " + starts);
  CHECK(run.status == 0);
  CHECK(contains(run.out, R"("cell":[1,0],"time":"0.50000000000000000")"));
  const std::string stream = folder.write(
      "stream",
      R"({"scene":{"dimension":2,"lattices":[{"vectors":[[1,0],[0,1]],"atoms":[{"position":[0,0],"radius":"1e-400"}]}]}})"
      "\n"
      R"({"x":["1/2",0],"v":[1,0]})");
  CHECK(folder.lorentz("trajectory --collisions 1 " + stream).out == run.out);
  CHECK(folder.lorentz("trajectory --scene square --radius -1e-400 --collisions 1 " + starts).status == 2);
  CHECK(folder.lorentz("trajectory --scene square --time 0e5 " + starts).status == 2);
}

TEST_CASE("trajectory: an engine held against it", "[cli][trajectory]") {
  const Folder folder;
  const std::string starts =
      folder.write("starts", R"({"id":7,"x":["1/2","1/10"],"direction":{"degrees":"36"}})");
  const std::string command = "trajectory --scene square --radius 1/10 --collisions 30 " + starts;
  const Run run = folder.lorentz(command + " --engine reduction --csv " + folder.file("table") + " --svg " +
                                 folder.file("picture"));
  CHECK(run.status == 0);
  CHECK(contains(run.out, R"("engine_bits":)"));
  CHECK(contains(last_line(run.out), R"("diverged":8)"));
  CHECK(folder.read("table").starts_with(
      "id,collision,lattice,atom,cell1,cell2,time,bits,engine_bits\n7,1,0,0,3,2,3.0657078058760461,"));
  CHECK(lines(folder.read("table")) == 31);
  CHECK(contains(folder.read("picture"), "reduction: another obstacle at collision 8"));
  folder.lorentz(command + " --svg " + folder.file("picture") + " -e " + folder.never());
  CHECK(contains(folder.read("picture"), ": stopped (never) at collision 1"));
  // Another program is an engine, too; and the truth does not part from itself for a few collisions.
  const Run program = folder.lorentz(command + " --engine cmd:" LORENTZ_NAIVE_ENGINE);
  CHECK(contains(last_line(program.out), R"("diverged":8)"));
  const Run exact =
      folder.lorentz("trajectory --scene square --radius 1/10 --collisions 5 --engine oracle " + starts);
  CHECK(contains(last_line(exact.out), R"("diverged":null)"));
  // No engine is blamed for a time beyond binary64, nor, on its first flight, for one that is rounded up to a collision.
  for (const std::string how :
       {"--x 1/2,1/2 --v 1,0 --time 1e309", "--x 1/2,0 --v 1,0 --time 0.3999999999999999999"})
    CHECK(std::regex_search(folder.lorentz("trajectory --scene square --radius 1/10 -e reduction " + how).out,
                            std::regex(R"("end":"time","collisions":0,.*"diverged":null)")));
}

TEST_CASE("trajectory: an engine that names the next obstacle of a column departs there",
          "[cli][trajectory_command]") {
  const Folder folder;
  const std::string engine = folder.write(
      "engine.sh", std::string(LORENTZ_PROGRAM) + " first-hit | sed -u 's/\"cell\":.0,0/\"cell\":[0,1/'\n");
  const Run run = folder.lorentz(
      "trajectory --scene square --radius 0.25 --x 0.01,0.5 --v 0,1 --collisions 1 -e 'cmd:sh " + engine +
      "'");
  INFO(run.out << run.err);
  CHECK(contains(last_line(run.out), R"("diverged":1)"));
}

TEST_CASE("trajectory: scenes in a stream, numbers exactly as they are written", "[cli][trajectory]") {
  const Folder folder;
  const std::string starts = folder.write(
      "starts",
      R"({"scene":{"dimension":2,"lattices":[{"vectors":[["1/3",0],[0,"1/3"]],"atoms":[{"position":[0,0],"radius":"1/9"}]}]}})"
      "\n"
      R"({"id":1,"x":["1/6","1/30"],"v":["1/3",0]})"
      "\n"
      "{\"id\":2,\"x\":[0.5,\"0.1\"],\"v\":[1,\"sqrt(2)\"]}\n");
  const Run run = folder.lorentz("trajectory --time 10 --digits 25 " + starts);
  CHECK(run.status == 0);
  // The challenge again, in a unit three times as long: its distance divided by 3.
  CHECK(contains(run.out, R"({"id":1,"end":"time","collisions":14,)"));
  CHECK(contains(run.out, R"("distance":"0.3317543064811180536301039")"));
  CHECK(contains(run.out, R"({"id":2,"end":"time",)"));
}

TEST_CASE("trajectory: bad input is told with its place", "[cli][trajectory]") {
  const Folder folder;
  const auto refused = [&](const std::string& line, const std::string& message) {
    const std::string starts = folder.write("starts", line + "\n" + kChallenge);
    const Run run = folder.lorentz("trajectory --scene square --collisions 1 " + starts);
    INFO(line << "\n" << run.err);
    CHECK(run.status == 2);
    CHECK(contains(run.err, "starts:1: " + message));
    CHECK(contains(run.out, R"("outcome":"error")"));
    CHECK(contains(run.out, R"({"id":"siam","collision":1)"));  // the rest goes on
  };
  refused(R"({"x":["1/0",0],"v":[1,0]})", R"(x: "1/0" is not a rational number)");
  refused("{\"x\":[\"sqrt(2)\",0],\"v\":[1,0]}", "x: \"sqrt(2)\" is not a rational number");
  refused("{\"x\":[\"1/2\",0],\"v\":[\"sqrt(-2)\",0]}", "v: \"sqrt(-2)\" is not a known number");
  refused(R"({"x":["1/2",0],"v":[0,"0/7"]})", "v is zero");
  refused(R"({"x":["1/2",0]})", "v is missing");
  refused(R"({"x":["1/2",0],"v":[1,0],"direction":{"degrees":3}})", "has both v and direction");
  refused(R"({"x":["1/2",0],"direction":{"gradient":3}})",
          R"(direction: needs one of "degrees" and "slope")");
  refused(R"({"x":["1/2"],"v":[1,0]})", "x: has 1 components");
  refused(R"({"x":["1/2",0],"v":[1,0],"from":{"lattice":1,"atom":0,"cell":[0,0]}})", "from names lattice 1");
  const Run no_scene =
      folder.lorentz("trajectory --collisions 1 " +
                     folder.write("starts", "{\"scene\":{\"dimension\":2,\"lattices\":[]}}\n" + kChallenge));
  CHECK(no_scene.status == 2);
  folder.write("table", "id,collision");  // a table of nothing takes no other's place
  CHECK(folder.lorentz("trajectory --scene square --collisions 1 --x 0 --v 1,0 --csv " + folder.file("table"))
            .status == 2);
  CHECK(folder.read("table") == "id,collision");
  CHECK(contains(no_scene.err, "starts:1: a scene needs at least one lattice"));
  CHECK(contains(no_scene.err, "starts:2: the scene in line 1 was bad"));
}

TEST_CASE("trajectory: invalid options, and files that cannot be written", "[cli][trajectory]") {
  const Folder folder;
  const std::string starts = folder.write("starts", kChallenge);
  const auto status = [&](const std::string& arguments, const std::string& message) {
    const Run run = folder.lorentz("trajectory --scene square " + arguments + " " + starts);
    INFO(arguments << "\n" << run.err);
    CHECK(contains(run.err, message));
    return run.status;
  };
  CHECK(status("", "needs --collisions N or --time T") == 2);
  CHECK(status("--time 0", "--time: \"0\" is not a rational number above zero") == 2);
  CHECK(status("--collisions 5 --radius -1/3", "--radius: \"-1/3\" is no") == 2);
  CHECK(status("--collisions 5 --engine reductoin", "did you mean") == 2);
  CHECK(status("--collisions 5 --digits 0", "--digits") == 2);
  CHECK(status("--collisions 5 --csv /dev/full", "/dev/full") == 3);
  CHECK(status("--collisions 5 --svg /dev/full", "/dev/full") == 3);
  const Run gone = folder.lorentz("trajectory --scene square --collisions 1 " + folder.file("nowhere"));
  CHECK(gone.status == 3);
  const Run none = folder.lorentz("trajectory --collisions 1 " + starts);
  CHECK(none.status == 2);
  CHECK(contains(none.err, "no scene before this start"));
  const int full = std::system((std::string(LORENTZ_PROGRAM) + " trajectory --scene square --collisions 5 " +
                                starts + " >/dev/full 2>/dev/null")
                                   .c_str());
  CHECK(WEXITSTATUS(full) == 3);
}

TEST_CASE("trajectory --svg: a path beyond binary64 is refused in words, and its lines are there",
          "[cli][trajectory]") {
  const Folder folder;
  const std::string starts = folder.write("starts", R"({"id":1,"x":["0","1/2"],"v":[1,0]})"
                                                    "\n");
  const Run run = folder.lorentz("trajectory --scene square --radius 1/10 --time 1e400 --svg " +
                                 folder.file("svg") + " " + starts);
  INFO(run.out << run.err);
  CHECK(run.status == 2);
  CHECK(contains(run.out, "\"end\":\"time\""));
  CHECK(contains(run.err, "too far from the origin"));
  CHECK_FALSE(contains(run.err, "stod"));
}

TEST_CASE("trajectory: what no precision decides says so", "[cli][trajectory]") {
  const Folder folder;
  const std::string starts = folder.write("starts", R"({"x":["1/2",0],"direction":{"degrees":150}})");
  const Run run =
      folder.lorentz("trajectory --scene square --radius 1/4 --collisions 3 --max-bits 2000 " + starts);
  CHECK(run.status == 0);
  CHECK(run.out == "{\"id\":null,\"end\":\"undecided\",\"collisions\":0,\"bits\":2000}\n");
  CHECK(contains(run.err, "undecided at collision 1 with 2000 bits"));
}

TEST_CASE("trajectory ends where the particle escapes for ever", "[cli][trajectory]") {
  const Folder folder;
  const std::string disc =
      R"({"scene":{"dimension":2,"lattices":[{"vectors":[],"atoms":[{"position":[0,0],"radius":1}]}]}})";
  // From 10^30 radii away, along an irrational direction: hit, and missed.
  const std::string x1 = R"({"id":1,"x":["-1000000000000000000000000000000","-14142135623730950488016887242)";
  const std::string v = R"x("],"v":["1","sqrt(2)"]})x";
  const auto starts =
      folder.write("starts", disc + "\n" + x1 + "09.398" + v + "\n" + x1 + "07.398" + v + "\n");
  const Run run = folder.lorentz("trajectory --collisions 4 --csv " + folder.file("table") + " " + starts);
  INFO(run.out << run.err);
  CHECK((run.status == 0 && lines(run.out) == 3));
  CHECK(contains(run.out, R"("lattice":0,"atom":0,"cell":[],"time":"1.0000000000000000e+30")"));
  CHECK(contains(run.out, R"("end":"never","collisions":1)"));
  CHECK(contains(run.out, R"("end":"never","collisions":0)"));
  CHECK(contains(folder.read("table"), "\n1,1,0,0,,,1.0000000000000000e+30,"));
  const auto near = folder.write("near", disc + "\n" + R"({"id":1,"x":[-3,0.5],"v":[1,0]})");
  CHECK(folder.lorentz("trajectory --collisions 4 --svg " + folder.file("path") + " " + near).status == 0);
  CHECK((contains(folder.read("path"), "</svg>") && !contains(folder.read("path"), "nan")));
}

TEST_CASE("trajectory: an engine is asked at the end, too, and its own end is told",
          "[cli][trajectory_command]") {
  const Folder folder;
  const auto run = [&](const std::string& cell, const std::string& how_far) {
    const std::string engine = folder.write(
        "engine.sh",
        R"(while read -r line; do case $line in *'"v":'*) echo '{"id":1,"outcome":"hit","lattice":0,)"
        R"("atom":0,"time":0.5,"cell":)" +
            cell + "}';; esac; done; exit 3");
    return folder.lorentz("trajectory --scene square --radius 0.125 --x 0.5,0.125 --v 1,0 " + how_far +
                          " -e 'cmd:sh " + engine + "'");
  };
  // The line touches a row of discs.
  const Run touched = run("[1,0]", "--collisions 5"), beside = run("[1,3]", "--time 2");
  CHECK(contains(touched.out, R"("end":"never","collisions":0)"));
  CHECK(contains(touched.out, R"("diverged":1})"));
  CHECK(contains(touched.err, "ended with exit 3 after its last answer"));
  CHECK(contains(beside.out, R"("diverged":1,"stopped":"missed"})"));
}
