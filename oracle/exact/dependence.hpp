// Decides exactly whether the vectors of a scene are independent.
#pragma once

#include <optional>
#include <string>

#include <lorentz/scene.hpp>

namespace lorentz::oracle {

/// As <lorentz/scene_check.hpp> says.
std::optional<std::string> dependence_in(const Scene& scene);

/// Returns the scene if it is valid and its vectors are independent; else throws InputError, which names the
/// place.
const Scene& checked_exactly(const Scene& scene);

}  // namespace lorentz::oracle
