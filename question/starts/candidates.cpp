#include "question/starts/candidates.hpp"

#include <algorithm>
#include <cmath>

#include <lorentz/errors.hpp>
#include <lorentz/geometry.hpp>
#include "question/starts/direction.hpp"
#include "src/problem/scene_geometry.hpp"

namespace lorentz::starts {

using cases::Random;
using cases::Series;

namespace {

constexpr Series kUniform("uniform starts"), kSurface("surface starts");

// Whether all points in and around the box are finite, with room for geometry with several of them.
bool in_range(const Scene& scene, const cases::Box& box) {
  double largest = 0, size = 0;
  for (int i = 0; i < box.dimension; ++i)
    for (const double component : box.vectors[i]) size += box.cells[i] * std::fabs(component);
  for (const double component : box.corner) size += std::fabs(component);
  for_each_atom(scene, [&](const Atom& atom) {
    for (const double component : atom.position) largest = std::max(largest, std::fabs(component));
    largest = std::max(largest, atom.radius);
    for (const Vec& axis : atom.semiaxes)
      for (const double component : axis) largest = std::max(largest, std::fabs(component));
  });
  return size + largest < 0x1p1000;
}

// The relative surface of each atom, lattice by lattice: per volume, or per period of each lattice if the
// lattices repeat in fewer directions. Empty if the values are beyond the range of binary64.
std::vector<double> surfaces_of(const Scene& scene) {
  std::vector<double> surfaces;
  if (!is_crystal(scene)) {
    for_each_atom(scene, [&](const Atom& atom) { surfaces.push_back(surface_of(atom, scene.dimension)); });
  } else if (const auto shares = shares_of(scene)) {
    for (const AtomShares::AtomShare& share : shares->atoms) surfaces.push_back(share.surface);
  }
  return surfaces;
}

}  // namespace

void StartColumns::resize(std::size_t count, int dimension, bool with_from) {
  const std::size_t from_count = with_from ? count : 0;
  for (int i = 0; i < 3; ++i) {
    const bool used = i < dimension;
    x[i].resize(used ? count : 0);
    v[i].resize(used ? count : 0);
    from_cell[i].resize(used ? from_count : 0);
  }
  from_lattice.resize(from_count);
  from_atom.resize(from_count);
}

QueryColumns StartColumns::view() const {
  QueryColumns columns;
  for (int i = 0; i < 3; ++i) columns.x[i] = x[i], columns.v[i] = v[i];
  if (from_lattice.empty()) return columns;
  columns.from_lattice = from_lattice, columns.from_atom = from_atom;
  for (int i = 0; i < 3; ++i) columns.from_cell[i] = from_cell[i];
  return columns;
}

std::string nowhere_to_start(std::uint64_t draws) {
  return "no free start in " + std::to_string(draws) +
         " draws: the obstacles leave no free part of the cell, or nearly none; take smaller ones";
}

Candidates::Candidates(const Scene& scene, Ensemble ensemble, std::uint64_t seed, std::uint64_t cells)
    : ensemble_(ensemble),
      seed_(seed),
      in_many_cells_(scene.lattices.size() > 1 && is_crystal(scene)),
      box_(cases::Box::of(scene, cells)) {
  if (!in_range(scene, box_))
    throw InputError(
        "the scene's numbers are too large for starts to be drawn; choose a larger unit of length");
  if (ensemble == Ensemble::surface) choose_by_surface(scene);
}

// One random word chooses the obstacle. Each obstacle gets its share of the words, in steps of 2^-40 of the
// largest share, because the last bits of elliptic integrals differ between machines.
void Candidates::choose_by_surface(const Scene& scene) {
  const std::vector<double> surfaces = surfaces_of(scene);
  double largest = 0, sum = 0, before = 0;
  for (const double surface : surfaces) largest = std::max(largest, surface);
  if (!std::isnormal(largest))
    throw InputError(
        "the obstacles are too large, too small or too slender for their surface to be known in binary64; no "
        "start on it can be drawn");
  const auto steps = [largest](double surface) { return std::round(surface / largest * 0x1p40); };
  for (const double surface : surfaces) sum += steps(surface);
  std::size_t number = 0;
  for (std::size_t l = 0; l < scene.lattices.size(); ++l) {
    const Lattice& lattice = scene.lattices[l];
    if (in_many_cells_) count_cells(lattice);
    for (std::size_t a = 0; a < lattice.atoms.size(); ++a) {
      before += steps(surfaces[number++]);
      const auto below = static_cast<std::uint64_t>(before / sum * 0x1p53);
      obstacles_.push_back({static_cast<std::int32_t>(l), static_cast<std::int32_t>(a),
                            lattice.atoms[a].position, Surface(lattice.atoms[a], scene.dimension), below});
    }
  }
}

void Candidates::count_cells(const Lattice& lattice) {
  const Cells cells{lattice.vectors, dual_of(lattice.vectors, box_.dimension)};
  double farthest = 0;
  for (int i = 0; i < box_.dimension; ++i)
    for (int k = 0; k < box_.dimension; ++k)
      farthest += box_.cells[i] * std::fabs(dot(cells.dual[k], box_.vectors[i]));
  if (!(farthest < 0x1p53))
    throw InputError("one lattice has cells so small that the box of another has too many of them to count");
  lattices_.push_back(cells);
}

const Candidates::Obstacle& Candidates::chosen_obstacle(Random& random) const {
  if (obstacles_.size() == 1) return obstacles_[0];
  return *std::upper_bound(
      obstacles_.begin(), obstacles_.end(), random.bits() >> 11,
      [](std::uint64_t bits, const Obstacle& obstacle) { return bits < obstacle.below; });
}

Candidates::Start Candidates::uniform_start(Random& random) const {
  Start start{};
  start.lattice = -1;
  start.x = box_.point(random);
  start.v = direction(random, box_.dimension);
  return start;
}

// In a superposition, the obstacle's cell is the cell that contains a drawn point of the box, so that all
// cells are equally likely.
Candidates::Start Candidates::surface_start(Random& random) const {
  const Obstacle& obstacle = chosen_obstacle(random);
  Start start{};
  start.lattice = obstacle.lattice, start.atom = obstacle.atom;
  start.x = obstacle.position;
  if (in_many_cells_) {
    const Cells& cells = lattices_[static_cast<std::size_t>(obstacle.lattice)];
    const Vec inside = coordinates(cells.dual, box_.point(random));
    for (int i = 0; i < box_.dimension; ++i) {
      const double n = std::floor(inside[i]);
      start.cell[i] = static_cast<std::int64_t>(n);
      start.x = sum(start.x, scaled(cells.vectors[i], n));
    }
  }
  const SurfacePoint point = obstacle.surface.point(random);
  start.x = sum(start.x, point.offset);
  start.v = cosine_law(random, point.normal, box_.dimension);
  return start;
}

Candidates::Start Candidates::start(std::uint64_t index, std::uint64_t attempt) const {
  const bool surface = ensemble_ == Ensemble::surface;
  Random random(seed_, surface ? kSurface : kUniform, index, cases::Use::cases, attempt);
  return surface ? surface_start(random) : uniform_start(random);
}

void Candidates::draw(std::uint64_t index, std::uint64_t attempt, Query& query) const {
  const Start drawn = start(index, attempt);
  query.x = drawn.x, query.v = drawn.v;
  const ObstacleId from{drawn.lattice, drawn.atom, {drawn.cell[0], drawn.cell[1], drawn.cell[2]}};
  query.from = drawn.lattice < 0 ? std::nullopt : std::optional(from);
}

void Candidates::draw(std::uint64_t index, std::uint64_t attempt, StartColumns& starts,
                      std::size_t place) const {
  const Start drawn = start(index, attempt);
  for (int i = 0; i < box_.dimension; ++i) {
    starts.x[i][place] = drawn.x[i];
    starts.v[i][place] = drawn.v[i];
  }
  if (ensemble_ != Ensemble::surface) return;
  starts.from_lattice[place] = drawn.lattice;
  starts.from_atom[place] = drawn.atom;
  for (int i = 0; i < box_.dimension; ++i) starts.from_cell[i][place] = drawn.cell[i];
}

void Candidates::draw(std::uint64_t first, std::size_t count, StartColumns& starts) const {
  starts.resize(count, box_.dimension, ensemble_ == Ensemble::surface);
  for (std::size_t i = 0; i < count; ++i) draw(first + i, 0, starts, i);
}

}  // namespace lorentz::starts
