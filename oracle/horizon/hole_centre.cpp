#include "oracle/horizon/shadow.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace lorentz::oracle {
namespace {

// ---- A step in a plane away from walls: a linear programme in three unknowns, in binary64

// The half-plane beyond a wall: a point moved by (x, y) is at the distance `far + out_x x + out_y y` from
// it.
struct Wall {
  double out_x, out_y;  // unit vector
  double far;
};
struct WideStep {
  double x = 0, y = 0;
};

struct StepBounds {
  double low_x, high_x, low_y, high_y;
};

// a x + b y + c t <= limit, for the step (x, y) and the distance t of the nearest wall.
struct Constraint {
  double a, b, c, limit;
};

struct Corner {
  double x = 0, y = 0, t = 0;
};

// How far outside a corner lies (excess), and how much of that can be rounding (slack).
double excess(const Constraint& k, const Corner& at) {
  return k.a * at.x + k.b * at.y + k.c * at.t - k.limit;
}
double slack(const Constraint& k, const Corner& at) {
  return 1e-13 * (std::fabs(k.a * at.x) + std::fabs(k.b * at.y) + std::fabs(k.c * at.t) + std::fabs(k.limit));
}

// The point where three constraints are equalities, by Cramer's rule; false if they are not independent.
bool corner_of(const Constraint& p, const Constraint& q, const Constraint& r, Corner& corner) {
  const auto det = [&](auto first, auto second, auto third) {
    return first(p) * (second(q) * third(r) - second(r) * third(q)) -
           first(q) * (second(p) * third(r) - second(r) * third(p)) +
           first(r) * (second(p) * third(q) - second(q) * third(p));
  };
  const auto a = [](const Constraint& k) { return k.a; };
  const auto b = [](const Constraint& k) { return k.b; };
  const auto c = [](const Constraint& k) { return k.c; };
  const auto limit = [](const Constraint& k) { return k.limit; };
  const double whole = det(a, b, c);
  if (std::fabs(whole) < 1e-15) return false;
  corner = {det(limit, b, c) / whole, det(a, limit, c) / whole, det(a, b, limit) / whole};
  return std::isfinite(corner.x) && std::isfinite(corner.y) && std::isfinite(corner.t);
}

// The highest corner that satisfies all of a few constraints.
Corner highest(const std::vector<Constraint>& some) {
  Corner best{0, 0, -std::numeric_limits<double>::infinity()}, corner;
  for (std::size_t i = 0; i < some.size(); ++i)
    for (std::size_t k = i + 1; k < some.size(); ++k)
      for (std::size_t m = k + 1; m < some.size(); ++m)
        if (corner_of(some[i], some[k], some[m], corner) && corner.t > best.t &&
            std::all_of(some.begin(), some.end(), [&](const Constraint& constraint) {
              return excess(constraint, corner) <= slack(constraint, corner);
            }))
          best = corner;
  return best;
}

// The step within the bounds after which the nearest wall is farthest away. Only a few walls matter. A wall
// that the step for the previous walls comes too near to is added, one at a time. Each is added once, because
// no later step violates an earlier wall by more than its slack.
WideStep widest_step(const std::vector<Wall>& walls, const StepBounds& bounds) {
  std::vector<Constraint> some{{1, 0, 0, bounds.high_x},
                               {-1, 0, 0, -bounds.low_x},
                               {0, 1, 0, bounds.high_y},
                               {0, -1, 0, -bounds.low_y}};
  const auto constraint = [](const Wall& wall) { return Constraint{-wall.out_x, -wall.out_y, 1, wall.far}; };
  const auto nearest = std::min_element(walls.begin(), walls.end(),
                                        [](const Wall& a, const Wall& b) { return a.far < b.far; });
  if (nearest == walls.end()) return {};
  some.push_back(constraint(*nearest));
  for (;;) {
    const Corner corner = highest(some);
    const Wall* worst = nullptr;
    double most = 0;
    for (const Wall& wall : walls) {
      const double over = excess(constraint(wall), corner);
      if (over <= std::max(most, slack(constraint(wall), corner))) continue;
      most = over;
      worst = &wall;
    }
    if (!worst) return {corner.x, corner.y};
    some.push_back(constraint(*worst));
  }
}

// ---- The climb

double quotient(const Z& a, const Z& b) {
  const BinaryApproximation x = approximation(a), y = approximation(b);
  return std::ldexp(x.mantissa / y.mantissa, static_cast<int>(x.exponent - y.exponent));
}

// Orthogonal axes of the plane. Lengths are in units of the largest disc's radius; vectors of the plane are
// integers, times 2^bits.
struct HoleFrame {
  unsigned long bits;
  std::array<ZVec<3>, 2> axes;
  std::array<Z, 2> units;  ///< |axis| times the unit, times 2^bits

  HoleFrame(const Shadow& shadow, unsigned long fine_bits) : bits(fine_bits) {
    axes = {shadow.basis[0].p, cross(shadow.along, shadow.basis[0].p)};
    const Z r = shadow.discs[0].radius;
    for (int i : {0, 1})
      units[i] = floor_sqrt(shifted_left(dot(axes[i], axes[i]) * r * r * shadow.along2, 2 * bits));
  }
  std::array<double, 2> coordinates(const ZVec<3>& fine) const {
    return {quotient(dot(fine, axes[0]), units[0]), quotient(dot(fine, axes[1]), units[1])};
  }
  ZVec<3> vector(const WideStep& step) const {
    ZVec<3> fine;
    const double parts[] = {step.x, step.y};
    for (int i : {0, 1}) {
      int exponent = 0;
      const Z mantissa(std::ldexp(std::frexp(parts[i], &exponent), 53));
      const Z length2 = dot(axes[i], axes[i]), times = mantissa * units[i];
      const int shift = exponent - 53;
      for (int k = 0; k < 3; ++k)
        fine[k] +=
            shift >= 0
                ? round_div(shifted_left(times * axes[i][k], static_cast<unsigned long>(shift)), length2)
                : round_div(times * axes[i][k], shifted_left(length2, static_cast<unsigned long>(-shift)));
    }
    return fine;
  }
  std::array<double, 3> direction(int i) const {
    const Z length = floor_sqrt(shifted_left(dot(axes[i], axes[i]), 2 * bits));
    std::array<double, 3> result;
    for (int k = 0; k < 3; ++k) result[k] = quotient(shifted_left(axes[i][k], bits), length);
    return result;
  }
};

// A disc whose centre is relative to the disc to which the start of a climb is relative; times 2^bits, and in
// the frame.
struct SeenDisc {
  Disc disc;
  double x, y, radius;
  double far = 0;  ///< from the point by which the discs are sorted
};

// The discs around the start of a climb.
struct HoleSurroundings {
  const Shadow& shadow;
  HoleFrame frame;
  std::vector<SeenDisc> discs;

  /// Sorts by distance from here, nearest first, and removes the discs further than `most`.
  void sort_by_distance(double x, double y, double most = std::numeric_limits<double>::infinity()) {
    for (SeenDisc& one : discs) one.far = std::hypot(one.x - x, one.y - y) - one.radius;
    std::erase_if(discs, [most](const SeenDisc& one) { return !(one.far <= most); });
    std::sort(discs.begin(), discs.end(), [](const SeenDisc& a, const SeenDisc& b) { return a.far < b.far; });
  }
};

// A place in the plane in binary64: fast, but too coarse near the edges of discs.
class RoughPlace {
 public:
  RoughPlace(const HoleSurroundings& around, double x, double y) : around_(&around), x_(x), y_(y) {
    for (const SeenDisc& one : around.discs) {
      const double dx = x - one.x, dy = y - one.y, length = std::sqrt(dx * dx + dy * dy);
      walls_.push_back({dx / length, dy / length, length - one.radius});
    }
  }
  const std::vector<Wall>& walls() const { return walls_; }
  RoughPlace moved(const WideStep& step) const { return {*around_, x_ + step.x, y_ + step.y}; }
  double x() const { return x_; }
  double y() const { return y_; }

 private:
  const HoleSurroundings* around_;
  double x_, y_;
  std::vector<Wall> walls_;
};

// A place in integers: its distances from the edges of discs are accurate, however small they are.
class ExactPlace {
 public:
  ExactPlace(const HoleSurroundings& around, ZVec<3> place) : around_(&around), place_(std::move(place)) {
    const HoleFrame& frame = around.frame;
    const Z unit = shifted_left(around.shadow.discs[0].radius * around.shadow.along2, frame.bits + kMore);
    for (const SeenDisc& one : around.discs) {
      const auto [x, y] = frame.coordinates(place_ - one.disc.centre);
      const double length = std::hypot(x, y);
      const Quadratic far = distance_from(one.disc);
      const Z fine = floor_sqrt(shifted_left(far.d, 2 * kMore)) + shifted_left(far.a, kMore);
      walls_.push_back({x / length, y / length, quotient(fine, unit)});
      if (walls_.size() > 1 && fine >= least_) continue;
      least_ = fine;
      nearest_ = far;
    }
  }
  const std::vector<Wall>& walls() const { return walls_; }
  ExactPlace moved(const WideStep& step) const { return {*around_, place_ + around_->frame.vector(step)}; }
  double x() const { return around_->frame.coordinates(place_)[0]; }
  double y() const { return around_->frame.coordinates(place_)[1]; }
  const Quadratic& clearance() const { return nearest_; }

 private:
  static constexpr unsigned long kMore = 64;

  // The distance of the line through the place from a ball: (|X cross g| - r g^2) / g^2, where X is the
  // vector between them, which need not be perpendicular to g.
  Quadratic distance_from(const Disc& disc) const {
    const Shadow& shadow = around_->shadow;
    const ZVec<3> across = cross(place_ - disc.centre, shadow.along);
    const unsigned long bits = around_->frame.bits;
    return {-shifted_left(disc.radius * shadow.along2, bits), +1, dot(across, across),
            shifted_left(shadow.along2, bits), 0};
  }

  const HoleSurroundings* around_;
  ZVec<3> place_;
  std::vector<Wall> walls_;
  Z least_;
  Quadratic nearest_;
};

template <class Place>
double clearance_at(const Place& place) {
  return std::min_element(place.walls().begin(), place.walls().end(),
                          [](const Wall& a, const Wall& b) { return a.far < b.far; })
      ->far;
}

// The clearance at a place if it is above `floor`; otherwise some value not above `floor`.
double rough_clearance(const HoleSurroundings& around, double x, double y, double floor) {
  double least = std::numeric_limits<double>::infinity();
  for (const SeenDisc& one : around.discs) {
    const double dx = x - one.x, dy = y - one.y;
    least = std::min(least, std::sqrt(dx * dx + dy * dy) - one.radius);
    if (least <= floor) break;
  }
  return least;
}

// Hops to places with more room, in ever smaller steps, also over discs: the hole may be wide far from the
// start, or another hole may be wider.
WideStep hop(const HoleSurroundings& around, const WideStep& start, double limit) {
  constexpr int kWays = 24;
  WideStep place = start;
  double best = 0;
  for (double step = limit / 4; step > limit / 200;) {
    bool better = false;
    for (int i = 0; i < kWays && !better; ++i) {
      const double angle = 2 * M_PI * i / kWays;
      const WideStep to{place.x + step * std::cos(angle), place.y + step * std::sin(angle)};
      const double there = rough_clearance(around, to.x, to.y, best);
      if (there <= best || std::hypot(to.x - start.x, to.y - start.y) > limit) continue;
      best = there;
      place = to;
      better = true;
    }
    if (!better) step /= 2;
  }
  return place;
}

// Climbs away from the discs. No disc is nearer than its tangent at the nearest point, so a step away from
// the tangents is a step away from the discs. Near the farthest place the steps converge like Newton's
// method. Goes no further than `limit` from the start.
template <class Place>
Place climb(Place place, double limit) {
  constexpr int kMostSteps = 400;
  const double start_x = place.x(), start_y = place.y();
  double best = clearance_at(place), longest = limit;
  for (int i = 0; i < kMostSteps && longest > 1e-3 * best; ++i) {
    const double dx = place.x() - start_x, dy = place.y() - start_y;
    const auto low = [&](double at) { return -std::min(longest, std::max(0.0, limit + at)); };
    const auto high = [&](double at) { return std::min(longest, std::max(0.0, limit - at)); };
    const WideStep step = widest_step(place.walls(), {low(dx), high(dx), low(dy), high(dy)});
    Place next = place.moved(step);
    const double there = clearance_at(next);
    if (!(there > best)) {
      longest /= 4;
      continue;
    }
    const bool arrived = there - best < 1e-12 * there;
    place = std::move(next);
    best = there;
    if (arrived) break;
  }
  return place;
}

// The discs, nearest first.
HoleSurroundings surroundings_of(const Shadow& shadow, const HolePoint& hole, const Z& reach) {
  HoleSurroundings result{shadow, HoleFrame(shadow, hole.bits), {}};
  ZVec<3> whole = hole.offset;
  for (Z& component : whole) component = component >> hole.bits;
  for (const Disc& disc : shadow.discs_around(shadow.discs[hole.disc].centre + whole, reach, false)) {
    const ZVec<3> centre = shifted_left(1, hole.bits) * (disc.centre + whole);
    const auto [x, y] = result.frame.coordinates(centre);
    result.discs.push_back({{centre, disc.radius}, x, y, quotient(disc.radius, shadow.discs[0].radius)});
  }
  const auto [x, y] = result.frame.coordinates(hole.offset);
  result.sort_by_distance(x, y);
  return result;
}

// Inverts X = x cross g: the projection is (g cross X) / g^2.
Vec offset_of(const HoleFrame& frame, double x, double y) {
  const auto first = frame.direction(0), second = frame.direction(1);
  Vec offset;
  for (int k = 0; k < 3; ++k) offset[k] = x * second[k] - y * first[k];
  return offset;
}

// For one disc and its translates, the point is already the one furthest from all centres. Its distance from
// them is the circumradius of 0, b1, b2: |b1| |b2| |b1 - b2| / (4 area |g|).
HoleCentre centre_of_largest(const Shadow& shadow, const HolePoint& hole) {
  const HoleFrame frame(shadow, hole.bits);
  const auto [x, y] = frame.coordinates(hole.offset);
  const ZVec<3>&b1 = shadow.basis[0].p, b2 = shadow.basis[1].p;
  const Z g11 = dot(b1, b1), g12 = dot(b1, b2), g22 = dot(b2, b2), g33 = g11 + g22 - 2 * abs(g12);
  const Z square = g11 * g22 * g33, over = 4 * (g11 * g22 - g12 * g12) * shadow.along2;
  return {offset_of(frame, x, y), {-shadow.discs[0].radius * over, +1, square * over, over, 0}};
}

}  // namespace

HoleCentre centre_of(const Shadow& shadow, const HolePoint& hole) {
  if (shadow.discs.size() == 1) return centre_of_largest(shadow, hole);
  // No point is further from all centres than half of |b1| + |b2|, so only discs within twice that distance
  // matter.
  const Z r = shadow.discs[0].radius, b11 = dot(shadow.basis[0].p, shadow.basis[0].p),
          b22 = dot(shadow.basis[1].p, shadow.basis[1].p);
  const Z reach = 2 * ceil_sqrt(ceil_div(2 * (b11 + b22), shadow.along2)) + 2 * r;
  const double limit = quotient(reach, r) / 3;
  HoleSurroundings around = surroundings_of(shadow, hole, reach);
  const auto [x, y] = around.frame.coordinates(hole.offset);
  const WideStep hopped = hop(around, {x, y}, limit);
  const RoughPlace rough = climb(RoughPlace(around, hopped.x, hopped.y), limit);
  constexpr double kWide = 1e-5;  // binary64 finds such holes well
  const bool wide = clearance_at(rough) > kWide;
  if (wide) around.sort_by_distance(rough.x(), rough.y(), 2 * clearance_at(rough));
  const ExactPlace start(around, hole.offset);
  const ExactPlace place = wide ? start.moved({rough.x() - x, rough.y() - y}) : climb(start, limit);
  return {offset_of(around.frame, place.x(), place.y()), place.clearance()};
}

}  // namespace lorentz::oracle
