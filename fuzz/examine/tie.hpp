// Of obstacles that contain x, or are entered together, the answer is the first by name; in other words for
// the scene that is another one.
#pragma once

#include <lorentz/answer.hpp>
#include <lorentz/query.hpp>
#include <lorentz/scene.hpp>
#include <lorentz/verdict.hpp>

namespace lorentz::fuzz {

/// Does x lie in the open obstacle? Decided exactly; the scene must have no flaw, the obstacle be one of it.
bool contains(const Scene& scene, const ObstacleId& obstacle, const Vec& x);

/// Whether an answer differs from the exact one by the choice among obstacles that it could name as well, and
/// in nothing else: in the same outcome, at the same time to the bit. The judge is the scene's.
bool is_tie(const Scene& scene, const oracle::Judge& judge, const Query& query, const Answer& exact,
            const Answer& other);

}  // namespace lorentz::fuzz
