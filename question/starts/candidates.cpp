#include "question/starts/candidates.hpp"

#include <algorithm>
#include <cmath>

#include <lorentz/errors.hpp>
#include <lorentz/geometry.hpp>
#include "src/problem/scene_geometry.hpp"

namespace lorentz::starts {

using cases::Random;

namespace {

// Whether all points in and around the box are finite, with room for geometry with several of them.
bool in_range(const Scene& scene, const cases::Box& box) {
  double largest = 0, size = 0;
  for (int i = 0; i < box.dimension; ++i)
    for (const double component : box.vectors[i]) size += box.cells[i] * std::fabs(component);
  for (const double component : box.corner) size += std::fabs(component);
  for_each_atom(scene, [&](const Atom& atom) {
    largest = std::max(largest, largest_component(atom.position));
    for (const Vec& axis : semiaxes_of(atom, scene.dimension))
      largest = std::max(largest, largest_component(axis));
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
    surfaces = shares->surfaces;
  }
  return surfaces;
}

}  // namespace

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
  if (surface) return surface_start(random);
  Start start{};
  start.x = box_.point(random);
  start.v = direction(random, box_.dimension);
  return start;
}

void Candidates::draw(std::uint64_t index, std::uint64_t attempt, Query& query) const {
  const Start drawn = start(index, attempt);
  query.x = drawn.x, query.v = drawn.v;
  query.from.reset();
  if (ensemble_ == Ensemble::surface)
    query.from = ObstacleId{drawn.lattice, drawn.atom, {drawn.cell[0], drawn.cell[1], drawn.cell[2]}};
}

void Candidates::draw(std::span<const std::uint64_t> indices, std::uint64_t attempt, QueryRows& rows) const {
  const bool surface = ensemble_ == Ensemble::surface;
  rows.resize(indices.size(), box_.dimension, surface);
  for (std::size_t i = surface ? 0 : draw_in_lanes(indices, attempt, rows); i < indices.size(); ++i) {
    const Start drawn = start(indices[i], attempt);
    for (int k = 0; k < box_.dimension; ++k) rows.x[k][i] = drawn.x[k], rows.v[k][i] = drawn.v[k];
    if (!surface) continue;
    rows.from_lattice[i] = drawn.lattice, rows.from_atom[i] = drawn.atom;
    for (int k = 0; k < box_.dimension; ++k) rows.from_cell[k][i] = drawn.cell[k];
  }
}

}  // namespace lorentz::starts
