// What an answer names, and when two answers are the same.
#pragma once

#include <lorentz/answer.hpp>
#include <lorentz/query.hpp>
#include <lorentz/scene.hpp>

namespace lorentz {

/// True if the answer names an obstacle: one that is hit, or one that contains x.
inline bool names_obstacle(const Answer& a) {
  return a.outcome == Outcome::hit || a.outcome == Outcome::inside;
}

/// The same for an answer to a valid query, and the scene has this obstacle.
inline bool names_obstacle(const Answer& a, const Query& query, const Scene& scene) {
  return names_obstacle(a) && !flaw_of(Query{query.x, query.v, a.obstacle}, scene);
}

/// True if the outcomes are equal and, for `hit` and `inside`, also the obstacles and the times.
inline bool same_answer(const Answer& a, const Answer& b) {
  if (a.outcome != b.outcome) return false;
  return !names_obstacle(a) || (a.obstacle == b.obstacle && a.time == b.time);
}

}  // namespace lorentz
