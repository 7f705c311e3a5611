// A step in a plane away from walls: a linear programme in three unknowns. It is computed in binary64, for a
// line that is only reported; nothing is decided here. Private to oracle/.
#pragma once

#include <vector>

namespace lorentz::oracle {

/// The half-plane beyond a wall: a point moved by (x, y) is at the distance `far + out_x x + out_y y` from
/// it.
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

/// The step within the bounds after which the nearest wall is farthest away.
WideStep widest_step(const std::vector<Wall>& walls, const StepBounds& bounds);

}  // namespace lorentz::oracle
