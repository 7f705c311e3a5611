// A hole in the shadow of a scene, and the line through it that is reported. Private to oracle/.
#pragma once

#include <lorentz/horizon.hpp>
#include "oracle/horizon/ball_scene.hpp"
#include "oracle/horizon/shadow.hpp"

namespace lorentz::oracle {

/// A hole among all balls of the lattice, if there is one; `shadow` must hold the largest ball. Adds to
/// `work` as hole_of_all does.
std::optional<HolePoint> hole_of(Shadow& shadow, const ObstacleLattice<3>& lattice, std::size_t& work);

/// A cylinder that fits into that hole: its point and radius, and whether the rounded point is inside.
/// Lengths in the shadow are multiplied by 2^-exponent.
Cylinder cylinder_in(const HolePoint& hole, const Shadow& shadow, const BallScene& balls, long exponent,
                     std::size_t& work);

}  // namespace lorentz::oracle
