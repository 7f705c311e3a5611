// The collision at the end of a flight, in binary64: where, how, and what the velocity becomes.
#pragma once

#include <lorentz/answer.hpp>
#include <lorentz/query.hpp>
#include <lorentz/scene.hpp>

namespace lorentz {

/// held by "Collision detail of balls is the oracle's, which is correctly rounded"
///
/// Collision point, outward unit normal, and the distance of the line of flight from the obstacle's
/// centre, in the scene's own geometry. For an answer that is a `hit` with a time. Numbers beyond
/// binary64 come out as not finite. The error is that of x + t v: some ulps of the distance flown.
Detail collision_detail(const Scene& scene, const Query& query, const Answer& answer);

/// held by "A reflection keeps the speed and turns the normal component"
///
/// The velocity after a specular reflection: v - 2 (v.n) n, n of unit length.
Vec reflected(const Vec& v, const Vec& normal);

}  // namespace lorentz
