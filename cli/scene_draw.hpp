// lorentz scene draw.
#pragma once

#include "cli/command.hpp"

namespace lorentz::cli {

Command scene_draw_command();

}  // namespace lorentz::cli
