// Are the vectors of a scene independent? Decided exactly.
#pragma once

#include <optional>
#include <string>

#include <lorentz/scene.hpp>

namespace lorentz::oracle {

/// Of a scene without flaws: which primitive vectors or semiaxes are linearly dependent, in words; or nothing.
std::optional<std::string> dependence_of(const Scene& scene);

/// The scene, if it has no flaw and its vectors are independent; else throws InputError, which names the place.
const Scene& checked_exactly(const Scene& scene);

}  // namespace lorentz::oracle
