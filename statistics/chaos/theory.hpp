// What theory knows of Lyapunov exponents and diffusion. Unit speed; lengths in the scene's unit.
// docs/chaos.md has the formulas and their sources.
#pragma once

#include <optional>

#include <lorentz/scene.hpp>

namespace lorentz::chaos {

/// The positive exponent a collision among small discs, one a cell of any 2D lattice of cell area A:
/// - ln(r^2 / A) + 1 - 4 ln 2 + 27 zeta(3) / (2 pi^2), up to O(r ln^2 r) (Dahlqvist 1997). Nothing for other
/// scenes.
std::optional<double> exponent_of_small_discs(const Scene& scene);

/// The sum of the positive exponents a collision among small balls, one a cell of volume V:
/// - 2 ln(r^3 / V) + 2 ln 2 + 2 <ln xi>, where xi = r^2 tau / V. Its mean was measured: <ln xi> =
/// -1.6857(10).
std::optional<double> exponents_of_small_balls(const Scene& scene);

/// The diffusion coefficient of discs of one triangular lattice that leave narrow gaps, as that of a random
/// walk between the traps (Machta & Zwanzig 1983); exact as the gap goes to 0. Nothing for other scenes, or
/// discs that overlap.
std::optional<double> machta_zwanzig(const Scene& scene);

/// By how much a collision widens a pencil that bounces head-on between two discs or balls of radius r whose
/// centres are a distance L apart.
double head_on_multiplier(double L, double r);

}  // namespace lorentz::chaos
