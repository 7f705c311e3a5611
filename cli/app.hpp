// The program `lorentz`: one file per subcommand, each of which adds itself here.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>

namespace lorentz::cli {

/// What a subcommand does once its options are parsed; returns an ExitStatus.
using Action = std::function<int()>;

void add_first_hit(CLI::App& app, Action& action);
void add_compare(CLI::App& app, Action& action);
void add_convergents(CLI::App& app, Action& action);
void add_horizon(CLI::App& app, Action& action);
void add_sample(CLI::App& app, Action& action);
void add_demo(CLI::App& app, Action& action);
void add_bench(CLI::App& app, Action& action);
void add_scene(CLI::App& app, Action& action);
void add_flights(CLI::App& app, Action& action);
void add_survival(CLI::App& app, Action& action);
void add_trajectory(CLI::App& app, Action& action);
void add_lyapunov(CLI::App& app, Action& action);
void add_diffusion(CLI::App& app, Action& action);
void add_fuzz(CLI::App& app, Action& action);
void add_judge(CLI::App& app, Action& action);
void add_golden(CLI::App& app, Action& action);
void add_doctor(CLI::App& app, Action& action);

/// The shell line that this program was called with.
const std::string& command_line();

/// The whole program: parses, acts, and turns exceptions into messages and an exit status.
int run(int argc, char** argv);

}  // namespace lorentz::cli
