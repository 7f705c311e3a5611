// lorentz bench as its users call it.
#include "tests/support/command_line.hpp"

#include <catch2/catch.hpp>

using namespace lorentz::test;

TEST_CASE("bench measures, concludes, and writes its figures", "[cli][bench_command]") {
  const Folder folder;
  const Run run =
      folder.lorentz("bench --scene square --radius 0.1 --count 64 --engine reduction,certified --csv " +
                     folder.file("speed.csv"));
  CHECK(run.status == 0);
  CHECK(contains(run.out, "square, r = 0.1, near-rational"));
  CHECK(contains(run.out, "reduction: "));
  CHECK(contains(run.out, "no wrong answer in 192"));
  const std::string csv = folder.read("speed.csv");
  CHECK(lines(csv) == 7);
  CHECK(contains(csv, "scene,radius,difficulty,engine,queries,ns_mean"));
  CHECK(folder.lorentz("bench --engine nobody").status == 2);
  CHECK(folder.lorentz("bench --count 3").status == 2);
  CHECK(folder.lorentz("bench --scene square --radius 0.1 --count 32 --csv /nowhere/speed.csv").status == 3);
}

TEST_CASE("bench counts wrong times apart from wrong answers", "[cli][bench_command]") {
  const Folder folder;
  const Run run = folder.lorentz("bench --scene square --radius 0.01 --count 64 --engine published");
  INFO(run.out);
  CHECK(contains(run.out, "published: no wrong answer in "));
  CHECK(contains(run.out, " wrong times of right obstacles: off by "));
}

TEST_CASE("bench takes scenes with semiaxes at their own size", "[cli][bench_command]") {
  const Folder folder;
  const Run run =
      folder.lorentz("bench --scene ellipse --engine reduction --count 32 --csv " + folder.file("c"));
  INFO(run.out << run.err);
  CHECK(run.status == 0);
  CHECK(contains(folder.read("c"), "ellipse,own,drawn,reduction,"));
  CHECK(folder.lorentz("bench --scene ellipse --radius 0.1 --engine reduction --count 32").status == 2);
}
