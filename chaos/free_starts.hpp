// Drawn particles that lie in no obstacle.
#pragma once

#include <cstdint>

#include <lorentz/trajectory_batch.hpp>
#include "flights/starts/starts.hpp"

namespace lorentz::chaos {

/// Adds the starts [first, last), of each the first attempt that is free. Throws InputError if there is none.
void add_free_starts(const flights::Starts& starts, const Reduction& engine, std::uint64_t first,
                     std::uint64_t last, Particles& particles);

}  // namespace lorentz::chaos
