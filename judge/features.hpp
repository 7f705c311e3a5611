// Features of a question, by which the failing questions can be distinguished from the others.
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
  bool other_cell = false;  ///< not a single unit square or cubic lattice
  bool never = false;       ///< nothing is ever hit
  // Lengths in units of the shortest primitive vector.
  double flight = kNone;  ///< to the obstacle that is hit
  double radius = kNone;  ///< the smallest
  double start = kNone;   ///< distance of x from the origin
  double cell = kNone;    ///< the largest absolute value in a cell, of the obstacle hit or of `from`
  double depth = kNone;   ///< by how many of its radii the line enters the obstacle that is hit
  double speed = kNone;   ///< |v|, in the scene's own unit
  // In radii (for an ellipsoid, its smallest semiaxis).
  double distance = kNone;         ///< from x to the centre of the obstacle in question
  double flight_in_radii = kNone;  ///< to the obstacle that is hit, in its radii
};

/// `in_question`: the obstacle in question; nothing: the scene's only obstacle, if it has just one.
Features features_of(const Question& question, const std::optional<ObstacleId>& in_question = {});

}  // namespace lorentz::judge
