// The program as its users call it, whatever the subcommand: usage, names, files, output that fails.
#include "tests/support/command_line.hpp"
#include "cli/fuzz.hpp"
#include "report/files/messages.hpp"
#include "report/query_text.hpp"
#include "src/exchange/exchange_write.hpp"

#include <catch2/catch.hpp>
#include <sstream>

using namespace lorentz;
using namespace lorentz::test;

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

TEST_CASE("What the system says of a file is said with its name, and in no function's words",
          "[cli][command_line]") {
  const Folder folder;
  std::filesystem::create_symlink("loop", folder.file("loop"));
  for (const std::string& name : {folder.file("loop"), folder.file(std::string(300, 'x'))})
    for (const char* command : {"flights --count 1 --store ", "golden verify ", "fuzz --count 1 --store "}) {
      const Run run = folder.lorentz(command + name);
      INFO(command << name << "\n" << run.err);
      CHECK(run.status == 3);
      CHECK(contains(run.err, name));
      for (const char* word : {"filesystem", "std::", "basic_", "stat"}) CHECK_FALSE(contains(run.err, word));
    }
}

TEST_CASE("Words in quotes are what bash makes of them, and act on no terminal", "[cli][command_line]") {
  const Folder folder;
  for (const std::string word : {"plain", "two words", "it's", "$(rm -rf x)", "\x1b[31m'\\n",
                                 "\u009b\u202e\u00fc", "two\nlines", "\x9b\x7f"}) {
    const std::string quoted = shell_quoted(word);
    INFO(quoted);
    CHECK(printable(quoted, Lines::kept) == quoted);
    CHECK(folder.run("bash " + folder.write("script", "printf %s " + quoted)).out == word);
  }
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
  CHECK(contains(said("first-hit squar", 3), "squar: no such file (a scene is given by --scene square)"));
  CHECK(contains(said("trajectory --time 1 hexagonl", 3), "given by --scene hexagonal)"));
  CHECK(contains(said("first-hit --format csv --scene square cubic", 3), "given by --scene cubic)"));
  CHECK(contains(said("golden check --ulsp 3", 2),
                 "--ulsp (did you mean --ulps?); lorentz golden check --help"));
  CHECK(contains(said("compare --count 1 --scene sqare", 2), "(did you mean square?)"));
  CHECK(contains(said("golden check -e reduction near-ratonal", 2), "(did you mean near-rational?)"));
  for (const char* command : {"first-hit", "compare", "bench", "golden check", "fuzz --time 1"}) {
    INFO(command);
    CHECK(contains(said(std::string(command) + " -e bacth", 2),
                   "no engine is called \"bacth\" (did you mean batch?); there are classical, "));
    CHECK_FALSE(contains(said(std::string(command) + " -e nobody", 2), "did you mean"));
  }
}

TEST_CASE("Without a subcommand the help is shown, every help has an example", "[cli][command_line]") {
  const Folder folder;
  for (const std::string bare : {"", "golden", "scene"}) {
    const Run run = folder.lorentz(bare), help = folder.lorentz(bare + " --help");
    CHECK(run.status == 2);
    CHECK(contains(run.out, "Subcommands:\n"));
    CHECK(run.out == help.out);
    CHECK(folder.lorentz("help " + std::string(bare)).out == help.out);
  }
  CHECK(folder.lorentz("help compair").status == 2);
  for (const char* command :
       {"",       "first-hit",   "compare",      "convergents",   "horizon",        "sample",     "demo",
        "bench",  "scene",       "doctor",       "scene show",    "scene draw",     "fuzz",       "fuzz show",
        "golden", "golden make", "golden check", "golden verify", "golden explain", "golden list"}) {
    INFO(command);
    CHECK(contains(folder.lorentz(std::string(command) + " --help").out, "Example"));
  }
}

TEST_CASE("A wrong LORENTZ_DATA is an error, without a catalogue it is said where it was looked for",
          "[cli][command_line]") {
  const Folder folder;
  const auto with_data = [&](const std::string& data, const std::string& arguments) {
    return folder.run("LORENTZ_DATA=" + data + " " LORENTZ_PROGRAM " " + arguments);
  };
  for (const char* arguments : {"scene show", "compare --count 1", "golden list"}) {
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

TEST_CASE("What is meant for a closed standard stream goes into no file", "[cli][command_line]") {
  const Folder folder;
  const auto run = [&](const std::string& arguments) {
    return WEXITSTATUS(std::system((std::string(LORENTZ_PROGRAM) + " " + arguments).c_str()));
  };
  const std::string flights = "flights --count 2000 --csv " + folder.file("csv");
  CHECK(run(flights + " >/dev/null 2>/dev/null") == 0);
  const std::string whole = folder.read("csv");
  for (const std::string closed :
       {" 2>&- >/dev/null", " >&- 2>/dev/null", " <&- >/dev/null 2>/dev/null", " <&- >&- 2>&-"}) {
    INFO(closed);
    CHECK(run(flights + closed) == (contains(closed, " >&-") ? 3 : 0));  // what was printed did not arrive
    CHECK(folder.read("csv") == whole);
  }
  // Nor is it a store, or its lock.
  const std::string campaign = "fuzz -e reduction -t tie --count 20 --store " + folder.file("store");
  CHECK(run(campaign + " 2>&- >/dev/null") == 0);
  CHECK(run(campaign + " >/dev/null 2>/dev/null") == 0);
}

TEST_CASE("With fewer threads than asked for, the same is found", "[cli][command_line]") {
  const Folder folder;
  const auto run = [&](const std::string& arguments, int threads) {
    const std::string preload = "ASAN_OPTIONS=verify_asan_link_order=0 LD_PRELOAD=" LORENTZ_FEW_THREADS
                                " LORENTZ_FEW_THREADS=" +
                                std::to_string(threads);
    return folder.run(preload + " timeout 300 " LORENTZ_PROGRAM " " + arguments);
  };
  for (const std::string arguments :
       {"fuzz -e published -t tie --count 40 --json", "flights --count 3e4 --json",
        "lyapunov --collisions 2e4 --json",
        "diffusion --scene triangular --radius 0.45 --count 500 --time 10 --json",
        "compare --count 300 --scene square --no-oracle", "compare --count 300 --json",
        "golden make --set ties --count 40", "judge --quick --time 4 -e certified-batch"}) {
    INFO(arguments);
    const Run few = run(arguments + " --jobs 12", 2), many = run(arguments + " --jobs 12", 1000);
    CHECK(few.status == many.status);
    CHECK(few.status < 2);
    const auto before_times = [](const std::string& out) {
      return out.substr(0, std::min(out.find("seconds"), out.find("\"ns_per")));
    };
    if (contains(arguments, "--json")) CHECK(before_times(few.out) == before_times(many.out));
  }
  const Run none = run("fuzz -e reduction -t tie --count 5 --jobs 3", 0);
  CHECK(none.status == 3);
  CHECK(contains(none.err, "no thread could be started; ask for fewer"));
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
        std::string("compare --radius 0.75 --count 5"), std::string("convergents 1.5 0")}) {
    const Run run = folder.lorentz(arguments);
    INFO(arguments << run.err);
    CHECK(run.status == 2);
    CHECK(contains(run.err, "lorentz: "));
  }
  CHECK(folder.lorentz("compare --engine reduction --count 1e2 --seed 18446744073709551615").status == 0);
  CHECK(contains(folder.lorentz("compare --seed 1e17").err,
                 "--seed: \"1e17\" is 2^53 or more; write all its digits"));
}

TEST_CASE("Names of scenes: the catalogue, files, and neither", "[cli][command_line]") {
  const Folder folder;
  CHECK(folder.lorentz("compare --count 5 --scene cubic --engine classical").status == 0);
  CHECK(folder.lorentz("compare --count 5 --scene " + std::string(5000, 'x')).status == 2);
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

TEST_CASE("A list with an empty item is bad usage, in every option that takes one", "[cli][command_line]") {
  const Folder folder;
  for (const std::string arguments :
       {"flights --count 10 --radius 0.1,,0.2", "flights --count 10 --scene square,,cubic",
        "flights --count 10 --radius 0.1,", "lyapunov --collisions 10 --radius ,0.1", "bench --scene ,",
        "bench --difficulty drawn,,grazing", "fuzz -e reduction -t never,",
        "compare --count 5 -e reduction,,batch", "golden check -e ,reduction ties",
        "scene draw square --window 0,0,1,", "scene draw square --window 0,,1,1"}) {
    const Run run = folder.lorentz(arguments);
    INFO(arguments << '\n' << run.err);
    CHECK(run.status == 2);
    CHECK(contains(run.err, "an item is empty in the list"));
  }
  // A command keeps its commas.
  CHECK(
      contains(folder.lorentz("compare --count 5 -e 'reduction,cmd:sh -c \"exit 3,,4\"'").out, "exit 3,,4"));
}

TEST_CASE("A cause is told as what it is", "[cli][command_line]") {
  const Folder folder;
  const auto says = [&](const std::string& command, int status, const std::string& why) {
    const Run run = folder.run(command);
    INFO(command << '\n' << run.err);
    CHECK(run.status == status);
    CHECK(contains(run.err, why));
  };
  const std::string program = LORENTZ_PROGRAM;
  for (const auto& [text, what] :
       {std::pair{"{\"a\":1}", "is JSON"}, {"\x93NUMPY\1", "is a binary file"}, {"<testsuites/>", "is XML"}})
    says(program + " compare -e reduction --count 1 --baseline " + folder.write("known", text), 2,
         std::string("known ") + what + ", not a list of known failures");
  CHECK(folder.run("LORENTZ_DATA= " + program + " scene show square").status == 0);
  says(program + " scene show " + folder.write("blank.toml", std::string(40 << 20, ' ')), 2,
       "is longer than 32 MiB");
#ifndef __SANITIZE_ADDRESS__  // which needs /proc, and more room for addresses than is left below
  const std::string no_proc = "unshare -m sh -c 'umount -l /proc && exec \"$@\"' - env -u LORENTZ_DATA ";
  if (folder.run(no_proc + "true").status == 0)  // else this machine does not allow it
    says(no_proc + program + " scene show square", 3,
         "looked for in no folder: without /proc the program does not know where it lies; set LORENTZ_DATA");
  says("ulimit -v 900000; " + program + " flights --jobs 1024 --count 1e6", 0, "");
#endif
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
      R"({"rise":3,"run":2,"convergents":[{"a":1,"p":1,"q":1,"remainder":0.5,"remainder_exact":"1/2"},{"a":2,"p":3,"q":2,"remainder":0,"remainder_exact":"0"}]})"
      "\n");
  CHECK(folder.lorentz("convergents 0x1.8p+0").out == folder.lorentz("convergents 1.5").out);
  CHECK(folder.lorentz("convergents -- -1.5").status == 0);
}

TEST_CASE("The command that prints a question prints it as often as it is to be asked",
          "[cli][command_line]") {
  const Folder folder;
  const Scene scene = unit_scene(2, 0.25);
  const std::string asked = report::query_members({{0.5, 0.25}, {1, 0.5}, {}}, 2);
  for (const std::size_t times : {1, 2, 7}) {
    const std::string file = folder.file("asked");
    REQUIRE(std::system((report::printed(scene, asked, times) + " >" + file).c_str()) == 0);
    std::vector<std::string> lines;
    std::istringstream printed(folder.read("asked"));
    for (std::string line; std::getline(printed, line);) lines.push_back(line);
    REQUIRE(lines.size() == times + 1);
    CHECK(lines[0] == scene_line(scene));
    for (std::size_t i = 1; i <= times; ++i) CHECK(lines[i] == "{\"id\":1," + asked + '}');
  }
}

TEST_CASE("Among the causes of a campaign's findings, wrong answers come first", "[cli][command_line]") {
  std::vector<fuzz::Stored> findings;
  for (const char* kind : {"undecided", "error", "wrong time", "wrong"}) {
    findings.push_back({1, {}});
    findings.back().finding.kind = kind;
    findings.back().finding.cause = kind;
  }
  findings.push_back(findings.back());
  findings.back().finding.cause = "another cause";
  std::vector<std::string> names;
  for (const cli::FindingCause& cause : cli::causes_of(findings)) names.push_back(cause.name);
  CHECK(names == std::vector<std::string>{"another cause", "wrong", "wrong time", "error", "undecided"});
}
