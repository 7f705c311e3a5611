#include "cli/app.hpp"

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <iostream>

#include <lorentz/exchange.hpp>
#include "cli/completion.hpp"
#include "cli/exit_status.hpp"
#include "cli/file_options.hpp"
#include "cli/manual.hpp"
#include "cli/messages.hpp"
#include "cli/signals.hpp"
#include "cli/versions.hpp"
#include "compare/nearest_name.hpp"
#include "src/problem/write_error.hpp"

namespace lorentz::cli {
namespace {

std::string versions() {
  return fmt::format("lorentz {}\nexchange format 1\n{}", LORENTZ_VERSION,
                     fmt::join(library_versions(), "\n"));
}

// A subcommand, and what it is called on the command line.
struct Called {
  const CLI::App& app;
  std::string name;
};

// The one that the words ask for. It must exist, and so must its own; the parser itself would only say that
// one is required.
Called subcommand_of(const CLI::App& app, const std::string& before, int argc, char** argv) {
  const std::string name = (before.empty() ? "" : before + ' ') + app.get_name();
  const auto commands = app.get_subcommands({});
  if (argc < 2 && app.get_require_subcommand_min() > 0) {
    print(app.help(before));
    throw InputError("name a subcommand");
  }
  if (argc < 2 || argv[1][0] == '-' || commands.empty()) return {app, name};
  std::vector<std::string> names;
  for (const CLI::App* command : commands) {
    if (command->get_name() == argv[1]) return subcommand_of(*command, name, argc - 1, argv + 1);
    names.push_back(command->get_name());
  }
  throw InputError(fmt::format("no subcommand is called {}{}; there are {}", json_quoted(argv[1]),
                               compare::did_you_mean(argv[1], names), fmt::join(names, ", ")));
}

// Of the words that no option took those that look like options, with what they may have been meant for.
std::string unknown_options(const CLI::App& app, const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  std::string text;
  for (const std::string& word : app.remaining(true))
    if (word.starts_with('-'))
      text += fmt::format("{}{}{}", text.empty() ? "" : ", ", word, compare::did_you_mean(word, names));
  return text;
}

// "--count: 1 required N missing" in words.
std::string in_words(const std::string& error) {
  const std::string required = ": 1 required ", missing = " missing";
  const auto at = error.find(required);
  if (at == std::string::npos || !error.ends_with(missing)) return error;
  const auto value = error.substr(at + required.size());
  return error.substr(0, at) + ": needs a value, " + value.substr(0, value.size() - missing.size());
}

void parse(CLI::App& app, int argc, char** argv) {
  const Called command = subcommand_of(app, "", argc, argv);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) throw;  // --help, --version
    const std::string options = unknown_options(app, command.app);
    throw InputError(fmt::format("{}; {} --help has all",
                                 options.empty() ? in_words(error.what()) : "no such option: " + options,
                                 command.name));
  }
  check_files(command.app);
}

std::string& called() {
  static std::string line;
  return line;
}

// `lorentz help golden make` is what everyone tries: lorentz golden make --help.
void help_as_option(int argc, char** argv) {
  static char option[] = "--help";
  if (argc < 2 || std::string_view(argv[1]) != "help") return;
  std::rotate(argv + 1, argv + 2, argv + argc);
  argv[argc - 1] = option;
}

// What shells and the build ask for, and no person: not in --help.
bool serves(const CLI::App& app, int argc, char** argv) {
  const std::vector<std::string> words(argv + std::min(argc, 2), argv + argc);
  const std::string service = argc > 1 ? argv[1] : "";
  if (service == "--complete") {
    print(completions(app, words));
    return true;
  }
  if (service != "--manuals" || words.size() != 1) return false;
  write_manuals(app, words[0]);
  return true;
}

int parse_and_act(CLI::App& app, const Action& action, int argc, char** argv) {
  try {
    if (serves(app, argc, argv)) return kDone;
    help_as_option(argc, argv);
    parse(app, argc, argv);
    return action();
  } catch (const CLI::ParseError& help) {
    app.exit(help);  // prints it
    return kDone;
  } catch (const InputError& error) {
    say("{}", error.what());
    return kBadInput;
  } catch (const FileError& error) {
    say("{}", error.what());
    return kFailed;
  } catch (const std::bad_alloc&) {
    say("out of memory");
    return kFailed;
  } catch (const std::filesystem::filesystem_error& error) {  // its own text is for programmers
    say("{}: {}", error.path1().string(), error.code().message());
    return kFailed;
  } catch (const std::exception& error) {
    say_text(error.what(), Lines::kept);
    return kFailed;
  }
}

}  // namespace

const std::string& command_line() {
  return called();
}

void finish_output() {
  static bool is_lost = false;  // is said once
  if (is_lost) return;
  std::cout.flush();
  const bool flushed = std::fflush(stdout) == 0;
  is_lost = !flushed || std::ferror(stdout) || !std::cout;
  if (is_lost) throw write_error("standard output", errno);
}

int run(int argc, char** argv) {
  end_in_order();
  called() = "lorentz";
  for (int i = 1; i < argc; ++i) called() += ' ' + shell_quoted(argv[i]);
  CLI::App app{"Exact first hits in periodic Lorentz gases: the reference that engines are checked against."};
  app.name("lorentz");
  app.set_version_flag("--version", versions());
  app.require_subcommand(1);
  const std::string statuses =
      "Exit status: 0 done, 1 a wrong answer was found, 2 bad usage or bad input, 3 the work could not be "
      "done.";
  app.footer(statuses);  // also of subcommands that have none
  Action action;
  add_first_hit(app, action);
  add_compare(app, action);
  add_judge(app, action);
  add_convergents(app, action);
  add_horizon(app, action);
  add_sample(app, action);
  add_demo(app, action);
  add_bench(app, action);
  add_scene(app, action);
  add_golden(app, action);
  add_fuzz(app, action);
  add_flights(app, action);
  add_trajectory(app, action);
  add_survival(app, action);
  add_lyapunov(app, action);
  add_diffusion(app, action);
  add_doctor(app, action);
  app.footer(
      statuses +
      "\nExample: what is hit first from (0, 0.445) along (1, 0.0175), among discs of radius 0.1?\n"
      "  echo '{\"id\":1,\"x\":[0,0.445],\"v\":[1,0.0175]}' | lorentz first-hit --scene square --radius 0.1");
  const int status = parse_and_act(app, action, argc, argv);
  try {
    finish_output();
  } catch (const FileError& error) {
    say("{}", error.what());
    return kFailed;
  }
  return status;
}

}  // namespace lorentz::cli
