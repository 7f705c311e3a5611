// The batch engine asked in two ways at once, as campaigns do. The two answers must be the same, or the reply is an
// error.
#pragma once

#include <functional>

#include "question/scene_engine.hpp"

namespace lorentz::question {

/// `batch`: together, and each query also alone (or by the function given here), to the bit.
using FlyAlone = std::function<Flight(const Batch&, const Query&, double max_time, Batch::Time)>;
SceneEngine batch_both_ways(const Scene& scene, const Traits& traits, FlyAlone alone = {});

}  // namespace lorentz::question
