// lorentz golden check and explain: engines against sets, one record in full.
#include <fmt/format.h>
#include <catch2/catch.hpp>

#include <algorithm>
#include <cstdio>
#include <set>
#include <sstream>

#include "report/page.hpp"
#include "tests/golden/golden_support.hpp"

using namespace lorentz;
using namespace lorentz::test;

namespace {

const std::string kCommitted = std::string(LORENTZ_SOURCE_DIR) + "/data/golden/";

// An engine in Python that passes the oracle's answers on, changed by a statement about `a`.
std::string engine(const Folder& folder, const std::string& statement) {
  const std::string script = folder.write(
      "engine.py",
      "import json, subprocess, sys\n"
      "answers = subprocess.run([sys.argv[1], 'first-hit', '--engine', 'oracle'], stdin=sys.stdin, "
      "capture_output=True, text=True).stdout\n"
      "for line in answers.splitlines():\n"
      "    a = json.loads(line)\n"
      "    " +
          statement +
          "\n"
          "    print(json.dumps(a))\n");
  return "'cmd:" LORENTZ_PYTHON " " + script + " " LORENTZ_PROGRAM "'";
}

std::string first_id(const std::string& set, const std::string& word) {
  golden::Reader reader(kCommitted + set + ".ndjson");
  for (golden::ReadRecord read; reader.next(read);)
    if (contains(read.text, word)) return read.record.id;
  throw std::logic_error("no record of " + set + " holds " + word);
}

bool is_json(const Folder& folder) {
  return std::system(
             (LORENTZ_PYTHON " -m json.tool --json-lines " + folder.file("out") + " >/dev/null").c_str()) ==
         0;
}

}  // namespace

TEST_CASE("golden check: exact engines agree, the published one does not", "[golden][golden_check]") {
  const Folder folder;
  const Run good = folder.lorentz("golden check --engine reduction ties bad-queries");
  INFO(good.out << good.err);
  CHECK(good.status == 0);
  CHECK(contains(good.out, "reduction\n"));
  CHECK(contains(good.out, "ties"));
  CHECK_FALSE(contains(good.out, "failures"));
  CHECK(folder.lorentz("golden check -e certified,oracle --strict grazing").status == 0);
  beginning_of_set(folder, "published-faults", 60);
  const std::string faults = folder.file("published-faults.ndjson");
  const Run bad = folder.lorentz("golden check " + faults + " --engine published --failures 2");
  CHECK(bad.status == 1);
  CHECK(contains(bad.out, "The first failures:"));
  const std::string failures = bad.out.substr(bad.out.find("The first failures"));
  CHECK(lines(failures.substr(0, failures.find("\n\n"))) == 1 + 2 * 8 - 1);
  CHECK_FALSE(
      contains(folder.lorentz("golden check " + faults + " -e published --failures 0").out, "failures:"));
  // In the plane a cell has two components.
  CHECK(contains(failures, R"("outcome":"hit","lattice":0,"atom":0,"cell":[1,1],)"));
  // What it says to run again runs, and fails on that record alone.
  const std::string again = between(bad.out, "again: lorentz ", "\n");
  const Run once = folder.lorentz(again + " --json");
  CHECK(once.status == 1);
  CHECK(contains(once.out, "\"records\":1,\"agree\":0,"));
}

TEST_CASE("golden check: the rules by which a record failed are those by which it is asked again",
          "[golden][golden_check]") {
  const Folder folder;
  for (const std::string rules : {"-e classical --ulps 0", "-e published-float --times"}) {
    const Run bad = folder.lorentz("golden check --first 200 --failures 1 ties axis-and-diagonal " + rules);
    REQUIRE(bad.status == 1);
    CHECK(folder.lorentz(between(bad.out, "again: lorentz ", "\n")).status == 1);
  }
}

TEST_CASE("golden check: half a set is not a set", "[golden][golden_check]") {
  const Folder folder;
  std::istringstream whole(folder.run("cat " + kCommitted + "published-faults.ndjson").out);
  std::string half, twice;
  for (std::string line; std::getline(whole, line);) {
    twice += line + '\n';
    if (lines(half) < 40) half += line + '\n';
  }
  twice += twice.substr(twice.rfind("{\"id\""));
  for (const std::string& text : {half, twice}) {
    const Run run = folder.lorentz("golden check -e published --baseline " + folder.file("known") + " " +
                                   folder.write("set.ndjson", text));
    CHECK(run.status == 2);
    CHECK(contains(run.err, "set.ndjson: the header says "));
    CHECK_FALSE(contains(run.err, "stale"));
  }
  CHECK(folder.lorentz("golden check -e oracle --first 5 " + folder.file("set.ndjson")).status == 0);
  // Nor is a set whose records name what their scenes do not have.
  half.replace(half.find(R"("lattice":0)", half.find("expect")), 11, R"("lattice":7)");
  const Run none = folder.lorentz("golden check -e oracle " + folder.write("set.ndjson", half));
  CHECK((none.status == 2 && contains(none.err, "set.ndjson:3: expect: cannot be right")));
}

TEST_CASE("golden check: a machine that rounds otherwise gives wrong answers", "[golden][golden_check]") {
  const Folder folder;
  const std::string check = "golden check --engine reduction axis-and-diagonal";
  CHECK(folder.lorentz(check).status == 0);
  const std::string preload = "ASAN_OPTIONS=verify_asan_link_order=0 LD_PRELOAD=" LORENTZ_TOWARD_ZERO " ";
  const Run run = folder.run(preload + LORENTZ_PROGRAM " " + check);
  INFO(run.out << run.err);
  CHECK(run.status == 1);
  CHECK(contains(run.out, "reduction: wrong in "));
}

TEST_CASE("The doctor says whether this machine is fit, and why not", "[golden][golden_check]") {
  const Folder folder;
  const Run fit = folder.lorentz("doctor");
  INFO(fit.out << fit.err);
  CHECK(fit.status == 0);
  CHECK(contains(fit.out, "Fit: answers here are what they are everywhere."));
  for (const char* engine : {"walk ", "reduction ", "certified ", "batch ", "certified-batch "})
    CHECK(contains(fit.out, "first hits: " + std::string(engine)));
  const Run unfit = folder.run("ASAN_OPTIONS=verify_asan_link_order=0 LD_PRELOAD=" LORENTZ_TOWARD_ZERO
                               " " LORENTZ_PROGRAM " doctor");
  INFO(unfit.out << unfit.err);
  CHECK(unfit.status == 1);
  CHECK(contains(unfit.out, "toward zero  NO: expected: to nearest"));
  CHECK(contains(unfit.out, "NOT FIT"));
}

TEST_CASE("golden check: tables of numbers as JSON", "[golden][golden_check]") {
  const Folder folder;
  beginning_of_set(folder, "published-faults", 60);
  const std::string sets = folder.file("published-faults.ndjson") + " ties ";
  const Run json = folder.lorentz("golden check -e published -e reduction " + sets + " --json");
  CHECK(json.status == 1);
  CHECK(is_json(folder));
  CHECK(lines(json.out) == 2);
  CHECK(json.out.starts_with(
      "{\"engine\":\"published\",\"sets\":[{\"set\":\"published-faults\",\"records\":47,"));
  CHECK(contains(
      json.out,
      "{\"engine\":\"reduction\",\"sets\":[{\"set\":\"published-faults\",\"records\":47,\"agree\":"));
  CHECK(contains(json.out, "\"skipped-disc\":{\"records\":"));
}

TEST_CASE("golden check: another program that lies, is silent about some, or breaks",
          "[golden][golden_check]") {
  const Folder folder;
  beginning_of_set(folder, "generic-2d", 130);
  const std::string set = folder.file("generic-2d.ndjson");
  const auto checked = [&](const std::string& statement, const std::string& more = "") {
    return folder.lorentz("golden check --json --engine " + engine(folder, statement) + " " +
                          (more.empty() ? set : more));
  };
  const Run honest = checked("pass");
  INFO(honest.out << honest.err);
  CHECK(honest.status == 0);
  CHECK(contains(honest.out, "\"records\":125,\"agree\":125,\"ill_posed\":0,\"wrong\":0,"));
  const Run cells = checked("a['cell'][0] += 1");
  CHECK(cells.status == 1);
  CHECK(contains(cells.out, "\"agree\":0,\"ill_posed\":0,\"wrong\":125,\"wrong_time\":0,"));
  const Run times = checked("a['time'] *= 1 + 1e-9");
  CHECK(times.status == 0);
  CHECK(contains(times.out, "\"agree\":125,\"ill_posed\":0,\"wrong\":0,\"wrong_time\":125,"));
  CHECK(checked("a['time'] *= 1 + 1e-9", set + " --times").status == 1);
  const Run nothing = checked("a = {'id': a['id'], 'outcome': 'undecided'}");
  CHECK(nothing.status == 0);
  CHECK(contains(nothing.out, "\"undecided\":125,"));
  CHECK(checked("a = {'id': a['id'], 'outcome': 'undecided'}", set + " --strict").status == 1);
  const Run error = checked("a = {'id': a['id'], 'outcome': 'error', 'message': 'no'}");
  CHECK(error.status == 1);
  CHECK(contains(error.out, "\"error\":125"));
  // For an invalid query an answer is wrong, and an error is right.
  CHECK(checked("pass", "bad-queries").status == 0);
  const Run sure = checked("a = {'id': a['id'], 'outcome': 'never'}", "bad-queries");
  CHECK(sure.status == 1);
  CHECK(contains(sure.out, "\"wrong\":115,"));
  const Run dead = folder.lorentz("golden check --json --engine 'cmd:exit 5' generic-2d ties --timeout 5");
  CHECK(dead.status == 3);
  CHECK(contains(dead.err, "given up; 1 sets were not asked"));
  CHECK(contains(dead.out, "\"not_asked\":1}"));
  // One set kills it: the others are asked.
  const std::string fragile = "cmd:exec " LORENTZ_TOLERANT_ENGINE " dies-in 2";
  const Run some = folder.lorentz("golden check --json --engine '" + fragile +
                                  "' generic-3d generic-2d tricylinder --first 20");
  INFO(some.out << some.err);
  CHECK(some.status == 3);
  CHECK(contains(some.out, R"("set":"generic-2d","records":5,"agree":0,)"));
  CHECK(contains(some.out, R"("error":0,"missing":5,"not_asked":15,)"));
  CHECK(contains(some.err, " given up in generic-2d: 15 records were not asked"));
  CHECK(contains(some.out, R"("set":"tricylinder","records":20,"agree":20,)"));
  CHECK(contains(some.out, "\"not_asked\":0}"));
  // After one bad line the others are asked.
  const Run once = checked("a = {'id': a['id'], 'outcome': 'nonsense'} if str(a['id']) == '3' else a",
                           set + " ties --first 40");
  CHECK(once.status == 3);
  CHECK(contains(once.out, "\"missing\":1"));
  CHECK(contains(once.out, "\"set\":\"ties\""));
  CHECK(contains(once.out, "\"not_asked\":0}"));
}

TEST_CASE("golden check: judges exits by the sets that have them", "[golden][golden_check]") {
  const Folder folder;
  beginning_of_set(folder, "ball-3d", 100);
  const std::string set = folder.file("ball-3d.ndjson");
  long exits = 0;
  golden::Reader reader(set);
  for (golden::ReadRecord read; reader.next(read);) exits += read.record.expect.exit_time.has_value();
  CHECK(exits > 20);
  const auto wrong_times = [&](const std::string& engine) {
    const Run run = folder.lorentz("golden check --json --engine " + engine + " " + set);
    INFO(run.err);
    return between(run.out, "\"wrong_time\":", ",");
  };
  CHECK(wrong_times("'cmd:" LORENTZ_PROGRAM " first-hit --detail'") == "0");
  CHECK(wrong_times(engine(folder, "if 'cell' in a: a['exit_time'] = 'inf'")) == std::to_string(exits));
}

TEST_CASE("golden check: says whether a wrong time is the exit, another quantity, or near the right one",
          "[golden][golden_check]") {
  const Folder folder;
  // The line x2 = 0 leaves the disc at x1 = 3 + sqrt(3)/4, and the ellipse at x1 = 3 + sqrt(1/2).
  const std::pair<std::string, std::string> atoms[] = {
      {R"({"position":[3,0.25],"radius":0.5})", "(3 + 0.1875**0.5) / 0.5"},
      {R"({"position":[3,0],"semiaxes":[[1,0.5],[0,0.5]]})", "(3 + 0.5**0.5) / 0.5"}};
  for (const auto& [atom, exit] : atoms) {
    const std::string queries = folder.write(
        "queries.ndjson", R"({"scene":{"dimension":2,"lattices":[{"vectors":[],"atoms":[)" + atom +
                              R"(]}]}})"
                              "\n"
                              R"({"id":"a","x":[0,0],"v":[0.5,0]})"
                              "\n");
    const std::string set = folder.file("mine.ndjson");
    std::filesystem::remove(set);
    REQUIRE(folder.lorentz("golden make --queries " + queries + " -o " + set).status == 0);
    const auto told = [&](const std::string& statement) {
      return folder.lorentz("golden check --times " + set + " -e " + engine(folder, statement)).out;
    };
    const std::string left = told("a['time'] = " + exit);
    INFO(left);
    CHECK(contains(left, "the time of the exit from that obstacle, not the time of the entry: off by "));
    CHECK(contains(told("a['time'] = 1e9"), "another quantity than a time of that collision: off by "));
    CHECK(contains(told("a['time'] *= 1 + 1e-9"), "a wrong time of the right obstacle: off by "));
  }
}

TEST_CASE("golden check: one record, another tolerance, and bad usage", "[golden][golden_check]") {
  const Folder folder;
  const std::string id = first_id("grazing", "\"margin\":");
  const Run one = folder.lorentz("golden check -e reduction --json grazing --id " + id);
  CHECK(one.status == 0);
  CHECK(contains(one.out, "\"records\":1,\"agree\":1,"));
  CHECK(contains(folder.lorentz("golden check -e reduction --json --id " + id).out,
                 "\"records\":1,\"agree\":1,"));
  const Run none = folder.lorentz("golden check -e reduction grazing --id 0123456789abcdef");
  CHECK(none.status == 2);
  CHECK(contains(none.err, "0123456789abcdef"));
  // Times that are wrong by a few conditions are not by a million.
  beginning_of_set(folder, "published-faults", 100);
  const auto wrong = [&](const char* ulps) {
    const Run run = folder.lorentz("golden check -e published --json --ulps " + std::string(ulps) + " " +
                                   folder.file("published-faults.ndjson"));
    return std::stoi(between(run.out, "\"wrong_time\":", ","));
  };
  CHECK(wrong("1e-3") >= wrong("4"));
  CHECK(wrong("1e6") < wrong("4"));
  CHECK(wrong("0") >= wrong("1e-3"));
  for (const char* bad :
       {"", "-e nobody", "-e reduction --ulps -1", "-e reduction --ulps 1e9", "-e reduction --ulps x",
        "-e reduction --failures -1", "-e reduction --timeout 0"}) {
    INFO(bad);
    const Run run = folder.lorentz(std::string("golden check ties ") + bad);
    CHECK(run.status == 2);
    CHECK_FALSE(run.err.empty());
  }
  CHECK(folder.lorentz("golden check -e reduction no-such-set").status == 2);
}

TEST_CASE("golden check says by how much an answer departs, and what all sets come to",
          "[golden][golden_check]") {
  const Folder folder;
  beginning_of_set(folder, "published-faults", 100);
  const Run run =
      folder.lorentz("golden check -e published --failures 1000 " + folder.file("published-faults.ndjson"));
  INFO(run.out);
  CHECK(run.status == 1);
  CHECK(contains(run.out, "\ntotal "));
  CHECK(contains(run.out, " of its radii, and enters it first\n"));
  CHECK(contains(run.out, "    No decision is hard: inputs moved by 2^20 ulps give the same answer"));
  const std::string verdict = run.out.substr(run.out.rfind("\npublished: ") + 1);
  CHECK(verdict.starts_with("published: wrong in "));
  const int wrong = std::stoi(verdict.substr(std::string("published: wrong in ").size()));
  std::size_t told = 0;
  for (std::size_t at = 0; (at = run.out.find(" of its radii", at)) != std::string::npos; ++at) ++told;
  CHECK(told == static_cast<std::size_t>(wrong));
}

// An engine that computes exactly and rounds its times to binary32.
TEST_CASE("golden check: a set in binary32 is judged in binary32, unless told otherwise",
          "[golden][golden_check]") {
  const Folder folder;
  const std::string single =
      engine(folder,
             "if 'time' in a: import struct; a['time'] = struct.unpack('f', struct.pack('f', a['time']))[0]");
  const std::string check = "golden check --times --first 60 -e " + single + " ";
  const Run own = folder.lorentz(check + "generic-3d-binary32 --json");
  INFO(own.out << own.err);
  CHECK(own.status == 0);
  CHECK(contains(own.out, "\"records\":60,\"agree\":60,\"ill_posed\":0,\"wrong\":0,\"wrong_time\":0,"));
  CHECK(contains(own.out, "\"precision\":\"binary32\",\"time_tolerance\":null"));
  const Run told = folder.lorentz(check + "generic-3d-binary32 --precision binary64");
  INFO(told.out << told.err);
  CHECK(told.status == 1);
  CHECK(contains(told.out, "a wrong time of the right obstacle"));
  CHECK(contains(told.out, " --precision binary64 --id "));
  // Not the record's, which are of 24 bits: all of these are 2^20 ulps of 53 bits at least.
  CHECK(contains(told.out, "; its margin: 1.049e+06 ulps\n"));
  const Run both = folder.lorentz(check + "generic-3d-binary32 generic-3d --json");
  CHECK(both.status == 1);
  CHECK(contains(both.out, "\"precision\":null,\"time_tolerance\":null"));
  // Another name does not hide what a set is of.
  std::string text;
  {
    std::ifstream in(kCommitted + "generic-3d-binary32.ndjson");
    text.assign(std::istreambuf_iterator<char>(in), {});
  }
  folder.write("mine.ndjson", replaced(text, "generic-3d-binary32", "mine"));
  CHECK(contains(folder.lorentz("golden check -e oracle " + folder.file("mine.ndjson")).out,
                 "mine, in binary32"));
  CHECK(contains(folder.lorentz("golden explain " + first_id("generic-3d-binary32", "\"hit\"")).out,
                 "An ulp here is one of binary32, of 24 bits."));
}

TEST_CASE("golden verify: numbers that the set's precision does not have, and margins of another",
          "[golden][golden_check]") {
  const Folder folder;
  const std::string header = R"("count":)";
  beginning_of_set(folder, "generic-2d", 30);
  const std::string wide = folder.read("generic-2d.ndjson");
  const Run run =
      folder.lorentz("golden verify " +
                     folder.write("w.ndjson", replaced(wide, header, R"("precision":"binary32",)" + header)));
  INFO(run.out << run.err);
  CHECK(run.status == 1);
  CHECK(contains(run.err, "its numbers are not of binary32"));
  beginning_of_set(folder, "near-rational-binary32", 30);
  const std::string narrow = folder.read("near-rational-binary32.ndjson");
  const Run other = folder.lorentz(
      "golden verify " + folder.write("n.ndjson", replaced(narrow, R"("precision":"binary32",)", "")));
  INFO(other.out << other.err);
  CHECK(other.status == 1);
  CHECK(contains(other.err, "its margin is another one"));
}

TEST_CASE("golden verify and check warn of keys that no set has, by name", "[golden][golden_check]") {
  const Folder folder;
  beginning_of_set(folder, "ties", 4);
  std::string text = folder.read("ties.ndjson");
  for (const auto& [key, fresh] : {std::pair{"\"count\":", "\"one\":1,\"count\":"},
                                   {"\"dimension\":", "\"two\":2,\"dimension\":"},
                                   {"\"outcome\":", "\"three\":3,\"outcome\":"},
                                   {",\"margin\":", ",\"four\":4,\"margin\":"}})
    text = replaced(text, key, fresh);
  const std::string set = folder.write("odd.ndjson", text);
  for (const char* command : {"golden verify ", "golden check -e oracle "}) {
    const Run run = folder.lorentz(command + set);
    INFO(run.err);
    for (const char* key : {"one", "two", "three", "four"})
      CHECK(contains(run.err, std::string("the key \"") + key + "\" is not known"));
  }
  const Run strict = folder.lorentz("golden check --strict -e oracle " + set);
  CHECK(strict.status == 2);
  CHECK(contains(strict.err, "odd.ndjson:1: the key \"one\" is not known"));
}

TEST_CASE("golden verify: how many records a header may promise", "[golden][golden_check]") {
  const Folder folder;
  beginning_of_set(folder, "ties", 4);
  const std::string text = folder.read("ties.ndjson"),
                    count = "\"count\":" + between(text, "\"count\":", ",") + ",";
  const auto said = [&](const std::string& number) {
    return folder
        .lorentz("golden verify " +
                 folder.write("w.ndjson", replaced(text, count, "\"count\":" + number + ",")))
        .err;
  };
  CHECK(contains(said("1000000000000"), "the header says 1000000000000 records"));
  CHECK(contains(said("1000000000001"), "count: is out of range"));
}

TEST_CASE("golden: a folder stands for its sets, the beginning of an id for the id",
          "[golden][golden_check]") {
  const Folder folder;
  beginning_of_set(folder, "ties", 40);
  const std::string set = folder.file("ties.ndjson"), id = first_id("ties", "\"margin\":");
  const std::string sets = folder.file("sets");
  std::filesystem::create_directory(sets);
  std::filesystem::rename(set, sets + "/ties.ndjson");
  CHECK(contains(folder.lorentz("golden verify " + sets).out, "ties.ndjson: "));
  CHECK(folder.lorentz("golden check -e oracle " + sets).status == 0);
  CHECK(contains(folder.lorentz("golden explain " + id.substr(0, 10)).out, ": " + id + "\n"));
  CHECK(folder.lorentz("golden explain " + id.substr(0, 1)).status == 2);
  CHECK(contains(folder.lorentz("golden check -e oracle --json ties --id " + id.substr(0, 10)).out,
                 "\"records\":1,"));
  std::filesystem::create_directory(folder.file("empty"));
  CHECK(folder.lorentz("golden verify " + folder.file("empty")).status == 3);
  // Beyond the range of binary64 times have their digits.
  CHECK(contains(folder.lorentz("golden explain 19f204542d0726dd").out, "6.084416429e+319"));
}

TEST_CASE("golden explain: a hit, inside, never, and an invalid query", "[golden][golden_check]") {
  const Folder folder;
  const auto explained = [&](const std::string& set, const std::string& word,
                             const std::string& options = "") {
    const std::string id = first_id(set, word);
    const Run run = folder.lorentz("golden explain " + id + options);
    INFO(run.err);
    CHECK(run.status == 0);
    CHECK(contains(run.out, set + ".ndjson:"));
    CHECK(contains(run.out, id));
    CHECK(contains(run.out, "{\"scene\":"));
    return run.out;
  };
  const std::string hit = explained("grazing", "\"outcome\":\"hit\"");
  CHECK(contains(hit, "It hits lattice 0, atom 0, cell ("));
  CHECK(contains(hit, "its condition"));
  CHECK(contains(hit, "passed by (radii)"));
  CHECK(contains(hit, " hit\n"));
  const std::string picture = folder.file("tie.svg");
  const std::string hard = explained("ties", "\"margin\":0,", " --svg " + picture);
  CHECK(contains(hard, "The hard decision: is "));
  CHECK(contains(hard, "entered before the obstacle that is hit? No, by 0 ulps."));
  CHECK(contains(folder.read("tie.svg"), ">at one point</text>"));
  CHECK(contains(explained("boundary-starts", "\"expect\":{\"outcome\":\"inside\""),
                 "It starts inside lattice "));
  CHECK(contains(explained("never", "\"outcome\":\"never\""), "Nothing is ever hit: the flight is periodic"));
  CHECK(contains(explained("ball-3d-binary32", "\"outcome\":\"never\""), "Nothing is ever hit.\n"));
  const std::string single = explained("grazing-binary32", "\"outcome\":\"hit\"", " --svg " + picture);
  const std::string decision = single.substr(single.find("The hard decision"));
  CHECK(contains(folder.read("tie.svg"),
                 fmt::format("of this flight: {:.3g}<", std::stod(between(decision, ", by ", " ulps.")))));
  CHECK(contains(explained("bad-queries", "\"tags\":[\"v-zero\"]"), "It is not a valid query: "));
  const std::string id = first_id("grazing", "\"outcome\":\"hit\"");
  const std::string page = folder.file("page.html");
  const Run no_query =
      folder.lorentz("golden explain " + first_id("bad-queries", "v-zero") + " --html " + page);
  CHECK(no_query.status == 2);
  CHECK(contains(no_query.err, "nothing to draw"));
  CHECK_FALSE(std::filesystem::exists(page));
  const Run paged = folder.run(LORENTZ_PROGRAM " golden explain --html " + page + " " + id + " - < " +
                               kCommitted + "grazing.ndjson");
  CHECK(std::filesystem::exists(page) == report::has_page());
  if (report::has_page()) {
    CHECK(paged.status == 0);
    CHECK(contains(folder.read("page.html"), "\"kind\":\"case\",\"title\":\"golden record " + id));
    CHECK(contains(folder.read("page.html"), "lorentz golden explain " + id + " - --html "));
    CHECK(contains(folder.read("page.html"), "\"drawing\":\"\\u003csvg"));
  } else {
    CHECK(paged.status == 3);
    CHECK(contains(paged.err, "built without the page"));
  }
  const Run unknown = folder.lorentz("golden explain 0123456789abcdef");
  CHECK(unknown.status == 2);
  CHECK(contains(unknown.err, "0123456789abcdef"));
  CHECK(folder.lorentz("golden explain " + id + " ties").status == 2);
  CHECK(folder.lorentz("golden explain").status == 2);
}

TEST_CASE("golden: a reader that has enough does not keep it waiting", "[golden][golden_check]") {
  const Folder folder;
  for (const char* arguments :
       {"make --set generic-2d --count 1e9", "check -e reduction ties", "list", "verify ties grazing"}) {
    INFO(arguments);
    const std::string command = std::string("timeout 300 bash -c '" LORENTZ_PROGRAM " golden ") + arguments +
                                " 2>/dev/null | head -1 >/dev/null'";
    CHECK(WEXITSTATUS(std::system(command.c_str())) == 0);
  }
}

TEST_CASE("golden check: known failures do not count, new ones do, and what no longer fails is told of",
          "[golden][golden_check]") {
  const Folder folder;
  const std::string check = "golden check -e published --first 60 published-faults ";
  const std::string known = folder.file("known"), report = folder.file("report.xml");
  const Run first = folder.lorentz(check + "--baseline " + known);
  CHECK(first.status == 1);
  std::istringstream lines(folder.read("known"));
  std::vector<std::string> listed;
  for (std::string line; std::getline(lines, line);)
    if (line[0] != '#') listed.push_back(line);
  REQUIRE(listed.size() > 3);
  CHECK(listed[0].starts_with("published-faults "));
  CHECK(listed[0].ends_with(" wrong"));
  const Run again = folder.lorentz(check + "--baseline " + known + " --junit " + report);
  CHECK(again.status == 0);
  CHECK(contains(again.err, std::to_string(listed.size()) + " failures are known, 0 are new"));
  CHECK_FALSE(contains(again.out, "The first failures"));
  const std::string hidden = folder.read("report.xml");
  CHECK(contains(hidden, "tests=\"60\" failures=\"0\" skipped=\"" + std::to_string(listed.size()) + "\">"));
  CHECK(contains(hidden, "name=\"" + listed[1].substr(17, 16) + "\"><skipped message=\"wrong; known by " +
                             known + ":3\"/></testcase>"));
  // One that is not listed is new; one that is right is stale; of a set that is not asked nothing is said.
  const std::string removed = listed[1].substr(17, 16);
  std::string text = replaced(folder.read("known"), listed[1] + "\n", "# a comment\n\n");
  std::string right;
  std::ifstream set(LORENTZ_SOURCE_DIR "/data/golden/published-faults.ndjson");
  for (std::string line; right.empty() && std::getline(set, line);)
    if (line.starts_with("{\"id\"") && !contains(text, line.substr(7, 16)) && line.substr(7, 16) != removed)
      right = line.substr(7, 16);
  folder.write("known", text + "published-faults " + right + "\nties " + right + "\n");
  const Run fresh = folder.lorentz(check + "--baseline " + known + " --junit " + report);
  CHECK(fresh.status == 1);
  CHECK(contains(fresh.err, std::to_string(listed.size() - 1) + " failures are known, 1 are new"));
  CHECK(contains(fresh.err, "stale: published-faults " + right + " "));
  CHECK_FALSE(contains(fresh.err, "stale: ties"));
  CHECK(contains(fresh.out, removed));
  CHECK(contains(folder.read("report.xml"),
                 "name=\"" + removed + "\"><failure message=\"wrong\"/></testcase>"));
  // A record that is not among the first 60 is stale only where all of the set is asked.
  const std::string gone = "smoke 0123456789abcdef";
  const std::string smoke = "golden check -e reduction " LORENTZ_SOURCE_DIR "/data/golden/smoke --baseline " +
                            folder.write("known", gone + "\n");
  CHECK(contains(folder.lorentz(smoke).err, "stale: " + gone));
  CHECK_FALSE(contains(folder.lorentz(smoke + " --first 60").err, "stale"));
  const Run bad = folder.lorentz(check + "--baseline " + folder.write("bad", "# one\nties\n"));
  CHECK(bad.status == 2);
  CHECK(contains(bad.err, "bad:2: expected a set and the id"));
  CHECK(folder.lorentz("golden check -e published,walk --baseline " + known + " ties").status == 2);
}
