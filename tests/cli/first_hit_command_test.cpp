// lorentz first-hit on streams in JSON: what it prints where, and its exit status.
#include "tests/support/command_line.hpp"

#include <catch2/catch.hpp>

using namespace lorentz::test;

TEST_CASE("first-hit answers a stream, line by line", "[cli][first_hit_command]") {
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

TEST_CASE("Digits, detail and a time limit", "[cli][first_hit_command]") {
  const Folder folder;
  const auto queries = folder.write("q", kScene + kGood);
  CHECK(contains(folder.lorentz("first-hit --digits 5 " + queries).out, R"("time_decimal":"0.25000")"));
  CHECK(contains(folder.lorentz("first-hit --detail " + queries).out,
                 R"("point":[0.75,0],"normal":[-1,0],"impact_parameter":0)"));
  CHECK(contains(folder.lorentz("first-hit --detail " + queries).out,
                 R"("exit_time":0.75,"exit_point":[1.25,0],"exit_normal":[1,0]})"));
  CHECK(folder.lorentz("first-hit --max-time 0.25 " + queries).out ==
        "{\"id\":\"good\",\"outcome\":\"later\"}\n");
  CHECK(folder.lorentz("first-hit --max-time 0.2500001 " + queries).out == kGoodAnswer);
  CHECK(folder.lorentz("first-hit --max-time 0x1p-2 --engine classical " + queries).out ==
        "{\"id\":\"good\",\"outcome\":\"later\"}\n");
}

TEST_CASE("A query's own limit is the smaller of two", "[cli][first_hit_command]") {
  const Folder folder;
  const auto with = [&](const std::string& limit) {
    return folder.write("q", kScene + R"({"id":"good","x":[0.5,0],"v":[1,0],"max_time":)" + limit + "}\n");
  };
  const std::string later = "{\"id\":\"good\",\"outcome\":\"later\"}\n";
  for (const char* engine : {"oracle", "certified", "certified-batch", "walk", "classical",
                             "\"cmd:" LORENTZ_PROGRAM " first-hit\""}) {
    INFO(engine);
    const std::string command = "first-hit --engine " + std::string(engine) + ' ';
    CHECK(folder.lorentz(command + with("0.25")).out == later);
    CHECK(folder.lorentz(command + with("\"0x1.0000000000001p-2\"")).out == kGoodAnswer);
    CHECK(folder.lorentz(command + with("\"inf\"")).out == kGoodAnswer);
    CHECK(folder.lorentz(command + "--max-time 0.25 " + with("7")).out == later);
    CHECK(folder.lorentz(command + "--max-time 7 " + with("0.25")).out == later);
  }
  for (const char* bad : {"0", "-1", "\"nan\"", "null", "[1]"}) {
    INFO(bad);
    const Run run = folder.lorentz("first-hit " + with(bad));
    CHECK(run.status == 2);
    CHECK(contains(run.out, "max_time"));
  }
  const Run proved = folder.lorentz("first-hit --prove " + with("0.25"));
  CHECK(proved.status == 1);
  CHECK(proved.out == later);
  const Run record = folder.lorentz("golden make --queries " + with("0.25"));
  CHECK(record.status == 2);
  CHECK(contains(record.err, "has a limit (max_time), which no record has"));
}

TEST_CASE("The detail of a hit on an ellipse", "[cli][first_hit_command]") {
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
          "[cli][first_hit_command]") {
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

TEST_CASE("After a bad scene every query is an error, until the next good one", "[cli][first_hit_command]") {
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

TEST_CASE("A line that begins as a scene and is not JSON is a bad scene: the one before it is over",
          "[cli][first_hit_command]") {
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
  // A bad query is not a bad scene.
  const Run query = folder.lorentz(
      "first-hit " + folder.write("q2", kScene + R"({"id":1,"x":[NaN,0],"v":[1,0]})" + "\n" + kGood));
  CHECK(query.out.ends_with(kGoodAnswer));
}

TEST_CASE("An unknown key is warned of once a stream, with --strict it is an error",
          "[cli][first_hit_command]") {
  const Folder folder;
  const std::string misspelt = R"({"id":1,"x":[0.5,0],"v":[1,0],"form":{"lattice":0,"atom":0,"cell":[1,0]}})"
                               "\n";
  const auto queries = folder.write("q", kScene + misspelt + misspelt);
  const Run run = folder.lorentz("first-hit " + queries);
  CHECK(run.status == 0);
  CHECK(lines(run.out) == 2);
  CHECK(run.err == "lorentz: warning: " + queries +
                       ":2: the key \"form\" is not known (did you mean from?), and is ignored\n");
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

TEST_CASE("A scene whose obstacles overlap or touch is answered, with a warning",
          "[cli][first_hit_command]") {
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

TEST_CASE("The paper's example has a direction that is not what it seems", "[cli][first_hit_command]") {
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

TEST_CASE("first-hit --x --v asks one query", "[cli][first_hit_command]") {
  const Folder folder;
  const std::string square = "--scene square --radius 0.1 ", asked = square + "--x 0,0.445 --v 1,0.0175 ",
                    streamed = square + folder.write("q", R"({"x":[0,0.445],"v":[1,0.0175]})");
  for (const std::string more :
       {"", "--detail ", "--digits 30 ", "--max-time 9 ", "-e reduction ", "--prove "}) {
    const Run run = folder.lorentz("first-hit " + more + asked);
    INFO(more << run.err);
    CHECK(run.status == 0);
    CHECK(run.out == folder.lorentz("first-hit " + more + streamed).out);
    CHECK(contains(run.out, more.starts_with("--max") ? R"("outcome":"later")" : R"("cell":[26,1])"));
  }
  CHECK(contains(folder.lorentz("first-hit --scene square --x -0.5,0x1p-3 --v=-1,0").out,
                 R"("outcome":"never")"));
  CHECK(contains(folder.lorentz("first-hit --scene ball --x -2,0,0 --v 1,0,0").out, R"("time":1})"));
  const auto refused = [&](const std::string& options, const std::string& why) {
    const Run run = folder.lorentz("first-hit " + options);
    INFO(options << '\n' << run.err);
    CHECK(run.status == 2);
    CHECK(contains(run.err, why));
  };
  refused(square + "--x 0,0.5", "--x: needs --v, the velocity");
  refused(square + "--v 0,0.5", "--v: needs --x, the position");
  refused("--x 0,0.5 --v 1,0", "--x and --v: need --scene");
  refused(asked + folder.file("q"), "leave them out, or the file " + folder.file("q"));
  refused(asked + "--format csv", "leave --format out");
  refused(asked + "--prove --records", "leave --records out");
  refused(square + "--x 0,0.5,0 --v 1,0", "--x and --v:1: x: has 3 components, the scene has dimension 2");
  refused(square + "--x 0,0.5 --v 1", "--x and --v:1: v: has 1 components, the scene has dimension 2");
  refused(square + "--x 0,soon --v 1,0", "--x: ");
  refused(square + "--x 0,0.5 --v 0,0", "--x and --v:1: ");
}

TEST_CASE("Answers with their proofs, and golden sets of them", "[cli][first_hit_command]") {
  const Folder folder;
  const std::string row =
      R"({"scene":{"dimension":2,"lattices":[{"vectors":[[2,0]],"atoms":[{"position":[0,0],"radius":0.25}]}]}})";
  const std::string missed = R"({"id":"missed","x":[1,1],"v":[1,2]})",
                    bad = R"({"id":"bad","x":[0],"v":[1,0]})";
  const auto queries = folder.write("q", kScene + kGood + "\n" + row + "\n" + missed);
  const Run run = folder.lorentz("first-hit --prove " + queries);
  INFO(run.out << run.err);
  CHECK((run.status == 0 && lines(run.out) == 2));
  CHECK(contains(
      run.out, R"("time_decimal":"0.2500000000000000000000000000000000000000","certificate":{"windows":[{)"));
  CHECK(contains(run.out,
                 R"({"id":"missed","outcome":"never","certificate":{"windows":[{"lattice":0,"atom":0,)"));
  CHECK(contains(run.out, R"("to":"inf","basis":[[1]]}]}})"));
  const auto records = folder.write("set", folder.lorentz("first-hit --prove --records " + queries).out);
  CHECK(contains(folder.lorentz("golden verify " + records).out, "2 records, all verified"));
  // What the header says made it makes it.
  const auto plain = folder.write("plain", missed);
  const Run set = folder.lorentz("first-hit --prove --records --scene square --radius 0.3 " + plain);
  CHECK(set.status == 0);
  CHECK(contains(set.out, "\"generator\":\"lorentz first-hit --prove --records --scene square --radius 0.3 " +
                              plain + "\""));
  CHECK(folder.run("python3 " LORENTZ_SOURCE_DIR "/data/check.py " + records).status == 0);
  // Another answer has none, and says so; a bad line has none either.
  const Run other = folder.lorentz("first-hit --prove --engine 'cmd:" LORENTZ_NAIVE_ENGINE "' " + queries);
  CHECK((other.status == 1 && contains(other.err, "1 of the answers can't be proved")));
  CHECK(
      contains(other.out,
               R"({"id":"missed","outcome":"error","message":"no such scene here","reason":"unsupported"})"));
  const auto with_bad = folder.write("b", kScene + kGood + "\n" + bad);
  CHECK(folder.lorentz("first-hit --prove " + with_bad).status == 2);
  CHECK(folder.lorentz("first-hit --prove --records " + with_bad).status == 2);
  const Run never = folder.lorentz("first-hit --prove --engine " + folder.never() + " " +
                                   folder.write("g", kScene + kGood));
  INFO(never.out << never.err);
  CHECK((never.status == 1 && contains(never.err, "can't be proved") && !contains(never.out, "certificate")));
  for (const std::string options :
       {"--records", "--prove --digits 3", "--prove --detail", "--prove --max-time 1",
        "--prove --records --engine walk", "--prove --format csv --scene square"})
    CHECK(folder.lorentz("first-hit " + options + " " + queries).status == 2);
}
