// The free paths that an engine computes, and the exact ones of the same starts.
#pragma once

#include <cmath>

#include <optional>
#include <vector>

#include "question/question.hpp"

namespace lorentz::judge {

using question::Place;
using question::Question;

/// P(free path > t) twice, by the engine and exactly. Both are of the same flights, so any difference is due
/// to the engine.
struct PathPoint {
  double t = 0;
  double survival = 0, exact = 0;

  double apart() const { return std::fabs(survival - exact); }
};

/// The free paths in one scene. Paths are times of flight, because starts have unit speed. A flight that the
/// engine did not decide is in neither of the two.
class FreePaths {
 public:
  void add(const Question& question, const Answer& given);

  std::size_t flights() const { return given_.size(); }
  /// The mean over the flights that hit something; 0 if there are none.
  double mean() const { return mean_of(given_); }
  double exact_mean() const { return mean_of(exact_); }

  /// The curve at powers of the square root of 2, from where a few paths have ended to where none goes on.
  std::vector<PathPoint> points() const;
  /// The point at which the two are farthest apart; nothing if they agree everywhere.
  std::optional<PathPoint> farthest_apart() const;

 private:
  static double mean_of(const std::vector<double>& paths);

  std::vector<double> given_, exact_;  // infinite: nothing is ever hit
};

}  // namespace lorentz::judge
