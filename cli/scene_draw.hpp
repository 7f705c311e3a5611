// lorentz scene draw.
#pragma once

#include "cli/app.hpp"

namespace lorentz::cli {

void add_scene_draw(CLI::App& scene, Action& action);

}  // namespace lorentz::cli
