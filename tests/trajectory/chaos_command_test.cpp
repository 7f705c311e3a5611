// lorentz lyapunov and lorentz diffusion as their users call them.
#include <catch2/catch.hpp>

#include <fmt/format.h>

#include <lorentz/errors.hpp>
#include "statistics/chaos/diffusion.hpp"
#include "statistics/chaos/lyapunov.hpp"
#include "tests/support/command_line.hpp"

using namespace lorentz;
using namespace lorentz::test;

TEST_CASE("lorentz lyapunov: theory stands beside, and threads change nothing", "[chaos][chaos_command]") {
  const Folder folder;
  const std::string what = "lyapunov --scene square --radius 0.2 --collisions 1e5 --seed 9301 ";
  const Run one = folder.lorentz(what);
  INFO(one.out << one.err);
  REQUIRE(one.status == 0);
  CHECK(contains(one.out, "scene square, r = 0.2, seed 9301"));
  CHECK(contains(one.out, "exact 2.185840735"));
  CHECK(contains(one.out, "theory, r -> 0: 3.0905"));  // - 2 ln 0.2 - 0.1283720411
  CHECK(contains(one.out, "; off by +0.13"));
  CHECK(folder.lorentz(what + "--jobs 3").out == one.out);
  const Run json = folder.lorentz(what + "--json --spectrum");
  CHECK(json.status == 0);
  CHECK(contains(json.out, R"({"scene":"square","radius":0.2,"seed":9301,)"));
  CHECK(contains(json.out, R"("mean_free_path":2.185840734)"));
  CHECK(lines(json.out) == 1);
  CHECK(contains(folder.lorentz("lyapunov --scene square --radius 0.2 --collisions 1 --json").out,
                 R"("collisions":4096,)"));
  CHECK(contains(folder.lorentz("lyapunov --scene cubic --radius 0.2 --collisions 1e4").out,
                 "sum of those above zero, a collision: 7."));
}

TEST_CASE("lorentz diffusion: theory stands beside, and threads change nothing", "[chaos][chaos_command]") {
  const Folder folder;
  const std::string what = "diffusion --scene triangular --count 2000 --time 20 --seed 9302 ";
  const Run one = folder.lorentz(what + "--csv " + folder.file("csv"));
  INFO(one.out << one.err);
  REQUIRE(one.status == 0);
  CHECK(contains(one.out, "2000 particles until t = 20"));
  CHECK(contains(one.out, "theory, gaps -> 0 (Machta and Zwanzig): D = 0.06"));
  CHECK(contains(one.out, "every path ends"));
  CHECK(lines(folder.read("csv")) == 18);
  CHECK(folder.lorentz(what + "--jobs 3").out == one.out);
  const Run open = folder.lorentz("diffusion --radius 0.4 --count 500 --time 20 --from surface");
  CHECK(contains(open.out, "theory, 2 C: 0.102403"));
  CHECK_FALSE(contains(open.out, "by velocities"));  // of uniform starts only
  const Run json = folder.lorentz("diffusion --radius 0.4 --count 500 --time 20 --json");
  CHECK(contains(json.out, R"("two_C":0.10240)"));
  CHECK(lines(json.out) == 1);
}

TEST_CASE("lorentz diffusion: no D where lattices leave corridors open that they share",
          "[chaos][chaos_command]") {
  const Folder folder;
  const auto scene = [&](const char* second) {
    return folder.write("scene.toml",
                        std::string("dimension = 2\n[[lattices]]\nvectors = [[1, 0], [0, 1]]\n"
                                    "[[lattices.atoms]]\nposition = [0, 0]\nradius = 0.1\n[[lattices]]\n"
                                    "vectors = ") +
                            second + "\n[[lattices.atoms]]\nposition = [0, 0]\nradius = 0.1\n");
  };
  const std::string what = "diffusion --count 200 --time 10 --scene ";
  for (const char* second : {"[[1.414, 0], [0, 1.732]]", "[[1.4142135623730951, 0], [0.3, 1.7320508]]"}) {
    const std::string file = scene(second), text = folder.lorentz(what + file).out;
    INFO(text);
    CHECK(contains(text, "\nno D: corridors or planar channels are open"));
    CHECK(contains(text, "theory, 2 C: not known"));
    CHECK_FALSE(contains(text, "\nD = "));
    const std::string json = folder.lorentz(what + file + " --json").out;
    CHECK(contains(json, R"("open":true,"D":null,"D_error":null)"));
    CHECK(contains(json, R"("two_C":null)"));
  }
  CHECK(contains(folder.lorentz(what + scene("[[1.4, 0.3], [-0.2, 1.7]]")).out, "every path ends"));
  // Parallel to 1e-11, but not exactly.
  const std::string tiny = what + scene("[[1.4142135623730951, 1e-11], [1e-11, 1.7320508]]") + " ";
  CHECK(contains(folder.lorentz(tiny).out, "\nwhether there is a D is not known\n"));
  CHECK(contains(folder.lorentz(tiny + "--json").out, R"("open":null,"D":)"));
}

TEST_CASE("lorentz diffusion says when its time is too short for a D", "[chaos][chaos_command]") {
  const Folder folder;
  const auto run = [&](const char* words) {
    return folder.lorentz(std::string("diffusion --count 200 ") + words).out;
  };
  CHECK(contains(run("--scene triangular --time 0.5"), "T is 1.96 mean free paths: too short"));
  CHECK_FALSE(contains(run("--scene triangular --time 20"), "too short"));
  CHECK(contains(run("--radius 0.1 --time 20"), "too short"));
  CHECK(contains(run("--scene triangular --time 5 --json"), R"("too_short":true)"));
  CHECK(contains(run("--scene triangular --time 5.2 --json"), R"("too_short":false)"));  // 20 of 0.2554
  // Without an exact mean, by the collisions: pockets between overlapping discs.
  CHECK(contains(run("--radius 0.6 --time 0.01"), "mean free paths: too short"));
  CHECK(contains(run("--radius 0.6 --time 0.01 --json"), R"("too_short":true)"));
  CHECK(contains(run("--radius 0.6 --time 20 --json"), R"("too_short":false)"));
  CHECK(contains(run("--radius 0.4 --json"), R"("machta_zwanzig":null)"));  // where no D is
}

TEST_CASE("Groups that were kept are gone on with, to the bit", "[chaos]") {
  chaos::LyapunovPlan plan;
  plan.scene = unit_scene(2, 0.3);
  plan.seed = 9303, plan.collisions = 20'000;
  chaos::DiffusionPlan other{plan.scene, flights::Ensemble::uniform, 9304, 700, 5};
  const auto text = [&](const chaos::Work& work, bool lyapunov) {
    if (!lyapunov) {
      const chaos::Diffusion found = chaos::diffusion_of(other, work);
      return fmt::format("{:a} {:a} {}", found.coefficient.value, found.coefficient.error, found.particles);
    }
    const chaos::Lyapunov found = chaos::lyapunov_of(plan, work);
    return fmt::format("{:a} {:a} {}", found.map[0].value, found.map[0].error, found.collisions);
  };
  for (const bool lyapunov : {true, false}) {
    std::vector<std::string> kept, added;
    const auto keeping = [&](unsigned jobs) {
      chaos::Work work;
      work.jobs = jobs;
      work.each_kept = [&](const auto& read) {
        for (const std::string& one : kept) read(one);
      };
      work.keep = [&](const std::string& one) { added.push_back(one); };
      return work;
    };
    const std::string whole = text(keeping(1), lyapunov);
    CHECK(text({.jobs = 3}, lyapunov) == whole);
    REQUIRE(added.size() == chaos::kGroups);
    const std::vector<std::string> all = std::exchange(added, {});
    for (std::size_t i = 0; i < all.size(); i += 3) kept.push_back(all[i]);
    CHECK(text(keeping(2), lyapunov) == whole);
    CHECK(added.size() == chaos::kGroups - kept.size());
    kept = {all[0].substr(1)};
    CHECK_THROWS_AS(text(keeping(1), lyapunov), InputError);
    // All of a group may have stopped before anything was counted.
    std::uint64_t group = 0;
    chaos::Sums none = chaos::sums_in(all[0], group);
    none.stopped = lyapunov ? chaos::kParticles : none.particles;
    none.particles = none.collisions = 0;
    none.values.assign(none.values.size(), 0);
    kept = {chaos::text_of(group, none)};
    CHECK_NOTHROW(text(keeping(1), lyapunov));
  }
}

TEST_CASE("Statistics of trajectories: killed, they go on, the result is the same",
          "[chaos][chaos_command]") {
  const Folder folder;
  for (const std::string what : {"lyapunov --json --radius 0.3 --collisions 4e5",
                                 "diffusion --json --radius 0.3 --count 2e4 --time 30"}) {
    const std::string whole = folder.lorentz(what).out, store = " --store " + folder.file("store");
    folder.run("rm -f " + folder.file("store*"));
    CHECK_FALSE(contains(folder.lorentz(what + store).err, "parts are done"));
    folder.run("rm -f " + folder.file("store*"));
    // The pieces that it has, while it is written, too.
    const std::string count = LORENTZ_PYTHON " " + folder.write("count.py", R"(
import sqlite3, sys
try:
    print(sqlite3.connect("file:" + sys.argv[1] + "?mode=ro", uri=True).execute("SELECT count(*) FROM piece").fetchone()[0])
except sqlite3.Error:
    print(0)
)") + " " + folder.file("store");
    for (int kills = 0; kills < 3; ++kills)  // each time when it has kept something more
      folder.run("sh -c '" LORENTZ_PROGRAM " " + what + store + " & p=$!; n=$(" + count +
                 "); while [ -d /proc/$p ] && ! [ \"$(" + count +
                 ")\" -gt \"$n\" ]; do sleep 0.01; done; kill -9 $p; wait $p'");
    CHECK(std::stoi(folder.run(count).out) > 2);
    const Run rest = folder.lorentz(what + " --jobs 2" + store);
    INFO(what << rest.err);
    CHECK(rest.status == 0);
    CHECK(rest.out == whole);
    CHECK(contains(rest.err, " of 64 parts are done"));
    CHECK(folder.run(count).out == "64\n");
    CHECK(folder.lorentz(what + " --seed 1" + store).status == 2);
  }
}

TEST_CASE("Several scenes and radii give what each gives alone, and one table", "[chaos][chaos_command]") {
  const Folder folder;
  for (const std::string command : {"lyapunov --collisions 5e3", "diffusion --count 500 --time 5"}) {
    const auto of = [&](const std::string& places) {
      const Run run = folder.lorentz(command + " --json --csv " + folder.file("csv") + places);
      INFO(run.err);
      REQUIRE(run.status == 0);
      return run.out;
    };
    std::string lines, rows;
    for (const std::string scene : {"square", "triangular"})
      for (const std::string radius : {"0.25", "0.375"}) {
        lines += of(" --scene " + scene + " --radius " + radius);
        const std::string csv = folder.read("csv");
        std::string before = "scene,radius,";
        for (std::size_t begin = 0; begin < csv.size(); before = scene + "," + radius + ",") {
          const std::size_t end = csv.find('\n', begin) + 1;
          if (begin > 0 || rows.empty()) rows += before + csv.substr(begin, end - begin);
          begin = end;
        }
      }
    CHECK(contains(lines, "\"radius\":0.375"));
    CHECK(of(" --scene square,triangular --radius 0.25,0.375") == lines);
    CHECK(folder.read("csv") == rows);
    // What was found before a radius that is refused is not lost.
    const Run half = folder.lorentz(command + " --radius 0.25,0.8 --csv " + folder.file("half"));
    CHECK(half.status == 2);
    CHECK(folder.read("half").rfind("scene,radius,", 0) == 0);
    CHECK(contains(folder.read("half"), "\nsquare,0.25,"));
    CHECK(folder.lorentz(command + " --radius 0.25,x").status == 2);
  }
  for (const char* command : {"lyapunov", "diffusion"})
    CHECK(contains(folder.lorentz(std::string(command) + " --radius 0.2,0.3 --store " + folder.file("s")).err,
                   "--store: parts are kept of one scene"));
}

TEST_CASE("Statistics of trajectories: what cannot be done is said", "[chaos][chaos_command]") {
  const Folder folder;
  const Run ended = folder.lorentz("lyapunov --scene superposition-pi-5 --radius 1e-8 --collisions 1e4");
  CHECK(ended.status == 3);
  CHECK(contains(ended.err,
                 "all particles ended on the way (docs/chaos.md#errors): there is nothing to report"));
  for (const char* words :
       {"lyapunov --radius 6", "lyapunov --collisions 0", "lyapunov --jobs 0", "lyapunov --seed x",
        "lyapunov --radius -1", "diffusion --time 0", "diffusion --time x", "diffusion --from nowhere",
        "diffusion --count 0", "diffusion --scene ellipse --radius 1"}) {
    const Run run = folder.lorentz(words);
    INFO(words << ": " << run.err);
    CHECK(run.status == 2);
    CHECK(contains(run.err, "lorentz: "));
    CHECK(run.out.empty());
  }
  CHECK(contains(folder.lorentz("lyapunov --radius 6").err, "the engine batch, which does"));
  CHECK(contains(folder.lorentz("diffusion --from unifrom").err, "uniform?"));
  CHECK(folder.lorentz("diffusion --count 100 --time 5 --csv /nowhere/x").status == 3);
  for (const char* command : {"lyapunov", "diffusion"})
    CHECK(contains(folder.lorentz(std::string(command) + " --help").out,
                   std::string(":\n  lorentz ") + command));
}

TEST_CASE("lorentz diffusion: nothing is told of the few that met nothing", "[chaos][chaos_command]") {
  const Folder folder;
  const char* lattice =
      "[[lattices]]\nvectors = [[1, 0], [0, 1]]\n[[lattices.atoms]]\nposition = [1e15, 0.25]\n"
      "radius = 0.1\n";  // all starts are beyond 2^44 cells from the atom, and the engine does not know
  const std::string scene = folder.write("far.toml", std::string("dimension = 2\n") + lattice);
  const Run run = folder.lorentz("diffusion --count 2000 --time 20 --scene " + scene);
  CHECK(run.status == 3);
  CHECK(run.out.empty());
  CHECK(contains(run.err, "no particle got beyond its first obstacle"));
}
