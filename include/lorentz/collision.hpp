// The collision at the end of a flight, in binary64: its point, its normal and the velocity after it.
#pragma once

#include <lorentz/answer.hpp>
#include <lorentz/query.hpp>
#include <lorentz/scene.hpp>

namespace lorentz {

/// The collision point, the outward unit normal, and the distance of the line of flight from the obstacle's
/// centre, in the scene's own geometry. Numbers beyond binary64 come out as non-finite. The error is that of
/// x + t v: a few ulps of the distance flown. Throws InputError if the answer has no time, or names no
/// obstacle of the scene.
///
/// held by "Collision detail of balls is the oracle's, which is correctly rounded"
Detail collision_detail(const Scene& scene, const Query& query, const Answer& answer);

/// The velocity after a specular reflection: v - 2 (v.n) n. Requires a normal n of unit length.
///
/// held by "A reflection keeps the speed and turns the normal component"
Vec reflected(const Vec& v, const Vec& normal);

}  // namespace lorentz
