// One algorithm in several precisions, so that what precision costs, and what it buys, can be seen. The
// algorithm is the published one (docs/published.md), whose binary64 is the engine `published`.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <lorentz/engine.hpp>

namespace lorentz::question {

/// "published-float" (binary32), "published-dd" (double-double, some 106 bits), "published-128" and
/// "published-256" (so many bits).
std::vector<std::string> precision_names();

/// The engine of this name for a scene without flaws, or null for another name. Everything is computed in its
/// numbers, from the roots of the start to the time, which is rounded to a binary64 at the end. Scenes other
/// than one ball in each cell of the unit square or cubic lattice, of radius 1/2 or less, are `unsupported`.
std::unique_ptr<Engine> make_precision(std::string_view name, const Scene& scene);

}  // namespace lorentz::question
