// What `lorentz horizon` says, for others who want to know.
#pragma once

#include <string>

#include <lorentz/horizon.hpp>

namespace lorentz::cli {

/// Finite, infinite with the number of directions, or not known. `limited`: narrow channels were left out.
std::string verdict_of(const oracle::Horizon& horizon, bool limited);

/// All of it as one JSON object, of a scene of this name.
std::string json_of(const oracle::Horizon& horizon, const std::string& scene, bool limited);

}  // namespace lorentz::cli
