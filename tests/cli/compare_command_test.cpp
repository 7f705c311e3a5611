// lorentz compare as its users call it: verdicts, where they go, and its exit status.
#include "tests/support/command_line.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <numeric>
#include <random>
#include <sstream>

#include "tests/support/npy.hpp"

using namespace lorentz::test;

TEST_CASE("compare finds the wrong answers, in a table, in JSON and in a file that can be run again",
          "[cli][compare_command]") {
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
      R"("engines":[{"engine":"published","queries":2,"agree":0,"ill_posed":0,"wrong":1,"wrong_time":0,"other_quantity":0,"undecided":0,"unsupported":1,"error":0,"missing":0,)"));
  CHECK(contains(json.out, "\"ns_median\":"));
}

TEST_CASE("compare: a wrong time has its own column, and counts with --times only",
          "[cli][compare_command]") {
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
  CHECK(contains(json.out, R"("wrong_time_ulps":{"median":180144,"p99":180144,"max":180144})"));
  CHECK(contains(logged(late, "").out, "mine: no wrong answer in 1 "));
  CHECK(contains(logged(late, "").out, "  1 wrong time of right obstacles: off by "));
  // Another quantity, such as the time to the obstacle's far side, is not a time of that collision: that is
  // told first.
  const std::string through = R"("outcome":"hit","lattice":0,"atom":0,"cell":[1,0],"time":0.75)";
  CHECK((logged(through, "").status == 0 && logged(through, "--times").status == 1));
  CHECK(contains(logged(through, "").out, "mine: no wrong answer in 1 "));
  CHECK(contains(logged(through, "").out, " of such questions); in 1 the time is another quantity\n"));
  CHECK(contains(logged(through, "--json").out, R"("agree":1,"ill_posed":0,"wrong":0,)"));
  CHECK(contains(logged(through, "--json").out, R"("wrong_time":1,"other_quantity":1,)"));
  // Zero is a tolerance, here as elsewhere.
  CHECK(logged(late, "--times --ulps 0").status == 1);
  CHECK(logged(late, "--ulps -1").status == 2);
  const Run file = logged(late, "--times --disagreements " + folder.file("d"));
  CHECK(contains(folder.read("d"), R"("verdict":"wrong-time")"));
  CHECK(logged(late, "--disagreements " + folder.file("d")).status == 0);
  CHECK(lines(folder.read("d")) == 1);  // the scene alone
}

TEST_CASE("compare: errors and missing answers are failures, undecided ones with --strict",
          "[cli][compare_command]") {
  const Folder folder;
  const auto judged = [&](const std::string& answers, const std::string& more) {
    return folder
        .lorentz("compare --queries " + folder.write("q", kScene + kGood) +
                 " --answers mine=" + folder.write("a", answers) + more)
        .status;
  };
  const std::string error = R"({"id":"good","outcome":"error","message":"no"})"
                            "\n";
  const std::string undecided = R"({"id":"good","outcome":"undecided"})"
                                "\n";
  CHECK(judged(error, "") == 1);
  CHECK((judged(undecided, "") == 0 && judged(undecided, " --strict") == 1));
  CHECK(judged(kGoodAnswer, " --strict") == 0);
  const auto two = folder.write("two", kScene + kGood + R"({"id":2,"x":[0.5,0.1],"v":[1,0]})");
  const std::string half = "compare --queries " + two + " --answers mine=" + folder.write("a", kGoodAnswer);
  CHECK(folder.lorentz(half).status == 1);
}

TEST_CASE("compare shows the first wrong answers, and by how much", "[cli][compare_command]") {
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
  const auto on_surface = folder.write(  // of the disc behind
      "on", kScene + R"({"id":"good","x":[0.25,0],"v":[1,0]})" + "\n");
  const auto behind =
      folder.write("b", R"({"id":"good","outcome":"hit","lattice":0,"atom":0,"cell":[0,0],"time":0})"
                        "\n");
  CHECK(contains(folder.lorentz("compare --queries " + on_surface + " --answers mine=" + behind).out,
                 "lattice 0, atom 0, cell (0, 0) lies behind the start\n"));
  CHECK(contains(logged(R"("outcome":"inside","lattice":0,"atom":0,"cell":[0,0])"),
                 "x lies outside of lattice 0, atom 0, cell (0, 0) by 1 of its radii\n"));
}

TEST_CASE("compare shows the requested number of wrong answers", "[cli][compare_command]") {
  const Folder folder;
  std::string queries = kScene, answers;
  for (int i = 0; i < 4; ++i) {
    queries += R"({"id":)" + std::to_string(i) + R"(,"x":[0.5,0.)" + std::to_string(i + 1) +
               R"(],"v":[1,0]})" + "\n";
    answers += R"({"id":)" + std::to_string(i) +
               R"(,"outcome":"hit","lattice":0,"atom":0,"cell":[7,7],"time":9})" + "\n";
  }
  const std::string asked = "compare --queries " + folder.write("q", queries) +
                            " --answers mine=" + folder.write("a", answers) + " --failures ";
  for (const int most : {0, 1, 3, 9}) {
    const std::string out = folder.lorentz(asked + std::to_string(most)).out;
    CHECK(count_of(out, "(7, 7) by") == static_cast<std::size_t>(std::min(most, 4)));
  }
}

TEST_CASE("compare: the share of wrong answers, and nothing else where there is nothing",
          "[cli][compare_command]") {
  const Folder folder;
  std::string queries = kScene + kGood, answers = kGoodAnswer;
  for (const std::string id : {"2", "3"}) {
    queries += R"({"id":)" + id + R"(,"x":[0.5,0],"v":[-1,0]})" + '\n';
    answers += R"({"id":)" + id + R"(,"outcome":"hit","lattice":0,"atom":0,"cell":[9,9]})" + '\n';
  }
  const std::string asked = "compare --queries " + folder.write("q", queries) + " --answers mine=",
                    out = folder.lorentz(asked + folder.write("a", answers)).out;
  INFO(out);
  CHECK(contains(out, " 2 (66.7 %) "));
  CHECK(contains(out, "mine: wrong in 2 of 3 answers\n"));
}

TEST_CASE("compare asks all that it is told to, in scene after scene", "[cli][compare_command]") {
  const Run run =
      Folder().lorentz("compare -e reduction --scene square --radius 0.1,0.2 --count 20001 --json");
  CHECK(run.status == 0);
  CHECK(contains(run.out, "\"queries\":40002,"));
}

TEST_CASE("compare judges answers that were logged elsewhere", "[cli][compare_command]") {
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
      R"("engine":"mine","queries":3,"agree":1,"ill_posed":0,"wrong":1,"wrong_time":0,"other_quantity":0,"undecided":0,"unsupported":0,"error":0,"missing":1)"));
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
  // A file that is empty is said to be that, and nothing else.
  const Run none =
      folder.lorentz("compare --queries " + queries + " --answers mine=" + folder.write("a5", ""));
  CHECK(none.status == 2);
  CHECK(contains(none.err, "is empty"));
  CHECK_FALSE(contains(none.err, "no answer matches any query"));
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

TEST_CASE("compare: answers that a program wrote may end with the time of its own calls",
          "[cli][compare_command]") {
  const Folder folder;
  const std::string queries = folder.write("q", kScene + kGood);
  const auto with = [&](const std::string& seconds) {
    const std::string answers =
        std::string(kGoodAnswer) + "{\"engine_time\":{\"seconds\":" + seconds + ",\"queries\":1}}\n";
    return folder.lorentz("compare --json --queries " + queries +
                          " --answers mine=" + folder.write("a", answers));
  };
  const Run run = with("0.5");
  CHECK(run.status == 0);
  CHECK(run.err.empty());
  CHECK(contains(run.out, "\"engine_ns\":5e+08,"));
  const Run bad = with("-1");
  CHECK(bad.status == 2);
  CHECK(contains(bad.err, "a:2: engine_time: seconds is below zero"));
  CHECK(contains(with("0.5,\"query\":1").err, "a:2: the key \"engine_time.query\" is not known"));
}

TEST_CASE("compare and golden check judge by what an engine claims", "[cli][compare_command]") {
  const Folder folder;
  // The time is right in binary32, and has an error of 2^25 ulps of binary64; the third query has other numbers.
  const auto queries = folder.write("q", kScene + R"({"id":1,"x":[0.5,0.125],"v":[1,0]})"
                                                  "\n"
                                                  R"({"id":2,"x":[0.5,0.1],"v":[1,0]})"
                                                  "\n");
  const auto answers =
      folder.write("a", R"({"id":1,"outcome":"hit","lattice":0,"atom":0,"cell":[1,0],"time":0.28349366})"
                        "\n"
                        R"({"id":2,"outcome":"hit","lattice":0,"atom":0,"cell":[7,0],"time":1})"
                        "\n");
  const auto said = [&](const std::string& claim) {
    return folder.lorentz("compare --queries " + queries + " --answers mine=" + answers + claim);
  };
  CHECK(contains(said(" --json").out, R"("precision":"binary64","time_tolerance":null,"not_asked":0,)"));
  const Run single = said(" --precision binary32 --json");
  CHECK(single.err.empty());
  CHECK(single.status == 0);
  CHECK(contains(
      single.out,
      R"("precision":"binary32","time_tolerance":null,"not_asked":1,"outside_domain":0,"engines":[{"engine":"mine","queries":1,"agree":1,)"));
  CHECK(contains(single.out, R"("wrong_time":0,)"));
  CHECK(contains(said(" --precision binary32").out, "1 given queries, in binary32\n1 more were not asked"));
  const auto limited =
      folder.write("limited", kScene + R"({"id":1,"x":[0.5,0.125],"v":[1,0],"max_time":0.1})"
                                       "\n"
                                       R"({"id":2,"x":[0.5,0.125],"v":[1,0],"max_time":0.125})");
  CHECK(contains(folder.lorentz("compare --json -e oracle --precision binary32 --queries " + limited).out,
                 R"("not_asked":1,)"));
  CHECK(contains(said(" --time-tolerance 1e-6 --json").out, R"("time_tolerance":1e-06,)"));
  CHECK(contains(said(" --time-tolerance 1e-6 --json").out, R"("wrong_time":0,)"));
  CHECK(contains(said(" --time-tolerance 1e-9 --json").out, R"("wrong_time":1,)"));
  CHECK(contains(said(" --time-tolerance inf --json").out, R"("time_tolerance":"inf",)"));
  CHECK(contains(said(" --time-tolerance inf").out, ", times not judged\n"));
  for (const char* bad : {" --precision float", " --time-tolerance -1", " --time-tolerance few"})
    CHECK(said(bad).status == 2);
  const Run nothing = folder.lorentz("compare --precision binary32 --radius 1e-50 --count 3");
  CHECK(nothing.status == 2);
  CHECK(contains(nothing.err, "square: rounded to binary32: "));

  const Run check = folder.lorentz("golden check -e oracle --precision binary32 --json ball-3d");
  CHECK(contains(check.out, R"("sets":[{"set":"ball-3d","records":17,"agree":17,)"));
  CHECK(contains(check.out, R"("not_asked":623,)"));
  CHECK(contains(
      check.out,
      R"("precision":"binary32","time_tolerance":null,"records_not_asked":623,"records_outside_domain":0,"not_asked":0})"));
  CHECK(contains(folder.lorentz("golden check -e oracle --precision binary32 ball-3d").out,
                 "623 records were not asked: their numbers are of another precision"));
}

TEST_CASE("compare: single obstacles have cells without coordinates, which columns leave empty or zero",
          "[cli][compare_command]") {
  const Folder folder;
  const std::string scene = folder.write(
      "ball.json", R"({"dimension":2,"lattices":[{"vectors":[],"atoms":[{"position":[10,0],"radius":1}]}]})");
  const std::string queries = folder.write("q.csv", "x1,x2,v1,v2\n0,0,1,0\n");
  const auto judged = [&](const std::string& row) {
    const std::string answers = folder.write("a.csv", "outcome,lattice,atom,cell1,cell2,time\n" + row + "\n");
    return folder.lorentz("compare --scene " + scene + " --queries " + queries + " --answers A=" + answers);
  };
  for (const char* row : {"hit,0,0,,,9", "hit,0,0,0,0,9"}) {
    INFO(row);
    CHECK(judged(row).status == 0);
    CHECK(contains(judged(row).out, "no wrong answer in 1"));
  }
  CHECK(judged("hit,0,0,5,7,9").status == 2);
  CHECK(contains(judged("hit,0,0,5,7,9").err, "cell: has 2 components, the lattice has 0 vectors"));
  CHECK(judged("hit,7,0,0,0,9").status == 1);  // a lattice that is not there is a wrong answer
  const Run answered =
      folder.lorentz("first-hit --format csv --scene " + scene + " --engine batch " + queries);
  CHECK(answered.out == "outcome,lattice,atom,cell1,cell2,time\nhit,0,0,,,9\n");
}

TEST_CASE("compare accuses no engine where it cannot judge", "[cli][compare_command]") {
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
  CHECK(contains(flat.out, R"("error":0,"missing":1)"));  // as a program's invalid line
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
}

TEST_CASE("compare is repeatable, and --strict counts undecided answers", "[cli][compare_command]") {
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

TEST_CASE("demo: one sentence, a row for each engine whose counts add up, and commands that work",
          "[cli][compare_command]") {
  const Folder folder;
  const Run demo = folder.lorentz("demo");
  REQUIRE(demo.status == 0);
  CHECK(demo.out.starts_with("The published algorithm gets 53 of 95189 first hits wrong ("));
  CHECK(contains(demo.out, ", the exact oracle none ("));
  CHECK(contains(demo.out, ", certified-batch none ("));
  std::map<std::string, std::vector<std::size_t>> rows;  // right, wrong time, ill-posed, wrong, undecided
  std::istringstream lines(demo.out);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string name;
    std::vector<std::size_t> counts(5);
    words >> name;
    for (std::size_t& count : counts) words >> count;
    if (words) rows[name] = counts;
  }
  CHECK(rows.size() == 6);
  for (const auto& [name, counts] : rows) {
    INFO(name);
    CHECK(std::accumulate(counts.begin(), counts.end(), std::size_t{0}) == 95189);
  }
  CHECK(rows["published"] == std::vector<std::size_t>{62088, 33047, 1, 53, 0});
  CHECK(rows["certified"] == std::vector<std::size_t>{95189, 0, 0, 0, 0});
  // The first of the commands at the end takes minutes.
  std::istringstream rest(demo.out.substr(demo.out.find("  lorentz first-hit")));
  std::string first_hit, trajectory;
  std::getline(rest, first_hit), std::getline(rest, trajectory);
  CHECK(
      contains(folder.lorentz(first_hit.substr(10, first_hit.find("   ", 10) - 10)).out, "\"cell\":[26,1]"));
  CHECK(folder.run("cd " + folder.file("") + " && " LORENTZ_PROGRAM + trajectory.substr(9)).status == 0);
  CHECK(contains(folder.read("path.svg"), "<svg"));
}

TEST_CASE("Files of disagreements are read by the command that help and the last line advertise",
          "[cli][compare_command]") {
  const Folder folder;
  const std::string path = folder.file("wrong.ndjson");
  const auto read_back = [&](const std::string& how) {
    const Run run = folder.lorentz("compare --json --queries " + path + " -e classical");
    INFO(how << ": " << run.err);
    CHECK(run.status == 0);
    CHECK(run.err.find("not JSON") == std::string::npos);
    const std::size_t at = run.out.find("\"queries\":") + 10;
    return run.out.substr(at, run.out.find(',', at) - at);
  };
  // Ids of all kinds, some of which say things to terminals.
  folder.write(
      "q", kScene + R"({"id":"\"quoted\"\n\u001b[31m\u009b\u202e M\u00fcnchen","x":[0.5,0.1],"v":[1,0.3]})"
                    "\n"
                    R"({"id":17,"x":[0.5,0.1],"v":[1,0.3]})"
                    "\n"
                    R"({"x":[0.5,0.1],"v":[1,0.3]})"
                    "\n");
  folder.write("answers", R"({"id":"\"quoted\"\n\u001b[31m\u009b\u202e M\u00fcnchen","outcome":"never"})"
                          "\n"
                          R"({"id":17,"outcome":"never"})"
                          "\n");
  const Run run = folder.lorentz("compare --queries " + folder.file("q") +
                                 " --answers a=" + folder.file("answers") + " --disagreements " + path);
  CHECK(run.status == 1);
  CHECK(read_back("ids") == "2");
  for (const std::string& text : {run.out, run.err, folder.read("wrong.ndjson")})
    for (const char* acts : {"\x1b", "\u009b", "\u202e"}) CHECK_FALSE(contains(text, acts));
}

TEST_CASE("What another program writes reaches no terminal as it is, and is never cut in a character",
          "[cli][compare_command]") {
  const Folder folder;
  // Bytes that are not text; then what a terminal obeys and 200 letters of two bytes, the 60th astride the
  // cut.
  folder.write("engine",
               "import sys\nfor line in sys.stdin:\n  sys.stdout.buffer.write(b'\\x9b\\xff\\n' + "
               "b'x\\x1b[2J\\xc2\\x9b31m\\x7f' + b'\\xc3\\xa9' * 200 + b'\\n')\n  sys.stdout.flush()\n");
  const std::string program = "'cmd:" LORENTZ_PYTHON " " + folder.file("engine") + "'";
  folder.write("q", kScene + kGood);
  const Run answered = folder.run(LORENTZ_PROGRAM " first-hit -e " + program + " " + folder.file("q") +
                                  " > " + folder.file("answers") + "; cat " + folder.file("answers"));
  CHECK(contains(answered.out, "..."));
  for (const std::string& text : {answered.out, answered.err})
    for (const char* acts : {"\x1b", "\x9b", "\x7f"}) {
      INFO(text);
      CHECK_FALSE(contains(text, acts));
    }
  // lorentz reads its own output.
  const Run judged =
      folder.lorentz("compare --queries " + folder.file("q") + " --answers a=" + folder.file("answers"));
  INFO(judged.err);
  CHECK_FALSE(contains(judged.err, "not JSON"));
  CHECK(judged.status == 1);  // its only answer is an error
}

TEST_CASE("compare --no-oracle takes times and judges nothing", "[cli][compare_command]") {
  const Folder folder;
  const Run timed = folder.lorentz("compare --no-oracle --json --count 20 --engine classical");
  INFO(timed.out << timed.err);
  CHECK(timed.status == 0);
  CHECK(contains(timed.out, R"("judge":null)"));
  CHECK(contains(timed.out, R"("queries":20,"agree":null)"));
  CHECK_FALSE(contains(folder.lorentz("compare --no-oracle --count 20 -e classical").out, "agree"));
  for (const char* option : {"--junit", "--baseline", "--disagreements"})
    CHECK(contains(folder.lorentz(std::string("compare --no-oracle -e classical ") + option + " file").err,
                   std::string(option) + ": needs the oracle"));
}

TEST_CASE("compare draws in each scene at each radius, and takes a baseline and a report of JUnit",
          "[cli][compare_command]") {
  const Folder folder;
  const Run some =
      folder.lorentz("compare --scene square,cubic --radius 0.1,0.2 --count 30 -e published,reduction");
  INFO(some.out << some.err);
  CHECK(some.out.starts_with("4 scenes: 120 drawn queries, seed "));
  CHECK(
      folder.lorentz("compare --scene square,cubic --queries " + folder.write("q", kScene + kGood)).status ==
      2);
  const std::string again = "compare --queries " + folder.file("q") + " --answers mine=" +
                            folder.write("a", R"({"id":"good","outcome":"never"})"
                                              "\n") +
                            " --baseline " + folder.file("known") + " --junit " + folder.file("report.xml");
  const Run first = folder.lorentz(again);
  CHECK(first.status == 1);
  CHECK(contains(first.err, "it has the 1 failures of this run now"));
  CHECK(contains(folder.read("known"), "\ngiven "));
  CHECK(contains(folder.read("report.xml"), "<failure message=\"wrong\"/>"));
  const Run second = folder.lorentz(again);
  CHECK(second.status == 0);
  CHECK(contains(second.err, "1 failures are known, 0 are new"));
  CHECK(folder.lorentz(again + " -e published").status == 2);  // they are of one engine
}

TEST_CASE("The heading counts the scenes of a file, if there are several", "[cli][compare_command]") {
  const Folder folder;
  const auto heading = [&](const std::string& queries) {
    const std::string out =
        folder.lorentz("compare -e classical --queries " + folder.write("q", queries)).out;
    return out.substr(0, out.find('\n'));
  };
  const std::string other = R"({"scene":{"dimension":2,"lattices":[{"vectors":[[1,0],[0,1]],)"
                            R"("atoms":[{"position":[0,0],"radius":0.2}]}]}})"
                            "\n";
  CHECK(heading(kScene + kGood) == folder.file("q") + ": 1 given queries");
  CHECK(heading(kScene + kGood + other + kGood) == "2 scenes: 2 given queries");
}

namespace {

// Queries in the square lattice as columns of a format, and an engine's answers to them.
struct Columns {
  std::string queries, answers;
  Columns(const Folder& folder, const std::string& format, std::size_t count) {
    std::mt19937_64 random(7);
    std::vector<std::vector<double>> rows;
    std::string csv = "id,x1,x2,v1,v2\n";
    for (std::size_t i = 0; i < count; ++i) {
      std::vector<double> row;
      for (int k = 0; k < 4; ++k)
        row.push_back(static_cast<double>(random() >> 11) * 0x1p-53 - 0.5 * (k > 1));
      csv += "\"q " + std::to_string(i) + '"';
      for (const double number : row) csv += ',' + std::to_string(number);
      csv += '\n';
      rows.push_back(row);
    }
    queries = folder.write("q." + format, format == "npy" ? npy_rows(rows) : csv);
    answers =
        folder.write("a." + format, folder
                                        .lorentz("first-hit --scene square --radius 0.1 --engine oracle "
                                                 "--format " +
                                                 format + " " + queries)
                                        .out);
  }
};

}  // namespace

TEST_CASE("compare: answers in columns are matched to queries in columns, in whatever part they are read",
          "[cli][compare_command]") {
  for (const std::string format : {"npy", "csv"}) {
    INFO(format);
    const Folder folder;
    const Columns columns(folder, format, 10'003);  // the last of them are a part of their own
    const std::string command =
        "compare --json --scene square --radius 0.1 --queries " + columns.queries + " --answers gpu=";
    const Run right = folder.lorentz(command + columns.answers + " --engine oracle");
    CHECK(right.status == 0);
    const std::string all = R"("queries":10003,"agree":10003,"ill_posed":0,"wrong":0,)";
    CHECK(contains(right.out, R"({"engine":"oracle",)" + all));
    CHECK(contains(right.out, R"({"engine":"gpu",)" + all));
    // One obstacle is another one, in the first part and in the last.
    std::string text = folder.read("a." + format);
    const std::size_t row = 3 + 4 + 4 + 2 * 8 + 8;
    for (const std::size_t from_end : {std::size_t{10'002}, std::size_t{1}}) {
      std::size_t at = text.size() - from_end * row;  // lattice, behind three bytes
      if (format == "csv") at = text.find("hit,", text.find("q " + std::to_string(10'003 - from_end)));
      text[at + (format == "csv" ? 4 : 7)] = format == "csv" ? '3' : '\3';
    }
    const Run wrong = folder.lorentz(command + folder.write("w." + format, text));
    INFO(wrong.out << wrong.err);
    CHECK(wrong.status == 1);
    CHECK(contains(wrong.out, R"("wrong":2,)"));
  }
}

TEST_CASE("compare: columns that cannot be matched or read are told of", "[cli][compare_command]") {
  const Folder folder;
  const Columns npy(folder, "npy", 5), csv(folder, "csv", 5);
  const auto run = [&](const std::string& queries, const std::string& answers, const std::string& more = "") {
    return folder.lorentz("compare --scene square --radius 0.1 --queries " + queries +
                          (answers.empty() ? "" : " --answers mine=" + answers) + " " + more);
  };
  const auto refuses = [](const Run& run, int status, const std::string& why) {
    INFO(run.out << run.err);
    CHECK(run.status == status);
    CHECK(contains(run.err, why));
  };
  refuses(folder.lorentz("compare --queries " + npy.queries), 2, "columns hold no scene; --scene says it");
  refuses(run(folder.write("q", kScene + kGood), npy.answers), 2, "--queries needs columns, too");
  refuses(run(npy.queries, npy.queries), 2, "answers have the fields outcome, ");
  refuses(run(csv.queries, npy.answers), 2, "no answer matches any query");
  const std::string wide =
      "[('outcome', '<i16'), ('lattice', '<i4'), ('atom', '<i4'), ('cell', '<i8', (2,)), ('time', '<f8')]";
  refuses(run(npy.queries,
              folder.write("wide.npy", npy_file(npy_dictionary(wide, "(1,)"), std::string(48, '\1')))),
          2, "wide.npy");
  std::string cut = folder.read("a.npy");
  cut.resize(cut.size() - 40);
  refuses(run(npy.queries, folder.write("cut.npy", cut)), 2, "2 of 5 rows are missing");
  std::string odd = folder.read("a.npy");
  odd[odd.size() - 35] = 9;
  refuses(run(npy.queries, folder.write("odd.npy", odd)), 2, "row 4: is not an answer");
  const std::string names = "outcome,lattice,atom,cell1,cell2,time,id\n";
  refuses(run(csv.queries, folder.write("o.csv", names + "struck,0,0,1,0,2,q 0\n")), 2,
          "\"struck\" is not an outcome");
  refuses(run(csv.queries, folder.write("t.csv", names + "hit,0,0,1,0,soon,q 0\n")), 2, "column time");
  refuses(run(csv.queries, folder.write("n.csv", "outcome,lattice\n")), 2, "there is no column atom");
  refuses(run(folder.write("x.csv", "x1,x2,v1,v2\n0.5,0,1,0\n1,,2,3\n0.5,0,0,0\n"), ""), 2, "row 1: ");
  std::string many = "x1,x2,v1,v2\n";
  for (int i = 0; i < 30; ++i) many += "0.5,0,0,0\n";
  const Run told = run(folder.write("many.csv", many + "0.5,0,1,0\n"), "");
  refuses(told, 2, "many.csv: 10 more bad rows\n");
  CHECK(told.err.find("more bad rows") == told.err.rfind("more bad rows"));
  refuses(run(folder.write("l.csv", "x1,x2,v1,v2,max_time\n0.5,0,1,0,0\n"), ""), 2, "column max_time");
  // An id that comes twice is told of, and the rows behind it are read.
  const Run twice =
      run(csv.queries, folder.write("d.csv", names + "never,,,,,,q 0\nnever,,,,,,q 0\nnever,,,,,,q 1\n"),
          "--json");
  refuses(twice, 2, "d.csv: the id \"q 0\" came before");
  CHECK(contains(twice.out, R"("error":0,"missing":3,)"));
  // A cell beyond 64 bits, a time beyond binary64, and rows that say little.
  const std::string far = "hit,0,0,100000000000000000000,0,inf,q 0\nnever,,,,,,q 1\nundecided,,,,,,q 2\n";
  const Run said = run(csv.queries, folder.write("f.csv", names + far), "--json");
  CHECK(contains(said.out, R"("undecided":1,"unsupported":0,"error":0,"missing":2,)"));
}

TEST_CASE("compare and golden check say the same with threads as without", "[cli][compare_command]") {
  const Folder folder;
  const auto said = [&](const std::string& command, const char* end) {
    const Run run = folder.lorentz(command);
    return run.out.substr(0, run.out.find(end)) + folder.read("d");
  };
  for (const std::string command :
       {"compare --seed 3 --count 12000 --radius 0.01 --engine certified,published --times",
        "golden check ties never --engine certified"}) {
    INFO(command);
    const std::string more =
        command.starts_with("compare") ? " --json --disagreements " + folder.file("d") : "";
    const char* const end = command.starts_with("compare") ? "\"ns_per_query\"" : "no such text";
    CHECK(said(command + more, end) == said(command + more + " --jobs 3", end));
  }
  CHECK(folder.lorentz("compare --jobs 0").status == 2);
}

TEST_CASE("compare: an array of answers may leave out how they were decided", "[cli][compare_command]") {
  const Folder folder;
  const std::string queries =
      folder.write("q.npy", npy_rows({{0.5, 0, 1, 0}, {0.5, 0, 0, 1}, {0.05, 0, 1, 0}}));
  const std::string description =
      "[('outcome', '|u1'), ('lattice', '<i4'), ('atom', '<i4'), ('cell', '<i8', (2,)), ('time', '<f8')]";
  const auto row = [&](std::uint8_t outcome, std::int64_t n1, std::int64_t n2, double time) {
    return bytes_of(outcome) + std::string(8, '\0') + bytes_of(n1) + bytes_of(n2) + bytes_of(time);
  };
  const std::string rows = row(0, 1, 0, 0.4) + row(1, 7, 7, NAN) + row(2, 0, 0, NAN);
  const std::string answers = folder.write("a.npy", npy_file(npy_dictionary(description, "(3,)"), rows));
  const Run run = folder.lorentz("compare --json --scene square --radius 0.1 --queries " + queries +
                                 " --answers mine=" + answers);
  INFO(run.out << run.err);
  CHECK(contains(run.out, R"("queries":3,"agree":3,)"));
}

TEST_CASE("compare: answers may come in any order, and rows without ids are matched by their numbers",
          "[cli][compare_command]") {
  const Folder folder;
  std::string queries = kScene, answers, csv = "x1,x2,v1,v2\n",
              rows = "time,outcome,lattice,atom,cell1,cell2\n";
  for (int i = 0; i < 20; ++i) {
    const std::string n = std::to_string(i);
    queries += R"({"id":)" + n + R"(,"x":[)" + n + R"(.5,0],"v":[1,0]})" + '\n';
    const std::string answer = R"({"id":)" + n + R"(,"outcome":"hit","lattice":0,"atom":0,"cell":[)" +
                               std::to_string(i + 1) + R"(,0],"time":0.25})" + '\n';
    answers = answer + answers;  // the last first
    csv += n + ".5,0,1,0\n";
    rows += "0.25,hit,0,0," + std::to_string(i + 1) + ",0\n";
  }
  const auto agree = [&](const std::string& command) {
    const Run run = folder.lorentz("compare --json " + command);
    INFO(run.out << run.err);
    CHECK(contains(run.out, R"("queries":20,"agree":20,)"));
  };
  agree("--queries " + folder.write("q", queries) + " --answers mine=" + folder.write("a", answers));
  agree("--scene square --radius 0.25 --queries " + folder.write("q.csv", csv) +
        " --answers mine=" + folder.write("a.csv", rows));
}

TEST_CASE("Without a hit there is no error of a time", "[cli][compare_command]") {
  const Folder folder;
  const std::string queries = folder.write("q", R"({"id":1,"x":[0.5,0.5],"v":[1,0]})");
  const Run run = folder.lorentz("compare --scene square --radius 0.1 --json --queries " + queries);
  CHECK(contains(run.out, R"("max_ulp":null,"mean_ulp":null)"));
}

TEST_CASE("Logged answers keep up with more queries than are judged together", "[cli][compare_command]") {
  const Folder folder;
  const std::string queries = folder.lorentz("sample --count 20100 --radius 0.1").out;
  folder.write("q", queries);
  folder.write("a", folder.lorentz("first-hit -e reduction " + folder.file("q")).out);
  const std::string what = "compare --queries " + folder.file("q") + " --answers mine=" + folder.file("a");
  const Run whole = folder.lorentz(what);
  INFO(whole.out << whole.err);
  CHECK(whole.status == 0);
  CHECK(contains(whole.out, "20100 given queries"));
  CHECK(contains(whole.out, "mine: no wrong answer in 20100"));
}

TEST_CASE("A program's hit is judged as it was said, also beyond a limit", "[cli][compare_command]") {
  const Folder folder;
  const std::string queries = folder.write("q", R"({"id":0,"x":[0.3,0.01],"v":[1,0],"max_time":0.9}
{"id":1,"x":[0.3,0.01],"v":[1,0],"max_time":0.3}
)");
  const std::string program = folder.write(
      "engine",
      "exec sed -u -n 's/^{\"id\":\\([0-9]*\\),.*/{\"id\":\\1,\"outcome\":\"hit\",\"lattice\":0,\"atom\":0,"
      "\"cell\":[1,0],\"time\":5}/p'\n");
  const Run run = folder.lorentz("compare --json --scene square --radius 0.1 --queries " + queries +
                                 " -e 'cmd:sh " + program + "'");
  INFO(run.out << run.err);
  CHECK(contains(run.out, R"("agree":2,"ill_posed":0,"wrong":0)"));
  CHECK(contains(run.out, R"("wrong_time":2,"other_quantity":2)"));
  // A time is needed where the limit is applied, and only there.
  const std::string timeless =
      folder.write("timeless", "sh " + program + R"( | exec sed -u 's/,"time":5//')");
  const auto asked = [&](const std::string& command) {
    return folder.lorentz(command + queries + " --scene square --radius 0.1 -e 'cmd:sh " + timeless + "'");
  };
  CHECK(contains(asked("compare --json --queries ").out, R"("agree":2,)"));
  CHECK(contains(asked("first-hit ").out, "gave a hit without its time, which a limit needs"));
  // As an answer to a user it is `later`, with proofs or without.
  for (const char* prove : {"", " --prove"})
    CHECK(folder
              .lorentz("first-hit --scene square --radius 0.1 " + queries + prove + " -e 'cmd:sh " + program +
                       "'")
              .out == "{\"id\":0,\"outcome\":\"later\"}\n{\"id\":1,\"outcome\":\"later\"}\n");
}

TEST_CASE("compare: questions outside of the declared domain are counted, not asked",
          "[cli][compare_command]") {
  const Folder folder;
  const std::string queries = folder.write("q", R"({"id":1,"x":[0.5,0.5],"v":[1,0.3]}
{"id":2,"x":[0.5,0.5],"v":[1e6,0.3]}
{"id":3,"x":[1000.5,0.5],"v":[1,0.3]}
{"id":4,"x":[0.5,0.5],"v":[1,0.3],"max_time":0.25}
{"id":5,"x":[0,0.05],"v":[1,0.3]}
)");
  const auto asked = [&](const std::string& options) {
    const Run run = folder.lorentz("compare --scene square --radius 0.1 -e reduction --json --queries " +
                                   queries + ' ' + options);
    INFO(run.err);
    std::size_t outside = 0, number = 0;
    const auto after = [&](const std::string& key) { return run.out.substr(run.out.find(key) + key.size()); };
    outside = std::stoul(after("\"outside_domain\":")), number = std::stoul(after("\"queries\":"));
    CHECK(outside + number == 5);
    return number;
  };
  CHECK(asked("") == 5);
  CHECK(asked("--domain speed=..10") == 4);
  CHECK(asked("--domain coordinates=..1000") == 4);
  CHECK(asked("--domain speed=0x1p-3..0x1p3,coordinates=..1000,limits=no") == 2);
  CHECK(asked("--domain radius=0.2..") == 0);
  CHECK(asked("--domain dimension=3") == 0);
  CHECK(asked("--domain shape=ellipsoid") == 0);
  CHECK(asked("--domain flight=..1e-3") == 1);
  CHECK(asked("--starts-inside unsupported") == 4);
  for (const char* bad : {"speed", "speed=1", "speed=2..1", "speed=-1..1", "sped=1..2", "shape=box",
                          "limits=1", "=", "speed=1..2,", "speed=..1,speed=2..3"}) {
    INFO(bad);
    const Run run = folder.lorentz("compare --count 5 --domain " + std::string(bad));
    CHECK(run.status == 2);
    CHECK(contains(run.err, "--domain"));
  }
  // No two of the drawn ones have one id, whichever are not asked.
  const std::string failed = folder.file("failed");
  folder.lorentz("compare --radius 0.3 --count 10500 --domain flight=..1 -e " + folder.never() +
                 " --disagreements " + failed);
  folder.write("answers", folder.lorentz("first-hit " + failed).out);
  CHECK(folder.lorentz("compare --queries " + failed + " --answers me=" + folder.file("answers")).status ==
        0);
}

TEST_CASE("compare: an engine that passes obstacles around the start is right by its own rule",
          "[cli][compare_command]") {
  const Folder folder;
  // Answers what the exact rule says, and what it says by other rules is wrong.
  const std::string queries = folder.write("q", R"({"id":1,"x":[0,0.05],"v":[1,0.25]})"
                                                "\n");
  const std::string scene = " --scene square --radius 0.1 --json -e 'cmd:sh ";
  const std::pair<const char*, const char*> answers[] = {
      {"inside", R"("outcome":"inside","lattice":0,"atom":0,"cell":[0,0])"},
      {"miss", R"("outcome":"hit","lattice":0,"atom":0,"cell":[4,1],"time":3.9034)"},
      {"zero", R"("outcome":"hit","lattice":0,"atom":0,"cell":[0,0],"time":0)"},
      {"exit", R"("outcome":"hit","lattice":0,"atom":0,"cell":[0,0],"time":0.0731)"}};
  for (const auto& [rule, answer] : answers) {
    const std::string program = folder.write(
        std::string("engine_") + rule,
        "exec sed -u -n 's/^{\"id\":\\([0-9]*\\),.*/{\"id\":\\1," + std::string(answer) + "}/p'\n");
    for (const auto& [other, ignored] : answers) {
      INFO(rule << " judged by " << other);
      const Run run = folder.lorentz("compare" + scene + program + "' --queries " + queries +
                                     " --time-tolerance 0.1 --starts-inside " + other);
      const bool is_right = contains(run.out, R"("agree":1,)") && contains(run.out, R"("wrong_time":0,)");
      CHECK(is_right == (std::string_view(rule) == other));
    }
  }
}
