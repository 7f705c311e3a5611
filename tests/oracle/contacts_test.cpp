// Which obstacles touch or overlap: against constructions by hand, and against the nearest point found by
// search.
#include <catch2/catch.hpp>

#include <chrono>
#include <set>

#include <lorentz/scene_check.hpp>
#include "tests/support/support.hpp"

using namespace lorentz;
using lorentz::test::Draw;
using oracle::Contact;
using oracle::contacts_in;
using oracle::SearchEnd;

namespace {

using Axes = std::vector<Vec>;

// Two bodies alone in a wide cell.
Scene pair(int dimension, const Axes& first, const Axes& second, const Vec& apart) {
  Scene scene = unit_scene(dimension, 1);
  for (int i = 0; i < dimension; ++i) scene.lattices[0].vectors[i][i] = 4096;
  scene.lattices[0].atoms = {{{}, 0, first}, {apart, 0, second}};
  return scene;
}

enum class Found { apart, touch, overlap };

Found found_in(const Scene& scene) {
  const auto contacts = contacts_in(scene, 10);
  REQUIRE(contacts.end == SearchEnd::complete);
  if (contacts.found.empty()) return Found::apart;
  REQUIRE(contacts.found.size() == 1);
  return contacts.found[0].overlap ? Found::overlap : Found::touch;
}

Vec image(const std::array<Vec, 3>& columns, const Vec& x) {
  Vec y{};
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) y[k] += columns[i][k] * x[i];
  return y;
}

double norm(const Vec& a) {
  return std::hypot(a[0], a[1], a[2]);
}

// The inverse of a matrix by columns; the third column of a 2D one is made (0, 0, 1).
std::array<Vec, 3> inverse(const std::array<Vec, 3>& m) {
  std::array<Vec, 3> rows;
  for (int i = 0; i < 3; ++i) {
    const Vec &a = m[(i + 1) % 3], &b = m[(i + 2) % 3];
    rows[i] = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
  }
  const double det = rows[0][0] * m[0][0] + rows[0][1] * m[0][1] + rows[0][2] * m[0][2];
  std::array<Vec, 3> columns;
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) columns[k][i] = rows[i][k] / det;
  return columns;
}

std::array<Vec, 3> matrix(const Axes& axes) {
  std::array<Vec, 3> m{Vec{}, Vec{}, Vec{0, 0, 1}};
  for (std::size_t i = 0; i < axes.size(); ++i) m[i] = axes[i];
  return m;
}

// The smallest |A1^-1 (c + A2 y)| over |y| <= 1, from many starts by steps towards the nearest point: below 1
// iff the two have inner points in common.
double nearest(const Axes& first, const Axes& second, const Vec& c) {
  const std::array<Vec, 3> inverse1 = inverse(matrix(first)), a2 = matrix(second);
  std::array<Vec, 3> m;
  for (int i = 0; i < 3; ++i) m[i] = image(inverse1, a2[i]);
  if (first.size() == 2) m[2] = {};
  const Vec offset = image(inverse1, c);
  double size2 = 0;
  for (const Vec& column : m) size2 += norm(column) * norm(column);
  Vec y{};
  double best = norm(offset);
  for (int step = 0; step < 20000; ++step) {  // projected gradient: the problem is convex
    Vec value = image(m, y);
    for (int k = 0; k < 3; ++k) value[k] += offset[k];
    best = std::min(best, norm(value));
    for (int i = 0; i < 3; ++i)
      y[i] -= (m[i][0] * value[0] + m[i][1] * value[1] + m[i][2] * value[2]) / size2;
    const double length = norm(y);
    if (length > 1)
      for (double& component : y) component /= length;
  }
  return best;
}

Axes drawn_axes(Draw& draw, int dimension) {
  for (;;) {
    Axes axes;
    for (int i = 0; i < dimension; ++i) axes.push_back(draw.vec(dimension, -0.6, 0.6));
    const auto m = matrix(axes);
    const double det = image(inverse(m), {1, 0, 0})[0];
    if (std::isfinite(det) && norm(image(inverse(m), {1, 1, 1})) < 8) return axes;
  }
}

}  // namespace

TEST_CASE("An ellipse and a disc at distance 2: touching, an ulp nearer or farther: not",
          "[oracle][contacts]") {
  const Axes ellipse{Vec{1, 0}, Vec{0, 0.5}}, disc{Vec{1, 0}, Vec{0, 1}};
  for (const bool as_ball : {false, true}) {
    const auto at = [&](double distance) {
      Scene scene = pair(2, ellipse, disc, {distance, 0});
      if (as_ball) scene.lattices[0].atoms[1] = {{distance, 0}, 1, {}};
      return found_in(scene);
    };
    CHECK(at(2) == Found::touch);
    CHECK(at(std::nextafter(2.0, 3)) == Found::apart);
    CHECK(at(std::nextafter(2.0, 0)) == Found::overlap);
    CHECK(at(0) == Found::overlap);
  }
  CHECK(found_in(pair(2, ellipse, disc, {0, 1.5})) == Found::touch);
  CHECK(found_in(pair(2, ellipse, disc, {0, 1.5 + 0x1p-52})) == Found::apart);
  // 3-4-5, and one inside the other.
  const Axes turned{Vec{3, 4}, Vec{-2, 1.5}}, round{Vec{5, 0}, Vec{0, 5}};
  CHECK(found_in(pair(2, turned, round, {6, 8})) == Found::touch);
  CHECK(found_in(pair(2, turned, round, {-6, 4.5})) == Found::touch);
  CHECK(found_in(pair(2, turned, round, {6, 8 + 0x1p-49})) == Found::apart);
  CHECK(found_in(pair(2, turned, round, {6, 8 - 0x1p-49})) == Found::overlap);
  CHECK(found_in(pair(2, turned, Axes{Vec{50, 0}, Vec{0, 50}}, {1, 1})) == Found::overlap);
}

TEST_CASE("Ellipsoids that touch at their poles still do under every linear map, and no longer an ulp off",
          "[oracle][contacts]") {
  Draw draw(61);
  for (const int dimension : {2, 3})
    for (int n = 0; n < 300; ++n) {
      const auto size = [&] { return static_cast<double>(1 + draw.below(6)); };
      std::array<Vec, 3> map{};
      do
        for (int i = 0; i < dimension; ++i)
          for (int k = 0; k < dimension; ++k) map[i][k] = draw.fraction(1, 5);
      while (std::fabs(test::determinant({map, {}}, dimension)) < 0.5);
      const double a = size(), b = size();
      Axes first, second;
      for (int i = 0; i < dimension; ++i) {
        Vec e{};
        e[i] = i == 0 ? a : size();
        first.push_back(image(map, e));
        e[i] = i == 0 ? b : size();
        second.push_back(image(map, e));
      }
      const auto at = [&](double distance) {
        return found_in(pair(dimension, first, second, image(map, {distance, 0, 0})));
      };
      INFO("case " << n << " in dimension " << dimension);
      REQUIRE(at(a + b) == Found::touch);
      REQUIRE(at(a + b + 0x1p-40) == Found::apart);
      REQUIRE(at(a + b - 0x1p-40) == Found::overlap);
    }
}

TEST_CASE("Drawn ellipses and ellipsoids against a search for the nearest point", "[oracle][contacts]") {
  Draw draw(62);
  int apart = 0, overlap = 0;
  for (int n = 0; n < 1200; ++n) {
    const int dimension = 2 + n % 2;
    const Axes first = drawn_axes(draw, dimension);
    const Axes second = draw.one_in(4) ? first : drawn_axes(draw, dimension);
    const Vec c = draw.vec(dimension, -1, 1);
    const double value = nearest(first, second, c);
    if (std::fabs(value - 1) < 1e-3) continue;
    ++(value < 1 ? overlap : apart);
    INFO("case " << n << ": " << value);
    REQUIRE(found_in(pair(dimension, first, second, c)) == (value < 1 ? Found::overlap : Found::apart));
  }
  CHECK(apart > 300);    // 555 seen
  CHECK(overlap > 510);  // 644 seen
}

TEST_CASE("All contacts of a lattice of ellipses: every cell that a look at all cells finds",
          "[oracle][contacts]") {
  Draw draw(63);
  int contacts = 0;
  for (int n = 0; n < 60; ++n) {
    Scene scene = unit_scene(2, 1);
    scene.lattices[0].vectors = {Vec{1, draw.between(-1, 1)}, Vec{draw.between(-1, 1), 2.5}};
    scene.lattices[0].atoms.clear();
    for (int a = 0; a < 2; ++a)
      scene.lattices[0].atoms.push_back({draw.vec(2, 0, 1), 0, drawn_axes(draw, 2)});
    if (draw.one_in(3)) scene.lattices[0].atoms[1] = {draw.vec(2, 0, 1), draw.between(0.1, 0.8), {}};
    std::set<std::array<std::int64_t, 4>> expected, unclear, seen;
    const auto axes = [&](int a) {
      const Atom& atom = scene.lattices[0].atoms[static_cast<std::size_t>(a)];
      return atom.is_ball() ? Axes{Vec{atom.radius, 0}, Vec{0, atom.radius}} : atom.semiaxes;
    };
    for (int a = 0; a < 2; ++a)
      for (int b = a; b < 2; ++b)
        for (std::int64_t i = -7; i <= 7; ++i)
          for (std::int64_t k = -7; k <= 7; ++k) {
            if (a == b && (i < 0 || (i == 0 && k <= 0))) continue;
            Vec c = test::centre_of(scene, {0, b, {i, k, 0}});
            for (int m = 0; m < 2; ++m)
              c[m] -= scene.lattices[0].atoms[static_cast<std::size_t>(a)].position[m];
            if (norm(c) > 3.5) continue;
            const double value = nearest(axes(a), axes(b), c);
            if (value < 1) expected.insert({a, b, i, k});
            if (std::fabs(value - 1) < 1e-3) unclear.insert({a, b, i, k});
          }
    const auto found = contacts_in(scene, 1000);
    REQUIRE(found.end == SearchEnd::complete);
    for (const Contact& contact : found.found)
      seen.insert({contact.atom, contact.other_atom, (*contact.cell)[0].int64(), (*contact.cell)[1].int64()});
    REQUIRE(seen.size() == found.found.size());
    contacts += static_cast<int>(seen.size());
    if (unclear.empty()) REQUIRE(seen == expected);
  }
  CHECK(contacts > 85);  // 107 seen
}

TEST_CASE("Touching balls are counted once a pair, and told from overlapping ones", "[oracle][contacts]") {
  const auto count = [](const Scene& scene, bool overlap) {
    const auto contacts = contacts_in(scene, 100);
    REQUIRE(contacts.end == SearchEnd::complete);
    for (const Contact& contact : contacts.found) CHECK(contact.overlap == overlap);
    return contacts.found.size();
  };
  CHECK(count(unit_scene(2, 0.5), false) == 2);
  CHECK(count(unit_scene(3, 0.5), false) == 3);
  CHECK(count(unit_scene(3, std::nextafter(0.5, 1)), true) == 3);
  CHECK(count(unit_scene(2, 0.625), true) == 2);
  CHECK(count(unit_scene(2, 0.75), true) == 4);  // the diagonals too
  Scene two = unit_scene(2, 0.25);
  two.lattices[0].atoms.push_back({{0.5, 0}, 0.25, {}});
  CHECK(count(two, false) == 2);
  const Contact first = contacts_in(two, 1).found[0];
  CHECK(first.other_atom == 1);
  CHECK(first.cell.has_value());
  CHECK(contacts_in(unit_scene(3, 1e9), 10).found.size() == 10);
  CHECK(contacts_in(unit_scene(3, 1e9), 10).end == SearchEnd::limit);
}

namespace {

// All components times these, each ball written as semiaxes.
Scene stretched(Scene scene, const Vec& by) {
  const auto stretch = [&](Vec& a) {
    for (int i = 0; i < 3; ++i) a[i] *= by[i];
  };
  for (Lattice& lattice : scene.lattices) {
    for (Vec& u : lattice.vectors) stretch(u);
    for (Atom& atom : lattice.atoms) {
      stretch(atom.position);
      for (int i = 0; i < scene.dimension; ++i) {
        Vec axis{};
        axis[i] = atom.radius * by[i];
        atom.semiaxes.push_back(axis);
      }
      atom.radius = 0;
    }
  }
  return scene;
}

// Touches and overlaps.
std::pair<int, int> counts_in(const Scene& scene) {
  const auto contacts = contacts_in(scene, 1000);
  REQUIRE(contacts.end == SearchEnd::complete);
  std::pair<int, int> counts;
  for (const Contact& contact : contacts.found) ++(contact.overlap ? counts.second : counts.first);
  return counts;
}

}  // namespace

TEST_CASE("Touches and overlaps of the same obstacles are counted apart, as balls or stretched",
          "[oracle][contacts]") {
  // 3-4-5: neighbours along either vector overlap, those along the diagonals touch.
  Scene plane = unit_scene(2, 0.625), space = unit_scene(3, 0.625);
  for (Scene* scene : {&plane, &space}) scene->lattices[0].vectors[1][1] = 0.75;
  space.lattices[0].vectors[2][2] = 2;
  for (const Vec& by : {Vec{1, 1, 1}, Vec{2, 0.5, 4}}) {
    for (const Scene& scene : {stretched(plane, by), stretched(space, by)})
      CHECK(counts_in(scene) == std::pair(2, 2));
    // Two atoms that differ, of which the second has no contact with itself.
    Scene two = plane;
    two.lattices[0].vectors = {Vec{4, 0, 0}, {0, 4, 0}};
    two.lattices[0].atoms = {{{}, 2, {}}, {{3, 0, 0}, 1, {}}};
    CHECK(counts_in(stretched(two, by)) == std::pair(3, 1));  // 3 and 1 apart; its own translates, twice
    // Two lattices that overlap in one place and touch in another, whichever is looked at first.
    for (const double aside : {-0.25, 0.25})
      for (const int axis : {0, 1})
        for (const std::size_t small : {0, 1}) {
          Scene pair = unit_scene(2, 0.5);
          pair.lattices.push_back(pair.lattices[0]);
          pair.lattices[small].atoms[0].radius = 0.25, pair.lattices[small].atoms[0].position[axis] = aside;
          pair = stretched(pair, by);
          CHECK(counts_in(pair) == std::pair(2, 1));  // the larger touch their own translates
          const Contact last = contacts_in(pair, 100).found.back();
          CHECK(last.lattice == 0);
          CHECK(last.other_lattice == 1);
          CHECK(last.overlap);
          CHECK_FALSE(last.cell);
        }
  }
}

TEST_CASE("Lattices of other periods meet somewhere, slender ellipses reach beyond the next box",
          "[oracle][contacts]") {
  for (const int axis : {0, 1})
    for (const double first : {3.0, 4.0}) {  // periods of 3 and 4: centres differ by any integer
      Scene scene = unit_scene(2, 0.25);
      scene.lattices.push_back(scene.lattices[0]);
      for (Lattice& lattice : scene.lattices) lattice.vectors = {Vec{12, 0, 0}, {0, 12, 0}};
      const auto i = static_cast<std::size_t>(axis);
      scene.lattices[0].vectors[i][axis] = first, scene.lattices[1].vectors[i][axis] = 7 - first;
      scene.lattices[1].atoms[0].position[axis] = 1.5;
      CHECK(counts_in(scene) == std::pair(1, 0));
      scene.lattices[1].atoms[0].position[axis] = 1;
      CHECK(counts_in(scene) == std::pair(0, 1));
    }
  Scene narrow = unit_scene(2, 0.125);  // of two lattices the second meets its own translates
  narrow.lattices.push_back(narrow.lattices[0]);
  narrow.lattices[0].vectors = {Vec{8, 0, 0}, {0, 8, 0}},
  narrow.lattices[1].vectors = {Vec{0.2, 0, 0}, {0, 8, 0}};
  narrow.lattices[1].atoms[0].position = {0, 4, 0};
  CHECK(counts_in(narrow) == std::pair(0, 1));
  // Three lattices with two atoms each: the last atoms of the outer two lattices meet, or of the last two.
  for (const std::size_t one : {0, 1}) {
    Scene scene = unit_scene(2, 0.125);
    scene.lattices[0].vectors = {Vec{8, 0, 0}, {0, 8, 0}};
    scene.lattices[0].atoms.push_back(scene.lattices[0].atoms[0]);
    scene.lattices.resize(3, scene.lattices[0]);
    for (int l = 0; l < 3; ++l)
      for (int a = 0; a < 2; ++a) scene.lattices[l].atoms[a].position = {l + 0.0, 3.0 * a, 0};
    scene.lattices[2].atoms[1].position[0] = static_cast<double>(one) + 0.125;
    const auto found = contacts_in(scene, 10).found;
    REQUIRE(found.size() == 1);
    CHECK(std::array{found[0].lattice, found[0].atom, found[0].other_lattice, found[0].other_atom} ==
          std::array{static_cast<std::int32_t>(one), 1, 2, 1});
  }
  // Four columns of four in a period, each with those at distances 1 and 2 along its length; and a speck.
  for (const int along : {0, 1}) {
    Scene scene = unit_scene(2, 0.01);
    scene.lattices[0].vectors = {Vec{4, 0, 0}, {0, 4, 0}};
    std::vector<Atom> atoms;
    for (int i = 0; i < 16; ++i) {
      Atom atom{{i % 4 + 0.0, i / 4 + 0.0, 0}, 0, {Vec{0.05, 0, 0}, {0, 0.05, 0}}};
      atom.semiaxes[static_cast<std::size_t>(along)][along] = 1.4;
      atoms.push_back(atom);
    }
    atoms.push_back({{0.5, 0.5, 0}, 0.01, {}});
    scene.lattices[0].atoms = atoms;
    CHECK(counts_in(scene) == std::pair(0, 32));
  }
}

TEST_CASE("Slender ellipses meet across boxes that would do for round ones", "[oracle][contacts]") {
  for (const int along : {0, 1}) {
    Scene scene = unit_scene(2, 0.01);
    scene.lattices[0].vectors = {Vec{28, 0, 0}, {0, 28, 0}};
    auto& atoms = scene.lattices[0].atoms;
    for (int i = 0; i < 196; ++i)
      atoms.push_back({{2.0 * (i % 14) + 0.5, 2.0 * (i / 14) + 0.5, 0}, 0.01, {}});
    for (const double place : {1.9, 4.65}) {  // 2.75 apart, and 2.8 long
      Atom atom{{1, 1, 0}, 0, {Vec{0.05, 0, 0}, {0, 0.05, 0}}};
      atom.position[along] = place;
      atom.semiaxes[static_cast<std::size_t>(along)][along] = 1.4;
      atoms.push_back(atom);
    }
    CHECK(counts_in(scene) == std::pair(0, 1));
  }
}

TEST_CASE("Hundreds of balls in a skewed cell: every contact that a look at all pairs finds",
          "[oracle][contacts]") {
  Draw draw(64);
  std::size_t contacts = 0;
  for (int n = 0; n < 12; ++n) {
    const int dimension = 2 + n % 2;
    Scene scene = unit_scene(dimension, 1);
    Lattice& lattice = scene.lattices[0];
    do
      for (int i = 0; i < dimension; ++i) lattice.vectors[i] = draw.vec(dimension, -10, 10);
    while (std::fabs(test::determinant(lattice, dimension)) < (dimension == 2 ? 50 : 300));
    lattice.atoms.clear();
    for (int a = 0; a < 250; ++a) {
      Vec x{};
      for (int i = 0; i < dimension; ++i) {
        const double share = draw.between(-2, 2);
        for (int k = 0; k < dimension; ++k) x[k] += share * lattice.vectors[i][k];
      }
      lattice.atoms.push_back({x, dimension == 2 ? draw.between(0.25, 0.4) : draw.between(0.4, 0.6), {}});
    }
    // Differences of fractional coordinates brought to within 1/2; cells around are looked at too.
    const auto inverse_columns =
        inverse(matrix(Axes(lattice.vectors.begin(), lattice.vectors.begin() + dimension)));
    std::size_t expected = 0;
    for (std::size_t a = 0; a < lattice.atoms.size(); ++a)
      for (std::size_t b = a + 1; b < lattice.atoms.size(); ++b) {
        Vec c{}, home{};
        for (int k = 0; k < 3; ++k) c[k] = lattice.atoms[b].position[k] - lattice.atoms[a].position[k];
        const Vec n = image(inverse_columns, c);
        for (int k = 0; k < 3; ++k) home[k] = n[k] - (k < dimension ? std::round(n[k]) : 0);
        for (int i = -2; i <= 2; ++i)
          for (int k = -2; k <= 2; ++k)
            for (int m = -2; m <= 2; ++m) {
              if (dimension == 2 && m != 0) continue;
              const Vec at =
                  image(lattice.vectors, {home[0] + i, home[1] + k, dimension == 3 ? home[2] + m : 0});
              expected += norm(at) <= lattice.atoms[a].radius + lattice.atoms[b].radius;
            }
      }
    const auto found = contacts_in(scene, 100'000);
    REQUIRE(found.end == SearchEnd::complete);
    REQUIRE(found.found.size() == expected);
    contacts += expected;
  }
  CHECK(contacts > 3400);  // 4 273 seen
}

TEST_CASE("Ten thousand atoms are checked in seconds, what would take too long is given up, and said so",
          "[oracle][contacts]") {
  Scene scene = unit_scene(3, 0.4 / 22);
  auto& atoms = scene.lattices[0].atoms;
  atoms.clear();
  for (int i = 0; i < 22 * 22 * 22; ++i)
    atoms.push_back({{i % 22 / 22.0, i / 22 % 22 / 22.0, i / 484 / 22.0}, 0.4 / 22, {}});
  const auto start = std::chrono::steady_clock::now();
  auto contacts = contacts_in(scene, 10);
  CHECK(contacts.found.empty());
  CHECK(contacts.end == SearchEnd::complete);
  atoms.push_back({{-0.98 / 22, 7.0, -3.0}, 0.05 / 22, {}});
  contacts = contacts_in(scene, 10);
  CHECK(contacts.end == SearchEnd::complete);
  REQUIRE(contacts.found.size() == 1);
  CHECK(contacts.found[0].atom == 21);
  CHECK(contacts.found[0].other_atom == 22 * 22 * 22);
  CHECK(contacts_in(scene, 10, oracle::Pairs::all, 1000).end == SearchEnd::budget);
  CHECK(std::chrono::steady_clock::now() - start < std::chrono::seconds(60));
  // A lattice so dense that 10^8 translates of a disc overlap it: the first few are found at once.
  Scene dense = unit_scene(2, 0.1);
  dense.lattices[0].vectors = {Vec{1e-9, 0}, Vec{1e9, 1}};
  CHECK(contacts_in(dense, 10).found.size() == 10);
  // A needle through 10^8 cells is no more work than a disc.
  Scene needle = unit_scene(2, 1e-9);
  needle.lattices[0].atoms.push_back({{0.5, 0.5}, 0, {Vec{1e8, 1}, Vec{-1e-9, 1e-9}}});
  CHECK(contacts_in(needle, 10).end == SearchEnd::complete);
}

TEST_CASE("Contacts: a ball written as semiaxes is found to be one, and costs no more",
          "[oracle][contacts]") {
  // 3-4-5: (0, 3, 4) / 16, (0, 4, -3) / 16 and 5 / 16.
  const Axes turned{{0, 0.1875, 0.25}, {-0.3125, 0, 0}, {0, 0.25, -0.1875}};
  Scene balls = unit_scene(3, 0.5), written;
  balls.lattices[0].atoms.push_back({{0.5, 0.5, 0.125}, 0.3125, {}});
  written = balls;
  written.lattices[0].atoms[1] = {{0.5, 0.5, 0.125}, 0, turned};
  const auto all = contacts_in(balls, 100);
  REQUIRE(all.found.size() > 5);
  long least = 1;
  while (contacts_in(balls, 100, oracle::Pairs::all, least).end != SearchEnd::complete) ++least;
  const auto same = contacts_in(written, 100, oracle::Pairs::all, least);
  CHECK(same.end == SearchEnd::complete);
  REQUIRE(same.found.size() == all.found.size());
  for (std::size_t i = 0; i < all.found.size(); ++i) {
    CHECK(same.found[i].cell == all.found[i].cell);
    CHECK(same.found[i].overlap == all.found[i].overlap);
  }
}
