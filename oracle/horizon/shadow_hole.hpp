// A hole in a scene's shadow, and the line through it that is named. Private to oracle/.
#pragma once

#include <lorentz/horizon.hpp>
#include "oracle/horizon/ball_scene.hpp"
#include "oracle/horizon/shadow.hpp"

namespace lorentz::oracle {

/// A hole among all the lattice's balls, if there is one; the shadow has its largest. Adds to `work` as
/// hole_of_all does.
std::optional<HolePoint> hole_of(Shadow& shadow, const ObstacleLattice<3>& lattice, std::size_t& work);

/// A cylinder that fits into that hole: its point and radius, and whether the rounded point is inside. Lengths
/// in the shadow are times 2^-exponent.
Cylinder cylinder_in(const HolePoint& hole, const Shadow& shadow, const BallScene& balls, long exponent,
                     std::size_t& work);

}  // namespace lorentz::oracle
