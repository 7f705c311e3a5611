// The engines of this program as answerers.
#pragma once

#include <functional>
#include <memory>

#include "question/scene_engine.hpp"

namespace lorentz::question {

/// Makes the engine for a valid scene.
using MakeSceneEngine = std::function<SceneEngine(const Scene&)>;

/// An engine in bulk gathers queries and flies them together; others answer at once.
std::unique_ptr<Answerer> own_answerer(const Traits& traits, MakeSceneEngine make,
                                       const AnswererOptions& options = {});

}  // namespace lorentz::question
