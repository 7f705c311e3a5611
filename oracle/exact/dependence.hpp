// Decides exactly whether the vectors of a scene are independent.
#pragma once

#include <optional>
#include <string>

#include <lorentz/scene.hpp>

namespace lorentz::oracle {

/// For a scene that is otherwise valid: names the primitive vectors or semiaxes that are linearly dependent,
/// or nothing.
std::optional<std::string> dependence_of(const Scene& scene);

/// Returns the scene if it is valid and its vectors are independent; else throws InputError, which names the
/// place.
const Scene& checked_exactly(const Scene& scene);

}  // namespace lorentz::oracle
