// lorentz judge as its users call it: the fault is named and can be made again from what is printed.
#include <catch2/catch.hpp>

#include <sstream>

#include <regex>

#include "report/page.hpp"
#include "tests/support/command_line.hpp"

using namespace lorentz::test;

namespace {

// The text after `begin`, to the end of its line.
std::string line_after(const std::string& text, const std::string& begin) {
  const std::size_t at = text.find(begin);
  if (at == std::string::npos) return "";
  const std::size_t from = at + begin.size();
  return text.substr(from, text.find('\n', from) - from);
}

// What is printed is run as it stands, by a shell that finds `lorentz`.
Run run_printed(const Folder& folder, const std::string& command) {
  const fs::path program = LORENTZ_PROGRAM;
  return folder.run("PATH=" + program.parent_path().string() + ":$PATH sh " +
                    folder.write("again.sh", command + "\n"));
}

}  // namespace

TEST_CASE("judge names the one fault of an engine, and each command that it prints makes it again",
          "[judge][judge_command]") {
  const Folder folder;
  const Run run =
      folder.lorentz(std::string("judge --quick --time 5 --all --engine cmd:") + LORENTZ_TOLERANT_ENGINE);
  INFO(run.out << run.err);
  CHECK(run.status == 1);
  CHECK(contains(run.out,
                 "\nwrong: passes over obstacles that the line enters by less than 1e-09 of their "
                 "radii; ill-posed "));
  CHECK(run.out.starts_with("what:    cmd:" LORENTZ_TOLERANT_ENGINE "; judged in binary64"));
  CHECK(contains(run.out, "\nworst:   passes over obstacles that the line enters by less than 1e-09"));
  CHECK(contains(run.out,
                 "\n1. wrong: names a later obstacle than one it grazes\n   passes over obstacles that the "
                 "line enters by less than 1e-09"));
  CHECK(contains(run.out, "\n   the one question: {\"origin\":[\""));
  CHECK_FALSE(contains(run.out, "2. wrong"));
  CHECK(contains(run.out, "and none of the right answers)"));
  CHECK(contains(run.out, "\ngolden grazing "));
  CHECK(contains(run.out, "\ncampaign "));
  const std::string compare = line_after(run.out, "\n   $ ");
  CHECK(contains(compare, "\"0x1"));
  const Run again = run_printed(folder, compare);
  INFO(again.out << again.err);
  CHECK(again.status == 1);
  CHECK(contains(again.out, "wrong in 1 of 1 answers"));
  const Run alone = run_printed(folder, line_after(run.out, compare + "\n   $ "));
  CHECK(contains(alone.out, line_after(run.out, "\n   says  {")));
}

TEST_CASE("judge --questions: the same is asked and found, however long the engine takes",
          "[judge][judge_command]") {
  const Folder folder;
  const auto found = [&](const std::string& pause) {
    const std::string engine =
        folder.write("engine.sh", LORENTZ_TOLERANT_ENGINE " | while IFS= read -r line; do " + pause +
                                      "printf '%s\\n' \"$line\"; done\n");
    const Run run = folder.lorentz("judge --questions 8 --json --engine 'cmd:sh " + engine + "'");
    INFO(run.out << run.err);
    CHECK(run.status == 1);
    const std::size_t rows = run.out.find("\"difficulties\""), calls = run.out.find("\"calls\"");
    REQUIRE((rows < calls && calls < run.out.size()));
    return std::regex_replace(run.out.substr(rows, calls - rows), std::regex("\"ns_per_query\":[^}]*"), "");
  };
  const std::string fast = found(""), slow = found("sleep 0.01; ");
  CHECK(contains(fast, R"({"name":"campaign","explanation":)"));
  CHECK_FALSE(contains(fast, R"("queries":9,)"));
  // Only a program is asked what is invalid.
  CHECK(contains(fast, "golden bad-queries"));
  CHECK_FALSE(contains(folder.lorentz("judge --questions 1 --json -e certified").out, "golden bad-queries"));
  CHECK(fast == slow);
  CHECK(folder.lorentz("judge --questions 8 --time 3 --engine classical").status == 2);
  CHECK(folder.lorentz("judge --questions 8 --jobs 2 --engine classical").status == 2);
  CHECK(folder.lorentz("judge --questions 0 --engine classical").status == 2);
}

TEST_CASE("judge --baseline: failures that are known by row and id do not count", "[judge][judge_command]") {
  const Folder folder;
  const std::string judge = "judge --questions 8 --engine published ";
  const std::string known = folder.file("known"), report = folder.file("report.xml");
  CHECK(folder.lorentz(judge + "--baseline " + known + " --junit " + report).status == 1);
  const std::string text = folder.read("known");
  std::istringstream lines(text);
  std::string heading, first;
  REQUIRE(std::getline(lines, heading));
  while (std::getline(lines, first) && !first.starts_with("golden-")) {
  }
  CHECK_THAT(first, Catch::StartsWith("golden-") && Catch::EndsWith(" wrong"));
  const std::string key = first.substr(0, first.rfind(' ')), id = key.substr(key.find(' ') + 1);
  CHECK(contains(folder.read("report.xml"), "name=\"" + id + "\"><failure message=\"wrong\"/>"));
  // The id is that of the set's record.
  const std::string set = key.substr(7, key.find(' ') - 7);
  CHECK(folder.lorentz("golden check -e published --id " + id + " " + set).status == 1);
  const Run same = folder.lorentz(judge + "--baseline " + known + " --junit " + report);
  CHECK(same.status == 0);
  CHECK(contains(same.err, " failures are known, 0 are new"));
  CHECK_FALSE(contains(folder.read("report.xml"), "<failure"));
  const std::string stale = "golden-ties 0123456789abcdef";
  const Run other =
      folder.lorentz(judge + "--baseline " + folder.write("known", replaced(text, first, stale)));
  CHECK(other.status == 1);
  CHECK(contains(other.err, "new: " + first + "\n"));
  CHECK(contains(other.err, "stale: " + stale + " fails no more"));
  // What breaks at once was not asked, so nothing is known to fail no more; answers to nonsense count with --strict.
  const Run broken = folder.lorentz("judge --questions 8 -e cmd:false --baseline " + folder.file("known"));
  CHECK((broken.status == 3 && !contains(broken.err, "stale")));
  const std::string lenient =
      "judge --questions 8 --strict --baseline " + folder.file("strict") + " -e " + folder.never();
  CHECK(folder.lorentz(lenient).status == 1);
  CHECK(contains(folder.read("strict"), " nonsense\n"));
  CHECK(folder.lorentz(lenient).status == 0);
  // Without a number of questions another run asks others.
  for (const std::string option : {"--baseline ", "--junit "})
    CHECK(folder.lorentz("judge --time 1 -e published " + option + folder.file("known")).status == 2);
}

TEST_CASE("judge finds a correct engine right, in JSON, too", "[judge][judge_command]") {
  const Folder folder;
  const Run run = folder.lorentz("judge --quick --time 3 --json --strict --engine certified");
  INFO(run.out << run.err);
  CHECK(run.status == 0);
  CHECK(contains(run.out, R"({"format":1,"kind":"judge","title":"certified, judged","manifest":{)"));
  CHECK(contains(
      run.out,
      R"("engine":"certified","library":null,"verdict":"right","line":"right: no wrong answer in )"));
  CHECK(contains(run.out, R"("ill_posed":0,"wrong":0,"wrong_time":0,"other_quantity":0,"undecided":0,)"));
  CHECK(contains(run.out, R"("difficulties":[{"name":"plain",)"));
  CHECK(std::regex_search(run.out, std::regex(R"("findings":\[\],"calls":\[\{"decade":-\d+,"agree":\d)")));
  CHECK(contains(run.out, "\"system\":\"Linux "));
  CHECK(std::regex_search(
      run.out, std::regex("\"by\":\"(length of the flight|smallest radius), in lattice vectors\"")));
  CHECK(contains(run.out, R"("free_paths":[{"scene":"square","engine":"certified","radius":0.1,)"));
  CHECK(lines(run.out) == 1);
}

TEST_CASE("judge: an engine that breaks, bad usage, places that cannot be written",
          "[judge][judge_command]") {
  const Folder folder;
  const Run broken = folder.lorentz("judge --quick --time 2 --json --engine cmd:false");
  INFO(broken.out << broken.err);
  CHECK(broken.status == 3);
  CHECK(contains(broken.out, R"("verdict":"broken","line":"broken: )"));
  CHECK(contains(broken.out, R"("cause":"no-answer",)"));
  CHECK(folder.lorentz("judge --engine nobody").status == 2);
  CHECK(folder.lorentz("judge").status == 2);
  CHECK(folder.lorentz("judge --engine reduction --time never").status == 2);
  CHECK(folder.lorentz("judge --engine reduction --html /nowhere/page.html").status == 3);
  CHECK(folder.lorentz("judge --engine reduction --html ''").status == 2);
}

TEST_CASE("judge: a fault that comes with a count is told, and the command that is printed makes it again",
          "[judge][judge_command]") {
  const Folder folder;
  const Run run = folder.lorentz(std::string("judge --quick --time 4 --all --engine 'cmd:") +
                                 LORENTZ_TOLERANT_ENGINE + " dies 50'");
  INFO(run.out << run.err);
  CHECK(run.status == 3);
  CHECK(contains(run.out, "\nbroken: "));
  CHECK(contains(run.out, "asked again and again, this comes at time number 50"));
  const Run again = run_printed(folder, line_after(run.out, "\n   $ "));
  INFO(again.out << again.err);
  CHECK(again.status == 3);
  CHECK(contains(again.err, "died (exit 3)"));
}

TEST_CASE("judge ends in its time, and at once when it is told to, whatever the engine does",
          "[judge][judge_command]") {
  const Folder folder;
  const std::string pid = folder.file("pid");
  const auto hangs = [&](int at) {
    return "'cmd:echo $$ >" + pid + "; echo started >>" + pid + ".all; exec " + LORENTZ_TOLERANT_ENGINE +
           " hangs " + std::to_string(at) + "'";
  };
  // Each silence costs 2 s, of which there are 3.
  const Run often = folder.lorentz("judge --quick --time 3 --all --engine " + hangs(9));
  INFO(often.out << often.err);
  CHECK(often.status == 3);
  CHECK(contains(often.out, "no-answer") == false);  // causes are for programs
  CHECK(contains(often.out, "gives no answer: it dies, falls silent, or leaves the question out"));
  // A silence that would be waited for for 11 days is over with the time. (The 5 minutes are for a test that
  // fails.)
  const Run once =
      folder.run("timeout 300 " LORENTZ_PROGRAM " judge --quick --time 3 --timeout 1e6 --engine " + hangs(9));
  INFO(once.out << once.err);
  CHECK(once.status == 0);
  CHECK_FALSE(goes_on_running(pid));
  // Never an answer; then the signals, of which each must end it and the engine that it started.
  // (The shell has its children in the background ignore INT.)
  const std::string judge = "env --default-signal=INT " LORENTZ_PROGRAM " judge --engine " + hangs(1) +
                            (lorentz::report::has_page() ? " --html " + folder.file("page.html") : "");
  for (const char* signal : {"INT", "TERM", "HUP"}) {
    fs::remove(pid), fs::remove(pid + ".all");  // the first start is to hear what it says of itself
    const std::string script =
        folder.write("signal.sh", judge + " & judge=$!; while ! sed -n 2p " + pid +
                                      ".all | grep -q .; do sleep 0.05; done; kill -s " + signal +
                                      " $judge; wait $judge\n");
    const Run run = folder.run("sh " + script);
    INFO(signal << run.out << run.err);
    CHECK(contains(run.out, "broken: "));
    CHECK(contains(run.out, "; interrupted before all was asked"));
    CHECK(run.status == 3);
    CHECK_FALSE(goes_on_running(pid));
    CHECK(fs::remove(folder.file("page.html")) == lorentz::report::has_page());
  }
  CHECK(folder.run("ls " + folder.file("") + " | grep page").status == 1);  // nor a part of one
}

TEST_CASE("judge: starting takes no part in the speed, free paths that are cut show where",
          "[judge][judge_command]") {
  const Folder folder;
  const std::string judge =
      std::string("judge --quick --time 6 --all --engine 'cmd:") + LORENTZ_TOLERANT_ENGINE;
  const Run slow = folder.lorentz(judge + " starts 700' --timeout 60");
  INFO(slow.out << slow.err);
  CHECK(slow.status == 0);
  CHECK(contains(slow.out, "\nStart: "));
  CHECK_FALSE(contains(slow.out, "not asked: drawn square"));
  const Run small = folder.lorentz(judge + " starts 700' --timeout 60 --domain radius=..0.1");
  INFO(small.out);
  CHECK(contains(small.out, "\nStart: "));
  const Run cut = folder.lorentz(judge + " cuts 20'");
  INFO(cut.out << cut.err);
  CHECK(contains(cut.out, "; P(free path > "));
  CHECK(contains(cut.out, "wrong: "));
  CHECK(contains(cut.out, "says never where an obstacle is hit"));
}

TEST_CASE("judge --golden: the simplest case of each fault is a set", "[judge][judge_command]") {
  const Folder folder;
  const std::string set = folder.file("faults.ndjson");
  const Run run = folder.lorentz("judge --engine published-float --questions 40 --json --golden " + set);
  CHECK(run.status == 1);
  CHECK(folder.lorentz("golden verify " + set).status == 0);
  const Run check = folder.lorentz("golden check --times --engine published-float --json " + set);
  CHECK(check.status == 1);
  // Each cause that is told of is a tag, and each record fails again, or is ill-posed.
  std::size_t records = 0;
  std::istringstream lines(folder.read("faults.ndjson"));
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with("{\"id\"")) {
      ++records;
      CHECK(contains(run.out, "\"cause\":" + line.substr(line.find("\"tags\":[") + 8,
                                                         line.find_first_of(",]", line.find("\"tags\":[")) -
                                                             line.find("\"tags\":[") - 8)));
    }
  CHECK(records >= 4);
  const Run brief = folder.lorentz("judge --engine published-float --questions 4 --golden " + set);
  CHECK(contains(brief.out, "\n1. wrong: "));
  CHECK(brief.out.ends_with(
      "\nmore:    --all prints the table, and each finding with an example and commands; " + set + "\n"));
  CHECK(contains(check.out, "\"agree\":"));
}

TEST_CASE("judge --golden: a fault that needs a limit is left out, and this is said",
          "[judge][judge_command]") {
  // `later` where the hit comes before the limit, but after half of it.
  const Folder folder;
  const std::string script = folder.write(
      "engine.py",
      "import json, subprocess, sys\n"
      "limits = {}\n"
      "asker = subprocess.Popen([sys.argv[1], 'first-hit'], stdin=-1, stdout=-1, text=True, bufsize=1)\n"
      "for line in sys.stdin:\n"
      "    question = json.loads(line)\n"
      "    asker.stdin.write(line)\n"
      "    if 'x' not in question: continue\n"
      "    answer = json.loads(asker.stdout.readline())\n"
      "    limit = question.get('max_time')\n"
      "    if answer.get('outcome') == 'hit' and limit and answer['time'] > limit / 2:\n"
      "        answer = {'id': answer['id'], 'outcome': 'later'}\n"
      "    print(json.dumps(answer), flush=True)\n");
  const Run run = folder.lorentz("judge --questions 5 -e 'cmd:" LORENTZ_PYTHON " " + script +
                                 " " LORENTZ_PROGRAM "' --golden " + folder.file("set"));
  INFO(run.out << run.err);
  CHECK(run.status == 1);
  CHECK(contains(run.err, "--golden: 1 of 1 findings are left out: their questions have a limit (max_time)"));
  CHECK_FALSE(contains(folder.read("set"), "\"id\""));
}

TEST_CASE("flights makes pages of its curves", "[judge][judge_command]") {
  if (!lorentz::report::has_page()) return;
  const Folder folder;
  CHECK(
      folder.lorentz("flights --radius 0.1,0.01 --from surface --count 2e4 --html " + folder.file("flights"))
          .status == 0);
  const std::string flights = folder.read("flights");
  CHECK(contains(
      flights, R"("kind":"flights","title":"Free paths: square, surface starts","line":"square, r = 0.1: )"));
  CHECK(contains(flights,
                 R"("free_paths":[{"scene":"square","engine":"batch","radius":0.1,"from":"surface",)"));
  CHECK(contains(flights, R"("law":"Boca-Zaharescu, r -)"));
  CHECK(contains(flights, R"({"scene":"square","engine":"batch","radius":0.01,)"));
}
