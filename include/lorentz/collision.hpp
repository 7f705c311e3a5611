// The collision at the end of a flight, in binary64: its point, its normal and the velocity after it; and where the line
// of flight would leave the obstacle again.
#pragma once

#include <lorentz/answer.hpp>
#include <lorentz/query.hpp>
#include <lorentz/scene.hpp>

namespace lorentz {

/// The collision point and the point at which the line leaves the obstacle, the outward unit normals there, and the
/// distance of the line from the obstacle's centre, in the scene's own geometry. Numbers beyond binary64 come out as
/// non-finite. The error is that of x + t v: a few ulps of the distance flown. For `inside` there is no collision: its
/// point and normal are zero. Throws InputError if the answer is neither a hit with a time nor `inside`, or names no
/// obstacle of the scene.
Detail collision_detail(const Scene& scene, const Query& query, const Answer& answer);

/// When the line leaves the obstacle that the answer names, with the error of collision_detail, and its exceptions.
double exit_time(const Scene& scene, const Query& query, const Answer& answer);

/// The velocity after a specular reflection: v - 2 (v.n) n. Requires a normal n of unit length.
Vec reflected(const Vec& v, const Vec& normal);

}  // namespace lorentz
