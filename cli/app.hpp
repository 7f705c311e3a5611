// The program `lorentz`: a file for each subcommand, or for a few that belong together. Each declares its
// command here.
#pragma once

#include <string>
#include <vector>

#include "cli/command.hpp"

namespace lorentz::cli {

Command first_hit_command();
Command compare_command();
Command convergents_command();
Command horizon_command();
Command sample_command();
Command demo_command();
Command doctor_command();
Command bench_command();
Command scene_command();
Command flights_command();
Command trajectory_command();
Command lyapunov_command();
Command diffusion_command();
Command fuzz_command();
Command judge_command();
Command golden_command();

// lorentz scene draw.
Command scene_draw_command();

// The parts of `lorentz golden`.
Command golden_make_command();
Command golden_check_command();
Command golden_verify_command();
Command golden_explain_command();

// The parts of `lorentz fuzz`.
Command fuzz_show_command();

/// The shell line that called this program.
const std::string& command_line();

/// "GMP 6.2.1", ..: the libraries for computing, reading, storing and printing.
std::vector<std::string> library_versions();

/// The whole program: parses, acts, and turns exceptions into messages and an exit status.
int run(int argc, char** argv);

}  // namespace lorentz::cli
