// Obstacles that overlap their own translates, be it by the last bit, are those of several coarser lattices to the
// reduction engine, and those that just touch are not: in rows, layers and crystals. The oracle's exact contacts say
// which is which. The engine is held against the oracle there, and where obstacles overlap by more.
#include <catch2/catch.hpp>

#include <lorentz/geometry.hpp>
#include <lorentz/scene_check.hpp>
#include "src/engines/reduction/bravais.hpp"
#include "tests/engines/reduction_support.hpp"

using namespace lorentz;
using namespace lorentz::test;

namespace {

// A lattice of this rank: integers, a square or cubic cell, or numbers with all bits; then of any size.
Scene lattice_scene(Draw& draw, int dimension, int rank) {
  Scene scene = unit_scene(dimension, 0.1);
  Lattice& lattice = scene.lattices[0];
  lattice.rank = rank;
  const std::uint64_t kind = draw.below(3);
  do {
    lattice.vectors = {};
    for (int i = 0; i < rank; ++i) {
      if (kind == 0) lattice.vectors[i][i] = static_cast<double>(1 + draw.below(3));
      for (int k = 0; k < dimension && kind > 0; ++k)
        lattice.vectors[i][k] = kind == 1 ? draw.fraction(1, 6) : draw.between(-1, 1);
    }
  } while (oracle::dependence_in(scene));
  if (draw.one_in(2)) {
    const double size = std::exp2(draw.between(-40, 40));
    for (Vec& u : lattice.vectors)
      for (double& component : u) component *= size;
  }
  if (draw.one_in(2)) lattice.atoms[0].position = draw.vec(dimension, -1, 1);
  return scene;
}

// The largest factor of the atom's size at which its obstacles do not overlap, to the last bit.
template <class Resized>
double last_without_overlap(const Resized& resized, double high) {
  const auto overlaps = [&](double factor) {
    const oracle::Contacts contacts = oracle::contacts_in(resized(factor), 100);
    return std::ranges::any_of(contacts.found, [](const oracle::Contact& one) { return one.overlap; });
  };
  double low = high / 2;
  while (overlaps(low)) low /= 2;
  for (high = 2 * low; std::nextafter(low, high) < high;) {
    const double middle = low + (high - low) / 2;
    (overlaps(middle) ? high : low) = middle;
  }
  return low;
}

void scale_semiaxes(Atom& atom, double factor) {
  atom.radius = 0;
  for (Vec& axis : atom.semiaxes)
    for (double& component : axis) component *= factor;
}

double shortest_primitive(const Lattice& lattice, int rank) {
  double shortest = length(lattice.vectors[0]);
  for (int i = 1; i < rank; ++i) shortest = std::min(shortest, length(lattice.vectors[i]));
  return shortest;
}

// A flight past the point where the obstacle of the cell 0 touches a neighbour, or nearly so.
Query past_contact(Draw& draw, const Scene& scene, int rank) {
  const Lattice& lattice = scene.lattices[0];
  const Vec& u = lattice.vectors[draw.below(rank)];
  Query query{lattice.atoms[0].position, draw.vec(scene.dimension, -1, 1), {}};
  for (int k = 0; k < scene.dimension; ++k) query.x[k] += u[k] / 2 - query.v[k] * length(u);
  return query;
}

}  // namespace

TEST_CASE(
    "Obstacles that touch their translates are told from those that overlap by an ulp, and both are decided "
    "like the oracle does",
    "[engines][reduction][touching]") {
  Draw draw(20'261'128);
  Count count;
  int single = 0, touching = 0;
  for (const auto& [dimension, rank] : {std::pair(2, 1), {2, 2}, {3, 1}, {3, 2}, {3, 3}})
    for (int i = 0; i < 60; ++i) {
      const Scene drawn = lattice_scene(draw, dimension, rank);
      const bool is_ball = i % 3 != 0;
      const std::vector<Vec> axes = semiaxes_of(draw, i % 2 ? Style::generic : Style::grid, dimension);
      const double unit = shortest_primitive(drawn.lattices[0], rank);
      const auto resized = [&](double factor) {
        Scene scene = drawn;
        Atom& atom = scene.lattices[0].atoms[0];
        if (is_ball) return atom.radius = factor, scene;
        atom.semiaxes = axes;
        return scale_semiaxes(atom, factor), scene;
      };
      const double last = last_without_overlap(resized, 64 * unit);
      const Scene scene = resized(last), above = resized(std::nextafter(last, HUGE_VAL));
      INFO(stream(scene, {{}, {1, 0, 0}, {}}));
      REQUIRE(Reduction::beyond(scene).value_or("") == "");
      REQUIRE(Reduction::beyond(above).value_or("") == "");
      const bool strides = prepare(scene).strides;  // where the obstacle reaches far into a flat cell
      single += !strides;
      touching += !oracle::contacts_in(scene, 1).found.empty();
      CHECK(prepare(resized(std::nextafter(last, 0))).strides == strides);
      CHECK(prepare(above).strides);
      for (int k = 0; k < 8; ++k) {
        const Scene& asked = k < 4 ? scene : above;
        Query query = k % 2 ? past_contact(draw, asked, rank) : hard_query(draw, Style::near_grid, asked);
        check(asked, query, count);
      }
    }
  CHECK(single > 260);                 // 280 seen
  CHECK(touching > 60);                // 73 seen
  CHECK(count.hit > 900);              // 1 097 seen
  CHECK(count.stages.undecided < 60);  // 18 seen
}

// From a bit more than touching to radii of several cells; several radii in one lattice, so that their lattices are
// of different coarseness; starts in and on obstacles, and leaving them.
TEST_CASE("Among obstacles that overlap their translates the engine decides like the oracle does",
          "[engines][reduction][touching]") {
  const std::vector<std::pair<int, int>> kinds{{2, 2}, {3, 3}, {2, 1}, {3, 2}, {3, 1}};
  Draw draw(20'261'129);
  Count count;
  long overlapping = 0;
  for (int i = 0; i < 1500; ++i) {
    const auto [dimension, rank] = kinds[draw.below(kinds.size())];
    Scene scene = lattice_scene(draw, dimension, rank);
    Lattice& lattice = scene.lattices[0];
    const double unit = shortest_primitive(lattice, rank), most = dimension == 2 ? 1.5 : 0.3;
    lattice.atoms.resize(1 + draw.below(2));
    for (Atom& atom : lattice.atoms) {
      atom.position = i % 2 ? draw.vec(dimension, -1, 1) : Vec{};
      const double factor = unit * std::exp2(draw.between(-3, most));
      if (draw.one_in(3)) {
        atom.semiaxes = semiaxes_of(draw, Style::generic, dimension);
        scale_semiaxes(atom, factor);
      } else {
        atom = {atom.position, factor, {}};
      }
    }
    if (Reduction::beyond(scene)) continue;
    const bool strides = prepare(scene).strides;
    overlapping += strides;
    for (int k = 0; k < 8 && strides; ++k)
      check(scene, k % 2 ? past_contact(draw, scene, rank) : hard_query(draw, Style::near_grid, scene),
            count);
  }
  CHECK(overlapping > 600);             // 701 seen
  CHECK(count.hit > 900);               // 1 153 seen
  CHECK(count.inside > 3'000);          // 3 943 seen
  CHECK(count.stages.undecided < 100);  // 45 seen
}

TEST_CASE("Balls of half the shortest vector do not overlap, in any lattice",
          "[engines][reduction][touching]") {
  const auto strides = [](int dimension, const std::vector<Vec>& vectors, double radius) {
    Scene scene = unit_scene(dimension, radius);
    Lattice& lattice = scene.lattices[0];
    lattice.rank = static_cast<int>(vectors.size());
    lattice.vectors = {};
    std::copy(vectors.begin(), vectors.end(), lattice.vectors.begin());
    REQUIRE(Reduction::beyond(scene).value_or("") == "");
    return prepare(scene).strides;
  };
  for (const auto& [dimension, vectors, radius] :
       std::initializer_list<std::tuple<int, std::vector<Vec>, double>>{
           {2, {{2, 0, 0}, {0, 2, 0}}, 1},
           {2, {{1, 0, 0}}, 0.5},
           {2, {{3, 4, 0}, {7, -1, 0}}, 2.5},
           {3, {{0, 0, 1}}, 0.5},
           {3, {{1, 2, 2}, {2, 1, -2}}, 1.5},
           {3, {{2, 3, 6}, {3, -6, 2}, {6, 2, -3}}, 3.5}}) {
    INFO(dimension << ' ' << vectors.size() << ' ' << radius);
    CHECK_FALSE(strides(dimension, vectors, std::nextafter(radius, 0)));
    CHECK_FALSE(strides(dimension, vectors, radius));
    CHECK(strides(dimension, vectors, std::nextafter(radius, 10)));
  }
  // A component of 2^-600 makes the shortest vector longer than 1. Its square is below all binary64: the
  // engine, which takes such components as zero, does not know, and takes them as overlapping.
  CHECK(strides(2, {{1, 0x1p-600, 0}, {0, 1, 0}}, 0.5));
}

TEST_CASE("Cells beyond 64 bits among obstacles that overlap their translates along one vector",
          "[engines][reduction][touching]") {
  Draw draw(7203);
  INFO("seed 7203");
  int hits = 0;
  for (int i = 0; i < 400; ++i) {
    // Rows at a distance of 10, counted in a skewed cell: a row far away has a number in the other vector that is
    // larger than 2^63.
    const double skew = (i % 2 ? -1 : 1) * (1e6 + static_cast<double>(draw.below(40'000)));
    const double row =
        (draw.one_in(2) ? -1 : 1) * static_cast<double>(16'000'000'000'000 + draw.below(1'000'000));
    Scene scene = unit_scene(2, 0.75);
    const int along = i % 4 / 2;
    scene.lattices[0].vectors[along] = {1, 0}, scene.lattices[0].vectors[1 - along] = {skew, 10};
    const Query query{{draw.between(-1, 1), 10 * row + 5, 0}, draw.vec(2, -1, 1), {}};
    const Answer given = Reduction(scene).first_hit(query), exact = oracle::Oracle(scene).first_hit(query);
    INFO(stream(scene, query) << line(given, 2) << line(exact, 2));
    if (given.outcome != Outcome::hit) continue;
    ++hits;
    REQUIRE(given.obstacle == exact.obstacle);
    REQUIRE_FALSE(exact.obstacle.cell[along].fits_int64());
  }
  CHECK(hits > 380);
}
