// lorentz flights as its users call it.
#include <catch2/catch.hpp>

#include "tests/support/command_line.hpp"

using namespace lorentz::test;

TEST_CASE("Flights: the same words for threads, shards and processes", "[flights][flights_command]") {
  const Folder folder;
  const std::string what = "flights --scene square --radius 0.2 --from surface --count 3e5 --seed 7501 ";
  const Run one = folder.lorentz(what + "--store " + folder.file("one"));
  INFO(one.err);
  REQUIRE(one.status == 0);
  CHECK(contains(one.out, "300000 flights: "));
  CHECK(contains(one.out, "exact 2.185840735"));
  const std::string store = folder.read("one");
  CHECK(folder.lorentz(what + "--jobs 3").out == one.out);
  for (const char* shard : {"0/2", "1/2"})
    CHECK(
        folder.lorentz(what + "--shard " + shard + " --store " + folder.file(std::string("part") + shard[0]))
            .status == 0);
  const Run sum = folder.lorentz(what + "--add " + folder.file("part0") + " " + folder.file("part1") +
                                 " --store " + folder.file("sum"));
  INFO(sum.err);
  CHECK(sum.status == 0);
  CHECK(sum.out == one.out);
  CHECK(folder.read("sum") == store);
  const Run twice = folder.lorentz(what + "--add " + folder.file("part0") + " " + folder.file("part0"));
  CHECK(twice.status == 2);
  CHECK(contains(twice.err, "is there twice"));
#ifdef LORENTZ_MPIRUN
  const Run ranks =
      folder.run(std::string(LORENTZ_MPIRUN) + " --allow-run-as-root --oversubscribe --quiet -n 2 " +
                 LORENTZ_PROGRAM + " " + what + "--store " + folder.file("ranks"));
  INFO(ranks.err);
  CHECK(ranks.status == 0);
  CHECK(ranks.out == one.out);
  CHECK(folder.read("ranks") == store);
  // Ranks go on with what a shard has done.
  const Run rest =
      folder.run(std::string(LORENTZ_MPIRUN) + " --allow-run-as-root --oversubscribe --quiet -n 2 " +
                 LORENTZ_PROGRAM + " " + what + "--store " + folder.file("part0"));
  INFO(rest.err);
  CHECK(rest.status == 0);
  CHECK(rest.out == one.out);
  CHECK(folder.read("part0") == store);
#endif
}

TEST_CASE("Flights: a store goes on with its own run only", "[flights][flights_command]") {
  const Folder folder;
  const std::string what = "flights --radius 0.3 --count 2e5 --store " + folder.file("store") + " ";
  CHECK(folder.lorentz(what).status == 0);
  const Run again = folder.lorentz(what);
  CHECK(again.status == 0);
  CHECK(contains(again.err, "4 of 4 blocks are done"));
  const Run other = folder.lorentz(what + "--seed 1");
  CHECK(other.status == 2);
  CHECK(contains(other.err, "another run"));
  folder.write("store", folder.read("store").substr(0, 300));
  const Run torn = folder.lorentz(what);
  CHECK(torn.status == 2);
  CHECK(contains(torn.err, "store: no account of flights"));
}

TEST_CASE("Flights: JSON, CSV and a picture", "[flights][flights_command]") {
  const Folder folder;
  const Run run = folder.lorentz("flights --radius 1e-4 --count 2e5 --json --csv " + folder.file("bins.csv") +
                                 " --svg " + folder.file("picture.svg"));
  INFO(run.err);
  REQUIRE(run.status == 0);
  for (const char* part :
       {"{\"scene\":\"square\",", "\"seed\":20161115", "\"count\":200000", "\"never\":0", "\"undecided\":0",
        "\"mean\":", "\"mean_error\":", "\"mean_exact\":null", "\"tail_exponent\":", "\"tail_interval\":[",
        "\"theory\":[{\"name\":\"Boca-Zaharescu\"", "\"p_value\":", "\"seconds\":"})
    CHECK(contains(run.out, part));
  const std::string csv = folder.read("bins.csv");
  CHECK(contains(csv, "bins,from,to,count,density,density_error,survival_at_to,Boca-Zaharescu: density"));
  CHECK(contains(csv, "\nlogarithmic,"));
  CHECK(contains(csv, "\nlinear,"));
  CHECK(contains(folder.read("picture.svg"), "<svg"));
}

TEST_CASE("Flights: the limit law is not rejected, from surfaces too, and a wrong one is",
          "[flights][flights_command]") {
  const Folder folder;
  const auto number = [](const std::string& out, const std::string& key) {
    const std::size_t at = out.find("\"" + key + "\":");
    REQUIRE(at != std::string::npos);
    return std::stod(out.substr(at + key.size() + 3));
  };
  for (const char* scene : {"square", "superposition-pi-5"})
    for (const char* from : {"uniform", "surface"}) {
      const Run run = folder.lorentz(
          std::string("flights --radius 1e-4 --count 3e6 --jobs 2 --seed 7502 --json --scene ") + scene +
          " --from " + from);
      INFO(scene << ", " << from << ": " << run.out);
      REQUIRE(run.status == 0);
      CHECK(number(run.out, "p_value") > 0.001);
      CHECK(number(run.out, "p_value_of_1.02") < 1e-9);
    }
}

TEST_CASE("Flights: what a mean means is said where it is not what it looks like",
          "[flights][flights_command]") {
  const Folder folder;
  const auto said = [&](const std::string& options) {
    return folder.lorentz("flights --count 1e5 " + options).out;
  };
  CHECK(contains(said("--scene square"), "the exact mean is infinite"));
  CHECK(contains(said("--scene square --from surface"), "the variance is infinite"));
  CHECK(contains(said("--scene cubic"), "the exact mean is infinite"));
  for (const char* finite : {"--scene triangular", "--scene triangular --from surface"})
    CHECK_FALSE(contains(said(finite), "is infinite"));
}

TEST_CASE("Flights: bad input is named, with the remedy", "[flights][flights_command]") {
  const Folder folder;
  const std::vector<std::pair<std::string, std::string>> bad{
      {"--count 0", "--count"},
      {"--from surfaces", "surface"},
      {"--engine bacth", "batch"},
      {"--engine cmd:cat", "lorentz sample"},
      {"--radius 0.75",
       "the engine batch does radii up to half the shortest lattice vector only; certified does"},
      {"--radius 0.75 --engine certified", "no free start"},
      {"--radius -1", "--radius"},
      {"--scene sqare", "square"},
      {"--shard 3", "I/N"},
      {"--shard 2/2", "--shard"},
      {"--add /no/such/file", "/no/such/file"},
  };
  for (const auto& [arguments, words] : bad) {
    const Run run = folder.lorentz("flights --count 1000 " + arguments);
    INFO(arguments << ": " << run.err);
    CHECK((run.status == 2 || run.status == 3));
    CHECK(contains(run.err, words));
    CHECK(run.out.empty());
  }
  const Run full = folder.lorentz("flights --count 1000 --csv /dev/full");
  CHECK(full.status == 3);
  CHECK(contains(full.err, "/dev/full"));
}
