// The scenes of the catalogue are what their comments say.
#include <catch2/catch.hpp>

#include <filesystem>
#include <fstream>
#include <map>
#include <numbers>
#include <sstream>

#include <lorentz/scene_check.hpp>
#include "src/problem/scene_geometry.hpp"
#include "tests/support/scenes.hpp"
#include "tests/support/support.hpp"

using namespace lorentz;
using std::numbers::pi;
using test::all_scenes, test::with_radius;
namespace fs = std::filesystem;

namespace {

const fs::path kData = fs::path(LORENTZ_SOURCE_DIR) / "data";

Scene scene(const std::string& name) {
  return read_scene_file(kData / "scenes" / (name + ".toml"));
}

struct Neighbours {
  double distance = 1e9;
  int count = 0;
};

// The nearest obstacles to one of an atom of the first lattice, of the same or of any atom.
Neighbours neighbours(const Scene& scene, int atom, bool like = false) {
  std::vector<double> distances;
  const Lattice& lattice = scene.lattices[0];
  const Vec& x = lattice.atoms[static_cast<std::size_t>(atom)].position;
  for (int other = 0; other < static_cast<int>(lattice.atoms.size()); ++other)
    for (std::int64_t i = -3; i <= 3; ++i)
      for (std::int64_t k = -3; k <= 3; ++k)
        for (std::int64_t m = -3; m <= (scene.dimension == 3 ? 3 : -3); ++m) {
          const Vec c = test::centre_of(scene, {0, other, {i, k, scene.dimension == 3 ? m : 0}});
          const double distance = std::hypot(c[0] - x[0], c[1] - x[1], c[2] - x[2]);
          if (distance > 1e-9 && (!like || other == atom)) distances.push_back(distance);
        }
  Neighbours nearest;
  for (const double distance : distances) nearest.distance = std::min(nearest.distance, distance);
  for (const double distance : distances) nearest.count += distance < nearest.distance * (1 + 1e-9);
  return nearest;
}

}  // namespace

TEST_CASE("Every scene of the catalogue is one, says what it is, and stands in the table of data/README.md",
          "[cases][catalogue]") {
  std::ostringstream readme;
  readme << std::ifstream(kData / "README.md").rdbuf();
  const auto scenes = all_scenes();
  CHECK(scenes.size() >= 37);  // 37 seen
  for (const auto& [name, scene] : scenes) {
    INFO(name);
    CHECK_FALSE(flaw_of(scene).has_value());
    CHECK_FALSE(oracle::dependence_in(scene).has_value());
    CHECK(readme.str().find("| `" + name + "` |") != std::string::npos);
    std::string first;
    std::getline(std::ifstream(kData / "scenes" / (name + ".toml")), first);
    CHECK(first.starts_with("# "));
    CHECK(first.size() < 95);  // 87 seen at most
  }
}

TEST_CASE("Nothing in the catalogue overlaps or touches, but what says so", "[cases][catalogue]") {
  for (const auto& [name, scene] : all_scenes()) {
    INFO(name);
    const auto within = oracle::contacts_in(scene, 100, oracle::Pairs::within_lattices);
    const auto all = oracle::contacts_in(scene, 100);
    CHECK(all.end == oracle::SearchEnd::complete);
    const std::size_t own = name == "overlapping"           ? 1
                            : name == "overlapping-pockets" ? 2
                            : name == "overlapping-3d"      ? 3
                                                            : 0;
    const std::size_t lattices = name == "impurity" ? 1 : scene.lattices.size();  // others meet somewhere
    CHECK(within.found.size() == own);
    CHECK(all.found.size() == own + lattices * (lattices - 1) / 2);
    for (const auto& contact : all.found) CHECK(contact.overlap);
  }
}

TEST_CASE("Crystals: nearest neighbours, their number, and the filling at which balls touch",
          "[cases][catalogue]") {
  struct Crystal {
    const char* name;
    double distance;
    int neighbours;
    double filling;
  };
  const double s2 = std::sqrt(2), s3 = std::sqrt(3);
  for (const Crystal& crystal : {Crystal{"square", 1, 4, pi / 4},
                                 {"triangular", 1, 6, pi * s3 / 6},
                                 {"hexagonal", 1, 6, pi * s3 / 6},
                                 {"honeycomb", 1 / s3, 3, pi * s3 / 9},
                                 {"kagome", 0.5, 4, pi * s3 / 8},
                                 {"rectangular", 1, 2, pi / 6},
                                 {"centred-rectangular", std::sqrt(13.0) / 4, 4, pi * 13 / 48},
                                 {"oblique", 1, 2, pi / 5},
                                 {"pins-square", 1.26, 4, pi / 4},
                                 {"pins-hex", 1.275, 6, pi * s3 / 6},
                                 {"cubic", 1, 6, pi / 6},
                                 {"bcc", s3 / 2, 8, pi * s3 / 8},
                                 {"fcc", s2 / 2, 12, pi / std::sqrt(18.0)},
                                 {"hcp", 1, 12, pi / std::sqrt(18.0)},
                                 {"diamond", s3 / 4, 4, pi * s3 / 16}}) {
    INFO(crystal.name);
    const Scene here = scene(crystal.name);
    const int atoms = static_cast<int>(here.lattices[0].atoms.size());
    for (int a = 0; a < atoms; ++a) {
      CHECK(neighbours(here, a).distance == Approx(crystal.distance).epsilon(1e-15));
      CHECK(neighbours(here, a).count == crystal.neighbours);
    }
    const double touching = crystal.distance / 2;
    CHECK(filling_of(with_radius(here, touching))->fraction == Approx(crystal.filling).epsilon(1e-14));
    // Exactly, a little to either side of touching (whether at it depends on how sqrt(3) was rounded).
    CHECK(oracle::contacts_in(with_radius(here, touching * (1 - 1e-14)), 100).found.empty());
    CHECK(oracle::contacts_in(with_radius(here, touching * (1 + 1e-14)), 100).found.size() ==
          static_cast<std::size_t>(atoms * crystal.neighbours / 2));
    CHECK(here.lattices[0].atoms[0].radius < touching);
  }
}

TEST_CASE("Compounds: neighbours by kind", "[cases][catalogue]") {
  const auto check = [](const Neighbours& found, double distance, int count) {
    CHECK(found.distance == Approx(distance).epsilon(1e-15));
    CHECK(found.count == count);
  };
  for (const int atom : {0, 1}) {
    check(neighbours(scene("rock-salt"), atom), 0.5, 6);
    check(neighbours(scene("rock-salt"), atom, true), std::sqrt(0.5), 12);
    check(neighbours(scene("cesium-chloride"), atom), std::sqrt(0.75), 8);
    check(neighbours(scene("cesium-chloride"), atom, true), 1, 6);
  }
  check(neighbours(scene("perovskite"), 0), std::sqrt(0.5), 12);
  check(neighbours(scene("perovskite"), 1), 0.5, 6);
  for (const int x : {2, 3, 4}) check(neighbours(scene("perovskite"), x), 0.5, 2);
}

TEST_CASE("Superpositions are turned by the angles they are called after", "[cases][catalogue]") {
  const auto turned = [](const std::string& name, std::size_t lattice, long double angle) {
    const auto u = scene(name).lattices[lattice].vectors;
    const auto c = static_cast<double>(std::cos(angle)), s = static_cast<double>(std::sin(angle));
    CHECK(u == std::array<Vec, 3>{Vec{c, s}, Vec{-s, c}, Vec{}});
  };
  constexpr long double kPi = std::numbers::pi_v<long double>;
  turned("superposition-pi-5", 1, kPi / 5);
  turned("superposition-pi-7", 1, kPi / 7);
  turned("superposition-pi-5-pi-7", 1, kPi / 5);
  turned("superposition-pi-5-pi-7", 2, kPi / 7);
}
