// The name of a scene in a report.
#pragma once

#include <optional>
#include <string>

#include <lorentz/scene.hpp>

namespace lorentz::report {

/// The radius that all obstacles have, or nothing.
std::optional<double> common_radius(const Scene& scene);

/// "square", or "square, r = 0.1" if all obstacles are balls of one radius.
std::string name_with_radius(const std::string& name, const Scene& scene);

}  // namespace lorentz::report
