// lorentz flights as its users call it.
#include <catch2/catch.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <regex>
#include <sstream>
#include <vector>

#include "report/runs/sqlite.hpp"
#include "tests/support/command_line.hpp"

using namespace lorentz::test;

namespace {

// The number of the first such key from a place on.
double number_of(const std::string& json, const std::string& key, std::size_t from = 0) {
  const std::size_t at = json.find("\"" + key + "\":", from);
  REQUIRE(at != std::string::npos);
  return std::stod(json.substr(at + key.size() + 3));
}

// The one piece of a store.
std::string account_in(const std::string& path) {
  const lorentz::runs::Connection store(path, path, SQLITE_OPEN_READONLY);
  lorentz::runs::Statement row(store, "SELECT text FROM piece");
  REQUIRE(row.step());
  const std::string text = row.text();
  CHECK_FALSE(row.step());
  return text;
}

}  // namespace

TEST_CASE("Flights: the same words for threads and processes", "[flights][flights_command]") {
  const Folder folder;
  const std::string what = "flights --scene square --radius 0.2 --from surface --count 3e5 --seed 7501 ";
  const Run one = folder.lorentz(what + "--store " + folder.file("one"));
  INFO(one.err);
  REQUIRE(one.status == 0);
  CHECK(contains(one.out, "300000 flights: "));
  CHECK(contains(one.out, "exact 2.185840735"));
  const std::string account = account_in(folder.file("one"));
  CHECK(folder.lorentz(what + "--jobs 3").out == one.out);
  CHECK(folder.lorentz(what + "--time 1e-9 --store " + folder.file("begun")).status == 0);
#ifdef LORENTZ_MPIRUN
  const Run ranks =
      folder.run(std::string(LORENTZ_MPIRUN) + " --allow-run-as-root --oversubscribe --quiet -n 2 " +
                 LORENTZ_PROGRAM + " " + what + "--store " + folder.file("ranks"));
  INFO(ranks.err);
  CHECK(ranks.status == 0);
  CHECK(ranks.out == one.out);
  CHECK(account_in(folder.file("ranks")) == account);
  // Ranks go on with what one process has begun.
  const Run rest =
      folder.run(std::string(LORENTZ_MPIRUN) + " --allow-run-as-root --oversubscribe --quiet -n 2 " +
                 LORENTZ_PROGRAM + " " + what + "--store " + folder.file("begun"));
  INFO(rest.err);
  CHECK(rest.status == 0);
  CHECK(rest.out == one.out);
  CHECK(account_in(folder.file("begun")) == account);
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
  CHECK(torn.status == 3);
  CHECK(contains(torn.err, "store: is damaged (database disk image is malformed); take a copy from before"));
}

TEST_CASE("Flights: JSON and CSV", "[flights][flights_command]") {
  const Folder folder;
  const Run run = folder.lorentz("flights --radius 1e-4 --count 2e5 --json --csv " + folder.file("bins.csv"));
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
}

// The sum of the counts of the histogram's rows, and the last survival among its rows.
struct Histogram {
  std::uint64_t sum = 0;
  double last_survival = 1;
  std::string last_row;
};

static Histogram histogram_in(const std::string& csv, const std::string& bins) {
  Histogram read;
  std::istringstream rows(csv);
  for (std::string row; std::getline(rows, row);) {
    if (row.compare(0, bins.size() + 1, bins + ',') != 0) continue;
    std::istringstream cells(row);
    std::vector<std::string> cell(7);
    for (std::string& one : cell) std::getline(cells, one, ',');
    read.sum += std::stoull(cell[3]);
    if (!cell[6].empty()) read.last_survival = std::stod(cell[6]);
    read.last_row = row;
  }
  return read;
}

TEST_CASE("Flights: what lies beyond the last edge has no density in the CSV", "[flights][flights_command]") {
  const Folder folder;
  const Run run =
      folder.lorentz("flights --scene square --radius 0.1 --count 1e5 --json --csv " + folder.file("csv"));
  REQUIRE(run.status == 0);
  REQUIRE(contains(run.out, "\"hits\":100000,"));
  const std::string csv = folder.read("csv");
  const Histogram linear = histogram_in(csv, "linear"), logarithmic = histogram_in(csv, "logarithmic");
  CHECK(linear.sum == 100000);
  CHECK(logarithmic.sum == 100000);
  // As JSON has it: 64 is an edge of both histograms, and the last of the linear one.
  const std::string pair = run.out.substr(run.out.find("[64,") + 4);
  const std::uint64_t longer = std::stoull(pair);
  CHECK(linear.last_survival == static_cast<double>(longer) / 100000);
  CHECK(linear.last_row == fmt::format("linear,64,inf,{},,,", longer) +
                               (contains(csv.substr(0, csv.find('\n')), ": density") ? ",," : ""));
}

TEST_CASE("Flights: several radii, each as alone", "[flights][flights_command]") {
  const Folder folder;
  for (const std::string from : {"uniform", "surface"}) {
    const std::string what = "flights --count 1e5 --seed 7503 --from " + from + " ";
    const auto alone = [&](const std::string& radius) {
      return folder.lorentz(what + "--radius " + radius + " --csv " + folder.file(radius)).out;
    };
    const std::string large = alone("0.3"), small = alone("0.01");
    CHECK(large != small);
    const Run both = folder.lorentz(what + "--radius 0.3,0.01 --csv " + folder.file("both"));
    INFO(both.err);
    CHECK(both.status == 0);
    CHECK(both.out == large + "\n" + small);
    CHECK(folder.lorentz(what + "--radius 0.3 --radius 0.01").out == both.out);
    std::istringstream rows(folder.read("both"));
    std::string names, text, of_radius[2];
    std::getline(rows, names);
    CHECK(names.starts_with("radius,bins,from,to,"));
    for (std::string row; std::getline(rows, row);) {
      const auto comma = row.find(',');
      of_radius[row.substr(0, comma) == "0.01"] += row.substr(comma + 1) + '\n';
    }
    names = names.substr(names.find(',') + 1) + '\n';
    CHECK(names + of_radius[0] == folder.read("0.3"));
    CHECK(names + of_radius[1] == folder.read("0.01"));
#ifdef LORENTZ_MPIRUN
    const Run ranks =
        folder.run(std::string(LORENTZ_MPIRUN) + " --allow-run-as-root --oversubscribe --quiet -n 2 " +
                   LORENTZ_PROGRAM + " " + what + "--radius 0.3,0.01");
    INFO(ranks.err);
    CHECK(ranks.out == both.out);
#endif
  }
  const Run json = folder.lorentz("flights --count 1e4 --json --radius 0.3,1e-2");
  CHECK(lines(json.out) == 2);
  CHECK(json.out.starts_with(R"({"scene":"square","radius":0.3,"from":)"));
  CHECK(contains(json.out,
                 "\n"
                 R"({"scene":"square","radius":0.01,"from":)"));
  CHECK_FALSE(contains(folder.lorentz("flights --count 1e4 --json --radius 0.3").out, "\"radius\""));
  // What was found before a radius that is refused is not lost.
  const Run half = folder.lorentz("flights --count 1e3 --radius 0.3,0.8 --csv " + folder.file("half"));
  CHECK(half.status == 2);
  CHECK(contains(folder.read("half"), "\n0.3,"));
}

TEST_CASE("Flights: several scenes in one table", "[flights][flights_command]") {
  const Folder folder;
  const std::string what = "flights --count 1e4 --seed 7504 ";
  const auto fly = [&](const std::string& options) {
    const Run run = folder.lorentz(what + options);
    INFO(options << ": " << run.err);
    CHECK(run.status == 0);
    return run.out;
  };
  // "cubic" has no law, and the columns of one stay empty.
  const std::string square = fly("--scene square --radius 0.01 --csv " + folder.file("square")),
                    cubic = fly("--scene cubic --radius 0.01 --csv " + folder.file("cubic"));
  CHECK(fly("--scene cubic,square --radius 0.01 --csv " + folder.file("both")) == cubic + "\n" + square);
  std::istringstream rows(folder.read("both")), of_square(folder.read("square")),
      of_cubic(folder.read("cubic"));
  std::string row, single;
  std::getline(rows, row), std::getline(of_square, single), std::getline(of_cubic, row);
  rows.seekg(0);
  std::getline(rows, row);
  CHECK(row == "scene,radius," + single);
  while (std::getline(of_cubic, single) && std::getline(rows, row))
    CHECK(row == "cubic,0.01," + single + ",,");
  while (std::getline(of_square, single) && std::getline(rows, row)) CHECK(row == "square,0.01," + single);
  CHECK_FALSE(std::getline(rows, row));
  CHECK(folder.lorentz(what + "--scene cubic,square --store " + folder.file("store")).status == 2);
  // Each law has its columns, in all rows.
  fly("--scene square,superposition-pi-5 --radius 0.01 --csv " + folder.file("laws"));
  std::istringstream of_laws(folder.read("laws"));
  while (std::getline(of_laws, row)) CHECK(std::ranges::count(row, ',') == 12);
}

TEST_CASE("Flights: the limit law is not rejected, from surfaces too, and a wrong one is",
          "[flights][flights_command]") {
  const Folder folder;
  for (const char* scene : {"square", "superposition-pi-5"})
    for (const char* from : {"uniform", "surface"}) {
      const Run run = folder.lorentz(
          std::string("flights --radius 1e-4 --count 3e6 --jobs 2 --seed 7502 --json --scene ") + scene +
          " --from " + from);
      INFO(scene << ", " << from << ": " << run.out);
      REQUIRE(run.status == 0);
      CHECK(number_of(run.out, "p_value") > 0.001);
      CHECK(number_of(run.out, "p_value_of_1.02") < 1e-9);
    }
}

TEST_CASE("Flights: the constant of a tail in space, extrapolated, is that of its channels",
          "[flights][flights_command]") {
  const Folder folder;
  for (const std::string from : {"uniform", "surface"}) {
    const Run run = folder.lorentz(
        "flights --scene cubic --radius 0.2 --count 2e6 --jobs 2 --seed 7504 --json --from " + from);
    REQUIRE(run.status == 0);
    const std::size_t at = run.out.find("\"when\":\"t -> infinity\"");
    REQUIRE(at != std::string::npos);
    const double exact = number_of(run.out, "constant", at), measured = number_of(run.out, "measured", at),
                 error = number_of(run.out, "measured_error", at),
                 t = number_of(run.out, "measured_from", at),
                 longer = number_of(run.out, "measured_count", at);
    INFO(from << ": " << measured << " +- " << error << ", exact " << exact);
    CHECK(std::fabs(measured - exact) < 4 * error);
    CHECK(error < (from == "uniform" ? 0.04 : 0.2) * exact);
    // As it is, not extrapolated, it would be off.
    CHECK(longer / 2e6 * std::pow(t, from == "uniform" ? 1 : 2) > exact + 2 * error);
  }
  CHECK(contains(folder.lorentz("flights --scene cubic --count 3e5").out, "\n  measured: P(tau > t) ~ "));
  CHECK_FALSE(contains(folder.lorentz("flights --count 1e5").out, "measured"));
  // Where channels are so narrow that other flights hide them, nothing is extrapolated.
  for (const std::string from : {"uniform", "surface"}) {
    const std::string narrow = "flights --scene bcc --count 1e6 --jobs 2 --from " + from;
    CHECK(contains(folder.lorentz(narrow).out, "\n  not measured: where this power"));
    CHECK_FALSE(contains(folder.lorentz(narrow + " --json").out, "measured"));
  }
}

TEST_CASE("Flights: what the undecided are missing from is said", "[flights][flights_command]") {
  const Folder folder;
  const std::string remark = "what follows is without the undecided flights";
  CHECK(contains(folder.lorentz("flights -e classical --radius 3e-8 --count 16").out, remark));
  CHECK_FALSE(contains(folder.lorentz("flights -e classical --radius 1e-2 --count 12").out, remark));
}

TEST_CASE("Flights: lengths whose squares overflow are refused", "[flights][flights_command]") {
  const Folder folder;
  const auto run = [&](const std::string& spacing, const std::string& radius) {
    const std::string scene = folder.write(
        "scene.toml", "dimension = 2\n[[lattices]]\nvectors = [[" + spacing + ", 0], [0, " + spacing +
                          "]]\n[[lattices.atoms]]\nposition = [0, 0]\nradius = " + radius + "\n");
    return folder.lorentz("flights --scene " + scene + " -e certified --from surface --count 200");
  };
  for (const auto& [spacing, radius] : {std::pair{"1e160", "4e159"},
                                        {"1e-160", "4e-161"},
                                        {"1", "1e-100"},
                                        {"1e200", "4e199"},
                                        {"1e-200", "4e-201"},
                                        {"1e300", "1e290"}}) {
    const Run refused = run(spacing, radius);
    CHECK(refused.status == 2);
    CHECK(contains(refused.err, "lengths lie between 2^-250 and 2^250; choose another unit"));
  }
  for (const auto& [spacing, radius] : {std::pair{"1e70", "4e69"}, {"1e-70", "4e-71"}}) {
    const Run fine = run(spacing, radius);
    CHECK(fine.status == 0);
    CHECK_FALSE(contains(fine.out, "-inf"));
    CHECK_FALSE(contains(fine.out, "standard error 0"));
    CHECK_FALSE(contains(fine.out, "nan"));
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

TEST_CASE("Flights: the mean of a scene with overlaps and open corridors is infinite, too",
          "[flights][flights_command]") {
  const Folder folder;
  const std::string scene = folder.write("overlaps.toml",
                                         "dimension = 2\n[[lattices]]\nvectors = [[1, 0], [0, 1]]\n"
                                         "[[lattices.atoms]]\nposition = [0, 0]\nradius = 0.1\n"
                                         "[[lattices.atoms]]\nposition = [0.05, 0]\nradius = 0.1\n");
  const auto said = [&](const std::string& options) {
    return folder.lorentz("flights --count 1e4 --scene " + options).out;
  };
  CHECK(contains(said(scene + " --json"), "\"mean_remark\":\"the exact mean is infinite"));
  CHECK(contains(said(scene + " --from surface"), "the variance is infinite"));
  // Turned by 0.3, rounded: of one direction but for 1e-17.
  const std::string turned =
      folder.write("turned.toml",
                   "dimension = 2\n[[lattices]]\nvectors = [[0.955336489125606, 0.29552020666133955], "
                   "[-0.29552020666133955, 0.955336489125606]]\n[[lattices.atoms]]\nposition = [0, 0]\n"
                   "radius = 0.1\n[[lattices]]\nvectors = [[1.351049819551329, 0.4179286842157663], "
                   "[-0.51186, 1.65469]]\n[[lattices.atoms]]\nposition = [0, 0]\nradius = 0.1\n");
  CHECK(contains(said(turned), "the exact mean may be infinite, or too large for a sample: ways of the"));
  CHECK_FALSE(contains(said("superposition-pi-5"), "infinite"));
}

TEST_CASE("Flights: where nothing is tested there is no p-value", "[flights][flights_command]") {
  const Folder folder;
  // The law begins at 64 spacings, and no path is so long.
  const std::string what = "flights --scene triangular --radius 0.45 --from surface --count 1e5 --seed 7507 ";
  CHECK(contains(folder.lorentz(what).out, "\n  not tested: hardly a flight is longer than 64\n"));
  const std::string json = folder.lorentz(what + "--json").out;
  CHECK(contains(json, R"("degrees":0,"p_value":null,"p_value_of_1.02":null)"));
  // One flight has a mean, and nothing that tells its error.
  const Run one = folder.lorentz("flights --count 1 --json --from surface");
  CHECK(contains(one.out, "\"mean_error\":null"));
  CHECK(contains(folder.lorentz("flights --count 1 --from surface").out, "standard error not known"));
}

TEST_CASE("Flights: the interval of the exponent holds what the law itself has there",
          "[flights][flights_command]") {
  const Folder folder;
  int inside = 0;
  for (int seed = 1; seed <= 20; ++seed) {
    const Run run =
        folder.lorentz("flights --scene superposition-pi-5-pi-7 --from surface --count 2e5 --json --seed " +
                       std::to_string(seed));
    const std::size_t at = run.out.find("\"tail_interval\":[");
    REQUIRE(at != std::string::npos);
    double low = 0, high = 0;
    REQUIRE(std::sscanf(run.out.c_str() + at, "\"tail_interval\":[%lf,%lf]", &low, &high) == 2);
    const double law = number_of(run.out, "tail_exponent", run.out.find("\"theory\""));
    CHECK(law > 5.4);  // what it is here; in the end it is 5
    inside += low <= law && law <= high;
  }
  INFO(inside << " of 20");
  CHECK(inside >= 15);  // of 95 in 100 fewer come once in 3000 times
}

// Binary64 has no direction that meets discs so small before its numbers end.
TEST_CASE("Flights: the exponent stands inside of its interval, and a name has the one radius of all balls",
          "[flights][flights_command]") {
  const Folder folder;
  const std::string out = folder.lorentz("flights --scene square --radius 0.1 --count 200000").out;
  std::smatch found;
  REQUIRE(std::regex_search(out, found, std::regex(R"(like t\^-([0-9.]+), 95 % \[([0-9.]+), ([0-9.]+)\])")));
  CHECK(std::stod(found[2]) < std::stod(found[1]));
  CHECK(std::stod(found[1]) < std::stod(found[3]));
  CHECK(contains(out, "square, r = 0.1"));
  CHECK_FALSE(contains(out, "no law is known"));
  CHECK(contains(folder.lorentz("flights --count 1000 --scene overlapping").out,
                 "no law is known: several obstacles"));
  const auto named = [&](const char* scene) {
    return contains(folder.lorentz("flights --count 1000 --scene " + std::string(scene)).out, ", r = ");
  };
  CHECK(named("honeycomb"));
  CHECK_FALSE(named("ellipse"));
  CHECK_FALSE(named("perovskite"));       // of the five the last three are equal
  CHECK_FALSE(named("cesium-chloride"));  // two
}

TEST_CASE("Flights: where nothing is ever hit it is said, and nothing drawn", "[flights][flights_command]") {
  const Folder folder;
  const std::string what = "flights --radius 1e-70 --engine certified --count 1000 ";
  const Run table = folder.lorentz(what + "--csv " + folder.file("csv"));
  CHECK(table.status == 0);
  CHECK(contains(table.out, "1000 flights: 0 hits, 1000 never, 0 undecided"));
  CHECK(contains(table.out, "nothing was hit: there are no free paths to speak of"));
  CHECK(lines(folder.read("csv")) == 1);
  const std::string json = folder.lorentz(what + "--json").out;
  for (const char* part : {"\"hits\":0", "\"never\":1000", "\"mean\":null", "\"shortest\":null"})
    CHECK(contains(json, part));
}

// At this radius most flights have a period, of 2^53 and less, and no disc on it.
TEST_CASE("Flights: what never ends is longer than all that ends", "[flights][flights_command]") {
  const Folder folder;
  const Run run = folder.lorentz("flights --radius 1e-17 --engine certified --count 2000 --seed 7505 --json");
  INFO(run.err << run.out);
  REQUIRE(run.status == 0);
  const double hits = number_of(run.out, "hits"), never = number_of(run.out, "never");
  CHECK(hits > 100);
  CHECK(never > 100);
  CHECK(hits + never == 2000);
  CHECK(contains(run.out, fmt::format(",{}]],\"seconds\"", never)));  // the survival's end
  CHECK(number_of(run.out, "p_value") < 1e-300);                      // the law has no such flights
}

TEST_CASE("Flights: bad input is named, with the remedy", "[flights][flights_command]") {
  const Folder folder;
  const std::vector<std::pair<std::string, std::string>> bad{
      {"--count 0", "--count"},
      {"--from surfaces", "surface"},
      {"--engine bacth", "batch"},
      {"--engine cmd:cat", "lorentz sample"},
      {"--radius 1e-13",
       "the engine batch does radii from 1e-12 of the shortest lattice vector only; certified does"},
      {"--radius 0.75", "no free start"},
      {"--radius 0.75 --engine certified", "no free start"},
      {"--radius -1", "--radius"},
      {"--scene sqare", "square"},
      {"--store /no/such/file", "/no/such/file"},
      {"--store /dev/zero", "/dev/zero: is not a regular file"},
      {"--radius 0.1,0.2 --store store", "run several one by one"},
      {"--radius 0.1,0", "--radius"},
  };
  for (const auto& [arguments, words] : bad) {
    const Run run = folder.lorentz("flights --count 1000 " + arguments);
    INFO(arguments << ": " << run.err);
    CHECK((run.status == 2 || run.status == 3));
    CHECK(contains(run.err, words));
    CHECK(run.out.empty());
  }
  for (const std::string file : {"--csv", "--store"}) {
    const Run full = folder.lorentz("flights --count 1000 " + file + " /dev/full");
    INFO(file);
    CHECK(full.status == 3);
    CHECK(contains(full.err, "/dev/full"));
  }
  CHECK(folder.run("sh -c '" LORENTZ_PROGRAM " flights --count 1000 >/dev/full'").status == 3);
}
