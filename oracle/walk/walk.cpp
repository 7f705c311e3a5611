// How it walks. In coordinates y of one atom's lattice (n counts from the atom) the plane is cut into unit
// cells around the integer points. The ray passes from cell to cell. A point of the ray on an obstacle's
// surface has |n_i - y_i| <= r |row i of M^-1| =: R_i for that obstacle, and lies within 1/2 of its cell's n.
// So an obstacle that is entered in a cell has its n within K_i = floor(R_i + 1/2) of the cell's n. All of
// these obstacles are tested, each exactly. The walk ends in the cell that the ray leaves after the earliest
// entry found.
//
// A lattice of fewer vectors is completed by vectors perpendicular to its own, so long that x and all its
// obstacles are within half of each. So a ray that leaves a cell across such a vector meets no more
// obstacles.
#include <lorentz/walk.hpp>

#include <CGAL/MP_Float.h>
#include <CGAL/Quotient.h>
#include <CGAL/Root_of_traits.h>
#include <CGAL/config.h>
#include <CGAL/number_utils.h>

#include <bit>
#include <cmath>
#include <limits>
#include <optional>
#include <tuple>
#include <vector>

#include <lorentz/errors.hpp>
#include <lorentz/pimpl.hpp>

namespace lorentz::oracle {
namespace {

using Real = CGAL::MP_Float;  // exact sums and products of binary64 values
using Ratio = CGAL::Quotient<Real>;
using Root = CGAL::Root_of_traits<Real>::Root_of_2;  // a + b sqrt(c), compared exactly
using RealVec = std::array<Real, 3>;
using Index = std::array<std::int64_t, 3>;

constexpr int kMaxReach = 100;
constexpr double kMaxStart = 0x1p50;

RealVec exact(const Vec& a) {
  return {Real(a[0]), Real(a[1]), Real(a[2])};
}

Real inner(const RealVec& a, const RealVec& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

RealVec outer(const RealVec& a, const RealVec& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Cell to_cell(const Index& n) {
  return {Integer(n[0]), Integer(n[1]), Integer(n[2])};
}

struct Hit {
  Root time;
  int lattice, atom;
  Index n;
};

enum class WalkEnd { done, gave_up };

// One atom's lattice seen by the ray.
class AtomWalk {
 public:
  AtomWalk(const Scene& scene, int lattice, int atom, const Query& query)
      : dimension_(scene.dimension), lattice_(lattice), atom_(atom) {
    rank_ = scene.lattices[lattice].rank_in(dimension_);
    for (int i = 0; i < 3; ++i) u_[i] = exact(scene.lattices[lattice].vectors[i]);
    if (dimension_ == 2) u_[2] = {Real(0), Real(0), Real(1)};
    const Atom& obstacle = scene.lattices[lattice].atoms[atom];
    Real r(obstacle.radius);
    v_ = exact(query.v);
    for (int k = 0; k < 3; ++k) start_[k] = Real(obstacle.position[k]) - Real(query.x[k]);
    if (!obstacle.is_ball()) r = make_balls(obstacle.semiaxes);
    r2_ = r * r;
    v2_ = inner(v_, v_);
    complete(r);
    if (query.from && query.from->lattice == lattice && query.from->atom == atom) from_ = query.from->cell;
    // y_i(t) = (Y_i + t W_i) / det.
    RealVec row[3] = {outer(u_[1], u_[2]), outer(u_[2], u_[0]), outer(u_[0], u_[1])};
    det_ = inner(row[0], u_[0]);
    const bool flipped = det_ < Real(0);
    if (flipped) det_ = -det_;
    for (int i = 0; i < dimension_; ++i) {
      if (flipped)
        for (Real& component : row[i]) component = -component;
      Y_[i] = -inner(row[i], start_);
      W_[i] = inner(row[i], v_);
      reach_[i] = reach_of(row[i]);
      home_[i] = nearest(Y_[i]);
    }
  }

  // False if the start is too far out, or an obstacle reaches too far, for a walk.
  bool can_walk() const {
    for (int i = 0; i < dimension_; ++i)
      if (reach_[i] > kMaxReach || std::fabs(CGAL::to_double(Ratio(Y_[i], det_))) > kMaxStart) return false;
    return true;
  }

  // The smallest n whose obstacle contains x.
  std::optional<Index> inside() const {
    std::optional<Index> found;
    around(home_, -1, 0, [&](const Index& n) {
      const RealVec c = centre(n);
      if (!found && inner(c, c) < r2_ && !is_from(n)) found = n;
    });
    return found;
  }

  // Obstacles that are entered at `limit` or later, if it is given, may be ignored.
  WalkEnd walk(std::int64_t max_cells, const std::optional<Ratio>& limit, std::optional<Hit>& best) const {
    Index n = home_;
    around(n, -1, 0, [&](const Index& m) { test(m, best); });
    Index first_crossing{};
    int first_axis = -1, returns = 0;
    for (std::int64_t step = 0; step < max_cells; ++step) {
      const int axis = next_axis(n);
      const int sign = W_[axis] > Real(0) ? 1 : -1;
      const Ratio end = leaving(n, axis);
      if (limit && end >= *limit) return WalkEnd::done;
      if (best && CGAL::compare(Root(end), best->time) != CGAL::SMALLER) return WalkEnd::done;
      if (axis >= rank_) return WalkEnd::done;
      n[axis] += sign;
      around(n, axis, sign, [&](const Index& m) { test(m, best); });
      // The ray has come back to the same place relative to the lattice for the second time, so it meets
      // nothing new. (The first time is not enough: `from` may have hidden a hit once.)
      if (first_axis < 0) {
        first_axis = axis;
        first_crossing = n;
      } else if (axis == first_axis && is_along_flight(n, first_crossing)) {
        first_crossing = n;
        if (++returns == 2 && !best) return WalkEnd::done;
      }
    }
    return WalkEnd::gave_up;
  }

 private:
  // Maps space so that the ellipsoids { A y : |y| < 1 } become balls, by det(A) A^-1, whose rows are the
  // cross products of two columns of A. The radius of the balls is det(A). Points that coincide on the line
  // and the lattice still do, so n and t are the same.
  Real make_balls(const std::vector<Vec>& semiaxes) {
    RealVec a[3] = {exact(semiaxes[0]), exact(semiaxes[1]), {Real(0), Real(0), Real(1)}};
    if (dimension_ == 3) a[2] = exact(semiaxes[2]);
    const RealVec row[3] = {outer(a[1], a[2]), outer(a[2], a[0]), outer(a[0], a[1])};
    for (RealVec* place : {&u_[0], &u_[1], &u_[2], &v_, &start_})
      *place = {inner(row[0], *place), inner(row[1], *place), inner(row[2], *place)};
    return inner(row[0], a[0]);
  }

  // floor(R + 1/2), R = r |row| / det: the smallest K with (K + 1/2) det > r |row|.
  int reach_of(const RealVec& row) const {
    const Real size2 = r2_ * inner(row, row);
    int k = 0;
    for (; k <= kMaxReach; ++k) {
      const Real margin = Real(k + 0.5) * det_;
      if (margin * margin > size2) break;
    }
    return k;
  }

  // An integer n with |n - y / det| <= 1/2.
  std::int64_t nearest(const Real& y) const {
    const double guess = CGAL::to_double(Ratio(y, det_));
    if (!(std::fabs(guess) <= kMaxStart)) return 0;  // can_walk returns false
    auto n = static_cast<std::int64_t>(std::floor(guess + 0.5));
    const Real two(2);
    while (two * (y - Real(static_cast<double>(n)) * det_) > det_) ++n;
    while (two * (y - Real(static_cast<double>(n)) * det_) < -det_) --n;
    return n;
  }

  RealVec centre(const Index& n) const {
    RealVec c = start_;
    for (int i = 0; i < dimension_; ++i)
      for (int k = 0; k < 3; ++k) c[k] += Real(static_cast<double>(n[i])) * u_[i][k];
    return c;
  }

  // Visits the indices within reach of cell n in lexicographic order. If an axis is given, visits only those
  // that came within reach by the step onto n.
  template <class Visit>
  void around(const Index& n, int axis, int sign, Visit visit) const {
    Index low{}, high{};
    for (int i = 0; i < dimension_; ++i) {
      low[i] = n[i] - reach_[i];
      high[i] = n[i] + reach_[i];
    }
    if (axis >= 0) low[axis] = high[axis] = n[axis] + sign * reach_[axis];
    Index m;
    for (m[0] = low[0]; m[0] <= high[0]; ++m[0])
      for (m[1] = low[1]; m[1] <= high[1]; ++m[1])
        for (m[2] = low[2]; m[2] <= high[2]; ++m[2]) visit(m);
  }

  bool is_from(const Index& n) const { return from_ && *from_ == to_cell(n); }

  void test(const Index& n, std::optional<Hit>& best) const {
    const RealVec c = centre(n);
    const Real s = inner(v_, c);
    if (s <= Real(0)) return;
    const Real c2 = inner(c, c);
    if (c2 < r2_ || is_from(n)) return;
    const Real discriminant = s * s - v2_ * (c2 - r2_);
    if (discriminant <= Real(0)) return;
    // The smaller root of v^2 t^2 - 2 s t + (c^2 - r^2) = 0.
    const Root time = CGAL::make_root_of_2(v2_, Real(-2) * s, c2 - r2_, true);
    if (best) {
      const auto order = CGAL::compare(time, best->time);
      const auto key = std::tie(lattice_, atom_, n);
      const auto best_key = std::tie(best->lattice, best->atom, best->n);
      if (order == CGAL::LARGER || (order == CGAL::EQUAL && key >= best_key)) return;
    }
    best = Hit{time, lattice_, atom_, n};
  }

  // The time at which the ray leaves cell n across `axis`.
  Ratio leaving(const Index& n, int axis) const {
    const double face = static_cast<double>(n[axis]) + (W_[axis] > Real(0) ? 0.5 : -0.5);
    return Ratio(Real(face) * det_ - Y_[axis], W_[axis]);
  }

  int next_axis(const Index& n) const {
    int axis = -1;
    Ratio earliest;
    for (int i = 0; i < dimension_; ++i) {
      if (W_[i] == Real(0)) continue;
      const Ratio time = leaving(n, i);
      if (axis < 0 || time < earliest) {
        axis = i;
        earliest = time;
      }
    }
    return axis;
  }

  bool is_along_flight(const Index& n, const Index& before) const {
    const auto moved = [&](int i) { return Real(static_cast<double>(n[i] - before[i])); };
    for (int i = 0; i < dimension_; ++i)
      for (int j = i + 1; j < dimension_; ++j)
        if (W_[i] * moved(j) != W_[j] * moved(i)) return false;
    return true;
  }

  // Finds the missing vectors.
  void complete(const Real& r) {
    if (rank_ == dimension_) return;
    const RealVec z{Real(0), Real(0), Real(1)};
    if (rank_ == 0) u_[0] = {Real(1), Real(0), Real(0)};
    if (rank_ <= 1) {
      u_[1] = outer(z, u_[0]);
      if (inner(u_[1], u_[1]) == Real(0)) u_[1] = {Real(1), Real(0), Real(0)};
    }
    if (rank_ <= 2 && dimension_ == 3) u_[2] = outer(u_[0], u_[1]);
    for (int i = rank_; i < dimension_; ++i)
      while (!is_long(u_[i], r))
        for (Real& component : u_[i]) component = component * Real(2);
  }

  // |u| > 4 (|s.u| / |u| + r), where s leads from x to the atom's position; tested by squares, with
  // |s.u| / |u| <= |s|.
  bool is_long(const RealVec& u, const Real& r) const {
    return inner(u, u) > Real(64) * (inner(start_, start_) + r * r);
  }

  int dimension_, lattice_, atom_, rank_ = 0;
  std::array<RealVec, 3> u_;
  RealVec v_, start_, Y_, W_;
  Real r2_, v2_, det_;
  std::array<int, 3> reach_{};
  Index home_{};
  std::optional<Cell> from_;
};

// The binary64 nearest to a time >= 0, ties to even, by bisection over the binary64 values.
double rounded(const Root& time) {
  const auto value = [](std::uint64_t bits) { return std::bit_cast<double>(bits); };
  const auto at_least = [&](std::uint64_t bits) {
    return CGAL::compare(time, Root(Real(value(bits)))) != CGAL::SMALLER;
  };
  const std::uint64_t infinity = std::bit_cast<std::uint64_t>(std::numeric_limits<double>::infinity());
  std::uint64_t low = 0, high = infinity;  // low <= time < high, where infinity stands for 2^1024
  const double guess = CGAL::to_double(time);
  if (guess > 0 && guess < 1e300) {
    const std::uint64_t bits = std::bit_cast<std::uint64_t>(guess);
    if (bits > 64 && at_least(bits - 64)) low = bits - 64;
    if (!at_least(bits + 64)) high = bits + 64;
  }
  while (high - low > 1) {
    const std::uint64_t middle = low + (high - low) / 2;
    (at_least(middle) ? low : high) = middle;
  }
  // 2^1024 is twice 2^1023, which binary64 can represent.
  const Real above = high == infinity ? Real(2) * Real(0x1p1023) : Real(value(high));
  const auto order = CGAL::compare(Root(Real(2)) * time, Root(Real(value(low)) + above));
  const bool up = order == CGAL::LARGER || (order == CGAL::EQUAL && low % 2 == 1);
  return value(up ? high : low);
}

std::array<Vec, 3> columns_of(const Atom& atom) {
  std::array<Vec, 3> columns{};
  std::copy(atom.semiaxes.begin(), atom.semiaxes.end(), columns.begin());
  return columns;
}

// Decides exactly whether the first `count` vectors are linearly dependent. (In the plane the third
// components are zero.)
bool are_dependent(const std::array<Vec, 3>& vectors, int count) {
  const auto nothing = [](const RealVec& a) { return inner(a, a) == Real(0); };
  if (count == 0) return false;
  const RealVec a = exact(vectors[0]), b = exact(vectors[1]);
  if (count == 1) return nothing(a);
  return count == 2 ? nothing(outer(a, b)) : inner(outer(a, b), exact(vectors[2])) == Real(0);
}

}  // namespace

Walk::Walk(Scene scene, std::int64_t max_cells) : scene_(std::move(scene)), max_cells_(max_cells) {
  checked(scene_);
  for (const Lattice& lattice : scene_.lattices) {
    bool dependent = are_dependent(lattice.vectors, lattice.rank_in(scene_.dimension));
    for (const Atom& atom : lattice.atoms)
      dependent |= !atom.is_ball() && are_dependent(columns_of(atom), scene_.dimension);
    if (dependent) throw InputError("scene: vectors of a lattice, or semiaxes, are linearly dependent");
  }
}

Answer Walk::first_hit(const Query& query, double max_time) const {
  if (scene_.lattices.empty()) throw_moved_from();
  if (auto flaw = flaw_of(query, scene_, max_time)) return Answer::error(*flaw);
  std::vector<AtomWalk> walks;
  for (int l = 0; l < static_cast<int>(scene_.lattices.size()); ++l)
    for (int a = 0; a < static_cast<int>(scene_.lattices[l].atoms.size()); ++a) {
      walks.emplace_back(scene_, l, a, query);
      if (!walks.back().can_walk()) return Answer::undecided();
      if (auto n = walks.back().inside()) return Answer::inside({l, a, to_cell(*n)});
    }
  std::optional<Ratio> limit;
  if (max_time < 0) return Answer::later();  // also minus infinity
  if (std::isfinite(max_time)) limit = Ratio(Real(max_time));
  std::optional<Hit> best;
  for (const AtomWalk& walk : walks)
    if (walk.walk(max_cells_, limit, best) == WalkEnd::gave_up) return Answer::undecided();
  if (limit && !(best && CGAL::compare(best->time, Root(*limit)) == CGAL::SMALLER)) return Answer::later();
  if (!best) return Answer::never();
  return Answer::hit({best->lattice, best->atom, to_cell(best->n)}, rounded(best->time));
}

std::string walk_libraries() {
  return std::string("CGAL ") + CGAL_VERSION_STR;
}

}  // namespace lorentz::oracle
