#include <lorentz/scene_check.hpp>

#include <catch2/catch.hpp>

#include "tests/support/scenes.hpp"
#include "tests/support/support.hpp"

using namespace lorentz;

namespace {

Scene with_vectors(int dimension, const std::array<Vec, 3>& vectors) {
  return test::one_atom(dimension, vectors, 0.1);
}

bool in_contact(const Scene& scene) {
  return !oracle::contacts_in(scene, 1).found.empty();
}

}  // namespace

TEST_CASE("Dependent vectors are found exactly, nearly dependent ones count as independent",
          "[oracle][scene_check]") {
  CHECK(oracle::dependence_in(with_vectors(2, {Vec{1, 2}, Vec{2, 4}})).has_value());
  CHECK(oracle::dependence_in(with_vectors(2, {Vec{0.1, 0.2}, Vec{0.2, 0.4}})).has_value());
  CHECK(oracle::dependence_in(with_vectors(2, {Vec{1, 0}, Vec{0, 0}})).has_value());
  CHECK(oracle::dependence_in(with_vectors(3, {Vec{1, 2, 3}, Vec{4, 5, 6}, Vec{7, 8, 9}})).has_value());
  // 0.1 + 0.2 is not 0.3 in binary64, so these are independent, though the plain determinant says 0 or
  // nearly.
  CHECK_FALSE(oracle::dependence_in(with_vectors(2, {Vec{1, 0.1 + 0.2}, Vec{1, 0.3}})).has_value());
  CHECK_FALSE(oracle::dependence_in(with_vectors(2, {Vec{1e300, 1}, Vec{1e300, std::nextafter(1.0, 2)}}))
                  .has_value());
  CHECK_FALSE(oracle::dependence_in(with_vectors(2, {Vec{5e-324, 0}, Vec{0, 1e308}})).has_value());
  Scene flat = unit_scene(2, 0.1);
  flat.lattices[0].atoms[0].semiaxes = {Vec{1, 1}, Vec{2, 2}};
  CHECK(oracle::dependence_in(flat).has_value());
}

TEST_CASE("Dependent vectors are found in whichever lattice, atom and axis they are",
          "[oracle][scene_check]") {
  Scene scene = unit_scene(3, 0.1);
  const Atom ball = scene.lattices[0].atoms[0];
  const Atom body{{}, 0, {Vec{1, 0, 0}, Vec{0, 1, 0}, Vec{1, 1, 1}}};
  scene.lattices[0].atoms = {ball, body, ball, body};
  scene.lattices.resize(3, scene.lattices[0]);
  CHECK_FALSE(oracle::dependence_in(scene));
  for (const std::size_t lattice : {0, 1, 2}) {
    Scene flat = scene;
    flat.lattices[lattice].vectors[2] = {1, 1, 0};
    CHECK(oracle::dependence_in(flat).value().find("lattice " + std::to_string(lattice) +
                                                   ": the primitive") == 0);
    for (const std::size_t atom : {1, 3}) {
      flat = scene;
      flat.lattices[lattice].atoms[atom].semiaxes[2] = {1, 1, 0};
      CHECK(oracle::dependence_in(flat) == "lattice " + std::to_string(lattice) + ", atom " +
                                               std::to_string(atom) +
                                               ": the semiaxes are linearly dependent");
    }
  }
}

TEST_CASE("Contacts are described by who meets whom", "[oracle][scene_check]") {
  using oracle::description_of;
  CHECK(description_of({0, 1, 0, 1, {}, true}) ==
        "the obstacles of lattice 0, atom 1 overlap their own translates");
  CHECK(description_of({0, 1, 0, 2, {}, false}) ==
        "obstacles of lattice 0, atom 1 and of lattice 0, atom 2 touch");
  CHECK(description_of({0, 1, 2, 1, {}, true}) ==
        "obstacles of lattice 0, atom 1 and of lattice 2, atom 1 overlap");
}

TEST_CASE("Overlapping and touching obstacles are noticed, separate ones are not", "[oracle][scene_check]") {
  CHECK_FALSE(in_contact(unit_scene(2, std::nextafter(0.5, 0))));
  CHECK(in_contact(unit_scene(2, 0.5)));
  CHECK(in_contact(unit_scene(3, 0.5)));
  CHECK(in_contact(unit_scene(3, 1e9)));

  Scene motif = unit_scene(2, 0.25);
  motif.lattices[0].atoms.push_back({{0.5, 0.5}, 0.25, {}});
  CHECK_FALSE(in_contact(motif));
  motif.lattices[0].atoms[1].position = {0.5, 1000};  // touches (0, 1000) + (1, 0)'s half: distance 1/2
  CHECK(in_contact(motif));

  Scene two = unit_scene(2, 0.25);
  two.lattices.push_back(two.lattices[0]);
  CHECK(in_contact(two));
  CHECK(oracle::contacts_in(two, 1, oracle::Pairs::within_lattices).found.empty());
  two.lattices[1].atoms[0].position = {0.5, 0.5};
  CHECK_FALSE(in_contact(two));

  // Spacings 1 and 3/2 along x, 1 along y: differences are the multiples of 1/2 along x.
  two.lattices[1].vectors[0][0] = 1.5;
  two.lattices[1].atoms[0].position = {0.25, 0.5};
  two.lattices[1].atoms[0].radius = two.lattices[0].atoms[0].radius = 0.25;
  CHECK_FALSE(in_contact(two));  // nearest centres are (1/4, 1/2) apart
  two.lattices[1].atoms[0].radius = 0.3125;
  CHECK(in_contact(two));
  // Rotated by a binary64 angle: they come as near to each other as one likes, but not the lattices to
  // themselves.
  Scene rotated = unit_scene(2, 0.01);
  rotated.lattices.push_back(rotated.lattices[0]);
  rotated.lattices[1].vectors = {Vec{std::cos(0.6), std::sin(0.6)}, Vec{-std::sin(0.6), std::cos(0.6)}};
  rotated.lattices[1].atoms[0].position = {0.5, 0.5};
  CHECK(in_contact(rotated));

  // A skewed basis of the square: the overlap is along neither of its vectors.
  Scene skewed = unit_scene(2, 0.5);
  skewed.lattices[0].vectors = {Vec{1000, 1}, Vec{1001, 1}};
  CHECK(in_contact(skewed));
}
