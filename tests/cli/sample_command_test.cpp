// lorentz sample: what it writes first-hit reads, in every format, and no start lies in an obstacle.
#include <catch2/catch.hpp>
#include <cstdlib>
#include <sstream>
#include <vector>

#include "tests/support/command_line.hpp"
#include "tests/support/npy.hpp"

using namespace lorentz;
using namespace lorentz::test;

namespace {

// The numbers behind each `key`.
std::vector<double> times_behind(const std::string& key, const std::string& text) {
  std::vector<double> times;
  for (std::size_t at = text.find(key); at != std::string::npos; at = text.find(key, at + 1))
    times.push_back(std::strtod(text.c_str() + at + key.size(), nullptr));
  return times;
}

std::vector<double> times_of_csv(const std::string& text) {
  std::vector<double> times;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);)
    if (line.starts_with("hit,")) times.push_back(std::strtod(line.c_str() + line.rfind(',') + 1, nullptr));
  return times;
}

// A row begins with the outcome, 0 for `hit`, and ends with the time.
std::vector<double> times_of_npy(const std::string& file) {
  const std::string data = npy_data(file);
  const std::size_t row = data.size() / 50;
  std::vector<double> times;
  for (std::size_t at = 0; at < data.size(); at += row)
    if (data[at] == 0) times.push_back(number_of<double>(data.data() + at + row - 8));
  return times;
}

}  // namespace

TEST_CASE("What sample writes first-hit reads, and nothing is inside", "[cli][sample]") {
  const Folder folder;
  for (const std::string scene : {"square", "ellipses-mixed", "diamond", "superposition-pi-5", "overlapping"})
    for (const std::string kind : {"uniform", "surface", "near-rational", "grazing"}) {
      CAPTURE(scene, kind);
      const std::string arguments = "sample --scene " + scene + " --kind " + kind + " --count 50";
      const Run sample = folder.lorentz(arguments);
      REQUIRE(sample.status == 0);
      CHECK(contains(sample.err, scene + ": 50 " + kind + " starts (seed 20161115)\n"));
      CHECK(lines(sample.out) == 51);
      CHECK(sample.out.starts_with("{\"scene\":"));
      CHECK(contains(sample.out, "\n{\"id\":49,\"x\":["));
      CHECK(count_of(sample.out, "\"from\"") == (kind == "surface" ? 50 : 0));
      const Run answers = folder.lorentz("first-hit " + folder.write("queries", sample.out));
      CHECK(answers.status == 0);
      CHECK(lines(answers.out) == 50);
      CHECK_FALSE(contains(answers.out, "inside"));
      const std::vector<double> times = times_behind("\"time\":", answers.out);
      CHECK(times.size() > 40);
      for (const std::string format : {"csv", "npy"}) {
        const Run columns = folder.lorentz(arguments + " --format " + format);
        REQUIRE(columns.status == 0);
        const std::string file = folder.write("columns", columns.out);
        const Run same =
            folder.lorentz("first-hit --strict --scene " + scene + " --format " + format + " " + file);
        REQUIRE(same.status == 0);
        CHECK((format == "csv" ? times_of_csv(same.out) : times_of_npy(same.out)) == times);
      }
    }
}

TEST_CASE("A seed's starts are the same, and another's others, fewer are the first of many",
          "[cli][sample]") {
  const Folder folder;
  const std::string few = folder.lorentz("sample --count 20").out,
                    many = folder.lorentz("sample --count 3000").out;
  CHECK(many.starts_with(few));
  CHECK(folder.lorentz("sample --count 20 --seed 20161115").out == few);
  CHECK(folder.lorentz("sample --count 20 --seed 1").out != few);
  CHECK(lines(many) == 3001);
}

TEST_CASE("Sample says what is wrong with what it is asked", "[cli][sample]") {
  const Folder folder;
  const auto said = [&](const std::string& arguments) {
    const Run run = folder.lorentz("sample " + arguments);
    CHECK(run.status == 2);
    CHECK(run.out.empty());
    return run.err;
  };
  CHECK(contains(said("--count 0"), "--count: \"0\" is not a whole number from 1"));
  CHECK(contains(said("--kind unifrm"),
                 "is not one of uniform, surface, near-rational, grazing (did you mean uniform?)"));
  CHECK(contains(said("--format jsn"), "is not one of ndjson, csv, npy"));
  CHECK(contains(said("--radius 0"), "--radius: must be above zero"));
  CHECK(contains(said("--scene ellipse --radius 0.2"), "semiaxes, which have no radius"));
  for (const std::string kind : {"uniform", "surface", "near-rational", "grazing"})
    CHECK(contains(said("--radius 0.9 --kind " + kind),
                   "no free part of the cell, or nearly none; take smaller"));
}

TEST_CASE("Sample into a pipe that closes ends quietly", "[cli][sample]") {
  const Folder folder;
  const Run run = folder.run("(" LORENTZ_PROGRAM " sample --count 1e9 | head -n 1)");
  CHECK(run.status == 0);
  CHECK(run.err.empty());
  CHECK(lines(run.out) == 1);
}

TEST_CASE("sample --precision: starts in binary32, which compare asks of columns", "[cli][sample]") {
  const Folder folder;
  const std::string scene = " --scene cubic --radius 0.2 ";
  const Run stream = folder.lorentz("sample --precision binary32 --count 50" + scene);
  CHECK(contains(stream.out, R"("radius":0.20000000298023224)"));
  for (const double t : times_behind("\"v\":[", stream.out)) CHECK(t == static_cast<float>(t));
  CHECK(times_behind("\"v\":[", stream.out).size() == 50);
  for (const std::string format : {"npy", "csv"}) {
    const std::string queries = folder.file("q." + format), answers = folder.file("a." + format);
    const std::string drawn = "sample --precision binary32 --count 50 --format " + format + scene;
    folder.write("q." + format, folder.lorentz(drawn).out);
    folder.write("a." + format,
                 folder
                     .lorentz("first-hit --radius 0.20000000298023224 --scene cubic --format " + format +
                              " " + queries)
                     .out);
    const Run run = folder.lorentz("compare --json --precision binary32 --queries " + queries +
                                   " --answers mine=" + answers + scene);
    INFO(format << run.err);
    CHECK(run.status == 0);
    CHECK(contains(
        run.out, R"("not_asked":0,"outside_domain":0,"engines":[{"engine":"mine","queries":50,"agree":50,)"));
  }
  CHECK(folder.lorentz("sample --precision double").status == 2);
}
