// Theory of Lyapunov exponents and diffusion. Unit speed; lengths in the scene's unit.
// docs/chaos.md has the formulas and their sources.
#pragma once

#include <optional>

#include <lorentz/scene.hpp>

namespace lorentz::chaos {

/// The positive exponent per collision among small discs, one per cell of any 2D lattice with cell area A:
/// - ln(r^2 / A) + 1 - 4 ln 2 + 27 zeta(3) / (2 pi^2), up to O(r ln^2 r) (Dahlqvist 1997). Empty for other
/// scenes.
std::optional<double> exponent_of_small_discs(const Scene& scene);

/// The sum of the positive exponents per collision among small balls, one per cell of volume V:
/// - 2 ln(r^3 / V) + 2 ln 2 + 2 <ln xi>, where xi = r^2 tau / V. The mean <ln xi> = -1.6857(10) is a measured
/// value.
std::optional<double> exponents_of_small_balls(const Scene& scene);

/// The diffusion coefficient for discs on one triangular lattice with narrow gaps, modelled as a random walk
/// between the traps (Machta & Zwanzig 1983). Exact as the gap goes to 0. Empty for other scenes and for
/// overlapping discs.
std::optional<double> machta_zwanzig(const Scene& scene);

}  // namespace lorentz::chaos
