// What only exact arithmetic can say of a scene: are its vectors independent, do obstacles overlap?
#pragma once

#include <optional>
#include <string>

#include "../src/problem.hpp"

namespace lorentz::oracle {

/// For a scene that lorentz::flaw_of passed: what is wrong with it nevertheless (dependent primitive vectors
/// or semiaxes, decided exactly), or nothing.
std::optional<std::string> dependence_in(const Scene& scene);

/// Names a pair of obstacles that overlap or touch, or nothing. Looks at the pairs of balls that share their
/// primitive vectors, in scenes of up to 300 atoms. (Two lattices with different vectors nearly always
/// overlap somewhere; that is what they are for.)
std::optional<std::string> overlap_in(const Scene& scene);

}  // namespace lorentz::oracle
