// Let u be the period of the row, u' the same vector turned by a right angle, v = t u + u' a direction, and
// N = u - t u' its normal. The shadow along v is a union of intervals about N.p of half-width |A^T N|, with
// the period N.u = u^2. A gap between obstacles a and b has the width f(t) = N.(b - a) - |A^T N| - |B^T N|,
// which is concave. So a gap that has the same obstacles below and the same above at s and at t is open at
// all values between s and t.
//
// A gap opens or shuts where some f is 0, which is at a root of the polynomial
// (l^2 - q_a - q_b)^2 - 4 q_a q_b, with l = N.(b - a), q_a = |A^T N|^2, q_b = |B^T N|^2. Between two
// neighbouring roots no gap opens or shuts. At a root, the open gaps are those that are open on both sides of
// it.
#include "oracle/horizon/closed_directions.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>

#include <lorentz/errors.hpp>
#include "oracle/exact/exact_problem.hpp"
#include "oracle/exact/root_sums.hpp"
#include "oracle/exact/shape.hpp"
#include "oracle/horizon/circle_gaps.hpp"
#include "oracle/horizon/real_roots.hpp"

namespace lorentz::oracle {
namespace {

constexpr std::size_t kMostPairs = 20'000;

InputError too_many() {
  return InputError("horizon: unsupported for rows with more than " + std::to_string(kMostPairs) +
                    " pairs of obstacles that might shut a gap");
}

struct RowMember {
  ObstacleId id;
  Z turn;                // the number of cells of its own row in a period
  Polynomial centre, q;  // as polynomials of t: N.p, |A^T N|^2
};

// One period of all rows.
struct RowPeriod {
  ZVec<2> along, across;  // u, u'
  Z period;               // N.u = u^2
  std::vector<RowMember> members;

  void add(const ObstacleId& id, const Z& turn, const IntegerScene<2>::Atom& atom, const ZVec<2>& shift) {
    const auto seen = [&](const ZVec<2>& a) { return Polynomial{dot(a, along), -dot(a, across)}; };
    Polynomial q;
    for (const ZVec<2>& axis : axes_of<2>(atom)) q = q + seen(axis) * seen(axis);
    members.push_back({id, turn, seen(atom.position + shift), q});
  }
};

// Single obstacles are left out: they cannot fill the infinitely many gaps of a row.
RowPeriod row_of(const IntegerScene<2>& scene) {
  Z common = 1, count = 0;
  const ZVec<2>* first = nullptr;
  const auto each = [&](const auto& visit) {
    for (std::size_t l = 0; l < scene.lattices.size(); ++l)
      if (const auto& lattice = scene.lattices[l]; lattice.rank == 1)
        visit(static_cast<int>(l), lattice.vectors[0], gcd(lattice.vectors[0][0], lattice.vectors[0][1]),
              lattice.atoms);
  };
  each([&](int, const ZVec<2>& vector, const Z& steps, const auto&) {
    if (!first) first = &vector;
    if (cross(vector, *first) != 0)
      throw InputError(
          "horizon: unsupported for rows in different directions: in nearly all directions their shadows "
          "have no common period");
    common = lcm(common, steps);
  });
  each([&](int, const ZVec<2>&, const Z& steps, const auto& atoms) {
    count += common / steps * atoms.size();
  });
  if (count * count > kMostPairs) throw too_many();
  RowPeriod row;
  row.along = common * primitive(*first);
  row.across = {-row.along[1], row.along[0]};
  row.period = dot(row.along, row.along);
  each([&](int l, const ZVec<2>& vector, const Z& steps, const auto& atoms) {
    const Z cells = common / steps, turn = cells * sgn(dot(vector, *first));
    for (std::size_t a = 0; a < atoms.size(); ++a)
      for (long n = 0; n < cells; ++n)
        row.add({l, static_cast<int>(a), {Integer(n)}}, turn, atoms[a], n * vector);
  });
  return row;
}

// Identifies a gap: for each member the number of its last translate below the gap, minus the number for the
// first member.
using GapKey = std::vector<Z>;

// The gaps at t = a / 2^bits.
std::set<GapKey> gaps_at(const RowPeriod& row, const Z& a, long bits) {
  const Z period = value_at({row.period}, 1, a, bits);
  std::vector<Blocked> blocks;
  for (const RowMember& member : row.members) {
    const Z centre = value_at(member.centre, 1, a, bits), half2 = value_at(member.q, 2, a, bits);
    blocks.push_back({centre, half2, centre, half2});
  }
  std::set<GapKey> keys;
  for (const Gap& gap : gaps_between(blocks, period)) {
    GapKey key;
    for (const Blocked& block : blocks)
      key.push_back(last_step(gap.high - block.end, gap.high2, block.end2, 0, period, false));
    for (std::size_t i = key.size(); i-- > 0;) key[i] -= key[0];
    keys.insert(key);
  }
  return keys;
}

// At all t outside [low, high] / 2^kFractionBits some obstacle and its own translates leave no gap:
//   4 q >= period^2.
struct OpenRange {
  static constexpr unsigned long kFractionBits = 16;
  Z low, high;
  bool empty = false;

  explicit OpenRange(const RowPeriod& row) {
    for (bool first = true; const RowMember& member : row.members) {
      const Polynomial& q = member.q;
      const Z square = q[1] * q[1] - q[2] * (4 * q[0] - row.period * row.period);
      if (square <= 0) {
        empty = true;
        return;
      }
      const auto end = [&](int sign) {
        return floor_surd(-shifted_left(q[1], kFractionBits), sign, shifted_left(square, 2 * kFractionBits),
                          2 * q[2]);
      };
      low = first ? end(-1) : std::max(low, end(-1));
      high = first ? end(1) + 1 : std::min(high, Z(end(1) + 1));
      first = false;
    }
    empty = low > high;
  }
};

// A t at which the lines along v that touch member i also touch member j, n periods further.
struct Touch {
  RealRoot at;
  std::size_t i, j;
  Z n;
};

// Calls visit(i, j, n, l) for all pairs whose centres come within a period of each other at some t in the
// range.
template <class Visit>
void visit_pairs(const RowPeriod& row, const OpenRange& range, const Visit& visit) {
  for (std::size_t i = 0; i < row.members.size(); ++i) {
    visit(i, i, Z(1), Polynomial{row.period});
    for (std::size_t j = i + 1; j < row.members.size(); ++j) {
      Polynomial l = row.members[j].centre - row.members[i].centre;
      const Z scale = shifted_left(row.period, OpenRange::kFractionBits), low = l[1] * range.low,
              high = l[1] * range.high, start = shifted_left(l[0], OpenRange::kFractionBits);
      const Z last = ceil_div(-start - std::min(low, high), scale) + 1;
      Z n = floor_div(-start - std::max(low, high), scale) - 1;
      for (l = l + Polynomial{n * row.period}; n <= last; ++n, l = l + Polynomial{row.period})
        visit(i, j, n, l);
    }
  }
}

// All touches in ascending order; touches at the same t form one group.
std::vector<std::vector<Touch>> touches_of(const RowPeriod& row) {
  const OpenRange range(row);
  std::vector<Touch> touches;
  if (range.empty) return {};
  std::size_t pairs = 0;
  visit_pairs(row, range, [&](auto&&...) {
    if (++pairs > kMostPairs) throw too_many();
  });
  visit_pairs(row, range, [&](std::size_t i, std::size_t j, const Z& n, const Polynomial& l) {
    const Polynomial &a = row.members[i].q, &b = row.members[j].q;
    const Polynomial rest = l * l - a - b;
    for (RealRoot& root : real_roots(rest * rest - Polynomial{4} * a * b))
      touches.push_back({std::move(root), i, j, n});
  });
  std::vector<std::size_t> order(touches.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return a != b && compare(touches[a].at, touches[b].at) < 0;
  });
  std::vector<std::vector<Touch>> groups;
  for (const std::size_t k : order) {
    if (groups.empty() || compare(groups.back()[0].at, touches[k].at) != 0) groups.emplace_back();
    groups.back().push_back(std::move(touches[k]));
  }
  return groups;
}

// The gaps at some t below the first group, between neighbours, and above the last group.
std::vector<std::set<GapKey>> gaps_beside(const RowPeriod& row, std::vector<std::vector<Touch>>& groups) {
  std::vector<std::set<GapKey>> gaps;
  for (std::vector<Touch>& group : groups) {
    // The lower end of the interval may be the previous root, until refining moves it.
    RealRoot& root = group[0].at;
    do root.refine();
    while (!is_odd(root.low));
    gaps.push_back(gaps_at(row, root.low, root.bits));
  }
  if (groups.empty())
    gaps.push_back(gaps_at(row, 0, 0));
  else
    gaps.push_back(gaps_at(row, groups.back()[0].at.low + 2, groups.back()[0].at.bits));
  return gaps;
}

bool is_open_between(const std::set<GapKey>& a, const std::set<GapKey>& b) {
  return std::any_of(a.begin(), a.end(), [&](const GapKey& key) { return b.contains(key); });
}

ArcEnd end_at(const Vec& u, double cotangent) {
  const double size = std::max(1.0, std::fabs(cotangent)),
               along = size > 1 ? std::copysign(1, cotangent) : cotangent;
  return {std::atan2(1, cotangent), cotangent, {along * u[0] - u[1] / size, along * u[1] + u[0] / size}, {}};
}

// The end of an arc beside which this gap is open. Two obstacles that touch there, one from either side of
// the gap, shut it.
ArcEnd end_at(const RowPeriod& row, const Vec& u, const std::vector<Touch>& group, const GapKey& gap) {
  ArcEnd end = end_at(u, round_to_binary64(group[0].at));
  const auto touch = std::find_if(group.begin(), group.end(),
                                  [&](const Touch& each) { return each.n != gap[each.j] - gap[each.i]; });
  const RowMember &first = row.members[touch->i], &second = row.members[touch->j];
  end.between = {first.id, second.id};
  end.between[1].cell[0] = to_integer(to_z(second.id.cell[0]) + touch->n * second.turn);
  return end;
}

std::vector<ClosedArc> closed_arcs(const RowPeriod& row, const Vec& u) {
  std::vector<std::vector<Touch>> groups = touches_of(row);
  const std::vector<std::set<GapKey>> gaps = gaps_beside(row, groups);
  std::vector<ClosedArc> arcs;
  constexpr double kRow = std::numeric_limits<double>::infinity();  // its cotangent
  ArcEnd from = end_at(u, kRow);
  for (std::size_t g = groups.size(); g-- > 0;) {
    const std::set<GapKey>&above = gaps[g + 1], &below = gaps[g];
    if (is_open_between(above, below)) continue;
    if (!above.empty()) from = end_at(row, u, groups[g], *above.begin());
    if (!below.empty()) arcs.push_back({from, end_at(row, u, groups[g], *below.begin())});
  }
  arcs.push_back({from, end_at(u, -kRow)});
  return arcs;
}

}  // namespace

std::vector<ClosedArc> closed_directions(const Scene& scene) {
  int most = 0;
  for (const Lattice& lattice : scene.lattices) most = std::max(most, lattice.rank(scene.dimension));
  if (most == scene.dimension)
    throw InputError("horizon: unsupported for crystals among rows, layers or single obstacles");
  if (most == 0)
    throw InputError("horizon: unsupported for single obstacles, which leave all directions open");
  if (most == 2)
    throw InputError(
        "horizon: unsupported for layers: the directions that they close are regions with very many edges; "
        "name "
        "one direction");
  // In space a row's shadow is a row of discs, or one disc. Finitely many of these leave part of a plane
  // open.
  if (scene.dimension == 3) return {};
  const auto row = std::find_if(scene.lattices.begin(), scene.lattices.end(),
                                [](const Lattice& lattice) { return lattice.rank(2) == 1; });
  return closed_arcs(row_of(integer_scene<2>(scene)), row->vectors[0]);
}

}  // namespace lorentz::oracle
