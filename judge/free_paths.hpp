// The free paths that an engine flies, beside the exact ones of the same starts.
#pragma once

#include <cmath>

#include <optional>
#include <vector>

#include "question/question.hpp"

namespace lorentz::judge {

using question::Place;
using question::Question;

/// P(free path > t), twice: of the same flights, so that whatever sets the two apart is the engine's.
struct PathPoint {
  double t = 0;
  double survival = 0, exact = 0;

  double apart() const { return std::fabs(survival - exact); }
};

/// Of one scene. Paths are times of flight: starts have unit speed. What the engine did not decide is in
/// neither of the two.
class FreePaths {
 public:
  void add(const Question& question, const Answer& given);

  std::size_t flights() const { return given_.size(); }
  /// Over the flights that hit something; 0 of none.
  double mean() const { return mean_of(given_); }
  double exact_mean() const { return mean_of(exact_); }

  /// At powers of the square root of 2, from where some paths have ended to where none goes on.
  std::vector<PathPoint> points() const;
  /// The point at which the two are farthest apart; nothing if they are nowhere.
  std::optional<PathPoint> farthest_apart() const;

 private:
  static double mean_of(const std::vector<double>& paths);

  std::vector<double> given_, exact_;  // infinite: nothing is ever hit
};

}  // namespace lorentz::judge
