#include "tests/harness/decoder.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include <lorentz/geometry.hpp>
#include <lorentz/scene_check.hpp>

namespace lorentz::harness {
namespace {

// The volume of the first vectors, in plain binary64: it is only used to bound costs.
double volume(const std::array<Vec, 3>& a, int dimension) {
  if (dimension == 2) return std::fabs(a[0][0] * a[1][1] - a[0][1] * a[1][0]);
  return std::fabs(dot(a[0], cross(a[1], a[2])));
}

// Moves the size of a number into the range; the digits stay.
double folded(double a, int low, int high) {
  if (!std::isfinite(a))
    a = std::bit_cast<double>(std::bit_cast<std::uint64_t>(a) ^ (std::uint64_t{1} << 62));
  if (a == 0) return a;
  int exponent = 0;
  const double digits = std::frexp(a, &exponent);  // |digits| in [1/2, 1)
  if (exponent > low && exponent <= high) return a;
  const int sizes = high - low;
  return std::ldexp(digits, low + 1 + ((exponent % sizes) + sizes) % sizes);
}

double moved(double a, int ulps) {
  for (; ulps > 0; --ulps) a = std::nextafter(a, INFINITY);
  for (; ulps < 0; ++ulps) a = std::nextafter(a, -INFINITY);
  return a;
}

bool is_ordinary(const Atom& atom, double most, int dimension) {
  if (atom.is_ball()) return std::pow(2 * atom.radius, dimension) <= most;
  double box = 1;
  for (const Vec& axis : atom.semiaxes) box *= 2 * length(axis);
  return box <= most;
}

}  // namespace

bool is_ordinary(const Scene& scene) {
  if (flaw_of(scene) || oracle::dependence_in(scene)) return false;
  for (const Lattice& lattice : scene.lattices) {
    const double cell = volume(lattice.vectors, scene.dimension);
    if (!(cell >= 0x1p-6)) return false;
    for (const Vec& vector : lattice.vectors)
      if (!(length(vector) <= 0x1p5)) return false;
    for (const Atom& atom : lattice.atoms)
      if (!is_ordinary(atom, 8 * cell, scene.dimension)) return false;
  }
  return true;
}

double Decoder::raw() {
  std::uint64_t bits = 0;
  for (int i = 0; i < 64; i += 8) bits |= std::uint64_t{byte()} << i;
  return std::bit_cast<double>(bits);
}

double Decoder::number(int low, int high) {
  constexpr int kUsual = 200;  // beyond 2^200 flights of a thousand bits are right, but slow
  const unsigned kind = byte();
  const auto any_earlier = [&] { return earlier_.empty() ? 1.0 : earlier_[byte() % earlier_.size()]; };
  const auto small = [&] { return static_cast<std::int8_t>(byte()); };
  double a = 0;
  switch (kind % 4) {
    case 0:
      a = std::ldexp(small(), -static_cast<int>(kind / 4 % 8));
      break;
    case 1:
      a = raw();
      break;
    case 2:
      a = any_earlier();
      a = moved(kind & 4 ? -a : a, small());
      break;
    default:
      a = any_earlier();
      a *= std::ldexp(small(), -static_cast<int>(kind / 4 % 8));
  }
  const bool any_size = kind & 0x40;
  a = folded(a, any_size ? low : std::max(low, -kUsual), any_size ? high : std::min(high, kUsual));
  earlier_.push_back(a);
  return a;
}

Vec Decoder::vec(int dimension, int low, int high) {
  Vec a{};
  for (int i = 0; i < dimension; ++i) a[i] = number(low, high);
  return a;
}

Atom Decoder::atom(int dimension) {
  const bool ellipsoid = byte() % 4 == 3;
  Atom atom;
  atom.position = vec(dimension, -60, 4);
  if (ellipsoid)
    for (int i = 0; i < dimension; ++i) atom.semiaxes.push_back(vec(dimension, -20, 1));
  else
    atom.radius = std::fabs(number(-40, 1));
  return atom;
}

Lattice Decoder::lattice(int dimension) {
  const unsigned kind = byte();
  Lattice lattice = unit_scene(dimension, 0.25).lattices[0];
  if (kind & 1)
    for (int i = 0; i < dimension; ++i) lattice.vectors[i] = vec(dimension, -20, 4);
  if (!is_ordinary({dimension, {lattice}})) lattice = unit_scene(dimension, 0.25).lattices[0];
  // One ball at the origin, for which the engines have special code, or any atoms.
  const Lattice usual = lattice;
  if (kind & 2)
    lattice.atoms[0].radius = std::fabs(number(-40, 1));
  else
    lattice.atoms[0] = atom(dimension);
  for (unsigned more = kind / 4 % 4; !(kind & 2) && more > 0; --more)
    lattice.atoms.push_back(atom(dimension));
  for (Atom& atom : lattice.atoms) {
    Lattice alone = lattice;
    alone.atoms = {atom};
    if (!is_ordinary({dimension, {alone}})) atom = usual.atoms[0];
  }
  return lattice;
}

Scene Decoder::scene() {
  const unsigned kind = byte();
  Scene scene;
  scene.dimension = 2 + static_cast<int>(kind & 1);
  for (unsigned l = 0; l <= kind / 2 % 8 % 3; ++l) scene.lattices.push_back(lattice(scene.dimension));
  return scene;
}

Vec Decoder::velocity(const Scene& scene) {
  Vec v = vec(scene.dimension, -1074, 1023);
  if (v == Vec{}) v[0] = 1;
  return v;
}

Query Decoder::query(const Scene& scene) {
  Query query;
  query.x = vec(scene.dimension, -1074, 60);
  query.v = velocity(scene);
  if (!flag()) return query;
  ObstacleId from;
  from.lattice = static_cast<int>(byte() % scene.lattices.size());
  from.atom = static_cast<int>(byte() % scene.lattices[from.lattice].atoms.size());
  for (int i = 0; i < scene.dimension; ++i) from.cell[i] = static_cast<std::int8_t>(byte());
  query.from = from;
  return query;
}

}  // namespace lorentz::harness
