// A step in a plane away from walls: a linear programme of three unknowns. In binary64, for a line to be
// named; nothing is decided here. Private to oracle/.
#pragma once

#include <vector>

namespace lorentz::oracle {

/// The half-plane beyond a wall: a point that is moved by (x, y) is `far + out_x x + out_y y` from it.
struct Wall {
  double out_x, out_y;  ///< unit vector
  double far;
};

struct WideStep {
  double x = 0, y = 0;
};

struct StepBounds {
  double low_x, high_x, low_y, high_y;
};

/// The step within the bounds after which the nearest of the walls is farthest away.
WideStep widest_step(const std::vector<Wall>& walls, const StepBounds& bounds);

}  // namespace lorentz::oracle
