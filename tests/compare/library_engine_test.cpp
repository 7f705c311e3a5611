// lib:FILE.so: shared libraries as engines, and what is made of their faults. tests/compare/odd_library.c has the
// faults.
#include <catch2/catch.hpp>
#include <chrono>
#include <cstdlib>
#include <set>

#include "question/engines.hpp"
#include "question/race.hpp"
#include "question/starts/free_starts.hpp"
#include "tests/support/command_line.hpp"

using namespace lorentz::test;
using lorentz::Outcome;
using lorentz::question::AnswererOptions;
using lorentz::question::Reply;

namespace {

const std::string kOdd = "lib:" LORENTZ_ODD_LIBRARY;

// The variable for a time, here and in what is started.
class Odd {
 public:
  explicit Odd(const std::string& fault) { setenv("ODD", fault.c_str(), 1); }
  ~Odd() { unsetenv("ODD"); }
  Odd(const Odd&) = delete;
  Odd& operator=(const Odd&) = delete;
};

// Queries "q0", "q1", ... that start at (0, 0.5), (1, 0.5), ...
std::string odd_stream(int count = 20) {
  std::string text = kScene;
  for (int k = 0; k < count; ++k)
    text += "{\"id\":\"q" + std::to_string(k) + "\",\"x\":[" + std::to_string(k) + ",0.5],\"v\":[1,1]}\n";
  return text;
}

std::string line_of(int k, const std::string& rest) {
  return "{\"id\":\"q" + std::to_string(k) + "\"," + rest;
}

std::string hit(int k) {
  const std::string n = std::to_string(k);
  return line_of(k, R"("outcome":"hit","lattice":0,"atom":0,"cell":[)" + n + ",0],\"time\":" + n + "}\n");
}

std::string error(int k, const std::string& message) {
  return line_of(k, R"("outcome":"error","message":")" + message + "\"}\n");
}

// Every query has its answer in its place, but for this one, which has this line.
std::string all_but(int odd, const std::string& line, int count = 20) {
  std::string text;
  for (int k = 0; k < count; ++k) text += k == odd ? line : hit(k);
  return text;
}

Run ask(const Folder& folder, const std::string& fault, int count = 20, const std::string& options = "") {
  const Odd odd(fault);
  return folder.lorentz("first-hit " + options + " --engine " + kOdd + " " +
                        folder.write("q", odd_stream(count)));
}

std::vector<Reply> replies_of(lorentz::question::Answerer& answerer, const std::vector<double>& starts) {
  std::vector<Reply> replies;
  answerer.on_reply([&](Reply& reply) { replies.push_back(std::move(reply)); });
  for (const double x : starts) answerer.ask("1", {{x, 0.5, 0}, {1, 1, 0}, {}});
  answerer.drain();
  return replies;
}

}  // namespace

TEST_CASE("A library says what the same engine says as a program", "[compare][library_engine]") {
  const Folder folder;
  int hits = 0, of_obstacles = 0;
  for (const std::string scene : {"square", "cubic"})
    for (const std::string kind : {"uniform", "surface"}) {
      const std::string starts = folder
                                     .run(LORENTZ_PROGRAM " sample --scene " + scene +
                                          " --radius 0.3 --kind " + kind + " --seed 3 --count 500")
                                     .out;
      const std::string queries = folder.write("q", starts);
      const Run library = folder.lorentz("first-hit --engine lib:" LORENTZ_LIBRARY_ENGINE " " + queries);
      const Run program = folder.lorentz("first-hit --engine cmd:" LORENTZ_NAIVE_ENGINE " " + queries);
      INFO(scene << kind << library.err);
      CHECK(library.status == 0);
      CHECK(library.out == program.out);
      hits += count_of(library.out, "\"hit\""), of_obstacles += count_of(starts, "\"from\"");
    }
  CHECK(hits > 1900);
  CHECK(of_obstacles == 1000);
}

TEST_CASE("A library's crash, exit or silence costs the query that it shows at",
          "[compare][library_engine]") {
  const Folder folder;
  struct Fault {
    std::string name, error;
  };
  const Fault fault = GENERATE(values<Fault>({
      {"crashes", "lib died (signal 11, Segmentation fault) on this query"},
      {"aborts", "lib died (signal 6, Aborted) on this query"},
      {"exits", "lib died (exit 3) on this query"},
      {"ends", "lib ended (exit 0) without an answer to this query"},
      {"hangs", "lib gave no answer within 2 s"},
  }));
  const Run run = ask(folder, fault.name + " 57", 200, fault.name == "hangs" ? "--timeout 2" : "");
  INFO(fault.name << "\n" << run.err);
  CHECK(run.status == 3);
  CHECK(run.out == all_but(57, error(57, fault.error), 200));
  const std::string query = "{\"id\":\"q57\",\"x\":[57,0.5],\"v\":[1,1]}\n";
  CHECK(run.err == "lorentz: " + kOdd + ": " + fault.error.substr(4) + ":\n" + kScene + query);
}

TEST_CASE("A row that no answer can be made of is a fault of its own", "[compare][library_engine]") {
  const Folder folder;
  for (const auto& [name, message] : std::vector<std::pair<std::string, std::string>>{
           {"outcome", "gave the outcome 7, which <lorentz/engine.h> does not have"},
           {"silent", "gave no answer to this query: it left its outcome at -1"},
           {"lattice", "named the lattice 1; the scene has 1, counted from 0"},
           {"atom", "named the atom 4 of lattice 0, which has 1, counted from 0"},
           {"negative-atom", "named the atom -1 of lattice 0, which has 1, counted from 0"},
           {"not-a-number", "gave a hit whose time is not a number"}}) {
    const Run run = ask(folder, name);
    INFO(name << run.err);
    CHECK(run.status == 3);
    CHECK(run.out == all_but(5, error(5, "lib " + message)));
    CHECK(contains(run.err, message + ":\n"));
  }
}

TEST_CASE("What a library may say besides a hit", "[compare][library_engine]") {
  const Folder folder;
  for (const auto& [name, answer] : std::vector<std::pair<std::string, std::string>>{
           {"never", R"("outcome":"never"})"},
           {"inside", R"("outcome":"inside","lattice":0,"atom":0,"cell":[5,0]})"},
           {"undecided", R"("outcome":"undecided"})"},
           {"unsupported-query",
            R"("outcome":"error","message":"lib does not support this query","reason":"unsupported"})"}}) {
    const Run run = ask(folder, name);
    INFO(name << run.out << run.err);
    CHECK(run.status == 0);
    CHECK(run.err.empty());
    CHECK(run.out == all_but(5, line_of(5, answer + "\n")));
  }
}

TEST_CASE("A library sees the whole scene: lattices of any rank, balls and ellipsoids",
          "[compare][library_engine]") {
  const Folder folder;
  const std::string scene = folder.write("scene.toml", R"(dimension = 3
[[lattices]]
vectors = [[1, 0, 0], [0, 2, 0]]
[[lattices.atoms]]
position = [0.5, 0.25, 0.125]
radius = 0.25
[[lattices]]
vectors = []
[[lattices.atoms]]
position = [9, 8, 7]
radius = 3
[[lattices.atoms]]
position = [6, 5, 4]
semiaxes = [[1, 2, 0], [0, 3, 0], [0, 0, 4]]
)");
  const Odd odd("describes");
  const Run run = folder.lorentz("first-hit --jobs 3 --scene " + scene + " --engine " + kOdd + " " +
                                 folder.write("q", "{\"id\":1,\"x\":[0,0,50],\"v\":[1,0,0]}\n"));
  INFO(run.err);
  CHECK(run.status == 0);
  CHECK(contains(
      run.out,
      "lib does not support this scene: d 3 threads 3 lattices 2 atoms 3 ranks 2 0 vectors 1 0 0 0 2 0 "
      "lattice_of 0 1 1 positions 0.5 0.25 0.125 9 8 7 6 5 4 radii 0.25 3 0 "
      "shapes 0.25 0 0 0 0.25 0 0 0 0.25 3 0 0 0 3 0 0 0 3 1 2 0 0 3 0 0 0 4\""));
  CHECK(contains(run.out, R"("reason":"unsupported")"));
}

TEST_CASE("Cells have as many components as the lattice has vectors", "[compare][library_engine]") {
  const Folder folder;
  const std::string row = R"({"scene":{"dimension":2,"lattices":[{"vectors":[[1,0]],)"
                          R"("atoms":[{"position":[0,0],"radius":0.1}]}]}})"
                          "\n";
  const std::string query = R"({"id":1,"x":[5,0.5],"v":[1,1]})"
                            "\n";
  const Run run = folder.lorentz("first-hit --engine " + kOdd + " " + folder.write("q", row + query));
  CHECK(run.out == R"({"id":1,"outcome":"hit","lattice":0,"atom":0,"cell":[5],"time":5})"
                   "\n");
}

TEST_CASE("A scene that a library does not support", "[compare][library_engine]") {
  const Folder folder;
  const Run run = ask(folder, "unsupported", 2);
  CHECK(run.status == 0);
  CHECK(count_of(run.out, "lib does not support this scene\"") == 2);
  const Run ellipse =
      folder.lorentz("compare --json --scene ellipse --count 10 --engine lib:" LORENTZ_LIBRARY_ENGINE);
  CHECK(ellipse.status == 0);
  CHECK(contains(ellipse.out, R"("unsupported":10)"));
}

TEST_CASE("A library is told of the obstacle that is left, if 64 bits hold its cell",
          "[compare][library_engine]") {
  const Odd odd("tells-from");
  const auto engine = lorentz::question::engine_named(kOdd).answerer({});
  std::vector<Reply> replies;
  engine->on_reply([&](Reply& reply) { replies.push_back(std::move(reply)); });
  lorentz::Scene scene = lorentz::unit_scene(2, 0.25);
  scene.lattices.push_back(scene.lattices[0]);
  scene.lattices[1].atoms.resize(4, scene.lattices[1].atoms[0]);
  engine->set_scene(scene);
  lorentz::Query query{{1, 0.5, 0}, {1, 1, 0}, {}};
  engine->ask("1", query);
  query.from = lorentz::ObstacleId{1, 3, {-2, 4, 0}};
  engine->ask("2", query);
  query.from->cell[0] = *lorentz::Integer::from_decimal("9223372036854775808");
  engine->ask("3", query);
  query.from.reset();
  engine->ask("4", query);
  engine->drain();
  REQUIRE(replies.size() == 4);
  CHECK(replies[0].answer.time == 1);
  CHECK(replies[1].answer.time == 1000 + 100 + 30 - 0.2 + 0.04);
  CHECK(replies[2].answer.unsupported);
  CHECK(contains(replies[2].answer.message, "beyond 64 bits"));
  CHECK(replies[3].answer.time == 1);
  CHECK_FALSE(engine->failed());
}

TEST_CASE("A hundred thousand queries have their answers in order", "[compare][library_engine]") {
  const auto engine = lorentz::question::engine_named(kOdd).answerer({});
  engine->set_scene(lorentz::unit_scene(2, 0.25));
  std::vector<double> starts(100'000);
  for (std::size_t i = 0; i < starts.size(); ++i) starts[i] = static_cast<double>((i * 7919) % 100'003);
  const std::vector<Reply> replies = replies_of(*engine, starts);
  REQUIRE(replies.size() == starts.size());
  std::size_t right = 0;
  for (std::size_t i = 0; i < starts.size(); ++i)
    right += replies[i].answer.outcome == Outcome::hit && replies[i].answer.time == starts[i] &&
             replies[i].answer.obstacle.cell[0] == lorentz::Integer(static_cast<std::int64_t>(starts[i]));
  CHECK(right == starts.size());
  CHECK_FALSE(engine->failed());
}

TEST_CASE("A library is asked many queries at once", "[compare][library_engine]") {
  const Run run = ask(Folder(), "alone 1000", 3000);  // it aborts if more than 1000 come alone
  INFO(run.err);
  CHECK(run.status == 0);
  CHECK(run.out == all_but(-1, "", 3000));
}

TEST_CASE("A library that fails after its last row, or now and then, loses no answer",
          "[compare][library_engine]") {
  const Folder folder;
  // All rows are there when it crashes: halves are asked again, down to the one at fault.
  const Run after = ask(folder, "backwards 57", 200);
  INFO(after.err);
  CHECK(after.status == 3);
  CHECK(after.out == all_but(57, error(57, "lib died (signal 11, Segmentation fault) on this query"), 200));
  // It dies of how much it was asked; each query alone is answered.
  const Run often = ask(folder, "dies-after-calls 40", 100);
  INFO(often.err);
  CHECK(often.status == 3);
  CHECK(often.out == all_but(-1, "", 100));
  CHECK(contains(often.err,
                 "died (exit 6) where it was asked more than one query, and answers each by itself"));
  // Even where it was asked one at a time.
  const Odd odd("dies-after-calls 1");
  const auto engine = lorentz::question::engine_named(kOdd).answerer({});
  engine->set_scene(lorentz::unit_scene(2, 0.25));
  for (int i = 0; i < 3; ++i) {
    const std::vector<Reply> replies = replies_of(*engine, {3});
    REQUIRE(replies.size() == 1);
    CHECK(replies[0].answer.outcome == Outcome::hit);
  }
  CHECK(engine->failed());
}

TEST_CASE("A library that fails again and again is given up, until the next scene",
          "[compare][library_engine]") {
  const Folder folder;
  for (const auto& [fault, message] :
       {std::pair<std::string, std::string>{"crashes-always", "died (signal 11, Segmentation fault)"},
        {"hangs-always", "gave no answer within 1 s"}}) {
    const Run run = ask(folder, fault, 20, std::string(fault) == "hangs-always" ? "--timeout 1" : "");
    INFO(run.err);
    CHECK(run.status == 3);
    CHECK(lines(run.out) == 20);
    const std::string place = fault == "crashes-always" ? " on this query" : "";
    for (int k : {0, 4}) CHECK(contains(run.out, error(k, "lib " + message + place)));
    CHECK(count_of(run.err, message) == 2);
    CHECK(contains(run.err, "4 more times: " + message));
    for (int k : {5, 19})
      CHECK(contains(run.out,
                     error(k, "lib was given up after 5 failures in a row; this query was not asked")));
    CHECK(contains(run.err, "is given up after 5 failures in a row"));
  }
  const Odd odd("crashes-on-scene");
  const auto engine = lorentz::question::engine_named(kOdd).answerer({});
  const auto answered = [&](double radius, std::size_t queries) {
    engine->set_scene(lorentz::unit_scene(2, radius));
    std::set<std::string> messages;
    for (const Reply& reply : replies_of(*engine, std::vector<double>(queries, 3)))
      messages.insert(reply.answer.outcome == Outcome::hit ? "hit" : reply.answer.message);
    return messages;
  };
  CHECK(answered(0.125, 3) == std::set<std::string>{"hit"});
  CHECK(answered(0.25, 5) ==
        std::set<std::string>{"lib died (signal 11, Segmentation fault) while it prepared the scene"});
  CHECK(engine->given_up());
  CHECK_FALSE(engine->is_hopeless());
  CHECK(answered(0.5, 3) == std::set<std::string>{"hit"});
  CHECK_FALSE(engine->given_up());
}

TEST_CASE("A library that cannot be loaded is refused before anything is asked",
          "[compare][library_engine]") {
  const Folder folder;
  const auto refused = [&](const std::string& name, int status, const std::string& message) {
    const Run run = folder.lorentz("compare --count 5 --engine " + name);
    INFO(name << run.err);
    CHECK(run.status == status);
    CHECK(contains(run.err, message));
    CHECK(run.out.empty());
  };
  refused("lib:", 2, "lib: needs the path of a shared library");
  refused("lib:" + folder.file("no.so"), 3, "no.so: there is no such file; lib: is followed by the path");
  refused("lib:" + folder.file(""), 3, "there is no such file");
  refused("lib:" + folder.write("text.so", "text"), 3,
          "cannot be loaded as a shared library of this machine");
  refused("lib:libm.so.6", 3, "there is no such file");  // and not the system's
  {
    const Odd odd("version");
    refused(kOdd, 3, "is made for version 99 of <lorentz/engine.h>, and this is version 1; compile it again");
  }
  const Odd odd("crashes-when-loaded");
  refused(kOdd, 3, "died (signal 11, Segmentation fault) while it was loaded");
}

TEST_CASE("A library without the functions of the interface is refused by their names",
          "[compare][library_engine]") {
  const Folder folder;
  const std::string source = folder.write("part.c", "int lorentz_engine_interface(void) { return 1; }\n");
  REQUIRE(folder.run("cc -shared -fPIC -o " + folder.file("part.so") + " " + source).status == 0);
  const Run run = folder.lorentz("compare --count 5 --engine lib:" + folder.file("part.so"));
  CHECK(run.status == 3);
  CHECK(contains(run.err,
                 "does not export lorentz_engine_prepare, lorentz_engine_answer, lorentz_engine_release; "
                 "<lorentz/engine.h> declares"));
}

TEST_CASE("What a library writes, and how it ends, disturbs no answer", "[compare][library_engine]") {
  const Folder folder;
  const Run noisy = ask(folder, "noisy");
  CHECK(noisy.status == 0);
  CHECK(noisy.out == all_but(-1, ""));
  CHECK(contains(noisy.err, "00007\n"));
  const Run exits = ask(folder, "exits-when-released");
  CHECK(exits.status == 0);  // every answer is there
  CHECK(exits.out == all_but(-1, ""));
  CHECK(contains(exits.err, "ended with exit 2 after its last answer"));
}

TEST_CASE("What a library writes to standard error is passed on while it runs, however much it is",
          "[compare][library_engine]") {
  const Folder folder;
  for (const char* when : {"complains", "complains-when-loaded"}) {
    const Run run = ask(folder, when, 2000);
    INFO(when);
    CHECK(run.status == 0);
    CHECK(run.out == all_but(-1, "", 2000));
    CHECK(lines(run.err) == 2000);
  }
}

TEST_CASE("A library cannot fill this program's memory", "[compare][library_engine]") {
  const Folder folder;
  const Run claims = ask(folder, "claims-much");
  CHECK(claims.status == 3);
  CHECK(contains(claims.err, "claims more than 1 MiB of text"));
  const Run refuses = ask(folder, "refuses-at-length");
  CHECK(refuses.status == 0);
  CHECK(contains(refuses.out, "lib does not support this scene: xxx"));
  CHECK(refuses.out.size() < 20 * 70'000);
  const Run floods = ask(folder, "floods 57", 200, "--timeout 3600");
  CHECK(floods.status == 3);
  CHECK(floods.out == all_but(57, error(57, "lib wrote more than 1 MiB that is not an answer"), 200));
  CHECK(floods.err.size() < 10'000);
}

TEST_CASE("A crash while a scene is released is told as that, and costs no query",
          "[compare][library_engine]") {
  const Folder folder;
  const Odd odd("crashes-when-released");
  const std::string stream = odd_stream(2) + replaced(odd_stream(3), "0.25", "0.125");
  const Run run = folder.lorentz("first-hit --engine " + kOdd + " " + folder.write("q", stream));
  INFO(run.err);
  CHECK(run.status == 3);
  CHECK(run.out == all_but(-1, "", 2) + all_but(-1, "", 3));
  CHECK(contains(run.err, "died (signal 11, Segmentation fault) while it released the scene before\n"));
}

TEST_CASE("A library's time limit holds from its start on", "[compare][library_engine]") {
  const Folder folder;
  const auto start = std::chrono::steady_clock::now();
  const Run loading = ask(folder, "hangs-when-loaded", 20, "--timeout 1");
  CHECK(loading.status == 3);
  CHECK(contains(loading.err, "gave no answer within 1 s while it was loaded"));
  const Run preparing = ask(folder, "hangs-on-scene", 20, "--timeout 1");
  CHECK(preparing.status == 3);
  CHECK(contains(preparing.out, error(0, "lib gave no answer within 1 s while it prepared the scene")));
  CHECK(std::chrono::steady_clock::now() - start < std::chrono::seconds(50));  // 60 is that without an option
}

TEST_CASE("A library that hangs ends with this program, even if that is killed",
          "[compare][library_engine]") {
  const Folder folder;
  const std::string pid = folder.file("pid");
  const std::string command = "ODD=hangs-always ODD_PID=" + pid + " " LORENTZ_PROGRAM " first-hit --engine " +
                              kOdd + " " + folder.write("q", odd_stream(2)) + " & p=$!; while ! test -s " +
                              pid + "; do sleep 0.02; done; kill -9 $p; wait $p; true";
  CHECK(std::system(("{ " + command + "; } 2>/dev/null").c_str()) == 0);
  CHECK_FALSE(goes_on_running(pid));
}

TEST_CASE("Why a library cannot be started, and what helps", "[compare][library_engine]") {
  const Folder folder;
  // A shell of its own: the limit must leave room for what the outer one keeps.
  const Run run = folder.run("sh -c 'ulimit -n 9; exec \"$@\"' - " LORENTZ_PROGRAM " first-hit --engine " +
                             kOdd + " " + folder.write("q", odd_stream(2)));
  CHECK(run.status == 3);
  CHECK(contains(run.err, "cannot be started: Too many open files; allow more open files (ulimit -n)"));
}

TEST_CASE("What a library claims is handed on as it is", "[compare][library_engine]") {
  const auto claim = lorentz::question::engine_named(kOdd).introduce();
  REQUIRE(claim);
  CHECK(claim->name == "odd");
  CHECK(claim->precision == lorentz::NumberFormat::binary32);
  const auto none = lorentz::question::engine_named("lib:" LORENTZ_LIBRARY_ENGINE).introduce();
  CHECK_FALSE((none && (none->precision || none->time_tolerance)));
}

TEST_CASE("A library's time is that of its own calls", "[compare][library_engine]") {
  const auto seconds_of = [](const std::string& fault, std::size_t drains, std::size_t queries) {
    const Odd odd(fault);
    const auto engine = lorentz::question::engine_named(kOdd).answerer({});
    engine->set_scene(lorentz::unit_scene(2, 0.25));
    CHECK(engine->own_time()->seconds == 0);
    const auto start = std::chrono::steady_clock::now();
    for (std::size_t i = 0; i < drains; ++i)
      CHECK(replies_of(*engine, std::vector<double>(queries, 1)).size() == queries);
    const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - start;
    return std::pair(engine->own_time()->seconds, wall.count());
  };
  const auto [slow, slow_wall] = seconds_of("slow", 1, 50);  // 2 ms a query
  CHECK(slow >= 0.1);
  CHECK(slow < slow_wall);
  // The way to the other process and back takes much longer than a call.
  const auto [quick, quick_wall] = seconds_of("fine", 2000, 1);
  CHECK(quick > 0);
  CHECK(quick < quick_wall / 2);
}

TEST_CASE("A race times a library's calls, not its start nor its preparation", "[compare][library_engine]") {
  const Odd odd("slow-scene");  // half a second
  const auto place = std::make_shared<lorentz::question::Place>(lorentz::unit_scene(2, 0.25));
  const std::vector<lorentz::question::Question> questions = lorentz::question::questions_of(
      place, lorentz::starts::free_starts(place->scene(), lorentz::starts::Kind::uniform, 1, 40));
  lorentz::question::RaceOptions options;
  options.rounds = 1;
  const auto speeds = lorentz::question::race(questions, {lorentz::question::engine_named(kOdd)}, options);
  CHECK(speeds[0].ns_per_query > 0);
  CHECK(speeds[0].ns_per_query < 0.25e9 / 40);
}

TEST_CASE("A library that hangs ends when it is enough", "[compare][library_engine]") {
  const Odd odd("hangs");
  AnswererOptions options;
  const auto start = std::chrono::steady_clock::now();
  options.enough = [&] { return std::chrono::steady_clock::now() - start > std::chrono::milliseconds(400); };
  const auto engine = lorentz::question::engine_named(kOdd).answerer(options);
  engine->set_scene(lorentz::unit_scene(2, 0.25));
  const std::vector<Reply> replies = replies_of(*engine, {1, 2, 5, 7});
  REQUIRE(replies.size() == 4);
  for (const std::size_t i : {2, 3}) CHECK_FALSE(replies[i].was_asked());
  CHECK(std::chrono::steady_clock::now() - start < std::chrono::seconds(20));  // 60 is the timeout
}

TEST_CASE("Limits and details are added to a library's answers", "[compare][library_engine]") {
  const Folder folder;
  const Run limited = ask(folder, "fine", 20, "--max-time 9.5");
  CHECK(count_of(limited.out, "\"later\"") == 10);
  const std::string query = R"({"id":1,"x":[0.25,0],"v":[1,0]})"
                            "\n";
  const Run detail = folder.lorentz(
      "first-hit --detail --scene square --radius 0.25 --engine "
      "lib:" LORENTZ_LIBRARY_ENGINE " " +
      folder.write("q", query));
  INFO(detail.out << detail.err);
  CHECK(contains(detail.out, "\"normal\":[-1,0]"));
}

TEST_CASE("A library may be named wherever an engine is", "[compare][library_engine]") {
  const Folder folder;
  const std::string engine = " --engine lib:" LORENTZ_LIBRARY_ENGINE;
  const auto works = [&](const std::string& command, const std::string& says) {
    const Run run = folder.lorentz(command + engine);
    INFO(command << "\n" << run.out << run.err);
    CHECK(run.status <= 1);  // it is a naive engine
    CHECK(contains(run.out, says));
  };
  works("compare --json --scene cubic --count 50",
        R"("queries":50,"agree":49,"ill_posed":0,"wrong":0,"wrong_time":0,)");
  works("golden check --json --first 20 generic-2d", R"("engine":"lib:)");
  works("fuzz --json -t generic-2d --count 64 --mutate 0 --reword 0", R"("lib:)");
  works("judge --json --quick --time 2", R"("engine":"lib:)");
  works("trajectory --scene square --radius 0.25 --collisions 3 " +
            folder.write("s", R"({"id":1,"x":[0.5,0.1],"v":[1,0.3]})"
                              "\n"),
        "\"diverged\":null");
  CHECK(contains(folder.lorentz("compare --engine nobody").err, "lib:FILE.so"));
  CHECK(contains(folder.lorentz("judge --help").out, "lib:FILE.so"));
}
