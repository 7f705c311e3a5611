// What a search has found so far. Private to the reduction engine.
#pragma once

#include <limits>

#include <lorentz/flight.hpp>
#include "src/engines/base/double_double.hpp"

namespace lorentz {

/// The nearest obstacle that was found to be met, and the last stage that any decision needed.
template <int D>
struct Found {
  static constexpr double kNothing = std::numeric_limits<double>::infinity();

  Stage stage = Stage::binary64;
  Wide N[D];            ///< its cell, counted from the home cell, in the short basis
  double s = kNothing;  ///< v . d
  double slack = 0, s_error = 0, slack_error = 0;
  double h = 0;  ///< v x d; only in 2D, for ellipsoids

  bool any() const { return s < kNothing; }
  Outcome outcome() const { return any() ? Outcome::hit : Outcome::never; }
  Outcome give_up() {
    stage = Stage::undecided;
    return Outcome::undecided;
  }
  void needs(Stage needed) {
    if (stage < needed) stage = needed;
  }
};

}  // namespace lorentz
