// Moves a start so that a decision about an obstacle, or about two, is as close as it can be. Small blind
// moves do not get there: an ordinary query's margin is about 2^50 ulps, but the decisions that test a fast
// engine's error bounds have margins of a few ulps.
//
// A decision depends on the sign of a number f(x): the distance of the line, or of x, from the centre, less
// the radius; or the difference of two times of entry. Newton's steps along one component of x lead to a zero
// of f, up to the last bit of that component. If another component is set to zero before, it then takes up
// the remainder: binary64 is arbitrarily fine near zero, so f comes to about 2^-100, the precision
// (double-double) of this computation. From there bisection of the exact answers leads to two neighbouring
// binary64 values between which the answer changes.
//
// Ellipsoids { A y : |y| < 1 } become balls of the radius |det A| by adj(A).
#include "fuzz/campaign/variants.hpp"

#include <cmath>

#include <lorentz/geometry.hpp>
#include "question/cases/ulps.hpp"
#include "src/engines/base/double_double.hpp"

namespace lorentz::fuzz {

using namespace cases;
namespace {

using oracle::DecisionKind;
using Wide3 = std::array<Wide, 3>;

Wide inner(const Wide3& a, const Wide3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

Wide3 outer(const Wide3& a, const Wide3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Wide3 wide(const Vec& a) {
  return {Wide(a[0]), Wide(a[1]), Wide(a[2])};
}

// a + factor b
Wide3 sum_of(const Wide3& a, Wide factor, const Wide3& b) {
  return {a[0] + factor * b[0], a[1] + factor * b[1], a[2] + factor * b[2]};
}

// f at a place, and how it changes with each component of x.
struct Slope {
  Wide value = 0.0;
  Vec along{};
};

// One obstacle and the line, in coordinates in which the obstacle is a ball.
class ObstacleAndLine {
 public:
  ObstacleAndLine(const Scene& scene, const ObstacleId& id, const Vec& v) {
    const Lattice& lattice = scene.lattices[id.lattice];
    const Atom& atom = lattice.atoms[id.atom];
    centre_ = wide(atom.position);
    for (int i = 0; i < scene.dimension; ++i)
      centre_ = sum_of(centre_, Wide(static_cast<double>(id.cell[i].int64())), wide(lattice.vectors[i]));
    set_map(atom, scene.dimension);
    v_ = mapped(wide(v));
    v2_ = inner(v_, v_);
  }

  // |x - c| - r
  Slope containing(const Vec& x) const { return size_less_radius(arm_of(x)); }

  // The distance of the line from c, less r.
  Slope meeting(const Vec& x) const {
    const Wide3 arm = arm_of(x);
    return size_less_radius(sum_of(arm, -inner(arm, v_) / v2_, v_));
  }

  // The time of entry; if the obstacle is not entered, that of the nearest approach.
  Slope entry(const Vec& x) const {
    const Wide3 arm = arm_of(x);
    const Wide s = -inner(arm, v_), room = s * s - v2_ * (inner(arm, arm) - radius_ * radius_);
    const Wide root = room.hi > 0 ? sqrt(room) : Wide(0.0);
    Slope slope{(s - root) / v2_, {}};
    // The normal n at the point of entry: n . (dx + v dt) = 0.
    const Wide3 normal = sum_of(arm, slope.value, v_);
    const Wide across = inner(normal, v_);
    for (int k = 0; k < 3; ++k) slope.along[k] = -(inner(normal, column_[k]) / across).hi;
    return slope;
  }

 private:
  void set_map(const Atom& atom, int dimension) {
    std::array<Vec, 3> axes = semiaxes_of(atom, dimension);
    if (dimension == 2) axes[2] = {0, 0, 1};
    if (atom.is_ball()) axes = {Vec{1, 0, 0}, Vec{0, 1, 0}, Vec{0, 0, 1}};
    const Wide3 a = wide(axes[0]), b = wide(axes[1]), c = wide(axes[2]);
    const Wide3 rows[] = {outer(b, c), outer(c, a), outer(a, b)};
    const Wide det = inner(rows[0], a);
    radius_ = atom.is_ball() ? Wide(atom.radius) : det.hi < 0 ? -det : det;
    for (int k = 0; k < 3; ++k) column_[k] = {rows[0][k], rows[1][k], rows[2][k]};
  }

  Wide3 mapped(const Wide3& a) const {
    Wide3 image{Wide(0.0), Wide(0.0), Wide(0.0)};
    for (int k = 0; k < 3; ++k) image = sum_of(image, a[k], column_[k]);
    return image;
  }

  Wide3 arm_of(const Vec& x) const { return mapped(sum_of(wide(x), Wide(-1.0), centre_)); }

  Slope size_less_radius(const Wide3& a) const {
    const Wide size = sqrt(inner(a, a));
    Slope slope{size - radius_, {}};
    for (int k = 0; k < 3; ++k) slope.along[k] = (inner(a, column_[k]) / size).hi;
    return slope;
  }

  std::array<Wide3, 3> column_;  // of the map: the image of a step along each axis
  Wide3 centre_, v_;
  Wide radius_, v2_;
};

// Newton's steps along component k; false if they lead nowhere.
template <class F>
bool approach(const F& f, Vec& x, int k) {
  constexpr int kNewtonSteps = 6;
  for (int step = 0; step < kNewtonSteps; ++step) {
    const Slope slope = f(x);
    if (slope.value.hi == 0) return true;
    x[k] -= slope.value.value() / slope.along[k];
    if (!std::isfinite(x[k])) return false;
  }
  return true;
}

// Moves x to a zero of f along the component that f changes most with. If `finely` is drawn, another
// component is set to 0 first, and the last approach is along that one. Returns the component that was moved
// last, or nothing if that fails.
template <class F>
std::optional<int> approach(Random& random, int dimension, const F& f, Vec& x) {
  const bool finely = random.one_in(2);
  const auto last = static_cast<int>(random.below(static_cast<std::uint64_t>(dimension)));
  if (finely) x[last] = 0;
  const Slope slope = f(x);
  int first = finely ? (last + 1) % dimension : last;
  for (int k = 0; k < dimension; ++k)
    if (!(finely && k == last) && std::fabs(slope.along[k]) > std::fabs(slope.along[first])) first = k;
  if (!approach(f, x, first)) return std::nullopt;
  if (!finely) return first;
  return approach(f, x, last) ? std::optional(last) : std::nullopt;
}

// Moves component k to the number next to which the exact answer changes, by bisection, if the answer is
// another one near there.
void bisect(const Place& place, Query& query, int k) {
  const std::int64_t farthest = std::int64_t{1}
                                << (place.claim().precision == NumberFormat::binary64 ? 40 : 20);
  const NumberFormat precision = place.claim().precision;
  const auto answer_at = [&](double x) {
    Query there = query;
    there.x[k] = x;
    Answer answer = flaw_of(there, place.scene()) ? Answer::undecided() : place.exact(there);
    return std::pair(answer.outcome, std::move(answer.obstacle));
  };
  double here = query.x[k], there = here;
  const auto answer = answer_at(here);
  for (std::int64_t ulps = 1; there == here && ulps <= farthest; ulps *= -32)
    if (const double x = moved(here, ulps, precision); answer_at(x) != answer) there = x;
  if (there == here) return;
  for (double x = middle(here, there, precision); x != here && x != there; x = middle(here, there, precision))
    (answer_at(x) == answer ? here : there) = x;
  query.x[k] = here;
}

bool has_small_cell(const ObstacleId& id) {
  constexpr std::int64_t kLargest = std::int64_t{1} << 53;
  for (const Integer& n : id.cell)
    if (!n.fits_int64() || n.int64() > kLargest || n.int64() < -kLargest) return false;
  return true;
}

// A kind of decision and its obstacle; the order compares this obstacle with the one that is hit.
using NearDecision = std::pair<DecisionKind, ObstacleId>;

// The hardest decision, or one about the obstacle that is hit; a tie is with the obstacle that would be hit
// next.
NearDecision drawn_decision(Random& random, const Query& query, const Answer& exact,
                            const std::optional<oracle::HardestDecision>& hardest, const Place& place) {
  const std::uint64_t kind = random.below(8);
  if (kind < 4 && hardest && hardest->margin < oracle::kLargestMargin)
    return {hardest->kind, hardest->obstacle};
  if (kind == 7) {
    const Answer next = place.exact({query.x, query.v, exact.obstacle});
    if (next.outcome == Outcome::hit) return {DecisionKind::order, next.obstacle};
  }
  return {kind == 6 ? DecisionKind::containing : DecisionKind::meeting, exact.obstacle};
}

}  // namespace

std::optional<Query> query_near_decision(Random& random, const Place& place, const Query& query,
                                         const Answer& exact,
                                         const std::optional<oracle::HardestDecision>& hardest) {
  const Scene& scene = place.scene();
  if (exact.outcome != Outcome::hit) return std::nullopt;
  const auto [kind, obstacle] = drawn_decision(random, query, exact, hardest, place);
  if (!has_small_cell(obstacle) || !has_small_cell(exact.obstacle)) return std::nullopt;
  const ObstacleAndLine target(scene, obstacle, query.v), hit(scene, exact.obstacle, query.v);
  const auto off = [&, kind = kind](const Vec& x) {
    if (kind == DecisionKind::containing) return target.containing(x);
    if (kind == DecisionKind::meeting) return target.meeting(x);
    Slope difference = target.entry(x);
    const Slope other = hit.entry(x);
    difference.value = difference.value - other.value;
    for (int k = 0; k < 3; ++k) difference.along[k] -= other.along[k];
    return difference;
  };
  Query near = query;
  const auto last = approach(random, scene.dimension, off, near.x);
  near.x = rounded(near, place.claim().precision).x;
  if (!last || flaw_of(near, scene)) return std::nullopt;
  if (random.one_in(4)) bisect(place, near, *last);
  return near;
}

}  // namespace lorentz::fuzz
