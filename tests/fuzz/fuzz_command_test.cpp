// `lorentz fuzz` as its users call it.
#include <catch2/catch.hpp>

#include <signal.h>
#include <unistd.h>

#include <chrono>
#include <thread>

#include "tests/fuzz/campaign_support.hpp"
#include "tests/support/command_line.hpp"

using namespace lorentz;
using namespace lorentz::test;
using fuzz::Store;

namespace {

std::string stored(const std::string& path) {
  return text_of(Store(path, Store::Access::read));
}

// Starts the program, and sends it a signal each time that it is time for one.
template <class IsTime>
Run signalled_when(const Folder& folder, const IsTime& is_time, int signal,
                   const std::vector<std::string>& arguments, int times = 1) {
  const std::string out = folder.file("signalled.out"), err = folder.file("signalled.err");
  const pid_t child = fork();
  if (child == 0) {
    setpgid(0, 0);
    std::vector<char*> argv{const_cast<char*>(LORENTZ_PROGRAM)};
    for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
    argv.push_back(nullptr);
    if (!std::freopen(out.c_str(), "w", stdout)) _exit(126);
    if (!std::freopen(err.c_str(), "w", stderr)) _exit(126);
    execv(LORENTZ_PROGRAM, argv.data());
    _exit(127);
  }
  for (int i = 0; i < times; ++i) {
    while (!is_time()) std::this_thread::sleep_for(std::chrono::milliseconds(20));
    kill(-child, signal);
  }
  int status = 0;
  waitpid(child, &status, 0);
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, folder.read("signalled.out"),
          folder.read("signalled.err")};
}

// The same after a time, whatever it is at.
Run signalled_after(const Folder& folder, std::chrono::milliseconds time, int signal,
                    const std::vector<std::string>& arguments, int times = 1) {
  return signalled_when(
      folder, [&] { return std::this_thread::sleep_for(time), true; }, signal, arguments, times);
}

// False if it has ended, even if its status has not been collected yet.
bool is_running(int pid) {
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  std::string number, name, state;
  std::ifstream("/proc/" + std::to_string(pid) + "/stat") >> number >> name >> state;
  return !state.empty() && state != "Z";
}

}  // namespace

// These few cases meet 45 of the mistakes that were planted to try campaigns (docs/planted_bugs.md); their
// patches are gone.
TEST_CASE("Short campaigns of all targets find nothing in engines that claim to be exact", "[fuzz][cli]") {
  const Folder folder;
  for (const char* engine :
       {"reduction --count 40", "batch --count 40", "certified --times --count 40",
        "certified-batch --times --count 40", "walk --times --undecided no --count 10"}) {
    const Run run = folder.lorentz(std::string("fuzz --ulps 0 --first --engine ") + engine);
    INFO(engine << "\n" << run.out << run.err);
    CHECK(run.status == 0);
    CHECK(contains(run.out, "no findings"));
  }
}

TEST_CASE("A campaign on the published algorithm finds its faults, keeps them, shows them",
          "[fuzz][fuzz_command]") {
  const Folder folder;
  const std::string store = " --store " + folder.file("store");
  const Run run =
      folder.lorentz("fuzz -e published -t published-faults,leaving --count 32 --undecided no" + store);
  CHECK(run.status == 1);
  CHECK(contains(run.out, "seed 20161115"));
  CHECK(contains(run.out, "wrong, an obstacle passed over, 2D, unit lattice"));
  CHECK(contains(run.out, "wrong, an obstacle passed over, 3D, unit lattice"));
  CHECK(run.err.empty());
  const Run list = folder.lorentz("fuzz show" + store);
  CHECK(list.status == 0);
  CHECK(contains(list.out, "campaign 1\ntarget "));
  CHECK(contains(list.out, "published-faults     32 "));
  const Run list_json = folder.lorentz("fuzz show --json" + store);
  CHECK(contains(list_json.out, "{\"campaigns\":[{\"campaign\":1,\"version\":\""));
  CHECK(contains(list_json.out, "{\"target\":\"published-faults\",\"next\":32,\"cases\":32,"));
  CHECK(count_of(list_json.out, "\"id\":\"1/") > 3);
  CHECK(contains(list_json.out, "\"id\":\"1/published-faults/0\""));
  const std::string picture = folder.file("finding.svg");
  const Run show = folder.lorentz("fuzz show 1/published-faults/0 --svg " + picture + store);
  CHECK(show.status == 0);
  CHECK(folder.read("finding.svg").starts_with("<svg "));
  CHECK(contains(folder.read("finding.svg"), "Given: "));
  CHECK(contains(show.out, "as found:\n{\"scene\":"));
  CHECK(contains(show.out, "\"x\":[-0.04390243902439024,0.1951219512195122],\"v\":[9,5]"));
  // What is said of a case stands with the case: the shrunk one first.
  const std::size_t found = show.out.find("as found:"), departs = show.out.find("departs by"),
                    margin = show.out.find("margin of the exact answer");
  CHECK(show.out.find("shrunk to") < departs);
  CHECK(departs < margin);
  CHECK(margin < found);
  CHECK(contains(show.out, " of its radii, and enters it first\n"));
  CHECK(show.out.find("departs by", found) != std::string::npos);
  CHECK(show.out.find("margin of the exact answer", found) != std::string::npos);
  const Run as_json = folder.lorentz("fuzz show 1/published-faults/0 --json" + store);
  const std::size_t shrunk = as_json.out.find("\"shrunk\":");
  CHECK(as_json.out.find("\"departs\":") < shrunk);
  CHECK(as_json.out.find("\"departs\":", shrunk) != std::string::npos);
  CHECK(contains(as_json.out, "\"shrinking\":\"done\""));
  const Run again =
      folder.lorentz("fuzz -e published -t published-faults,leaving --count 32 --undecided no" + store);
  CHECK(contains(again.err, "goes on with campaign 1"));
  CHECK(again.out == run.out);
}

TEST_CASE("The lines of a finding are a query stream, of which a golden set is made",
          "[fuzz][fuzz_command]") {
  const Folder folder;
  const std::string store = " --store " + folder.file("store"), set = folder.file("finding.ndjson");
  folder.lorentz("fuzz -e published -t published-faults --count 32 --undecided no" + store);
  const Run made = folder.lorentz("fuzz show 1/published-faults/0" + store +
                                  " | grep '^{' | " LORENTZ_PROGRAM " golden make --queries - -o " + set);
  INFO(made.err);
  CHECK(made.status == 0);
  CHECK(contains(made.err, "finding: 2 records: "));  // shrunk, and as found
  CHECK(folder.lorentz("golden verify --walk " + set).status == 0);
  CHECK(folder.lorentz("golden check " + set + " -e certified").status == 0);
  const Run check = folder.lorentz("golden check " + set + " -e published");
  CHECK(check.status == 1);
  CHECK(contains(check.out, "published: wrong in 2 of 2 answers"));
}

TEST_CASE("It says which layers decided, and who judged", "[fuzz][fuzz_command]") {
  const Folder folder;
  const Run certified = folder.lorentz("fuzz -e certified -t grazing --count 300 --mutate 0");
  CHECK(contains(certified.out, "decided in binary64: "));
  CHECK(contains(certified.out, "; by exact arithmetic: "));
  CHECK(contains(certified.out, "judged by the oracle"));
  const Run reduction =
      folder.lorentz("fuzz -e reduction -t grazing --count 300 --mutate 0 --reword 0 --json");
  const auto number = [&](const std::string& key) {
    const std::size_t at = reduction.out.find("\"" + key + "\":");
    return at == std::string::npos ? -1 : std::stoi(reduction.out.substr(at + key.size() + 3));
  };
  CHECK(number("binary64") > 0);
  CHECK(number("double_double") > 0);
  CHECK(number("exact") == number("undecided"));
  CHECK(number("binary64") + number("double_double") + number("exact") == 300 - number("unsupported"));
  const Run classical = folder.lorentz("fuzz -e classical -t large-radius --count 100");
  CHECK_FALSE(contains(classical.out, "decided in binary64"));
}

TEST_CASE("The smallest margin is that of the variants, too", "[fuzz][fuzz_command]") {
  const Folder folder;
  const std::string command = "fuzz -e reduction -t corridor --count 40 --reword 0 --json --mutate ";
  const auto margin = [&](const char* mutate) {
    const std::string out = folder.lorentz(command + mutate).out, key = "\"smallest_margin\":";
    return out.substr(out.find(key) + key.size());
  };
  CHECK(margin("0").starts_with("null"));    // `never` has no margin
  const std::string smallest = margin("1");  // subnormal
  INFO(smallest.substr(0, 30));
  CHECK_FALSE(smallest.starts_with("null"));
  CHECK_FALSE(smallest.starts_with("0,"));  // what touches exactly is not counted
}

#ifdef LORENTZ_MPIRUN
TEST_CASE("Two processes find what one finds, to the bit", "[fuzz][fuzz_command]") {
  const Folder folder;
  const std::string what = " fuzz -e reduction -t leaving,grazing --count 800 --undecided yes --store ";
  const Run one = folder.lorentz(what + folder.file("one"));
  const Run two =
      folder.run(std::string(LORENTZ_MPIRUN) + " --allow-run-as-root --oversubscribe --quiet -n 2 " +
                 LORENTZ_PROGRAM + what + folder.file("two"));
  INFO(two.err);
  CHECK(one.status == 0);
  CHECK(two.status == 0);
  CHECK(contains(one.out, "1/leaving/"));
  CHECK(contains(one.out, "in double-double: "));
  CHECK(two.out == one.out);
  CHECK(stored(folder.file("two")) == stored(folder.file("one")));
  const Run locked =
      folder.run(std::string(LORENTZ_MPIRUN) + " --allow-run-as-root --oversubscribe --quiet -n 2 " +
                 LORENTZ_PROGRAM + " fuzz -t leaving --count 1 --store /no/such/folder/store");
  CHECK(locked.status == 3);
  CHECK(contains(locked.err, "/no/such/folder/store"));
}
#endif

TEST_CASE("A campaign can end at its first finding", "[fuzz][fuzz_command]") {
  const Folder folder;
  const std::string what = "fuzz -e published -t published-faults --undecided no --json --count 3000 ";
  const Run run = folder.lorentz(what + "--first");
  CHECK(run.status == 1);
  CHECK(contains(run.out, "\"cases\":1,"));
  CHECK(contains(run.out, "\"id\":\"1/published-faults/0\""));
  CHECK(run.out == folder.lorentz(what + "--first --jobs 3").out);
  const Run none = folder.lorentz("fuzz -e certified -t grazing --count 300 --first --json");
  CHECK(none.status == 0);
  CHECK(contains(none.out, "\"cases\":300,"));
}

TEST_CASE("With no ulp forgiven an answer is the exact one or wrong", "[fuzz][fuzz_command]") {
  const Folder folder;
  const std::string what = "fuzz -e classical -t tie --count 64 --mutate 0 --undecided no ";
  const Run lenient = folder.lorentz(what + "--ulps 4"), strict = folder.lorentz(what + "--ulps 0");
  CHECK(lenient.status == 0);
  CHECK(strict.status == 1);
  CHECK(contains(strict.out, "wrong, an obstacle"));
  CHECK(folder.lorentz("fuzz -e certified -t tie --count 64 --mutate 0 --ulps 0 --times").status == 0);
}

TEST_CASE("Where nothing is wrong it says what that means", "[fuzz][fuzz_command]") {
  const Folder folder;
  const Run run = folder.lorentz("fuzz -e certified -t grazing --count 300");
  CHECK(run.status == 0);
  CHECK(contains(run.out, "wrong: 0 in 300: at most 0.0099 of such cases, with 95 %"));
  CHECK(contains(run.out, "no findings"));
  const Run json =
      folder.lorentz("fuzz -e certified -t grazing --count 300 --json --seed 18446744073709551615");
  CHECK(json.status == 0);
  CHECK(contains(json.out, "\"seed\":\"18446744073709551615\""));
  CHECK(contains(json.out, "\"cases\":300"));
  CHECK(contains(json.out, "\"wrong_at_most\":0.0099"));
  CHECK(contains(json.out, "\"findings\":[]"));
}

// The killed runs ask for more cases than they can do, and are killed by what they have done.
TEST_CASE("Killed at any moment and gone on with, a campaign is as if it had never been",
          "[fuzz][fuzz_command]") {
  const Folder folder;
  const std::vector<std::string> arguments{"fuzz",        "-e",  "reduction", "-t", "leaving,grazing",
                                           "--undecided", "yes", "--jobs",    "2"};
  auto without_end = arguments;
  without_end.insert(without_end.end(), {"--count", "1000000000", "--store", folder.file("killed")});
  std::uint64_t most = 0;
  for (int kills = 0; kills < 3; ++kills) {
    std::uint64_t now = 0;
    const auto is_farther = [&] {
      if (!fs::exists(folder.file("killed"))) return false;
      try {  // it may have been begun only just now
        const Store store(folder.file("killed"), Store::Access::read);
        now = std::max(store.tally(1, "leaving").next, store.tally(1, "grazing").next);
      } catch (const std::runtime_error&) {
      }
      return now > most;
    };
    signalled_when(folder, is_farther, SIGKILL, without_end);
    is_farther();
    most = now;
  }
  CHECK(most >= 3);
  std::string line;
  for (const std::string& argument : arguments) line += argument + ' ';
  line += "--count " + std::to_string(most + 300) + " --store ";
  folder.lorentz(line + folder.file("once"));
  const std::string once = stored(folder.file("once"));
  CHECK(contains(once, "leaving/"));
  folder.lorentz(line + folder.file("killed"));
  CHECK(stored(folder.file("killed")) == once);
}

TEST_CASE("What answers a negative time is found, kept, and shown", "[fuzz][fuzz_command]") {
  const Folder folder;
  const std::string store = " --store " + folder.file("store");
  const std::string script =
      folder.write("engine.sh", std::string(LORENTZ_PROGRAM) +
                                    " first-hit --engine certified | sed -u "
                                    "'s/\"cell\":.0,1/\"cell\":[0,2/; s/\"time\":/\"time\":-/'\n");
  const Run run = folder.lorentz("fuzz -t generic-2d --count 128 --mutate 0 --reword 0 --engine 'cmd:sh " +
                                 script + "'" + store);
  INFO(run.err);
  CHECK(run.status == 1);
  REQUIRE(contains(stored(folder.file("store")), "\"time\":-"));
  const Run list = folder.lorentz("fuzz show --json" + store);
  CHECK(list.status == 0);
  CHECK(contains(list.out, "\"time\":-"));
}

TEST_CASE("Interrupted, a campaign reports what it has, and says how to go on", "[fuzz][fuzz_command]") {
  const Folder folder;
  const std::string store = folder.file("a store");
  const Run run = signalled_after(folder, std::chrono::milliseconds(1500), SIGINT,
                                  {"fuzz", "-e", "published", "-t", "published-faults", "--ulps", "8",
                                   "--undecided", "no", "--time", "20", "--store", store});
  INFO(run.out << run.err);
  CHECK(run.status == 1);
  CHECK(contains(run.out, "wrong, an obstacle passed over"));
  const std::string before = "interrupted; this goes on: lorentz ";
  REQUIRE(contains(run.err, before));
  std::string command = run.err.substr(run.err.find(before) + before.size());
  command.resize(command.find('\n') + 1);  // what was asked last may take the engine long, which a line says
  CHECK(command ==
        "fuzz -e published -t published-faults --ulps 8 --undecided no --time 20 --store '" + store + "'\n");
  command.replace(command.find("--time 20"), 9, "--time 0.1");
  const Run again = folder.lorentz(command.substr(0, command.size() - 1));
  CHECK(contains(again.err, "goes on with campaign 1"));

  // A second Ctrl-C does not wait for an engine that is silent, and leaves none behind.
  const std::string note = folder.file("pid");
  const Run silent = signalled_after(
      folder, std::chrono::milliseconds(1000), SIGINT,
      {"fuzz", "-t", "grazing", "--time", "20", "-e", "cmd:echo $$ > " + note + "; exec sleep 60"}, 2);
  CHECK(silent.status == -1);
  REQUIRE(std::stoi(folder.read("pid")) > 1);
  CHECK_FALSE(is_running(std::stoi(folder.read("pid"))));
}

TEST_CASE("Where stderr is not a terminal, a line there says now and then how it goes",
          "[fuzz][fuzz_command]") {
  const Folder folder;
  const std::string what = "fuzz -e certified -t grazing,tie --time 1";
  setenv("LORENTZ_PROGRESS_AFTER", "0.005", 1);  // and a line after 60 times as long
  const Run run = folder.lorentz(what);
  unsetenv("LORENTZ_PROGRESS_AFTER");
  INFO(run.err);
  CHECK(lines(run.err) >= 2);
  CHECK(lines(run.err) <= 3);
  CHECK(contains(run.err, "lorentz: 1 of 1 s: "));
  CHECK(contains(run.err, " cases, 0 findings, 2 of 2 targets\n"));
  CHECK(folder.lorentz(what).err.empty());  // one a minute
}

TEST_CASE("Options of fuzz before the name of its subcommand begin no campaign", "[fuzz][fuzz_command]") {
  const Folder folder;
  const std::string store = " --store " + folder.file("store");
  folder.lorentz("fuzz -e published -t published-faults --count 4" + store);
  // What is needed comes first.
  CHECK(contains(folder.lorentz("fuzz show --help").out, "exit\n  --store FILE REQUIRED"));
  const Run list = folder.lorentz("fuzz show" + store), behind = folder.lorentz("fuzz --json show" + store);
  CHECK(list.status == 0);
  CHECK(behind.status == 0);
  CHECK(behind.out == list.out);
}

TEST_CASE("Without a store the simplest of each cause is printed", "[fuzz][fuzz_command]") {
  const Folder folder;
  const std::string what = "fuzz -e published -t published-faults --count 32 --undecided no";
  const Run without = folder.lorentz(what);
  const Run with = folder.lorentz(what + " --store " + folder.file("store"));
  CHECK(without.out.find(with.out) == 0);
  CHECK(count_of(without.out, "\n1/") == 2 * count_of(with.out, "\n1/"));
  CHECK(count_of(without.out, "\n{\"scene\":") == count_of(with.out, "\n1/"));
  CHECK(count_of(without.out, "\nsays  {") == count_of(with.out, "\n1/"));
  CHECK(count_of(without.out, "\ntruth {") == count_of(with.out, "\n1/"));
}

TEST_CASE("A campaign keeps to the scenes that it is for, and is another one for others",
          "[fuzz][fuzz_command]") {
  const Folder folder;
  const std::string what = "fuzz -e published --count 64 --undecided no --store " + folder.file("store");
  const Run first = folder.lorentz(what + " -t leaving,generic --scenes unit --domain dimension=2 --json");
  CHECK(contains(folder.lorentz(what + " -t leaving,generic --domain dimension=2 --scenes unit").err,
                 "goes on with campaign 1"));
  CHECK(contains(first.out, ", scenes unit"));
  CHECK(folder.lorentz(what + " -t leaving,generic --domain dimension=2 --scenes lattice").err.empty());
  const Run list = folder.lorentz("fuzz show --json --store " + folder.file("store"));
  CHECK(contains(list.out, ", scenes unit"));
  CHECK(contains(list.out, ", scenes lattice"));
  CHECK(contains(list.out, "\"campaign\":2,"));
  const Run plane = folder.lorentz("fuzz -e certified --count 64 -t generic --domain dimension=2 --json");
  CHECK(contains(plane.out, R"("target":"generic","next":64,"cases":32,)"));  // the others are in space
  // Of all targets those that have such scenes.
  const Run all = folder.lorentz("fuzz -e published --count 1 --scenes unit --undecided no --json");
  CHECK(contains(all.out, "\"target\":\"leaving\""));
  CHECK_FALSE(contains(all.out, "\"target\":\"superpositions\""));
}

TEST_CASE("A program that is wrong on purpose is found", "[fuzz][fuzz_command]") {
  const Folder folder;
  const std::string script = folder.write(
      "engine.sh", std::string(LORENTZ_PROGRAM) +
                       " first-hit --engine certified | sed -u 's/\"cell\":.0,1/\"cell\":[0,2/'\n");
  const Run run = folder.lorentz("fuzz -t generic --count 512 --mutate 0 --jobs 2 --json --engine 'cmd:sh " +
                                 script + "'");
  INFO(run.out << run.err);
  CHECK(run.status == 1);
  CHECK(contains(run.out, "\"cause\":\"wrong, an obstacle"));
  CHECK(contains(run.out, "\"cell\":[0,2"));
}

TEST_CASE("A campaign that asked nothing says so, and does not succeed", "[fuzz][fuzz_command]") {
  const Folder folder;
  const std::string campaign =
      "fuzz -e reduction --domain dimension=3 -t generic --mutate 0 --reword 0 --count ";
  const Run nothing = folder.lorentz(campaign + "20");  // the first 32 indices are in the plane
  CHECK(nothing.status == 2);
  CHECK(contains(nothing.err, "no case was asked"));
  CHECK(folder.lorentz(campaign + "40").status == 0);
}

TEST_CASE("An engine that answers now like this, now like that: a finding stays as it was found",
          "[fuzz][fuzz_command]") {
  const Folder folder;
  const std::string script = folder.write("engine.sh", std::string(LORENTZ_PROGRAM) +
                                                           " first-hit --engine certified | sed -u "
                                                           "'2~2s/\"outcome\".*/\"outcome\":\"never\"}/'\n");
  const Run run = folder.lorentz(
      "fuzz -t generic-2d --count 128 --keep 20 --mutate 0 --reword 0 --json --engine 'cmd:sh " + script +
      "'");
  CHECK(run.status == 1);
  CHECK(contains(run.out, "\"kind\":\"wrong\""));
  CHECK_FALSE(contains(run.out, "\"cause\":\"fine"));
}

TEST_CASE("The exit status where an engine only errs, or is wrong in times only", "[fuzz][fuzz_command]") {
  const Folder folder;
  const auto engine = [&](const std::string& edit) {
    return " --engine 'cmd:sh " +
           folder.write("engine.sh", std::string(LORENTZ_PROGRAM) +
                                         " first-hit --engine certified | sed -u '" + edit + "'\n") +
           "'";
  };
  const std::string campaign = "fuzz -t generic --count 64 --mutate 0 --reword 0 --json";
  const std::string errs = engine(R"(s/"outcome".*/"outcome":"error","message":"no"}/)");
  const Run only_errors = folder.lorentz(campaign + errs);
  CHECK(only_errors.status == 1);
  CHECK(contains(only_errors.out, "\"wrong\":0,"));
  CHECK(contains(only_errors.out, "\"error\":64,"));
  const Run compared = folder.lorentz("compare --json --count 64" + errs);
  CHECK(compared.status == 1);
  CHECK(contains(compared.out, "\"wrong\":0,"));
  CHECK(contains(compared.out, "\"error\":64,"));
  const std::string other_quantity = engine(R"(s/"time":.*/"time":1e9}/)");
  CHECK(folder.lorentz(campaign + other_quantity).status == 0);
  CHECK(folder.lorentz(campaign + " --times" + other_quantity).status == 1);
  const std::string late =
      engine(R"(s/\("time":[0-9]*[.][0-9]\{4\}[0-9]*\)[0-9]\{4\}}/\1}/)");  // ten digits or so are right
  const Run times = folder.lorentz(campaign + late), strict = folder.lorentz(campaign + " --times" + late);
  CHECK(contains(times.out, "\"wrong\":0,"));
  CHECK(contains(times.out, "\"findings\":[]"));
  CHECK(times.status == 0);
  CHECK(contains(strict.out, "\"cause\":\"wrong time"));
  CHECK(strict.status == 1);
}

TEST_CASE("No query is an error that a program was not asked", "[fuzz][fuzz_command]") {
  const Folder folder;
  const Run run = folder.lorentz("fuzz -t grazing --count 300 --mutate 0 --json --engine 'cmd:exec " +
                                 std::string(LORENTZ_TOLERANT_ENGINE) + " dies-in 3'");
  INFO(run.out << run.err);
  CHECK(run.status == 3);
  CHECK(contains(run.out, "cmd died (exit 3) on this query"));
  CHECK_FALSE(contains(run.out, "not asked"));
}

TEST_CASE("A program that breaks is reported, and the campaign goes on", "[fuzz][fuzz_command]") {
  const Folder folder;
  const Run run =
      folder.lorentz("fuzz -t generic --count 8 --mutate 0 --reword 0 --json --engine 'cmd:exit 7'");
  CHECK(run.status == 3);
  CHECK(contains(run.out, "\"error\":8"));
  CHECK(contains(run.err, "exit 7"));
}

TEST_CASE("Bad options are refused before any work, with what would do", "[fuzz][fuzz_command]") {
  const Folder folder;
  const auto refused = [&](const std::string& options, const std::string& message, int status = 2) {
    const Run run = folder.lorentz("fuzz " + options);
    INFO(options << '\n' << run.err);
    CHECK(run.status == status);
    CHECK(contains(run.err, message));
    CHECK(run.out.empty());
  };
  refused("--target nonsense", "--target: \"nonsense\" is not one of generic, near-rational,");
  refused("-t grazing,grazing", "--target: grazing is named twice");
  refused("-e nonsense", "no engine is called \"nonsense\"");
  refused("-e cmd:", "cmd: needs the command");
  refused("--time 0", "--time: must be above zero");
  refused("--time soon", "--time: ");
  refused("--count 0", "--count: \"0\" is not a whole number from 1");
  refused("--seed x", "--seed: \"x\" is not a whole number");
  refused("--jobs 0", "--jobs: \"0\" is not a whole number from 1 to 1024");
  refused("--keep 0", "--keep: ");
  refused("--mutate -1", "--mutate: ");
  refused("--ulps 1e9", "--ulps: 1000000000 is above 1048576");
  refused("--undecided perhaps", "--undecided: \"perhaps\" is not one of no, yes");
  refused("--timeout 0", "--timeout: must be above zero");
  refused("--scenes cubes", "--scenes: \"cubes\" is not one of unit, lattice, ball, any");
  refused("-t superpositions --scenes unit", "--target: superpositions has no such scenes as --scenes and");
  refused("nonsense", "no subcommand is called \"nonsense\"; there is show");
  refused("show", "--store is required");
  refused("show --store " + folder.file("absent"), folder.file("absent") + ": No such file", 3);
  refused("show --svg picture --store " + folder.file("absent"), "--html, --svg: are of one finding");
  refused("-e published -e walk", "--engine: name one");
  refused("--count 1 --store /no/such/folder/store", "/no/such/folder/store", 3);
  folder.lorentz("fuzz -t grazing --count 1 --store " + folder.file("store"));
  refused("show 1/grazing/5 --store " + folder.file("store"),
          "no finding is called \"1/grazing/5\"; `lorentz fuzz show --store " + folder.file("store") +
              " --json`");
}

// An engine whose numbers are all binary32, at its door and in its times; else it is exact.
TEST_CASE("fuzz: an engine in float is right in binary32, and a store keeps to one claim", "[fuzz]") {
  const Folder folder;
  const std::string script = folder.write(
      "single.py",
      "import json, math, struct, subprocess, sys\n"
      "def single(a):\n"
      "    if isinstance(a, list): return [single(one) for one in a]\n"
      "    if isinstance(a, dict): return {key: single(one) for key, one in a.items()}\n"
      "    if not isinstance(a, float): return a\n"
      "    try: return struct.unpack('f', struct.pack('f', a))[0]\n"
      "    except OverflowError: return math.copysign(3.4028234663852886e38, a)\n"
      "pipe = subprocess.PIPE\n"
      "child = subprocess.Popen([sys.argv[1], 'first-hit', '--engine', 'oracle'], stdin=pipe, stdout=pipe, "
      "text=True)\n"
      "for line in sys.stdin:\n"
      "    asked = single(json.loads(line))\n"
      "    child.stdin.write(json.dumps(asked) + '\\n')\n"
      "    child.stdin.flush()\n"
      "    if 'scene' in asked: continue\n"
      "    print(json.dumps(single(json.loads(child.stdout.readline()))), flush=True)\n");
  const std::string fuzz = "fuzz --engine 'cmd:" LORENTZ_PYTHON " " + script +
                           " " LORENTZ_PROGRAM
                           "' --target grazing --count 12 --mutate 6 --reword 0 --keep 1 --json --store ";
  const std::string narrow = folder.file("narrow");
  const Run right = folder.lorentz(fuzz + narrow + " --precision binary32 --times");
  INFO(right.out << right.err);
  CHECK(right.status == 0);
  CHECK(contains(right.out, "\"precision\":\"binary32\",\"time_tolerance\":null"));
  const Run other = folder.lorentz(fuzz + narrow + " --times");
  CHECK(other.status == 2);
  CHECK(contains(other.err,
                 "its campaign 1 is judged in binary32, times by ulps; go on with --precision binary32"));
  CHECK(folder.lorentz(fuzz + folder.file("wide") + " --first").status == 1);
  CHECK(contains(folder.lorentz(fuzz + folder.file("wide") + " --domain dimension=2").err,
                 "its campaign 1 is judged in binary64, times by ulps; go on without options of a claim"));
}

TEST_CASE("fuzz --time-tolerance: times within it are right", "[fuzz]") {
  const Folder folder;
  // All times are a thousandth too late.
  const std::string script = folder.write(
      "late.py",
      "import json, subprocess, sys\n"
      "pipe = subprocess.PIPE\n"
      "child = subprocess.Popen([sys.argv[1], 'first-hit'], stdin=pipe, stdout=pipe, text=True)\n"
      "for line in sys.stdin:\n"
      "    child.stdin.write(line)\n"
      "    child.stdin.flush()\n"
      "    if 'scene' in json.loads(line): continue\n"
      "    answer = json.loads(child.stdout.readline())\n"
      "    if isinstance(answer.get('time'), float): answer['time'] *= 1.001\n"
      "    print(json.dumps(answer), flush=True)\n");
  const std::string fuzz = "fuzz --engine 'cmd:" LORENTZ_PYTHON " " + script +
                           " " LORENTZ_PROGRAM
                           "' --target generic-2d --count 6 --mutate 0 --reword 0 --times --json --store ";
  const Run within = folder.lorentz(fuzz + folder.file("within") + " --time-tolerance 0.01");
  INFO(within.out << within.err);
  CHECK(within.status == 0);
  CHECK(contains(within.out, "\"time_tolerance\":0.01"));
  CHECK(folder.lorentz(fuzz + folder.file("beyond") + " --time-tolerance 0.0001 --first").status == 1);
}
