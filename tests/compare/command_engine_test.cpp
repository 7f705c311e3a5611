// cmd:COMMAND: other programs as engines, and what is made of their faults. tests/compare/odd_engine.py and
// tests/compare/silent_engine.sh have the faults.
#include <sys/resource.h>
#include <unistd.h>

#include <array>
#include <catch2/catch.hpp>
#include <chrono>
#include <csignal>

#include "question/engines.hpp"
#include "question/process.hpp"
#include "tests/support/command_line.hpp"

using namespace lorentz::test;

namespace {

constexpr int kQueries = 20;

// The shell, which stays and waits, would keep the program's output open: with exec it does not stay.
std::string odd(const std::string& fault) {
  return "'cmd:exec " LORENTZ_PYTHON " -I -S " LORENTZ_SOURCE_DIR "/tests/compare/odd_engine.py " + fault +
         "'";
}

std::string silent(const std::string& fault) {
  return "'cmd:sh " LORENTZ_SOURCE_DIR "/tests/compare/silent_engine.sh " + fault + "'";
}

// Queries "q0", "q1", ... that start at (0, 0.5), (1, 0.5), ...
std::string stream(int count = kQueries) {
  std::string text = kScene;
  for (int k = 0; k < count; ++k)
    text += "{\"id\":\"q" + std::to_string(k) + "\",\"x\":[" + std::to_string(k) + ",0.5],\"v\":[1,1]}\n";
  return text;
}

std::string answer_to(int k) {
  const std::string n = std::to_string(k);
  return "{\"id\":\"q" + n + R"(","outcome":"hit","lattice":0,"atom":0,"cell":[)" + n + ",0],\"time\":" + n +
         "}";
}

std::string error_to(int k, const std::string& beginning) {
  return "{\"id\":\"q" + std::to_string(k) + R"(","outcome":"error","message":")" + beginning;
}

// Every query has its answer in its place, but for query 5, which has this error.
void check_all_but_fifth(const std::string& out, const std::string& error) {
  INFO(out);
  std::istringstream answers(out);
  int k = 0;
  for (std::string line; std::getline(answers, line); ++k) {
    if (k == 5 && !error.empty())
      CHECK(line.starts_with(error_to(5, error)));
    else
      CHECK(line == answer_to(k));
  }
  CHECK(k == kQueries);
}

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

TEST_CASE("What a program writes to its standard error is passed on, and its last line is kept",
          "[compare][command_engine]") {
  const Folder folder;
  const lorentz::test::Run run =
      folder.lorentz("first-hit --engine 'cmd:echo first >&2; echo \"last one\" >&2; exit 3' " +
                     folder.write("q", stream(1)));
  CHECK(contains(run.err, "first\nlast one\n"));
  using lorentz::question::shell_command;
  lorentz::question::Process process(
      shell_command("echo first >&2; printf 'last one\\n  \\n' >&2; head -c 400 /dev/zero | tr '\\0' x >&2"));
  process.end(std::chrono::seconds(60));
  CHECK(process.take_last_words() == std::string(lorentz::question::Process::kMostWords, 'x'));
  CHECK(process.take_last_words().empty());
  lorentz::question::Process two(shell_command("echo first >&2; printf 'last one\\n  \\n' >&2"));
  two.end(std::chrono::seconds(60));
  CHECK(two.take_last_words() == "last one");
  // The shell writes another line about a command that a signal ends.
  lorentz::question::Process aborts(shell_command("sh -c 'echo last one >&2; kill -ABRT $$'; exit $?"));
  CHECK(aborts.end(std::chrono::seconds(60)).code == 134);
  CHECK(aborts.take_last_words() == "last one");
}

TEST_CASE(
    "The time of processors is that of all processes of the program, and goes on counting after its end",
    "[compare][command_engine]") {
  // 0.2 s by the processor's own clock, in a child of the shell's, which then waits for its input.
  const std::string busy = LORENTZ_PYTHON
      " -I -S -c 'import time\nwhile time.process_time() < 0.2: pass\nprint(flush=True); input()'";
  lorentz::question::Process process(lorentz::question::shell_command("sleep 0; " + busy + "; true"));
  for (lorentz::question::LineBuffer lines;
       lines.read_from(process.output()) == lorentz::question::LineBuffer::Read::nothing;) {
  }
  const double running = process.processor_seconds();
  CHECK(running >= 0.18);
  CHECK(running < 5);
  process.end(std::chrono::seconds(60));
  CHECK(process.processor_seconds() >= running);
}

TEST_CASE("A program may answer line by line, in blocks, or when its input ends",
          "[compare][command_engine]") {
  const Folder folder;
  const auto queries = folder.write("q", stream());
  for (const char* manner : {"fine", "buffered", "at-end"}) {
    const Run run = folder.lorentz("first-hit --engine " + odd(manner) + " " + queries);
    INFO(manner << run.err);
    CHECK(run.status == 0);
    CHECK(run.err.empty());
    check_all_but_fifth(run.out, "");
  }
}

TEST_CASE("An error without an id answers nothing when no query waits", "[compare][command_engine]") {
  const Folder folder;
  const std::string program =
      folder.write("engine",
                   "sed -u -n 's/^{\"id\":\\([0-9]*\\),.*/{\"id\":\\1,\"outcome\":\"never\"}/p'\n"
                   "echo '{\"id\":null,\"outcome\":\"error\",\"message\":\"too late\"}'\n");
  const Run run =
      folder.lorentz("first-hit --engine 'cmd:sh " + program + "' " + folder.write("q", stream()));
  INFO(run.out << run.err);
  CHECK(contains(run.err, "gave an answer with an id that no query has, null"));
  CHECK_FALSE(contains(run.out, "too late"));
}

TEST_CASE("A key that no answer has is told of once, and of twenty at the most",
          "[compare][command_engine]") {
  const Folder folder;
  const std::string command = "first-hit --engine " + odd("own-keys"),
                    queries = " " + folder.write("q", stream());
  const Run run = folder.lorentz(command + queries);
  CHECK(run.status == 0);
  check_all_but_fifth(run.out, "");
  const auto times_told = [&](int n) {
    const std::string told = "writes the key \"own" + std::to_string(n) + "\", which is not known";
    const auto first = run.err.find(told);
    return first == std::string::npos ? 0 : run.err.find(told, first + 1) == std::string::npos ? 1 : 2;
  };
  for (int n = 0; n < 30; ++n) {
    INFO(n << run.err);
    CHECK(times_told(n) == (n < 20 ? 1 : 0));
  }
  const Run strict = folder.lorentz(command + " --strict" + queries);
  CHECK(strict.status == 3);  // as where there is no answer
  CHECK(contains(strict.out, "the key \\\"own0\\\" is not known"));
}

TEST_CASE("A program's fault costs the query that it shows at, is reported with it, and nothing else is lost",
          "[compare][command_engine]") {
  const Folder folder;
  const auto queries = folder.write("q", stream());
  struct Fault {
    std::string name, error, said;
  };
  const std::string bad_line =
      R"(cmd gave no answer to this query before that to a later one; before that it )";
  const Fault fault = GENERATE_COPY(values<Fault>({
      {"dies", "cmd died (exit 3) on this query", "died (exit 3) on this query"},
      {"dies-buffered", "cmd died (exit 3) on this query", "asked again, fewer at a time"},
      {"ends", "cmd ended (exit 0) without an answer", "ended (exit 0)"},
      {"crashes", "cmd died (signal 11, ", "died (signal 11, "},
      {"garbage", bad_line + "wrote a line that is not an answer, rubbish (not JSON",
       "not an answer, rubbish (not JSON"},
      {"long-line", "cmd wrote more than 1 MiB that is not an answer", "wrote more than 1 MiB that is not"},
      {"half", "cmd wrote a line that is not an answer, ", "needs lattice, atom and cell"},
      {"swaps", "cmd gave no answer to this query before that to a later one",
       "answered this query after a later"},
      {"unknown-id", bad_line + "gave an answer with an id that no query has, 123456", "123456"},
      {"skips", "cmd gave no answer to this query before that to a later one",
       "gave no answer to this query"},
      {"dimension", "cmd gave a cell of 3 components of a lattice of 2 vectors", "3 components"},
      {"twice", "", "answered this query again"},
  }));
  const Run run = folder.lorentz("first-hit --engine " + odd(fault.name) + " " + queries);
  INFO(fault.name << "\n" << run.err);
  CHECK(run.status == 3);
  check_all_but_fifth(run.out, fault.error);
  CHECK(contains(run.err, fault.said));
  // What was asked, as a stream that can be asked again.
  if (fault.name != "dies-buffered")
    CHECK(contains(run.err, ":\n" + kScene + "{\"id\":\"q5\",\"x\":[5,0.5],\"v\":[1,1]}\n"));
  CHECK(contains(run.err, "{\"id\":\"q5\",\"x\":[5,0.5],\"v\":[1,1]}\n"));
}

TEST_CASE("What a program wrote in place of an answer is told of the first that it kept back",
          "[compare][command_engine]") {
  const Folder folder;
  const Run run =
      folder.lorentz("first-hit --engine " + odd("garbage-skips") + " " + folder.write("q", stream()));
  const std::string no_answer = "cmd gave no answer to this query before that to a later one";
  CHECK(contains(run.out, answer_to(4) + "\n" + error_to(5, no_answer + "; before that it wrote a line")));
  CHECK(contains(run.out, error_to(6, no_answer + "\"}\n") + answer_to(7)));
  // A line that it wrote before a right answer is not part of this message.
  const Run later =
      folder.lorentz("first-hit --engine " + odd("skips-later") + " " + folder.write("q", stream()));
  CHECK(contains(later.err, "not an answer, rubbish (not JSON"));
  check_all_but_fifth(later.out, no_answer + "\"}");
}

TEST_CASE("A complaint that comes again is counted, not shown again", "[compare][command_engine]") {
  const Folder folder;
  for (const int count : {1, 2, 25}) {
    const Run run =
        folder.lorentz("first-hit --engine " + silent("stammers") + " " + folder.write("q", stream(count)));
    INFO(count << run.err);
    CHECK(run.status == 3);
    const std::string what = "answered this query again";
    CHECK(contains(run.err, what + ":\n" + kScene));
    CHECK(lines(run.err) == (count > 1 ? 4u : 3u));
    CHECK(contains(run.err, std::to_string(count - 1) + " more times: " + what + "\n") == (count > 1));
  }
  const Run dies = folder.lorentz("first-hit --engine 'cmd:exit 3' " + folder.write("q", stream()));
  INFO(dies.err);
  CHECK(lines(dies.err) == 5);  // with the scene and the query; that it is given up; and the count
  CHECK(contains(dies.err, "4 more times: died (exit 3) on this query"));
}

namespace {

using Answers = std::vector<lorentz::Answer>;

// What a program answers to `count` queries asked at once.
Answers asked(lorentz::question::Answerer& program, const lorentz::Scene& scene, int count) {
  Answers answers;
  program.on_reply([&](lorentz::question::Reply& reply) { answers.push_back(reply.answer); });
  program.set_scene(scene);
  for (int k = 0; k < count; ++k) program.ask("null", {{static_cast<double>(k), 0.5, 0}, {1, 1, 0}, {}});
  program.drain();
  return answers;
}

double processor_seconds() {
  rusage used{};
  getrusage(RUSAGE_SELF, &used);
  return static_cast<double>(used.ru_utime.tv_sec + used.ru_stime.tv_sec) +
         1e-6 * static_cast<double>(used.ru_utime.tv_usec + used.ru_stime.tv_usec);
}

}  // namespace

TEST_CASE("A program that closes its input is waited for, but nothing more is written",
          "[compare][command_engine]") {
  // The line of the scene is longer than what a pipe holds, so that it is not all written by then.
  lorentz::Scene scene = lorentz::unit_scene(2, 0.001);
  scene.lattices[0].atoms.resize(5000, scene.lattices[0].atoms[0]);
  lorentz::question::AnswererOptions options;
  options.timeout = 0.6;
  const auto program = lorentz::question::engine_named("cmd:exec <&-; exec sleep 1000").answerer(options);
  const double before = processor_seconds();
  const Answers answers = asked(*program, scene, 1);
  REQUIRE(answers.size() == 1);
  CHECK(answers[0].message == "cmd closed its input and gave no answer within 0.6 s");
  CHECK(processor_seconds() - before < 0.3);  // it sleeps meanwhile
}

TEST_CASE("A program that is known to hold back its last answers is told the end at once",
          "[compare][command_engine]") {
  // It answers in pairs, and at the end.
  const Folder folder;
  const std::string script = folder.write("pairs.sh", R"(echo >>"$1"
held=""
while read -r line; do
  case $line in *scene*) continue ;; esac
  id=${line#*:} && id=${id%%,*}
  answer="{\"id\":$id,\"outcome\":\"never\"}"
  if [ -n "$held" ]; then printf '%s\n' "$held" "$answer"; held=""; else held=$answer; fi
done
[ -n "$held" ] && echo "$held"
)");
  const auto program =
      lorentz::question::engine_named("cmd:exec sh " + script + " " + folder.file("starts")).answerer({});
  const auto ask = [&] { CHECK(asked(*program, lorentz::unit_scene(2, 0.25), 3).size() == 3); };
  ask(), ask();  // it is told the end after a while, and twice is enough to know it
  const auto start = std::chrono::steady_clock::now();
  constexpr int kTimes = 20;
  for (int i = 0; i < kTimes; ++i) ask();
  CHECK(seconds_since(start) < kTimes * 0.5 * 0.8);  // 0.5 s is the while
  CHECK(lines(folder.read("starts")) == 2 + kTimes);
  // It is given more queries at a time than it holds, and answers while others come: one start each time,
  // also after runs in which it answered at the end only.
  for (const int count : {1, 1, 5001, 5001, 5001})
    CHECK(asked(*program, lorentz::unit_scene(2, 0.25), count).size() == static_cast<std::size_t>(count));
  CHECK(lines(folder.read("starts")) == 2 + kTimes + 5);
  // It stays known as one that answers in pairs after a run in which it answered at the end only: while the
  // input pauses it is given time to answer a pair. Otherwise each pair would take a start.
  CHECK(asked(*program, lorentz::unit_scene(2, 0.25), 1).size() == 1);
  constexpr std::size_t kPairs = 10;
  std::array<int, 2> silent_input{};
  REQUIRE(pipe(silent_input.data()) == 0);
  std::size_t answers = 0;
  program->on_reply([&](lorentz::question::Reply&) { ++answers; });
  for (std::size_t i = 0; i < kPairs; ++i) {
    for (const double x : {0.0, 1.0}) program->ask("null", {{x, 0.5, 0}, {1, 1, 0}, {}});
    while (program->idle(silent_input[0])) continue;
  }
  for (const int end : silent_input) close(end);
  CHECK(answers == 2 * kPairs);
  CHECK(lines(folder.read("starts")) < 2 + kTimes + 6 + kPairs);
  CHECK_FALSE(program->failed());
}

TEST_CASE("A program that answers line by line may take its time, and is not started again",
          "[compare][command_engine]") {
  const Folder folder;
  const std::string script = folder.write("slow.sh", R"(echo >>"$1"
while read -r line; do
  case $line in *scene*) continue ;; esac
  id=${line#*:} && id=${id%%,*}
  [ -e "$2" ] && sleep 0.8
  echo "{\"id\":$id,\"outcome\":\"never\"}"
done
)");
  lorentz::question::AnswererOptions options;
  options.enough = [] { return false; };  // so that the clock is looked at often
  const auto program = lorentz::question::engine_named("cmd:exec sh " + script + " " + folder.file("starts") +
                                                       " " + folder.file("slowly"))
                           .answerer(options);
  const auto starts_after = [&](int queries) {
    for (int i = 0; i < queries; ++i) CHECK(asked(*program, lorentz::unit_scene(2, 0.25), 1).size() == 1);
    return lines(folder.read("starts"));
  };
  // Once it answers two without a new start it is known; on a busy machine that takes more than one.
  std::size_t starts = starts_after(1);
  for (std::size_t before = 0; before != starts; starts = starts_after(1)) before = starts;
  folder.write("slowly", "");
  const double seconds = processor_seconds();
  CHECK(starts_after(1) == starts);
  CHECK(processor_seconds() - seconds < 0.15);  // it sleeps meanwhile
  fs::remove(folder.file("slowly"));
  CHECK(starts_after(1) == starts);
  program->finish();
  CHECK_FALSE(program->failed());
}

TEST_CASE("Runs that are told the end during a search do not count as silent", "[compare][command_engine]") {
  // Its first start holds an answer back and dies at the second query; the others answer line by line.
  const Folder folder;
  const std::string script = folder.write("recovers.sh", R"(echo >>"$1"
starts=$(wc -l <"$1")
while read -r line; do
  case $line in *scene*) continue ;; esac
  id=${line#*:} && id=${id%%,*}
  [ "$starts" -gt 1 ] && echo "{\"id\":$id,\"outcome\":\"never\"}" && continue
  [ -n "$held" ] && exit 3
  held=$id
done
)");
  const auto program =
      lorentz::question::engine_named("cmd:exec sh " + script + " " + folder.file("starts")).answerer({});
  const auto ask = [&](int count) {
    for (const lorentz::Answer& answer : asked(*program, lorentz::unit_scene(2, 0.25), count))
      CHECK(answer.outcome == lorentz::Outcome::never);
    return lines(folder.read("starts"));
  };
  // The second start gets one query and the third two, which ends the search for the one at fault.
  CHECK(ask(3) == 3);
  // Had these two been taken for silent ones, each query would be followed by the end and by a new start. As
  // it is, there is one for the first 4 queries, and one for the others, unless both do not answer for 0.5 s.
  constexpr std::size_t kQueriesAfter = 11;
  std::size_t starts = 0;
  for (std::size_t i = 0; i < kQueriesAfter; ++i) starts = ask(1);
  CHECK(starts < 3 + kQueriesAfter);
}

TEST_CASE("How a program ended, in words", "[compare][command_engine]") {
  using lorentz::question::Ending;
  const auto exit = [](int code) { return Ending{Ending::How::exited, code}.text(); };
  CHECK(exit(0) == "exit 0");
  CHECK(exit(126) == "exit 126");
  CHECK(exit(127) == "exit 127, no such command");
  CHECK(exit(128) == "exit 128");
  CHECK(exit(129) == "exit 129, signal 1, Hangup");
  CHECK(exit(139) == "exit 139, signal 11, Segmentation fault");
  CHECK(exit(128 + SIGRTMAX).starts_with("exit 192, signal 64, "));
  CHECK(exit(129 + SIGRTMAX) == "exit 193");
  CHECK(Ending{Ending::How::signalled, 9}.text() == "signal 9, Killed");
  CHECK(Ending{Ending::How::still_ran, 0}.text() == "still running");
  CHECK((Ending{}.is_good() && !Ending{Ending::How::exited, 1}.is_good()));
  CHECK_FALSE(Ending{Ending::How::signalled, 0}.is_good());
}

TEST_CASE("An obstacle that the scene does not have is an answer, and a wrong one, of a program and of a log",
          "[compare][command_engine]") {
  const Folder folder;
  const auto queries = folder.write("q", stream(6));
  for (const char* fault : {"no-such-lattice", "no-such-atom"}) {
    const Run run = folder.lorentz("first-hit --detail --engine " + odd(fault) + " " + queries);
    INFO(fault << run.err);
    CHECK(run.status == 0);
    CHECK(run.err.empty());
    const bool lattice = std::string(fault) == "no-such-lattice";
    CHECK(contains(run.out, std::string(R"("q5","outcome":"hit",)") +
                                (lattice ? R"("lattice":1,"atom":0)" : R"("lattice":0,"atom":7)")));
    const Run compared = folder.lorentz("compare --json --queries " + queries + " --engine " + odd(fault) +
                                        " --answers logged=" + folder.write("a", run.out));
    INFO(compared.out << compared.err);
    CHECK(compared.status == 1);
    const std::string counts = R"(","queries":6,"agree":0,"ill_posed":0,"wrong":6,)";
    CHECK(contains(compared.out, "logged" + counts));
    CHECK(contains(compared.out, fault + counts));
  }
}

TEST_CASE("A time below zero is an answer, judged as any other", "[compare][command_engine]") {
  const Folder folder;
  // It starts on a disc, and moves into it: the time is 0.
  const auto queries = folder.write("q", kScene + R"({"id":1,"x":[-0.25,0],"v":[1,0]})"
                                                  "\n");
  const auto compared = [&](const char* time) {
    return folder.lorentz(
        "compare --json --times --queries " + queries + " --answers logged=" +
        folder.write("a", R"({"id":1,"outcome":"hit","lattice":0,"atom":0,"cell":[0,0],"time":)" +
                              std::string(time) + "}\n"));
  };
  CHECK(compared("-4e-19").status == 0);
  CHECK(contains(compared("-4e-19").out, R"("agree":1,)"));
  CHECK(compared("-1e-3").status == 1);
}

TEST_CASE("An answer after the last query, and one too few", "[compare][command_engine]") {
  const Folder folder;
  const auto queries = folder.write("q", stream(6));
  const Run twice = folder.lorentz("first-hit --engine " + odd("twice") + " " + queries);
  CHECK(twice.status == 3);
  CHECK(contains(twice.err, "answered this query again:\n"));
  CHECK(lines(twice.out) == 6);
  CHECK(twice.out.ends_with(answer_to(5) + "\n"));
  const Run skips = folder.lorentz("first-hit --engine " + odd("skips") + " " + queries);
  CHECK(skips.status == 3);
  CHECK(skips.out.ends_with(error_to(5, "cmd ended (exit 0) without an answer to this query\"}\n")));
}

TEST_CASE("Answers without an id: to the query whose turn it is, or of the scene",
          "[compare][command_engine]") {
  const Folder folder;
  const auto queries = folder.write("q", stream());
  const Run query = folder.lorentz("first-hit --engine " + odd("nameless") + " " + queries);
  CHECK(query.status == 0);  // an error is an answer
  check_all_but_fifth(query.out, "not mine\"}");
  const Run scene = folder.lorentz("first-hit --engine " + odd("refuses-scene") + " " + queries);
  CHECK(scene.status == 0);
  CHECK(contains(scene.err, "says of the scene: too wild a scene"));
  check_all_but_fifth(scene.out, "");
  const Run first =
      folder.lorentz("first-hit --engine " + odd("nameless 0") + " " + folder.write("p", stream(3)));
  CHECK(first.out == error_to(0, "not mine\"}\n") + answer_to(1) + "\n" + answer_to(2) + "\n");
  const Run only =
      folder.lorentz("first-hit --engine " + odd("nameless 0") + " " + folder.write("o", stream(1)));
  CHECK(only.status == 0);
  CHECK(only.out == error_to(0, "not mine\"}\n"));
}

TEST_CASE("Lines between the answers cost no answer, but are reported", "[compare][command_engine]") {
  const Folder folder;
  const Run run = folder.lorentz("first-hit --engine " + odd("talks") + " " + folder.write("q", stream()));
  CHECK(run.status == 3);
  CHECK(contains(run.err, "wrote a line that is not an answer, loading, please wait ("));
  check_all_but_fifth(run.out, "");
}

TEST_CASE("A silent program is killed, with all that it started", "[compare][command_engine]") {
  const Folder folder;
  const auto queries = folder.write("q", stream());
  for (const std::string fault : {"sleeps", "closes-input"}) {
    const Run run = folder.lorentz("first-hit --timeout 0.5 --engine " + silent(fault) + " " + queries);
    INFO(fault << run.err);
    CHECK(run.status == 3);
    CHECK(contains(run.err, "gave no answer within 0.5 s:\n"));
    check_all_but_fifth(run.out, fault == "sleeps" ? "cmd gave no answer within 0.5 s\"" : "cmd ");
  }
  const Run buffered = folder.lorentz("first-hit --timeout 0.4 --engine " + silent("sleeps-buffered 1") +
                                      " " + folder.write("p", stream(3)));
  INFO(buffered.err);
  CHECK(buffered.out ==
        answer_to(0) + "\n" + error_to(1, "cmd gave no answer within 0.4 s\"}\n") + answer_to(2) + "\n");
  // The grandchild, too.
  const std::string pid = folder.file("pid");
  const auto start = std::chrono::steady_clock::now();
  const Run never = folder.lorentz("first-hit --timeout 0.1 --engine 'cmd:sleep 1000 & echo $! >" + pid +
                                   "; wait' " + queries);
  CHECK(never.status == 3);
  CHECK(seconds_since(start) < 8);
  CHECK(lines(never.out) == kQueries);
  CHECK(contains(never.out, error_to(4, "cmd gave no answer within 0.1 s")));
  CHECK(contains(never.out,
                 error_to(5, "cmd was given up after 5 failures in a row; this query was not asked")));
  CHECK(contains(never.err, "is given up after 5 failures in a row"));
  CHECK_FALSE(goes_on_running(pid));
}

TEST_CASE("A program is not waited for any longer when it is enough, whatever it does",
          "[compare][command_engine]") {
  // It answers the first query and then hangs, floods, or goes on to do so behind the shell's back.
  const std::string first = R"(read -r scene; read -r query; echo '{"id":1,"outcome":"never"}'; )";
  for (const std::string then : {"exec sleep 1000", "exec yes", "while :; do echo x; done >&2",
                                 "sleep 1000 & wait", "trap '' TERM HUP PIPE; while :; do :; done"}) {
    lorentz::question::AnswererOptions options;
    const auto start = std::chrono::steady_clock::now();
    options.enough = [&] { return seconds_since(start) > 0.5; };
    const auto program = lorentz::question::engine_named("cmd:" + first + then).answerer(options);
    std::vector<lorentz::question::Reply> replies;
    program->on_reply([&](lorentz::question::Reply& reply) { replies.push_back(reply); });
    program->set_scene(lorentz::unit_scene(2, 0.25));
    for (int k = 0; k < 5000; ++k) program->ask("null", {{static_cast<double>(k), 0.5, 0}, {1, 1, 0}, {}});
    program->finish();
    INFO(then);
    CHECK(seconds_since(start) < 10);  // 60 is the timeout
    REQUIRE(replies.size() == 5000);
    CHECK(replies[0].answer.outcome == lorentz::Outcome::never);
    for (const std::size_t i : {1, 2, 4999}) {
      CHECK_FALSE(replies[i].was_asked());
      CHECK_FALSE(replies[i].is_fault());
    }
  }
}

TEST_CASE("A program that falls silent has its time from its start on", "[compare][command_engine]") {
  const auto start = std::chrono::steady_clock::now();
  const Run run = Folder().lorentz("compare --count 3 --timeout 0.5 --engine 'cmd:exec sleep 1000'");
  CHECK(run.status == 3);
  CHECK(contains(run.err, "gave no answer within 0.5 s"));
  CHECK(seconds_since(start) < 9);  // ten is how long it may introduce itself without an option
}

TEST_CASE("Hostile programs and libraries: every query has a reply, and the end comes",
          "[compare][command_engine][library_engine]") {
  const Folder folder;
  constexpr int kCount = 200;
  // Runs $FAULT at each query, whose number is $n.
  const std::string script = folder.write("hostile.sh", R"(eval "$1"
while read -r line; do
  case $line in *scene*) continue ;; esac
  n=$((n + 1))
  eval "$2"
  id=${line#*:} && id=${id%%,*}
  echo "{\"id\":$id,\"outcome\":\"never\"}"
done
)");
  struct Hostile {
    std::string engine;
    std::size_t answered;
  };
  const auto program = [&](const std::string& first, const std::string& each) {
    return "'cmd:exec sh " + script + " \"" + first + "\" \"" + each + "\"'";
  };
  const std::string at_100 = "test \\$n = 100 && ", library = "lib:" LORENTZ_ODD_LIBRARY;
  for (const auto& [engine, answered] :
       std::vector<Hostile>{{program("sleep 1000", ":"), 0},
                            {program(":", "sleep 1000"), 0},
                            {program(":", at_100 + "exec sleep 1000"), 198},
                            {program(":", at_100 + "exec tr 0 x </dev/zero"), 198},
                            {program(":", at_100 + "exec yes"), 198},
                            {program(":", at_100 + "kill -9 \\$\\$"), 198},
                            {program(":", at_100 + "{ sleep 1000 & }"), 200},
                            {program(":", "echo words >&2"), 200},
                            {program(":", "sleep 0.002"), 200},
                            {library + " hangs 0", 199},
                            {library + " hangs 99", 199},
                            {library + " floods 99", 199},
                            {library + " crashes 99", 199},
                            {library + " hangs-when-loaded", 0},
                            {library + " hangs-on-scene", 0}}) {
    const auto blank = engine.starts_with("lib:") ? engine.find(' ') : engine.size();
    const std::string odd = blank < engine.size() ? engine.substr(blank + 1) : "";
    const auto start = std::chrono::steady_clock::now();
    const Run run = folder.run("ODD='" + odd + "' " LORENTZ_PROGRAM " first-hit --timeout 1 --engine " +
                               engine.substr(0, blank) + " " + folder.write("q", stream(kCount)));
    INFO(engine << "\n" << run.err.substr(0, 1000));
    CHECK(run.status == (answered == kCount ? 0 : 3));
    const std::size_t errors = count_of(run.out, "\"error\"");
    if (odd != "hangs-when-loaded") CHECK(lines(run.out) == kCount);
    CHECK(lines(run.out) - errors == answered);
    CHECK(seconds_since(start) < 30);
  }
}

TEST_CASE("The last words of a program that dies are its own, not the shell's", "[compare][command_engine]") {
  for (const std::string signal : {"ABRT", "SEGV", "KILL"}) {
    INFO(signal);
    const std::string dies = "sh -c 'echo out of luck >&2; kill -" + signal + " $$'; exit $?";
    const auto program = lorentz::question::engine_named("cmd:" + dies).answerer({});
    program->on_reply([](lorentz::question::Reply& reply) { CHECK(reply.is_fault()); });
    program->set_scene(lorentz::unit_scene(2, 0.25));
    program->ask("null", {{0.5, 0.5, 0}, {1, 1, 0}, {}});
    program->finish();
    CHECK(program->take_last_words() == "out of luck");
  }
}

TEST_CASE("A flood of bad lines ends a program at 1 MiB", "[compare][command_engine]") {
  const Folder folder;
  const std::string queries = folder.write("q", stream(3));
  for (const std::string flood :
       {"exec yes a line of words, which is not an answer, nor is it JSON", "exec tr 0 x </dev/zero",
        "while read -r line; do :; done; yes so is this one, which comes when all queries have been read"}) {
    INFO(flood);
    const Run run = folder.lorentz("first-hit --timeout 3600 --engine 'cmd:" + flood + "' " + queries);
    CHECK(run.status == 3);
    CHECK(contains(run.out, error_to(1, "cmd wrote more than 1 MiB that is not an answer")));
    CHECK(run.err.size() < 10'000);
  }
}

TEST_CASE("A program that closes its output is not waited for", "[compare][command_engine]") {
  const Folder folder;
  const auto start = std::chrono::steady_clock::now();
  const Run run =
      folder.lorentz("first-hit --engine " + odd("closes-output") + " " + folder.write("q", stream()));
  CHECK(run.status == 3);
  check_all_but_fifth(run.out, "cmd closed its output before this query's answer");
  CHECK(seconds_since(start) < 10);
}

TEST_CASE("Programs that do not start, or end at once", "[compare][command_engine]") {
  const Folder folder;
  const auto queries = folder.write("q", stream());
  for (const auto& [command, message] :
       {std::pair<std::string, std::string>{"/no/such/program",
                                            "cmd died (exit 127, no such command) on this query"},
        {R"(sh -c "kill -SEGV \$\$"; exit $?)", "cmd died (exit 139, signal 11, "},
        {"true", "cmd ended (exit 0) without an answer to this query"}}) {
    const Run run = folder.lorentz("first-hit --engine 'cmd:" + command + "' " + queries);
    INFO(run.out << run.err);
    CHECK(run.status == 3);
    CHECK(lines(run.out) == kQueries);
    CHECK(run.out.starts_with(error_to(0, message)));
    CHECK(contains(run.out, error_to(4, message)));
    CHECK(contains(run.out, error_to(5, "cmd was given up")));
    CHECK(run.out.ends_with(
        error_to(19, "cmd was given up after 5 failures in a row; this query was not asked\"}\n")));
  }
}

TEST_CASE("A program that ends after some answers is started again, with its scene",
          "[compare][command_engine]") {
  const Folder folder;
  const Run run =
      folder.lorentz("first-hit --engine " + odd("ends-after 8") + " " + folder.write("q", stream()));
  INFO(run.out << run.err);
  CHECK(run.status == 3);
  CHECK(lines(run.out) == kQueries);
  CHECK(contains(run.out,
                 answer_to(7) + "\n" + error_to(8, "cmd died (exit 4) on this query\"}\n") + answer_to(9)));
  CHECK(contains(run.out, answer_to(16) + "\n" + error_to(17, "cmd died (exit 4)")));
  CHECK(run.out.ends_with(answer_to(19) + "\n"));
}

TEST_CASE("The end of a program: its status, and if it does not come", "[compare][command_engine]") {
  const Folder folder;
  const auto queries = folder.write("q", stream());
  const Run status = folder.lorentz("first-hit --engine " + odd("bad-exit") + " " + queries);
  CHECK(status.status == 0);  // every answer is there
  CHECK(contains(status.err, "ended with exit 9 after its last answer"));
  const auto start = std::chrono::steady_clock::now();
  const Run stays = folder.lorentz("first-hit --engine " + odd("stays") + " " + queries);
  CHECK(stays.status == 0);
  CHECK(contains(stays.err, "did not end when its input did"));
  CHECK(seconds_since(start) < 10);
}

TEST_CASE("A program's stderr is ours, however much it is", "[compare][command_engine]") {
  const Folder folder;
  const Run run =
      folder.lorentz("first-hit --engine " + odd("complains") + " " + folder.write("q", stream()));
  CHECK(run.status == 0);
  CHECK(run.err.size() == 100'001u * kQueries);
  check_all_but_fifth(run.out, "");
}

TEST_CASE("A program that complains without end keeps us neither from its answers nor from the end",
          "[compare][command_engine]") {
  const Folder folder;
  const auto queries = folder.write("q", stream());
  // Read as slowly as this, it always has more to say.
  const Run run =
      folder.run("{ timeout 300 " LORENTZ_PROGRAM
                 " first-hit --engine 'cmd:yes complaint >&2 & exec " LORENTZ_PROGRAM " first-hit' " +
                 queries + " >" + folder.file("o") + "; echo $? >" + folder.file("status") +
                 "; } 2>&1 | while test -n \"$(head -c 4096)\"; do :; done; cat " + folder.file("status") +
                 " " + folder.file("o"));
  CHECK(run.out == "0\n" + folder.lorentz("first-hit " + queries).out);
}

TEST_CASE("Ids of the user's, bad lines and scenes around another program", "[compare][command_engine]") {
  const Folder folder;
  const std::string solid =
      R"({"scene":{"dimension":3,"lattices":[{"vectors":[[1,0,0],[0,1,0],[0,0,1]],"atoms":[{"position":[0,0,0],"radius":0.25}]}]}})"
      "\n";
  const std::string mixed = kGood + kScene + kGood + kGood + "bad\n" + R"({"x":[0.5,0],"v":[1,0]})" + "\n" +
                            solid + R"({"id":7,"x":[0.5,0,0],"v":[1,0,0]})" + "\n" + kGood + kScene + kGood;
  const auto queries = folder.write("q", mixed);
  const Run own = folder.lorentz("first-hit --engine oracle " + queries);
  const Run other = folder.lorentz("first-hit --engine cmd:" LORENTZ_PROGRAM "' first-hit' " + queries);
  INFO(other.err);
  CHECK(other.status == 2);
  CHECK(other.out == own.out);
}

TEST_CASE("A time limit and the detail are added to other programs' answers, digits are the oracle's",
          "[compare][command_engine]") {
  const Folder folder;
  const auto queries = folder.write("q", kScene + kGood + R"({"id":7,"x":[0,0.5],"v":[1,0]})" + "\n");
  const std::string engine = "--engine cmd:" LORENTZ_PROGRAM "' first-hit' " + queries;
  for (const std::string option : {"--detail ", "--max-time 0.25 ", "--max-time 0.26 "})
    CHECK(folder.lorentz("first-hit " + option + engine).out ==
          folder.lorentz("first-hit " + option + queries).out);
  CHECK(folder.lorentz("first-hit --digits 5 " + engine).status == 2);
}

TEST_CASE("Answers come while the input pauses", "[compare][command_engine]") {
  const Folder folder;
  const auto rest = folder.write("rest", kGood);
  const std::string out = folder.file("o");
  const auto query = [](int k) { return stream(k + 1).substr(stream(k).size()); };
  struct Case {
    std::string manner, text;
    int count;
  };
  for (const auto& [manner, text, count] : {Case{"fine", stream(3), 3}, Case{"at-end", stream(3), 3},
                                            Case{"nameless 0", kScene + query(1) + kScene + query(0), 2}}) {
    const std::string number = std::to_string(count);
    const std::string command =
        "{ cat " + folder.write("first", text) + "; for i in $(seq 50); do sleep 0.1; test $(wc -l <" + out +
        ") = " + number + " && break; done; wc -l <" + out + " >" + folder.file("early") + "; cat " + rest +
        "; } | " LORENTZ_PROGRAM " first-hit --engine " + odd(manner) + " >" + out;
    CHECK(std::system((": >" + out + "; " + command).c_str()) == 0);
    CHECK(folder.read("early") == number + "\n");
    CHECK(lines(folder.read("o")) == static_cast<std::size_t>(count) + 1);
  }
}

TEST_CASE("A program that ends between two queries is to blame for it, and neither of them",
          "[compare][command_engine]") {
  const Folder folder;
  const std::string out = folder.file("o"), pid = folder.file("pid");
  // The second query comes when the program that gave the first answer has ended: it is a zombie, or gone.
  const std::string wait = "; for i in $(seq 600); do sleep 0.1; test -s " + out +
                           " && ! grep -q '^State:.[^Z]' /proc/$(cat " + pid + ")/status && break; done; ";
  const std::string command = "{ cat " + folder.write("first", stream(1)) + wait + "cat " +
                              folder.write("rest", kGood) +
                              "; } 2>/dev/null | " LORENTZ_PROGRAM " first-hit --engine 'cmd:echo $$ >" +
                              pid + "; " + odd("leaves 0").substr(5) + " >" + out + " 2>" + folder.file("e");
  CHECK(std::system((": >" + out + "; " + command).c_str()) != 0);
  CHECK(lines(folder.read("o")) == 2);
  CHECK_FALSE(contains(folder.read("o"), "error"));
  CHECK(contains(folder.read("e"), "ended (exit 0) before it was told to"));
}

TEST_CASE("The one query that a program dies of is found with few starts", "[compare][command_engine]") {
  const Folder folder;
  const std::string starts = folder.file("starts");
  const Run run = folder.lorentz("first-hit --engine 'cmd:echo >>" + starts + "; " +
                                 odd("dies-buffered").substr(5) + " " + folder.write("q", stream()));
  check_all_but_fifth(run.out, "cmd died (exit 3) on this query");
  CHECK(lines(folder.read("starts")) <= 14);  // one a query would be more
}

TEST_CASE("A program that was given up has one more chance in a new scene", "[compare][command_engine]") {
  const Folder folder;
  const auto query = [](int k) { return stream(k + 1).substr(stream(k).size()); };
  std::string text = kScene + query(0);
  for (int i = 0; i < 7; ++i) text += query(5);
  text += query(1) + kScene + query(2) + query(5) + query(3);
  const Run run = folder.lorentz("first-hit --engine " + odd("dies") + " " + folder.write("q", text));
  INFO(run.out << run.err);
  CHECK(contains(run.out, error_to(1, "cmd was given up")));
  CHECK(contains(run.out, answer_to(2) + "\n" + error_to(5, "cmd died (exit 3)")));
  CHECK(run.out.ends_with(answer_to(3) + "\n"));
}

TEST_CASE("When this program is killed, so is the other", "[compare][command_engine]") {
  const Folder folder;
  const std::string pid = folder.file("pid");
  const std::string command = LORENTZ_PROGRAM " first-hit --engine 'cmd:sleep 1000 & echo $! >" + pid +
                              "; wait' " + folder.write("q", stream()) + " & p=$!; while ! test -s " + pid +
                              "; do sleep 0.02; done; kill $p; wait $p; test $? = 143";
  CHECK(std::system(("{ " + command + "; } 2>/dev/null").c_str()) == 0);
  CHECK_FALSE(goes_on_running(pid));
}

TEST_CASE("A signal that ends a caller without handlers ends the program that it asks, too",
          "[compare][command_engine]") {
  const Folder folder;
  const std::string pid = folder.file("pid");
  const pid_t child = fork();
  REQUIRE(child >= 0);
  if (child == 0) {
    signal(SIGTERM, SIG_DFL);
    const auto program =
        lorentz::question::engine_named("cmd:echo $$ > " + pid + "; exec sleep 1000").answerer({});
    asked(*program, lorentz::unit_scene(2, 0.25), 1);
    _exit(1);
  }
  while (folder.read("pid").empty()) usleep(10'000);
  kill(child, SIGTERM);
  int status = 0;
  REQUIRE(waitpid(child, &status, 0) == child);
  CHECK((WIFSIGNALED(status) && WTERMSIG(status) == SIGTERM));
  CHECK_FALSE(goes_on_running(pid));
}

TEST_CASE("Names: commands with commas, none, and who else there is", "[compare][command_engine]") {
  const Folder folder;
  CHECK(folder.lorentz("compare --engine cmd:").status == 2);
  CHECK(folder.lorentz("first-hit --engine 'cmd:  ' " + folder.write("q", kScene + kGood)).status == 2);
  CHECK(contains(folder.lorentz("compare --engine nobody").err, "cmd:COMMAND"));
  CHECK(folder.lorentz("first-hit --timeout 0 " + folder.file("q")).status == 2);
  for (const char* help : {"first-hit --help", "compare --help", "bench --help"})
    CHECK(contains(folder.lorentz(help).out, "cmd:COMMAND"));
  const Run run = folder.lorentz("compare --json --count 50 -e 'oracle,cmd:echo a,b >&2; " LORENTZ_PROGRAM
                                 " first-hit' --engine reduction,oracle");
  INFO(run.out << run.err);
  CHECK(run.status == 0);
  CHECK(run.err == "a,b\n");
  CHECK(contains(run.out, R"({"engine":"cmd:echo a,b >&2; )"));
  CHECK(contains(run.out, R"({"engine":"reduction","queries":50,"agree":50)"));
  CHECK(contains(run.out, R"(first-hit","queries":50,"agree":50)"));
}

TEST_CASE("compare counts a failed query as missing and has exit status 3, before 2 and 1",
          "[compare][command_engine]") {
  const Folder folder;
  const Run run = folder.lorentz("compare --json --queries " + folder.write("q", stream() + "bad\n") +
                                 " --engine " + odd("dies"));
  INFO(run.out << run.err);
  CHECK(run.status == 3);
  CHECK(contains(
      run.out,
      R"("queries":20,"agree":0,"ill_posed":0,"wrong":19,"wrong_time":0,"other_quantity":0,"undecided":0,"unsupported":0,"error":0,"missing":1,)"));
  const std::string said = "died (exit 3) on this query";  // and it is not run again
  CHECK(contains(run.err, said));
  CHECK(run.err.find(said) == run.err.rfind(said));
}

TEST_CASE("bench takes other programs", "[compare][command_engine]") {
  const Folder folder;
  const Run run = folder.lorentz("bench --scene square --radius 0.1 --count 200 --csv " + folder.file("c") +
                                 " --engine cmd:" LORENTZ_PROGRAM "' first-hit --engine reduction'");
  INFO(run.out << run.err);
  CHECK(run.status == 0);
  CHECK(contains(folder.read("c"), "square,0.1,drawn,cmd:"));
}

TEST_CASE("A hundred thousand queries through the pipes are answered as without them",
          "[compare][command_engine]") {
  const Folder folder;
  std::string text = kScene;
  for (int i = 0; i < 100'000; ++i)
    text += "{\"id\":" + std::to_string(i % 1000) + ",\"x\":[0.5," + std::to_string(0.3 + 4e-6 * i) +
            "],\"v\":[" + std::to_string(1 + i % 17) + "," + std::to_string(i % 13 - 6) + "]}\n";
  const auto queries = folder.write("q", text);
  const Run own = folder.lorentz("first-hit --engine reduction " + queries);
  const Run other =
      folder.lorentz("first-hit --engine cmd:" LORENTZ_PROGRAM "' first-hit --engine reduction' " + queries);
  CHECK(other.status == 0);
  CHECK(lines(other.out) == 100'000);
  CHECK(other.out == own.out);
  // A program that reads all before it answers gets as many as may be on their way, again and again.
  const std::string all = folder.file("all");
  const Run at_end =
      folder.lorentz("first-hit --engine 'cmd:cat >" + all + "; wc -l <" + all +
                     " >&2; " LORENTZ_PROGRAM " first-hit --engine reduction " + all + "' " + queries);
  CHECK(at_end.status == 0);
  CHECK(at_end.out == own.out);
  CHECK(lines(at_end.err) >= 25);
  std::istringstream counts(at_end.err);
  for (int count = 0; counts >> count;) CHECK(count <= 4097);  // and the scene
}

TEST_CASE("The examples agree with the oracle", "[compare][command_engine]") {
  const Folder folder;
  for (const std::string engine :
       {"'cmd:" LORENTZ_PYTHON " " LORENTZ_SOURCE_DIR "/docs/examples/naive_engine.py'",
        "cmd:" LORENTZ_NAIVE_ENGINE})
    for (const std::string scene : {"square", "cubic"}) {
      const Run run =
          folder.lorentz("compare --json --scene " + scene + " --radius 0.1 --count 30 --engine " + engine);
      INFO(engine << run.out << run.err);
      CHECK(run.status == 0);
      CHECK(contains(run.out, R"("queries":30,"agree":30,)"));
    }
}

TEST_CASE("The examples read their streams properly", "[compare][command_engine]") {
  const Folder folder;
  const std::string python = LORENTZ_PYTHON " " LORENTZ_SOURCE_DIR "/docs/examples/naive_engine.py <";
  const std::string leaving =
      R"({"id":"l","x":[0.25,0],"v":[1,0],"from":{"lattice":0,"atom":0,"cell":[0,0]}})";
  const std::string inside = R"({"id":"i","x":[0.1,0],"v":[1,0]})",
                    corridor = R"({"id":"c","x":[0,0.5],"v":[1,0]})";
  const auto queries =
      folder.write("q", kGood + kScene + "bad\n" + leaving + "\n" + inside + "\n" + corridor + "\n");
  CHECK(std::system((python + queries + " >" + folder.file("o")).c_str()) == 0);
  const std::string out = folder.read("o");
  INFO(out);
  CHECK(out.starts_with(R"({"id": "good", "outcome": "error", "message": "no scene"})"
                        "\n"
                        R"({"id": null, "outcome": "error", )"));
  CHECK(contains(out,
                 R"({"id": "l", "outcome": "hit", "time": 0.5, "lattice": 0, "atom": 0, "cell": [1, 0]})"));
  CHECK(contains(out, R"({"id": "i", "outcome": "inside", "lattice": 0, "atom": 0, "cell": [0, 0]})"));
  CHECK(out.ends_with("{\"id\": \"c\", \"outcome\": \"undecided\"}\n"));
  for (const std::string engine :
       {"'cmd:" LORENTZ_PYTHON " " LORENTZ_SOURCE_DIR "/docs/examples/naive_engine.py'",
        "cmd:" LORENTZ_NAIVE_ENGINE})
    CHECK(contains(folder.lorentz("compare --json --scene ellipse --count 10 --engine " + engine).out,
                   R"("unsupported":10)"));
  const Run crystal = folder.lorentz("compare --json --scene hcp --count 20 --engine 'cmd:" LORENTZ_PYTHON
                                     " " LORENTZ_SOURCE_DIR "/docs/examples/naive_engine.py'");
  CHECK(contains(crystal.out, R"("agree":20,)"));
}
