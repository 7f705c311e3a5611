#include "question/cases/scenes.hpp"

#include <utility>

#include <lorentz/geometry.hpp>

namespace lorentz::cases {
namespace {

Scene crystal(int dimension, const std::array<Vec, 3>& vectors, std::vector<Atom> atoms) {
  return {dimension, {{vectors, std::move(atoms)}}};
}

constexpr double kRoot3Half = 0.8660254037844386;  // rounded, as in the catalogue
constexpr std::array<Vec, 3> kSquare{Vec{1, 0}, Vec{0, 1}, Vec{}};
constexpr std::array<Vec, 3> kTriangular{Vec{1, 0}, Vec{0.5, kRoot3Half}, Vec{}};
constexpr std::array<Vec, 3> kCubic{Vec{1, 0, 0}, Vec{0, 1, 0}, Vec{0, 0, 1}};
constexpr std::array<Vec, 3> kFcc{Vec{0, 0.5, 0.5}, Vec{0.5, 0, 0.5}, Vec{0.5, 0.5, 0}};
constexpr std::array<Vec, 3> kBcc{Vec{-0.5, 0.5, 0.5}, Vec{0.5, -0.5, 0.5}, Vec{0.5, 0.5, -0.5}};
constexpr std::array<Vec, 3> kHexagonal{Vec{1, 0, 0}, Vec{-0.5, kRoot3Half, 0}, Vec{0, 0, 1.632993161855452}};
constexpr std::array<Vec, 3> kTriclinic{Vec{1, 0, 0}, Vec{0.25, 1, 0}, Vec{-0.125, 0.25, 1.125}};

}  // namespace

const std::vector<Crystal>& crystals() {
  const Vec middle{0.5, 0.5, 0.5}, quarter{0.25, 0.25, 0.25};
  static const std::vector<Crystal> all{
      {"square", crystal(2, kSquare, {ball({}, 0.1)})},
      {"rectangular", crystal(2, {Vec{1, 0}, Vec{0, 1.5}, Vec{}}, {ball({}, 0.4)})},
      {"oblique", crystal(2, {Vec{1, 0}, Vec{0.25, 1.25}, Vec{}}, {ball({}, 0.4)})},
      {"triangular", crystal(2, kTriangular, {ball({}, 0.45)})},
      {"hexagonal", crystal(2, {Vec{1, 0}, Vec{-0.5, kRoot3Half}, Vec{}}, {ball({}, 0.4)})},
      {"honeycomb", crystal(2, kTriangular, {ball({}, 0.23), ball({0.5, 0.28867513459481287}, 0.23)})},
      {"kagome",
       crystal(2, kTriangular, {ball({}, 0.2), ball({0.5, 0}, 0.2), ball({0.25, 0.4330127018922193}, 0.2)})},
      {"cubic", crystal(3, kCubic, {ball({}, 0.1)})},
      {"bcc", crystal(3, kBcc, {ball({}, 0.35)})},
      {"fcc", crystal(3, kFcc, {ball({}, 0.28)})},
      {"hcp", crystal(3, kHexagonal,
                      {ball({0, 0.5773502691896257, 0.408248290463863}, 0.4),
                       ball({0.5, 0.28867513459481287, 1.224744871391589}, 0.4)})},
      {"diamond", crystal(3, kFcc, {ball({}, 0.17), ball(quarter, 0.17)})},
      {"rock-salt", crystal(3, kFcc, {ball({}, 0.28), ball(middle, 0.14)})},
      {"cesium-chloride", crystal(3, kCubic, {ball({}, 0.4), ball(middle, 0.3)})},
      {"perovskite", crystal(3, kCubic,
                             {ball(middle, 0.35), ball({}, 0.15), ball({0.5, 0, 0}, 0.25),
                              ball({0, 0.5, 0}, 0.25), ball({0, 0, 0.5}, 0.25)})},
      {"triclinic", crystal(3, kTriclinic, {ball({}, 0.4)})},
  };
  return all;
}

const Crystal& drawn_crystal(Random& random, int dimension) {
  std::vector<const Crystal*> some;
  for (const Crystal& crystal : crystals())
    if (crystal.scene.dimension == dimension) some.push_back(&crystal);
  return *some[random.below(some.size())];
}

Scene lattice_scene(int dimension, const std::array<Vec, 3>& vectors, double radius) {
  Scene scene = unit_scene(dimension, radius);
  scene.lattices[0].vectors = vectors;
  return scene;
}

void set_radius(Scene& scene, double radius) {
  for_each_atom(scene, [&](Atom& atom) {
    if (atom.is_ball()) atom.radius = radius;
  });
}

void scale_obstacles(Scene& scene, double factor) {
  for_each_atom(scene, [&](Atom& atom) {
    atom.radius *= factor;
    for (Vec& axis : atom.semiaxes) axis = scaled(axis, factor);
  });
}

void scale_places(Scene& scene, double factor) {
  for (Lattice& lattice : scene.lattices) {
    for (Vec& u : lattice.vectors) u = scaled(u, factor);
    for (Atom& atom : lattice.atoms) atom.position = scaled(atom.position, factor);
  }
}

Vec image(const std::vector<Vec>& semiaxes, const Vec& y) {
  Vec result{};
  for (std::size_t i = 0; i < semiaxes.size(); ++i) result = plus(result, y[i], semiaxes[i]);
  return result;
}

Vec drawn_across(Random& random, const Vec& v, int dimension) {
  const Vec n = dimension == 2 ? Vec{-v[1] * random.sign(), v[0], 0} : cross(v, random.direction(3));
  const double size = length(n);
  return size > 0 ? scaled(n, 1 / size) : Vec{0, 1, 0};
}

std::array<Vec, 3> drawn_frame(Random& random, const Vec& a, int dimension) {
  if (dimension == 2) return {a, Vec{-a[1], a[0], 0}, Vec{0, 0, 1}};
  Vec b = cross(a, random.direction(3));
  if (b == Vec{}) b = cross(a, a[0] == 0 ? Vec{1, 0, 0} : Vec{0, 1, 0});
  b = scaled(b, 1 / length(b));
  return {a, b, cross(a, b)};
}

Symmetry::Symmetry(Random& random, int dimension) {
  for (int i = dimension - 1; i > 0; --i)
    std::swap(from_[i], from_[random.below(static_cast<std::uint64_t>(i) + 1)]);
  for (int i = 0; i < dimension; ++i) sign_[i] = random.one_in(2) ? 1 : -1;
}

Vec Symmetry::operator()(const Vec& a) const {
  Vec image{};
  for (int i = 0; i < 3; ++i) image[i] = a[from_[i]] == 0 ? 0.0 : sign_[i] * a[from_[i]];
  return image;
}

Query Symmetry::operator()(const Query& query) const {
  Query image{(*this)(query.x), (*this)(query.v), query.from};
  if (!query.from) return image;
  for (int i = 0; i < 3; ++i) image.from->cell[i] = Integer(sign_[i] * query.from->cell[from_[i]].int64());
  return image;
}

}  // namespace lorentz::cases
