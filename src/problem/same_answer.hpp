// When two answers are the same.
#pragma once

#include <lorentz/answer.hpp>

namespace lorentz {

/// The same outcome and, of `hit` and `inside`, the same obstacle and time.
inline bool same_answer(const Answer& a, const Answer& b) {
  if (a.outcome != b.outcome) return false;
  const bool names_obstacle = a.outcome == Outcome::hit || a.outcome == Outcome::inside;
  return !names_obstacle || (a.obstacle == b.obstacle && a.time == b.time);
}

}  // namespace lorentz
