// Reports on the channels of a scene.
#pragma once

#include <cstddef>
#include <string>

#include <lorentz/horizon.hpp>

namespace lorentz::report {

/// Finite, infinite with the number of directions, or not known.
std::string verdict_of(const oracle::Horizon& horizon);

/// The whole report for people, with at most 20 rows in a table.
std::string text_of(const oracle::Horizon& horizon);

/// The whole report as one JSON object, for a scene of this name.
std::string json_of(const oracle::Horizon& horizon, const std::string& scene);

}  // namespace lorentz::report
