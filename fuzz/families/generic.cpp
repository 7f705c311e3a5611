// generic-2d, generic-3d: not aimed at anything. Uniform starts in the free part of a cell, isotropic
// directions, radii from 0.3 down to 1e-6. Among n such queries the one nearest to a wrong decision has a
// relative margin of 1/n. They show what is often wrong, and measure how much harder the other families are.
#include <iterator>

#include "fuzz/families/family.hpp"
#include "question/cases/drawn_flights.hpp"
#include "question/cases/scenes.hpp"

namespace lorentz::cases {
namespace {

constexpr const char* kDecades[] = {"radius-1e-1", "radius-1e-2", "radius-1e-3",
                                    "radius-1e-4", "radius-1e-5", "radius-1e-6"};
constexpr double kPowers[] = {1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6};

void make_generic(Source& source, int dimension, Case& made) {
  const bool unit = source.scene.one_in(2);
  made.scene = unit ? unit_scene(dimension, 1) : drawn_crystal(source.scene, dimension).scene;
  // In binary32 flights beyond 10^6 cells are noise: nothing can be told of radii below 1e-3.
  const std::uint64_t decades = source.is_wide() ? std::size(kPowers) : 3;
  const std::uint64_t decade = source.index / kCasesPerScene % decades;
  const double largest = decade > 0 ? 10 : made.scene.lattices[0].atoms.size() == 1 ? 3 : 2.1;
  set_radius(made.scene, kPowers[decade] * source.scene.between(1, largest));
  made.query = free_flight(source.random, made.scene);
  made.tags = {kDecades[decade], unit ? "unit-cell" : "crystal"};
}

std::vector<Tag> tags() {
  return {
      {"radius-1e-1", "radius 0.1 to 0.3: dense obstacles, short flights, many starts near a surface"},
      {"radius-1e-2", "radius 0.01 to 0.1"},
      {"radius-1e-3", "radius 1e-3 to 1e-2",
       "radius 1e-3 to 1e-2: a textbook quadratic at the start has no digit left in 2D"},
      {"radius-1e-4", "radius 1e-4 to 1e-3: cell-to-cell programs become slow", ""},
      {"radius-1e-5", "radius 1e-5 to 1e-4", ""},
      {"radius-1e-6", "radius 1e-6 to 1e-5: a textbook quadratic at the start has no digit left in 2D", ""},
      {"unit-cell", "the square or cubic lattice, which programs treat apart"},
      {"crystal", "another lattice, or several obstacles a cell"}};
}

}  // namespace

Family generic_2d() {
  return {"generic-2d", "Uniform free starts and isotropic directions in the plane.", tags(),
          [](Source& source, Case& made) { make_generic(source, 2, made); }};
}

Family generic_3d() {
  return {"generic-3d", "Uniform free starts and isotropic directions in space.", tags(),
          [](Source& source, Case& made) { make_generic(source, 3, made); }};
}

}  // namespace lorentz::cases
