#include "src/engines/classical/cell_walk.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <lorentz/engine_base.hpp>
#include <lorentz/errors.hpp>
#include <lorentz/geometry.hpp>
#include "src/engines/base/double_double.hpp"

namespace lorentz {
namespace {

// In units of the cell. An entry at most kBehindWall behind the wall still counts: rounded once more in the
// next cell, it might lie before that cell's beginning. The lists reach farther than that (kListMargin), so
// every obstacle that is entered there is compared. Flatter cells than kFlattest are refused, so that
// rounding errors stay below these margins.
constexpr double kBehindWall = 1e-9, kListMargin = 1e-6, kFlattest = 1e6;
constexpr int kLargestExponent = 500;
constexpr double kSmallest = 0x1p-500;  // of an obstacle, in units of the longest component of the cell

// The obstacle's own coordinates, in which it is the unit ball: A^-1 a. Not used for balls.
using OwnCoordinates = std::array<Vec, 3>;

struct Obstacle {
  Vec centre;
  double radius;
  const OwnCoordinates* own;  // null for a ball
  int atom;
  CellIndex n;  // its cell, counted from the one it reaches into

  // The time at which the line enters it; nothing if the obstacle lies behind.
  std::optional<double> entry(const Vec& x, const Vec& v) const {
    const Vec arm = plus(x, -1, centre);
    if (!own) {
      if (dot(arm, v) >= 0) return std::nullopt;
      return entry_time(arm, v, radius);
    }
    const Vec place = coordinates(*own, arm), velocity = coordinates(*own, v);
    if (dot(place, velocity) >= 0) return std::nullopt;
    return entry_time(place, velocity, 1);
  }

  bool contains(const Vec& x) const {
    const Vec arm = plus(x, -1, centre), place = own ? coordinates(*own, arm) : arm;
    return dot(place, place) < (own ? 1 : radius * radius);
  }
};

// The obstacle that a query leaves, if it belongs to this lattice.
struct From {
  int atom = -1;
  CellIndex n{};

  From(const ObstacleId* from, int lattice) {
    if (!from || from->lattice != lattice) return;
    if (const auto cell = index_of(from->cell)) atom = from->atom, n = *cell;
  }

  bool is(const Obstacle& obstacle, const CellIndex& cell) const {
    if (obstacle.atom != atom) return false;
    for (int i = 0; i < 3; ++i)
      if (cell[i] + obstacle.n[i] != n[i]) return false;
    return true;
  }
};

// A place, relative to the lattice point of its cell.
struct CellPlace {
  Vec x;
  CellIndex n{};
};

struct Walked {
  enum class CellWalkEnd { entered, nothing, gave_up } end;
  double time = 0;  // of the entry, or of the end of the walk
  ObstacleId obstacle;
};

}  // namespace

// One lattice in its own scale, 2^-exponent: the largest component of its vectors lies in [1, 2).
struct CellWalk::CellLattice {
  int dimension = 0, index = 0, exponent = 0;
  std::array<Vec, 3> vectors{}, dual{};
  std::vector<OwnCoordinates> own_coordinates;
  std::vector<Obstacle> obstacles;  // that reach into the cell around the origin, in the order of (atom, n)

  CellLattice(const Scene& scene, int l);
  std::optional<std::string> beyond() const;

  // The obstacles of an atom that reach into the cell: for each axis the range of their cells.
  struct CellRange {
    CellIndex first{}, last{};
    double count = 1;
  };
  std::optional<std::string> range_of(const Atom& atom, CellRange& range) const;
  double scaled(double length) const { return std::scalbn(length, -exponent); }
  Vec scaled(const Vec& a) const { return {scaled(a[0]), scaled(a[1]), scaled(a[2])}; }
  std::array<Vec, 3> scaled_axes(const Atom& atom) const;

  void list(const std::vector<Atom>& atoms);
  Vec relative(const Vec& x, const Vec& n) const;
  std::optional<CellPlace> home_of(const Vec& x) const;
  const Obstacle* around(const CellPlace& place, const From& from) const;
  Walked walk(CellPlace place, const Vec& v, const From& from, double limit) const;
  ObstacleId id_of(const Obstacle& obstacle, const CellIndex& cell) const;
};

CellWalk::CellLattice::CellLattice(const Scene& scene, int l) : dimension(scene.dimension), index(l) {
  double largest = 0;
  for (int i = 0; i < dimension; ++i)
    largest = std::max(largest, largest_component(scene.lattices[l].vectors[i]));
  if (largest > 0) exponent = std::ilogb(largest);
  for (int i = 0; i < dimension; ++i) vectors[i] = scaled(scene.lattices[l].vectors[i]);
  dual = dual_of(vectors, dimension);
}

std::optional<std::string> CellWalk::CellLattice::beyond() const {
  constexpr const char* kTooFlat =
      "does not do cells as flat as this one, whose walls binary64 cannot tell apart";
  if (std::abs(exponent) > kLargestExponent) return "does lattice vectors between 2^-500 and 2^500 only";
  for (int i = 0; i < dimension; ++i) {
    double sum = 0;  // the size of the terms of a coordinate within the cell; not finite if dual[i] is not
    for (int k = 0; k < dimension; ++k)
      for (int j = 0; j < dimension; ++j) sum += std::fabs(dual[i][k] * vectors[j][k]);
    if (!(sum < kFlattest)) return kTooFlat;
  }
  return std::nullopt;
}

std::array<Vec, 3> CellWalk::CellLattice::scaled_axes(const Atom& atom) const {
  std::array<Vec, 3> axes = semiaxes_of(atom, dimension);
  for (Vec& axis : axes) axis = scaled(axis);
  return axes;
}

// The range of n in |y_i(position) + n_i| <= 1/2 + reach_i. The reach along dual_i is the obstacle's support
// |A^T dual_i|.
std::optional<std::string> CellWalk::CellLattice::range_of(const Atom& atom, CellRange& range) const {
  const std::array<Vec, 3> axes = scaled_axes(atom);
  const OwnCoordinates own = atom.is_ball() ? OwnCoordinates{} : dual_of(axes, dimension);
  const double radius = scaled(atom.radius);
  if (atom.is_ball() && radius < kSmallest) return "does not do radii as small as this, 2^-500 of the cell";
  for (int i = 0; i < dimension; ++i) {
    for (int k = 0; k < dimension; ++k)
      if (!(std::fabs(own[i][k]) < 1 / kSmallest)) return "does not do semiaxes as short or as flat as these";
    double support2 = 0;
    for (const Vec& axis : axes) support2 += dot(axis, dual[i]) * dot(axis, dual[i]);
    const double reach = std::sqrt(support2);
    const double y = dot(dual[i], scaled(atom.position)),
                 half = 0.5 + reach * (1 + kListMargin) + kListMargin;
    if (!(std::fabs(y) < kMaxStart)) return "does not do atoms that far from the origin";
    if (!(half < kMaxObstacles)) {  // also if it is not finite
      range.count = std::numeric_limits<double>::infinity();
      continue;
    }
    range.first[i] = static_cast<std::int64_t>(std::ceil(-half - y));
    range.last[i] = static_cast<std::int64_t>(std::floor(half - y));
    range.count *= static_cast<double>(range.last[i] - range.first[i] + 1);
  }
  return std::nullopt;
}

std::optional<std::string> CellWalk::beyond(const Scene& scene) {
  double count = 0;
  for (int l = 0; l < static_cast<int>(scene.lattices.size()); ++l) {
    const CellLattice lattice(scene, l);
    if (auto why = lattice.beyond()) return why;
    for (const Atom& atom : scene.lattices[l].atoms) {
      CellLattice::CellRange range;
      if (auto why = lattice.range_of(atom, range)) return why;
      count += range.count;
    }
  }
  if (!(count <= kMaxObstacles))
    return "does scenes in which at most a million obstacles reach into a cell only";
  return std::nullopt;
}

void CellWalk::CellLattice::list(const std::vector<Atom>& atoms) {
  own_coordinates.reserve(atoms.size());  // the obstacles point there
  for (int a = 0; a < static_cast<int>(atoms.size()); ++a) {
    CellRange range;
    range_of(atoms[a], range);
    const OwnCoordinates* own = nullptr;
    if (!atoms[a].is_ball()) own = &own_coordinates.emplace_back(dual_of(scaled_axes(atoms[a]), dimension));
    const Vec position = scaled(atoms[a].position);
    CellIndex n;
    for (n[0] = range.first[0]; n[0] <= range.last[0]; ++n[0])
      for (n[1] = range.first[1]; n[1] <= range.last[1]; ++n[1])
        for (n[2] = range.first[2]; n[2] <= range.last[2]; ++n[2]) {
          const Vec minus_n{-double(n[0]), -double(n[1]), -double(n[2])};
          obstacles.push_back({relative(position, minus_n), scaled(atoms[a].radius), own, a, n});
        }
  }
}

// x - n_1 u_1 - ... - n_d u_d, rounded once, so that a distant start loses none of its digits.
Vec CellWalk::CellLattice::relative(const Vec& x, const Vec& n) const {
  Vec rest{};
  for (int k = 0; k < dimension; ++k) {
    Wide sum(x[k]);
    for (int i = 0; i < dimension; ++i) sum = sum - Wide::product(n[i], vectors[i][k]);
    rest[k] = sum.hi;
  }
  return rest;
}

// The cell that contains x; its upper walls belong to the next cells. Nothing if it is too far from the
// origin.
std::optional<CellPlace> CellWalk::CellLattice::home_of(const Vec& x) const {
  Vec rest = x, n{};
  for (int pass = 0; pass < 3; ++pass) {  // far off, the first coordinates may be wrong by a few cells
    for (int i = 0; i < dimension; ++i) {
      n[i] += std::floor(dot(dual[i], rest) + 0.5);
      if (!(std::fabs(n[i]) < kMaxStart)) return std::nullopt;
    }
    rest = relative(x, n);
  }
  CellPlace place{rest};
  for (int i = 0; i < dimension; ++i) place.n[i] = static_cast<std::int64_t>(n[i]);
  return place;
}

// The first obstacle, in the order of (atom, n), that contains the place.
const Obstacle* CellWalk::CellLattice::around(const CellPlace& place, const From& from) const {
  for (const Obstacle& obstacle : obstacles)
    if (obstacle.contains(place.x) && !from.is(obstacle, place.n)) return &obstacle;
  return nullptr;
}

ObstacleId CellWalk::CellLattice::id_of(const Obstacle& obstacle, const CellIndex& cell) const {
  ObstacleId id;
  id.lattice = index;
  id.atom = obstacle.atom;
  for (int i = 0; i < dimension; ++i) id.cell[i] = Integer(cell[i] + obstacle.n[i]);
  return id;
}

Walked CellWalk::CellLattice::walk(CellPlace place, const Vec& v, const From& from, double limit) const {
  const Vec w = coordinates(dual, v);
  double elapsed = 0, fastest = 0;
  for (int i = 0; i < dimension; ++i) fastest = std::max(fastest, std::fabs(w[i]));
  const long most = std::min(kMaxCells, kMaxTests / static_cast<long>(obstacles.size() + 1));
  for (long cell = 0; cell < most; ++cell) {
    int axis = 0;
    double to_wall = std::numeric_limits<double>::infinity();
    for (int i = 0; i < dimension; ++i) {
      if (w[i] == 0) continue;
      const double time = (std::copysign(0.5, w[i]) - dot(dual[i], place.x)) / w[i];
      if (time < to_wall) to_wall = time, axis = i;
    }
    to_wall = std::max(to_wall, 0.0);  // rounding may have put the place behind the wall already
    const Obstacle* entered = nullptr;
    double first = to_wall + kBehindWall / fastest;
    for (const Obstacle& obstacle : obstacles) {
      const auto time = obstacle.entry(place.x, v);
      if (time && *time >= 0 && *time < first && !from.is(obstacle, place.n))
        first = *time, entered = &obstacle;
    }
    if (entered) return {Walked::CellWalkEnd::entered, elapsed + first, id_of(*entered, place.n)};
    const int step = w[axis] > 0 ? 1 : -1;
    for (int k = 0; k < dimension; ++k) place.x[k] = (place.x[k] + to_wall * v[k]) - step * vectors[axis][k];
    place.n[axis] += step;
    elapsed += to_wall;
    if (elapsed > limit) return {Walked::CellWalkEnd::nothing, elapsed, {}};
  }
  return {Walked::CellWalkEnd::gave_up, elapsed, {}};
}

CellWalk::CellWalk(const Scene& scene) : Engine(scene) {
  if (auto why = beyond(scene)) throw UnsupportedError("classical " + *why);
  for (int l = 0; l < static_cast<int>(scene.lattices.size()); ++l)
    lattices_.emplace_back(scene, l).list(scene.lattices[l].atoms);
}

CellWalk::~CellWalk() = default;

void CellWalk::first_hit_scaled(const Ray& ray, double max_time, Answer& answer) const {
  for (const CellLattice& lattice : lattices_) {
    const auto home = lattice.home_of(lattice.scaled(ray.x));
    if (!home) {
      answer = Answer::unsupported_because("start too far from the origin for binary64");
      return;
    }
    const Obstacle* obstacle = lattice.around(*home, From(ray.from, lattice.index));
    if (!obstacle) continue;
    answer = Answer::inside(lattice.id_of(*obstacle, home->n));
    return;
  }
  double best = max_time, given_up = std::numeric_limits<double>::infinity();
  answer = Answer::never();  // before max_time, that is
  for (const CellLattice& lattice : lattices_) {
    const CellPlace home = *lattice.home_of(lattice.scaled(ray.x));
    const double limit = lattice.scaled(best);
    Walked walked = lattice.walk(home, ray.v, From(ray.from, lattice.index), limit);
    const double time = std::scalbn(walked.time, lattice.exponent);
    if (walked.end == Walked::CellWalkEnd::gave_up) given_up = std::min(given_up, time);
    if (walked.end != Walked::CellWalkEnd::entered || !(time < best)) continue;
    best = time;
    answer = Answer::hit(std::move(walked.obstacle), time);
  }
  if (given_up < best) answer = Answer::undecided();  // an earlier hit may lie in between
}

}  // namespace lorentz
