// What `lorentz horizon` says in its first line, for others who want to know.
#pragma once

#include <string>

#include <lorentz/horizon.hpp>

namespace lorentz::cli {

/// Finite, infinite with the number of directions, or not known. `limited`: narrow channels were left out.
std::string verdict_of(const oracle::Horizon& horizon, bool limited);

}  // namespace lorentz::cli
