// The program as its users call it: what it prints where, and its exit status.
#include "tests/support/command_line.hpp"

#include <catch2/catch.hpp>

using namespace lorentz::test;

TEST_CASE("first-hit answers a stream, line by line", "[cli][command_line]") {
  const Folder folder;
  const auto queries = folder.write("q", kScene + kGood + "\n" +
                                             R"({"id":7,"x":[0,0.5],"v":[1,0]})"
                                             "\n" +
                                             R"({"id":8,"x":[0.1,0],"v":[1,0]})");
  for (const std::string engine : {"oracle", "walk", "classical"}) {
    const Run run = folder.lorentz("first-hit --engine " + engine + " " + queries);
    INFO(run.out << run.err);
    CHECK(run.status == 0);
    CHECK(run.err.empty());
    CHECK(lines(run.out) == 3);
    CHECK(run.out.starts_with(kGoodAnswer));
    CHECK(contains(run.out, engine == "classical" ? R"({"id":7,"outcome":"undecided"})"
                                                  : R"({"id":7,"outcome":"never"})"));
    CHECK(contains(run.out, R"({"id":8,"outcome":"inside","lattice":0,"atom":0,"cell":[0,0]})"));
  }
  CHECK(folder.lorentz("first-hit < " + queries).out == folder.lorentz("first-hit - < " + queries).out);
}

TEST_CASE("Digits, detail and a time limit", "[cli][command_line]") {
  const Folder folder;
  const auto queries = folder.write("q", kScene + kGood);
  CHECK(contains(folder.lorentz("first-hit --digits 5 " + queries).out, R"("time_decimal":"0.25000")"));
  CHECK(contains(folder.lorentz("first-hit --detail " + queries).out,
                 R"("point":[0.75,0],"normal":[-1,0],"impact_parameter":0)"));
  CHECK(folder.lorentz("first-hit --max-time 0.25 " + queries).out ==
        "{\"id\":\"good\",\"outcome\":\"later\"}\n");
  CHECK(folder.lorentz("first-hit --max-time 0.2500001 " + queries).out == kGoodAnswer);
  CHECK(folder.lorentz("first-hit --max-time 0x1p-2 --engine classical " + queries).out ==
        "{\"id\":\"good\",\"outcome\":\"later\"}\n");
}

TEST_CASE("The detail of a hit on an ellipse", "[cli][command_line]") {
  const Folder folder;
  const auto queries = folder.write(
      "q",
      R"({"scene":{"dimension":2,"lattices":[{"vectors":[[1,0],[0,1]],"atoms":[{"position":[0,0],"semiaxes":[[0.25,0],[0,0.1]]}]}]}})"
      "\n"
      R"({"id":1,"x":[0.15,0.5],"v":[0,-1]})");
  const Run run = folder.lorentz("first-hit --detail --engine classical " + queries);
  INFO(run.out);  // entered at (0.15, 0.08): the normal is along (0.15 / 0.0625, 0.08 / 0.01) = (2.4, 8)
  CHECK(contains(run.out, R"("cell":[0,0],"time":0.4)"));
  CHECK(contains(run.out, R"("normal":[0.28734)"));
  CHECK(contains(run.out, R"("impact_parameter":0.15)"));
}

TEST_CASE("Bad lines get an error in their place, and the good ones around them their answers",
          "[cli][command_line]") {
  const Folder folder;
  const std::string huge(100'000'000, '1');
  for (const std::string& bad :
       {std::string("nonsense"), std::string("{\"x\":[0,0.5],\"v\":[0,0]}"),
        std::string("{\"x\":[0,0.5,0],\"v\":[1,0]}"), std::string("{\"x\":[NaN,0.5],\"v\":[1,0]}"),
        std::string("{\"x\":[1e999,0.5],\"v\":[1,0]}"), std::string("{\"v\":[1,0]}"),
        std::string(100000, '['), std::string("\xff\xfe"), huge}) {
    const Run run = folder.lorentz("first-hit " + folder.write("q", kScene + kGood + bad + "\n" + kGood));
    INFO(bad.substr(0, 100) << "\n" << run.out << run.err);
    CHECK(run.status == 2);
    CHECK(lines(run.out) == 3);
    CHECK(run.out.starts_with(kGoodAnswer + R"({"id":null,"outcome":"error","message":")"));
    CHECK(run.out.ends_with(kGoodAnswer));
    CHECK(contains(run.err, "q:3: "));
  }
}

TEST_CASE("After a bad scene every query is an error, until the next good one", "[cli][command_line]") {
  const Folder folder;
  const std::string dependent =
      R"({"scene":{"dimension":2,"lattices":[{"vectors":[[0.1,0.2],[0.2,0.4]],"atoms":[{"position":[0,0],"radius":0.25}]}]}})"
      "\n";
  const Run run =
      folder.lorentz("first-hit " + folder.write("q", kGood + dependent + kGood + kScene + kGood));
  INFO(run.out << run.err);
  CHECK(run.status == 2);
  CHECK(lines(run.out) == 4);
  CHECK(run.out.starts_with(R"({"id":"good","outcome":"error","message":"no scene before this query"})"));
  CHECK(contains(
      run.out,
      R"({"id":null,"outcome":"error","message":"lattice 0: the primitive vectors are linearly dependent)"));
  CHECK(run.out.ends_with(kGoodAnswer));
}

TEST_CASE("A line that begins as a scene and is no JSON is a bad scene: the one before it is over",
          "[cli][command_line]") {
  const Folder folder;
  for (
      const std::string& bad :
      {std::string(
           R"({"scene":{"dimension":2,"lattices":[{"vectors":[[1,0],[0,1]],"atoms":[{"position":[0,0],"radius":NaN}]}]}})"),
       std::string(R"({"scene":{"dimension":2,"lattices":[{"vec)"), std::string(R"( { "scene" : )"),
       std::string(R"({"id":3,"scene":NaN})"), std::string(R"({"scene":{}} x)")}) {
    const Run run = folder.lorentz("first-hit " +
                                   folder.write("q", kScene + kGood + bad + "\n" + kGood + kScene + kGood));
    INFO(bad << "\n" << run.out);
    CHECK(run.status == 2);
    CHECK(lines(run.out) == 4);
    CHECK(run.out.starts_with(kGoodAnswer + R"({"id":null,"outcome":"error")"));
    CHECK(contains(run.out, R"({"id":"good","outcome":"error","message":"the scene in line 3 was bad)"));
    CHECK(run.out.ends_with(kGoodAnswer));
  }
  // A bad query is none.
  const Run query = folder.lorentz(
      "first-hit " + folder.write("q2", kScene + R"({"id":1,"x":[NaN,0],"v":[1,0]})" + "\n" + kGood));
  CHECK(query.out.ends_with(kGoodAnswer));
}

TEST_CASE("An unknown key is warned of once a stream; with --strict it is an error", "[cli][command_line]") {
  const Folder folder;
  const std::string misspelt = R"({"id":1,"x":[0.5,0],"v":[1,0],"form":{"lattice":0,"atom":0,"cell":[1,0]}})"
                               "\n";
  const auto queries = folder.write("q", kScene + misspelt + misspelt);
  const Run run = folder.lorentz("first-hit " + queries);
  CHECK(run.status == 0);
  CHECK(lines(run.out) == 2);
  CHECK(run.err == "lorentz: warning: " + queries +
                       ":2: the key \"form\" is not known (did you mean from?), and is ignored (--strict: an "
                       "error)\n");
  const Run strict = folder.lorentz("first-hit --strict " + queries);
  CHECK(strict.status == 2);
  CHECK(contains(strict.out, R"({"id":1,"outcome":"error","message":"the key \"form\" is not known)"));
  const auto answers = folder.write("a", R"({"id":"good","outcome":"never","tiem":1})"
                                         "\n");
  const std::string judged =
      "compare --queries " + folder.write("g", kScene + kGood) + " --answers mine=" + answers;
  CHECK(contains(folder.lorentz(judged).err, "a:1: the key \"tiem\" is not known (did you mean time?)"));
  CHECK(folder.lorentz(judged + " --strict").status == 2);
  const std::string both = kScene.substr(0, kScene.size() - 2) + R"(,"x":[0.5,0],"v":[1,0]})"
                                                                 "\n";
  CHECK(contains(folder.lorentz("first-hit " + folder.write("b", both)).err,
                 "\"a query in the line of a scene\" is not known"));
  CHECK(folder.lorentz("first-hit --strict " + folder.write("b", both)).status == 2);
  const auto scene = folder.write("s.toml", R"(dimension = 2
lattices = [{vectors = [[1, 0], [0, 1]], atoms = [{position = [0, 0], radius = 0.25, raduis = 0.3}]}])");
  CHECK(
      contains(folder.lorentz("scene show " + scene).err, R"(the key "lattices.atoms.raduis" is not known)"));
}

TEST_CASE("Files that are not there, folders, empty files, a full disk", "[cli][command_line]") {
  const Folder folder;
  CHECK(folder.lorentz("first-hit /no/such/file").status == 3);
  CHECK(contains(folder.lorentz("first-hit /no/such/file").err, "/no/such/file"));
  CHECK(folder.lorentz("first-hit /tmp").status == 3);
  CHECK(folder.lorentz("first-hit " + folder.write("q", "")).status == 2);
  CHECK(contains(folder.lorentz("first-hit " + folder.write("q", "\n\n")).err, "is empty"));
  CHECK(folder.lorentz("compare --scene /no/such/scene").status == 3);
  CHECK(folder.lorentz("compare --scene " + folder.write("s", "")).status == 2);
  CHECK(folder.lorentz("compare --count 10 --disagreements /no/such/folder/f").status == 3);
  const auto queries = folder.write("q", kScene + kGood);
  const int status = std::system(
      (std::string(LORENTZ_PROGRAM) + " first-hit " + queries + " >/dev/full 2>/dev/null").c_str());
  CHECK(WEXITSTATUS(status) == 3);
}

TEST_CASE("Bad usage", "[cli][command_line]") {
  const Folder folder;
  const auto queries = folder.write("q", kScene + kGood);
  for (const std::string& arguments :
       {std::string(""), std::string("no-such-command"), "first-hit --no-such-option " + queries,
        "first-hit --engine nobody " + queries, "first-hit --digits 0 " + queries,
        "first-hit --max-time soon " + queries, "first-hit --radius 0.1 " + queries,
        std::string("compare --radius 0 --scene square"), std::string("compare --radius nan --scene square"),
        std::string("compare --answers nofile"), std::string("convergents one"),
        std::string("convergents 1 0")}) {
    const Run run = folder.lorentz(arguments);
    INFO(arguments << "\n" << run.out << run.err);
    CHECK(run.status == 2);
    CHECK_FALSE(run.err.empty());
  }
  for (const char* help : {"--help", "first-hit --help", "compare --help", "convergents --help", "--version"})
    CHECK(folder.lorentz(help).status == 0);
}

TEST_CASE("Mistyped subcommands, options, scenes and engines get the nearest name", "[cli][command_line]") {
  const Folder folder;
  const auto said = [&](const std::string& arguments, int status) {
    const Run run = folder.lorentz(arguments);
    CHECK(run.status == status);
    return run.err;
  };
  CHECK(
      contains(said("compair", 2), "no subcommand is called \"compair\" (did you mean compare?); there are"));
  CHECK(contains(said("golden verfy", 2), "(did you mean verify?)"));
  CHECK(contains(said("compare --engin classical", 2),
                 "no such option: --engin (did you mean --engine?); lorentz compare --help has all"));
  CHECK(contains(said("golden check --ulsp 3", 2),
                 "--ulsp (did you mean --ulps?); lorentz golden check --help"));
  CHECK(contains(said("compare --count 1 --scene sqare", 3), "(did you mean square?)"));
  CHECK(contains(said("golden check -e reduction near-ratonal", 3), "(did you mean near-rational?)"));
  for (const char* command : {"first-hit", "compare", "bench", "golden check", "fuzz --time 1"}) {
    INFO(command);
    CHECK(contains(said(std::string(command) + " -e bacth", 2),
                   "no engine is called \"bacth\" (did you mean batch?); there are classical, "));
    CHECK_FALSE(contains(said(std::string(command) + " -e nobody", 2), "did you mean"));
  }
}

TEST_CASE("Without a subcommand the help is shown; every help has an example", "[cli][command_line]") {
  const Folder folder;
  for (const std::string bare : {"", "golden", "scene"}) {
    const Run run = folder.lorentz(bare), help = folder.lorentz(bare + " --help");
    CHECK(run.status == 2);
    CHECK(contains(run.out, "Subcommands:\n"));
    CHECK(run.out == help.out);
  }
  for (const char* command : {"",
                              "first-hit",
                              "compare",
                              "convergents",
                              "horizon",
                              "sample",
                              "demo",
                              "bench",
                              "scene",
                              "scene list",
                              "scene show",
                              "scene draw",
                              "fuzz",
                              "fuzz list",
                              "fuzz show",
                              "fuzz export",
                              "fuzz merge",
                              "golden",
                              "golden make",
                              "golden check",
                              "golden verify",
                              "golden explain",
                              "golden list"}) {
    INFO(command);
    CHECK(contains(folder.lorentz(std::string(command) + " --help").out, "Example"));
  }
}

TEST_CASE("A wrong LORENTZ_DATA is an error; without a catalogue it is said where it was looked for",
          "[cli][command_line]") {
  const Folder folder;
  const auto with_data = [&](const std::string& data, const std::string& arguments) {
    return folder.run("LORENTZ_DATA=" + data + " " LORENTZ_PROGRAM " " + arguments);
  };
  for (const char* arguments : {"scene list", "compare --count 1", "golden list"}) {
    const Run run = with_data("/no/such/folder", arguments);
    CHECK(run.status == 3);
    CHECK(contains(run.err, "LORENTZ_DATA is /no/such/folder, which has no folder scenes or golden"));
  }
}

TEST_CASE("A closed or full stderr loses messages and nothing else", "[cli][command_line]") {
  const Folder folder;
  const auto queries = folder.write("q", kScene + kGood + "bad\n" + kGood);
  for (const std::string redirection : {"2>&-", "2>/dev/full"}) {
    const int status = std::system(
        (std::string(LORENTZ_PROGRAM) + " first-hit " + queries + " >" + folder.file("o") + " " + redirection)
            .c_str());
    REQUIRE(WIFEXITED(status));
    CHECK(WEXITSTATUS(status) == 2);
    CHECK(lines(folder.read("o")) == 3);
  }
}

TEST_CASE("Output that does not arrive is a failure, in every subcommand", "[cli][command_line]") {
  const Folder folder;
  for (const char* arguments :
       {"--version", "--help", "compare --count 10", "compare --count 10 --json", "convergents 1.5"}) {
    INFO(arguments);
    const int status =
        std::system((std::string(LORENTZ_PROGRAM) + " " + arguments + " >/dev/full 2>/dev/null").c_str());
    REQUIRE(WIFEXITED(status));
    CHECK(WEXITSTATUS(status) == 3);
  }
}

TEST_CASE("Counts and seeds out of range, scenes that cannot be drawn from", "[cli][command_line]") {
  const Folder folder;
  const auto full = folder.write("s",
                                 "dimension = 2\nlattices = [{vectors = [[1, 0], [0, 1]], atoms = "
                                 "[{position = [0, 0], semiaxes = [[1, 0], [0, 2]]}]}]\n");
  for (const std::string& arguments :
       {std::string("compare --count -1"), std::string("compare --count 99999999999999999999999"),
        std::string("compare --count 1.5"), std::string("compare --seed -1"),
        std::string("compare --seed 18446744073709551616"), "compare --count 5 --scene " + full,
        std::string("compare --radius 0.75 --count 5"), std::string("convergents 1.5 --limit 0")}) {
    const Run run = folder.lorentz(arguments);
    INFO(arguments << run.err);
    CHECK(run.status == 2);
    CHECK(contains(run.err, "lorentz: "));
  }
  CHECK(folder.lorentz("compare --engine reduction --count 1e2 --seed 18446744073709551615").status == 0);
}

TEST_CASE("A scene whose obstacles overlap or touch is answered, with a warning", "[cli][command_line]") {
  const Folder folder;
  const auto run = [&](const char* radius) {
    return folder.lorentz("first-hit --scene square --radius " + std::string(radius) + " " +
                          folder.write("q", kGood));
  };
  CHECK(run("0.4").err.empty());
  CHECK(contains(run("0.5").err, "touch"));
  CHECK(contains(run("0.6").err, "overlap"));
  CHECK(run("0.5").status == 0);
  // Obstacles of two lattices always overlap somewhere.
  CHECK(folder.lorentz("first-hit --scene superposition-pi-5 " + folder.write("q", kGood)).err.empty());
  CHECK(run("0.5").out ==
        "{\"id\":\"good\",\"outcome\":\"hit\",\"lattice\":0,\"atom\":0,\"cell\":[1,0],\"time\":0}\n");
}

TEST_CASE("compare finds the wrong answers, in a table, in JSON and in a file that can be run again",
          "[cli][command_line]") {
  const Folder folder;
  const std::string skipped =
      R"({"scene":{"dimension":2,"lattices":[{"vectors":[[1,0],[0,1]],"atoms":[{"position":[0,0],"radius":0.2}]}]}})"
      "\n"
      R"({"id":"skip","x":[-0.04390243902439025,0.1951219512195122],"v":[9,5],"from":{"lattice":0,"atom":0,"cell":[0,0]}})"
      "\n";
  const auto queries = folder.write("q", skipped + kGood);
  const Run run = folder.lorentz("compare --queries " + queries +
                                 " --engine classical,published --disagreements " + folder.file("d"));
  INFO(run.out << run.err << folder.read("d"));
  CHECK(run.status == 1);
  CHECK(contains(run.out, "published"));
  CHECK(contains(run.out, "1 (100 %)"));
  CHECK(lines(folder.read("d")) == 2);
  CHECK(contains(folder.read("d"), R"("engine":"published","verdict":"wrong","departs":)"));
  CHECK(contains(folder.read("d"),
                 R"("expected":{"id":"skip","outcome":"hit","lattice":0,"atom":0,"cell":[1,1])"));
  CHECK(folder.lorentz("compare --queries " + folder.file("d") + " --engine published").status == 1);
  CHECK(folder.lorentz("compare --queries " + folder.file("d") + " --engine classical").status == 0);

  const Run json = folder.lorentz("compare --json --queries " + queries + " --engine published");
  CHECK(json.status == 1);
  CHECK(contains(
      json.out,
      R"("engines":[{"engine":"published","queries":2,"agree":0,"ill_posed":0,"wrong":1,"undecided":0,"unsupported":1,"error":0,"missing":0,)"));
  CHECK(contains(json.out, "\"ns_median\":"));
}

TEST_CASE("compare: a wrong time has its own column, and counts with --times only", "[cli][command_line]") {
  const Folder folder;
  const auto queries = folder.write("q", kScene + kGood);
  const auto logged = [&](const std::string& answer, const std::string& more) {
    const auto answers = folder.write("a", R"({"id":"good",)" + answer + "}\n");
    return folder.lorentz("compare --queries " + queries + " --answers mine=" + answers + " " + more);
  };
  const std::string late = R"("outcome":"hit","lattice":0,"atom":0,"cell":[1,0],"time":0.25000000001)";
  CHECK(logged(late, "").status == 0);
  CHECK(logged(late, "--times").status == 1);
  const Run json = logged(late, "--json");
  CHECK(contains(json.out, R"("agree":1,"ill_posed":0,"wrong":0,)"));
  CHECK(
      contains(json.out, R"("wrong_time":1,"wrong_time_ulps":{"median":180144,"p99":180144,"max":180144})"));
  CHECK(contains(logged(late, "").out, "mine: no wrong answer in 1 "));
  CHECK(contains(logged(late, "").out, "  1 wrong time of right obstacles: off by "));
  // Another quantity, such as the time to the obstacle's far side, is no time of that collision.
  const std::string through = R"("outcome":"hit","lattice":0,"atom":0,"cell":[1,0],"time":0.75)";
  CHECK(logged(through, "").status == 1);
  CHECK(contains(logged(through, "--json").out, R"("agree":0,"ill_posed":0,"wrong":1,)"));
  // Zero is a tolerance, here as elsewhere.
  CHECK(logged(late, "--times --ulps 0").status == 1);
  CHECK(logged(late, "--ulps -1").status == 2);
  const Run file = logged(late, "--times --disagreements " + folder.file("d"));
  CHECK(contains(folder.read("d"), R"("verdict":"wrong-time")"));
  CHECK(logged(late, "--disagreements " + folder.file("d")).status == 0);
  CHECK(lines(folder.read("d")) == 1);  // the scene alone
}

TEST_CASE("compare: errors and missing answers count with --strict", "[cli][command_line]") {
  const Folder folder;
  const auto judged = [&](const std::string& answers, const std::string& more) {
    return folder
        .lorentz("compare --queries " + folder.write("q", kScene + kGood) +
                 " --answers mine=" + folder.write("a", answers) + more)
        .status;
  };
  const std::string error = R"({"id":"good","outcome":"error","message":"no"})"
                            "\n";
  CHECK(judged(error, "") == 0);
  CHECK(judged(error, " --strict") == 1);
  CHECK(judged(kGoodAnswer, " --strict") == 0);
  const auto two = folder.write("two", kScene + kGood + R"({"id":2,"x":[0.5,0.1],"v":[1,0]})");
  const std::string half = "compare --queries " + two + " --answers mine=" + folder.write("a", kGoodAnswer);
  CHECK(folder.lorentz(half).status == 0);
  CHECK(folder.lorentz(half + " --strict").status == 1);
}

TEST_CASE("compare shows the first wrong answers, and by how much", "[cli][command_line]") {
  const Folder folder;
  const auto queries = folder.write("q", kScene + kGood);
  const auto logged = [&](const std::string& answer) {
    const auto answers = folder.write("a", R"({"id":"good",)" + answer + "}\n");
    return folder.lorentz("compare --queries " + queries + " --answers mine=" + answers).out;
  };
  CHECK(contains(logged(R"("outcome":"hit","lattice":0,"atom":0,"cell":[2,0],"time":1.25)"),
                 "the line meets lattice 0, atom 0, cell (1, 0) by 1 of its radii, and enters it first\n"));
  CHECK(contains(logged(R"("outcome":"never")"),
                 "the line meets lattice 0, atom 0, cell (1, 0) by 1 of its radii\n"));
  CHECK(contains(logged(R"("outcome":"hit","lattice":0,"atom":0,"cell":[1,1],"time":0.5)"),
                 "the line misses lattice 0, atom 0, cell (1, 1) by 3 of its radii\n"));
  CHECK(contains(logged(R"("outcome":"hit","lattice":0,"atom":0,"cell":[0,0],"time":0)"),
                 "lattice 0, atom 0, cell (0, 0) lies behind the start\n"));
  CHECK(contains(logged(R"("outcome":"inside","lattice":0,"atom":0,"cell":[0,0])"),
                 "x lies outside of lattice 0, atom 0, cell (0, 0) by 1 of its radii\n"));
}

TEST_CASE("compare judges answers that were logged elsewhere", "[cli][command_line]") {
  const Folder folder;
  const auto queries = folder.write("q", kScene + kGood +
                                             R"({"id":2,"x":[0,0.5],"v":[1,0]})"
                                             "\n" +
                                             R"({"id":3,"x":[0.5,0],"v":[-1,0]})"
                                             "\n");
  const auto answers =
      folder.write("a", kGoodAnswer + R"({"id":2,"outcome":"hit","lattice":0,"atom":0,"cell":[9,9]})"
                                      "\n");
  const Run run = folder.lorentz("compare --json --queries " + queries + " --answers mine=" + answers);
  INFO(run.out << run.err);
  CHECK(run.status == 1);
  CHECK(contains(
      run.out,
      R"("engine":"mine","queries":3,"agree":1,"ill_posed":0,"wrong":1,"undecided":0,"unsupported":0,"error":0,"missing":1)"));
  const Run twice = folder.lorentz("compare --queries " + queries +
                                   " --answers mine=" + folder.write("a2", kGoodAnswer + kGoodAnswer));
  CHECK(twice.status == 2);
  CHECK(contains(twice.err, "a2:2: "));
  CHECK(folder
            .lorentz("compare --queries " + queries +
                     " --answers mine=" + folder.write("a3", "rubbish\n" + kGoodAnswer))
            .status == 2);
  CHECK(folder.lorentz("compare --queries " + queries + " --answers mine=/no/such/file").status == 3);
  // The wrong file: none of its answers is to one of these queries.
  const Run other = folder.lorentz("compare --queries " + queries + " --answers mine=" +
                                   folder.write("a4", R"({"id":"x","outcome":"never"})"
                                                      "\n"));
  CHECK(other.status == 2);
  CHECK(contains(other.err, "no answer matches any query"));
  // Ids that come twice in the queries cannot be matched; lines without an id are passed over.
  CHECK(folder
            .lorentz("compare --queries " + folder.write("q2", kScene + kGood + kGood) +
                     " --answers mine=" + folder.write("a5", kGoodAnswer))
            .status == 2);
  const std::string error = R"({"id":null,"outcome":"error","message":"not JSON"})"
                            "\n";
  CHECK(folder
            .lorentz("compare --queries " + folder.write("q3", kScene + kGood) +
                     " --answers mine=" + folder.write("a6", error + kGoodAnswer + error))
            .status == 0);
}

TEST_CASE("compare accuses nobody where it cannot judge", "[cli][command_line]") {
  const Folder folder;
  const auto answers = folder.write("a", kGoodAnswer);
  // A cell of another dimension is bad input, neither right nor wrong.
  const std::string solid =
      R"({"scene":{"dimension":3,"lattices":[{"vectors":[[1,0,0],[0,1,0],[0,0,1]],"atoms":[{"position":[0,0,0],"radius":0.25}]}]}})"
      "\n";
  const Run flat = folder.lorentz("compare --json --queries " +
                                  folder.write("q3", solid + R"({"id":"good","x":[0.5,0,0],"v":[1,0,0]})"
                                                             "\n") +
                                  " --answers mine=" + answers);
  CHECK(flat.status == 2);
  CHECK(contains(flat.err, "a:1: cell: has 2 components"));
  CHECK(contains(flat.out, R"("agree":0,"ill_posed":0,"wrong":0)"));
  // Answers to drawn queries there cannot be.
  CHECK(folder.lorentz("compare --count 5 --answers mine=" + answers).status == 2);
  // Bad input counts more than a wrong answer.
  const auto wrong = folder.write("w", R"({"id":"good","outcome":"never"})"
                                       "\n");
  CHECK(folder.lorentz("compare --queries " + folder.write("q4", kScene + kGood) + " --answers mine=" + wrong)
            .status == 1);
  CHECK(folder
            .lorentz("compare --queries " + folder.write("q5", kScene + kGood + "bad\n") +
                     " --answers mine=" + wrong)
            .status == 2);
  const Run timed = folder.lorentz("compare --no-oracle --json --count 20 --engine classical");
  CHECK(timed.status == 0);
  CHECK(contains(timed.out, R"("queries":20,"agree":null)"));
}

TEST_CASE("The paper's example has a direction that is not what it seems", "[cli][command_line]") {
  const Folder folder;
  const std::string file =
      std::string(LORENTZ_SOURCE_DIR) + "/data/examples/paper-89-directions.queries.ndjson";
  const Run exact = folder.lorentz("first-hit " + file),
            published = folder.lorentz("first-hit --engine published " + file);
  CHECK(lines(exact.out) == 89);
  CHECK(contains(
      exact.out,
      R"({"id":45,"outcome":"hit","lattice":0,"atom":0,"cell":[1933508068799870,1933508068799870],"time":2734393333854587})"));
  CHECK(contains(published.out, R"({"id":45,"outcome":"never"})"));
}

TEST_CASE("Names of scenes: the catalogue, files, and neither", "[cli][command_line]") {
  const Folder folder;
  CHECK(folder.lorentz("compare --count 5 --scene cubic --engine classical").status == 0);
  CHECK(folder.lorentz("compare --count 5 --scene " + std::string(5000, 'x')).status == 3);
  fs::create_directory(folder.file("scenes"));
  folder.write("scenes/mine.toml",
               "dimension = 2\nlattices = [{vectors = [[2, 0], [0, 2]], atoms = [{position = [0, 0], radius "
               "= 0.5}]}]\n");
  const std::string command = "LORENTZ_DATA=" + folder.file("") + " " + LORENTZ_PROGRAM +
                              " compare --count 5 --scene mine --engine oracle >/dev/null 2>&1";
  CHECK(WEXITSTATUS(std::system(command.c_str())) == 0);
  CHECK(contains(folder.lorentz("first-hit --scene square " + folder.write("q", kScene + kGood)).err,
                 "takes the place of --scene"));
}

TEST_CASE("compare --judge certified: the same verdicts, and none of what rests on reduction",
          "[cli][command_line]") {
  const Folder folder;
  const std::string arguments =
      "compare --scene cubic --radius 0.1 --count 3000 --seed 5 --engine published --times";
  const auto departures = [&](const std::string& judge) {
    const std::string file = folder.file(judge);
    const Run run = folder.lorentz(arguments + " --judge " + judge + " --disagreements " + file);
    CHECK(run.status == 1);
    CHECK(contains(run.out, ", judged by certified") == (judge == "certified"));
    return folder.read(judge);
  };
  const std::string by_oracle = departures("oracle");
  CHECK(contains(by_oracle, "\"wrong\""));
  CHECK(departures("certified") == by_oracle);
  const auto refused = [&](const std::string& more) {
    const Run run = folder.lorentz("compare --count 3 --judge " + more);
    CHECK(run.status == 2);
    return run.err;
  };
  for (const char* engine : {"reduction", "certified", "batch", "certified-batch"})
    CHECK(contains(refused("certified -e published," + std::string(engine)),
                   "no judge of the engine " + std::string(engine) + "; use oracle"));
  CHECK(contains(refused("nobody"), "\"nobody\" is none; there are oracle and certified"));
  CHECK(contains(refused("certified --no-oracle -e walk"), "nobody is judged with --no-oracle"));
}

TEST_CASE("compare is repeatable, and --strict counts undecided answers", "[cli][command_line]") {
  const Folder folder;
  const std::string arguments =
      "compare --scene cubic --radius 0.2 --count 300 --engine oracle,reduction --seed 5";
  const Run first = folder.lorentz(arguments + " --json"), second = folder.lorentz(arguments + " --json");
  CHECK(first.status == 0);
  CHECK(first.out.substr(0, first.out.find("ns_per_query")) ==
        second.out.substr(0, second.out.find("ns_per_query")));
  const auto never = folder.write("q", kScene + R"({"id":2,"x":[0,0.5],"v":[1,0]})"
                                                "\n");
  CHECK(folder.lorentz("compare --engine classical --queries " + never).status == 0);
  CHECK(folder.lorentz("compare --engine classical --strict --queries " + never).status == 1);
}

TEST_CASE("convergents prints the expansion", "[cli][command_line]") {
  const Folder folder;
  const Run run = folder.lorentz("convergents 3.141592653589793");
  CHECK(run.status == 0);
  CHECK(contains(run.out, "292"));
  CHECK(contains(run.out, "355  "));
  const Run json = folder.lorentz("convergents --json 3 2");
  CHECK(
      json.out ==
      R"({"rise":3,"run":2,"convergents":[{"a":1,"p":1,"q":1,"remainder":0.5,"remainder_exact":"1/2"},{"a":2,"p":3,"q":2,"remainder":0,"remainder_exact":"0"}],"complete":true})"
      "\n");
  CHECK(folder.lorentz("convergents 0x1.8p+0").out == folder.lorentz("convergents 1.5").out);
  CHECK(folder.lorentz("convergents -- -1.5").status == 0);
  CHECK(contains(folder.lorentz("convergents 3.14159 --limit 3").out, "stopped after --limit 3"));
}

TEST_CASE("bench measures, concludes, and writes its figures", "[cli][command_line]") {
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
  CHECK(contains(csv, "scene,radius,difficulty,engine,queries,ns_mean"));
  CHECK(folder.lorentz("bench --engine nobody").status == 2);
  CHECK(folder.lorentz("bench --count 3").status == 2);
  CHECK(folder.lorentz("bench --scene square --radius 0.1 --count 32 --csv /nowhere/speed.csv").status == 3);
}

TEST_CASE("bench counts wrong times apart from wrong answers", "[cli][command_line]") {
  const Folder folder;
  const Run run = folder.lorentz("bench --scene square --radius 0.01 --count 64 --engine published");
  INFO(run.out);
  CHECK(contains(run.out, "published: no wrong answer in "));
  CHECK(contains(run.out, " wrong times of right obstacles: off by "));
}

TEST_CASE("bench takes scenes with semiaxes at their own size", "[cli][command_line]") {
  const Folder folder;
  const Run run =
      folder.lorentz("bench --scene ellipse --engine reduction --count 32 --csv " + folder.file("c"));
  INFO(run.out << run.err);
  CHECK(run.status == 0);
  CHECK(contains(folder.read("c"), "ellipse,own,drawn,reduction,"));
  CHECK(folder.lorentz("bench --scene ellipse --radius 0.1 --engine reduction --count 32").status == 2);
}
