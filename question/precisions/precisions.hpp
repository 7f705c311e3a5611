// One algorithm in several precisions, to show what precision costs and what it gains. The algorithm is the
// published one (docs/published.md); in binary64 it is the engine `published`.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <lorentz/engine.hpp>

namespace lorentz::question {

/// "published-float" (binary32) and "published-256" (256 bits).
std::vector<std::string> precision_names();

/// The engine of this name for a valid scene, or null for another name. Everything is computed in its
/// numbers, from the roots of the start to the time, which is rounded to a binary64 at the end. Only scenes
/// with one ball of radius 1/2 or less in each cell of the unit square or cubic lattice are supported; others
/// are `unsupported`.
std::unique_ptr<Engine> make_precision(std::string_view name, const Scene& scene);

}  // namespace lorentz::question
