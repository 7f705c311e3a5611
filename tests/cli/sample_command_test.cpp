// lorentz sample: what it writes first-hit reads, in every format, and no start lies in an obstacle.
#include <catch2/catch.hpp>

#include "tests/support/command_line.hpp"
#include "tests/support/npy.hpp"

using namespace lorentz;
using namespace lorentz::test;

namespace {

std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
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
      for (const std::string format : {"csv", "npy"}) {
        const Run columns = folder.lorentz(arguments + " --format " + format);
        REQUIRE(columns.status == 0);
        const std::string first_hit = "first-hit --strict --scene " + scene + " --format ";
        const Run of_columns =
            folder.lorentz(first_hit + format + " " + folder.write("columns", columns.out));
        REQUIRE(of_columns.status == 0);
        if (format == "npy") {  // the same rows, from fields and from numbers
          CHECK(contains(columns.out, kind == "surface" ? "('from_cell', '<i8'" : "'descr': '<f8'"));
          const std::size_t row = 11 + 8 + (scene == "diamond" ? 24 : 16);
          CHECK(npy_data(of_columns.out).size() == 50 * row);
          for (std::size_t i = 0; i < 50; ++i) CHECK(npy_data(of_columns.out)[i * row] < 2);
        } else {
          CHECK(lines(of_columns.out) == 51);
          CHECK(count_of(of_columns.out, "\nhit,") == count_of(answers.out, "\"hit\""));
        }
      }
    }
}

TEST_CASE("A seed's starts are the same, and another's others; fewer are the first of many",
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
  CHECK(contains(said("--count 0"), "--count: \"0\" is no whole number from 1"));
  CHECK(
      contains(said("--kind unifrm"), "(did you mean uniform?); there are uniform, surface, near-rational"));
  CHECK(contains(said("--format jsn"), "there are ndjson, csv, npy"));
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
