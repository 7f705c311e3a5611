// What there is to say of the channels of a scene, and of the closed directions of rows.
#pragma once

#include <cstddef>
#include <string>

#include <lorentz/horizon.hpp>

namespace lorentz::report {

/// Finite, infinite with the number of directions, or not known. `limited`: narrow channels were left out.
std::string verdict_of(const oracle::Horizon& horizon, bool limited);

/// All of it for people, `limit` rows of a table at most.
std::string text_of(const oracle::Horizon& horizon, std::size_t limit, bool limited);

/// All of it as one JSON object, of a scene of this name.
std::string json_of(const oracle::Horizon& horizon, const std::string& scene, bool limited);

/// Of one direction through a layer.
std::string text_of(const oracle::OpenDirection& found);
std::string json_of(const oracle::OpenDirection& found, const std::string& scene, const Vec& direction);

}  // namespace lorentz::report
