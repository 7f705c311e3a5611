// Features of questions, and what distinguishes the questions on which an engine fails.
#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "question/question.hpp"

namespace lorentz::judge {

using question::Question;

/// Features of a question, by which the failing questions can be distinguished from the others.
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

/// What distinguishes the questions on which an engine fails.
struct Circumstance {
  std::string text;          ///< a clause after "only "
  double share = 0;          ///< the share of the right answers that have it, too
  bool is_of_depth = false;  ///< says that the obstacle is only just entered
  std::function<bool(const Features&)> holds = [](const Features&) { return true; };
};

/// A property of all failing questions and of at most half of the right ones, which all failing ones would
/// have by chance with a probability below 1 in 1000 (share^number). Limits are powers of ten; those of
/// lengths in radii are powers of two. If several properties qualify, it is the one that is rarest among the
/// right answers; if no property does, nothing.
std::optional<Circumstance> circumstance_of(const std::vector<Features>& failing,
                                            const std::vector<Features>& right);

}  // namespace lorentz::judge
