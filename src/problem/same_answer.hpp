// When two answers are the same.
#pragma once

#include <lorentz/answer.hpp>

namespace lorentz {

/// True if the outcomes are equal and, for `hit` and `inside`, also the obstacles and the times.
inline bool same_answer(const Answer& a, const Answer& b) {
  if (a.outcome != b.outcome) return false;
  const bool names_obstacle = a.outcome == Outcome::hit || a.outcome == Outcome::inside;
  return !names_obstacle || (a.obstacle == b.obstacle && a.time == b.time);
}

}  // namespace lorentz
