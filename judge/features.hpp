// What a question is like, for those who look for what sets the failing ones apart.
#pragma once

#include <limits>
#include <optional>

#include "question/question.hpp"

namespace lorentz::judge {

using question::Place;
using question::Question;

struct Features {
  static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

  bool in_space = false;        ///< 3D
  bool zero_component = false;  ///< a component of v is 0
  bool leaving = false;         ///< `from` is given
  bool several_lattices = false, several_atoms = false, ellipsoids = false;
  bool other_cell = false;  ///< not one unit square or cubic lattice
  bool never = false;       ///< nothing is ever hit
  // Lengths in those of the shortest primitive vector.
  double flight = kNone;  ///< to the obstacle that is hit
  double radius = kNone;  ///< the smallest
  double start = kNone;   ///< of x from the origin
  double cell = kNone;    ///< the largest number of a cell, without its sign: of the obstacle hit, of `from`
  double depth = kNone;   ///< by so many of its radii the line enters the obstacle that is hit
  double speed = kNone;   ///< of v, in the scene's own unit
  // In radii (of an ellipsoid: its smallest semiaxis).
  double distance = kNone;         ///< of x from the centre of the obstacle in question
  double flight_in_radii = kNone;  ///< to the obstacle that is hit, in radii of that
};

/// `in_question`: the obstacle that is in question; nothing: the only one that there is.
Features features_of(const Question& question, const std::optional<ObstacleId>& in_question = {});

}  // namespace lorentz::judge
