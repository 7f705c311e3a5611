#include "oracle/horizon/widest_step.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace lorentz::oracle {
namespace {

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

}  // namespace

// Only a few walls matter. A wall that the step for the previous walls comes too near to is added, one at a
// time. Each is added once, because no later step violates an earlier wall by more than its slack.
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

}  // namespace lorentz::oracle
