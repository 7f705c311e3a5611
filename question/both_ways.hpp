// The fast engines asked in two ways at once, as campaigns do. The two answers must be the same, or the reply is
// an error.
#pragma once

#include <functional>

#include "question/scene_engine.hpp"

namespace lorentz::question {

/// `reduction`: at once, and along a direction prepared for many starts (or by the function given here).
using FlyPrepared = std::function<Flight(const Reduction&, const Query&, double max_time)>;
SceneEngine reduction_both_ways(const Scene& scene, const Traits& traits, FlyPrepared prepared = {});

/// `batch`: together, and each query also alone (or by the function given here), to the bit.
using FlyAlone = std::function<Flight(const Batch&, const Query&, double max_time, Batch::Time)>;
SceneEngine batch_both_ways(const Scene& scene, const Traits& traits, FlyAlone alone = {});

}  // namespace lorentz::question
