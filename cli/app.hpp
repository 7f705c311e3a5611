// The program `lorentz`: one file per subcommand. Each declares its command here, with name and options.
#pragma once

#include <string>

#include "cli/command.hpp"

namespace lorentz::cli {

Command first_hit_command();
Command compare_command();
Command convergents_command();
Command horizon_command();
Command sample_command();
Command demo_command();
Command bench_command();
Command scene_command();
Command flights_command();
Command survival_command();
Command trajectory_command();
Command lyapunov_command();
Command diffusion_command();
Command fuzz_command();
Command judge_command();
Command golden_command();
Command doctor_command();

/// The shell line that called this program.
const std::string& command_line();

/// The parser library and its version.
std::string parser_library();

/// The whole program: parses, acts, and turns exceptions into messages and an exit status.
int run(int argc, char** argv);

}  // namespace lorentz::cli
