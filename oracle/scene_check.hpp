// What only exact arithmetic can say of a scene: are its vectors independent, do obstacles overlap?
#pragma once

#include <optional>
#include <string>

#include "../src/problem.hpp"

namespace lorentz::oracle {

/// For a scene that lorentz::flaw_of passed: what is wrong with it nevertheless (dependent primitive vectors
/// or semiaxes, decided exactly), or nothing.
std::optional<std::string> dependence_in(const Scene& scene);

/// Names a pair of atoms, obstacles of which overlap or touch somewhere, or nothing; decided exactly, for
/// balls, in scenes of up to 300 atoms. (Two lattices with incommensurate vectors overlap somewhere: binary64
/// makes them commensurate, but finely.)
std::optional<std::string> overlap_in(const Scene& scene);

}  // namespace lorentz::oracle
