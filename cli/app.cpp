#include "cli/app.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <deque>
#include <filesystem>
#include <system_error>

#include <lorentz/exchange.hpp>
#include "cli/file_options.hpp"
#include "cli/help_texts.hpp"
#include "cli/numbers.hpp"
#include "cli/output.hpp"
#include "report/files/signals.hpp"
#include "src/exchange/nearest_name.hpp"

namespace lorentz::cli {
namespace {

std::string versions() {
  return fmt::format("lorentz {}\nexchange format 1\n{}", LORENTZ_VERSION,
                     fmt::join(library_versions(), "\n"));
}

// ---- The parser's tree, built from the tables

// Numbers as typed, converted after all options are parsed. A deque, because addresses must stay valid.
using NumbersGiven = std::deque<std::pair<const Option&, std::optional<std::string>>>;

CLI::Option* add_option(CLI::App& app, const Option& option, NumbersGiven& numbers) {
  return std::visit(
      [&](auto target) -> CLI::Option* {
        using To = std::remove_pointer_t<decltype(target)>;
        if constexpr (std::is_same_v<To, std::monostate>)
          return app.get_option(option.name());
        else if constexpr (std::is_same_v<To, bool>)
          return app.add_flag(option.names, *target, option.help);
        else if constexpr (std::is_pointer_v<decltype(target)>)
          return app.add_option(option.names, *target, option.help)->type_name(option.type);
        else
          return app.add_option(option.names, numbers.emplace_back(option, std::nullopt).second, option.help)
              ->type_name(option.type)
              ->default_str(option.default_text());
      },
      option.target);
}

void add(CLI::App& app, const Command& command, NumbersGiven& numbers) {
  for (const Option& option : command.options) {
    CLI::Option* added = add_option(app, option, numbers);
    if (!option.default_text().empty() && added->get_default_str().empty()) added->capture_default_str();
    if (option.traits & kRequired) added->required();
    if (option.traits & kOneAtATime) added->allow_extra_args(false);
  }
  for (const Option& option : command.options)
    if (!option.excludes.empty()) app.get_option(option.name())->excludes(app.get_option(option.excludes));
  if (!command.commands.empty()) app.require_subcommand(command.act ? 0 : 1, 1);
  app.footer(command.footer);
  for (const Command& one : command.commands)
    add(*app.add_subcommand(one.name, one.description), one, numbers);
}

// ---- Parsing the words

// A subcommand, and its name on the command line.
struct Called {
  const Command& command;
  std::string name;
};

// The subcommand that the words name. It must exist, and its own subcommand, too. The parser alone would only
// report that a subcommand is required.
Called subcommand_of(CLI::App& app, const Command& command, const std::string& before, int argc,
                     char** argv) {
  const std::string name = (before.empty() ? "" : before + ' ') + command.name;
  if (argc < 2 && !command.act) {
    print(app.help(before));
    throw InputError("name a subcommand");
  }
  if (argc < 2 || argv[1][0] == '-' || command.commands.empty()) return {command, name};
  if (const Command* one = command.called(argv[1]))
    return subcommand_of(*app.get_subcommand(argv[1]), *one, name, argc - 1, argv + 1);
  std::vector<std::string> names;
  for (const Command& one : command.commands) names.push_back(one.name);
  throw InputError(fmt::format("no subcommand is called {}{}; there {} {}", json_quoted(argv[1]),
                               did_you_mean(argv[1], names), names.size() > 1 ? "are" : "is",
                               fmt::join(names, ", ")));
}

// The unparsed words that look like options, with suggestions of the intended options.
std::string unknown_options(const CLI::App& app, const Command& command) {
  std::vector<std::string> names;
  for (const Option& option : command.options)
    for (const std::string& name : option.long_names()) names.push_back(name);
  std::string text;
  for (const std::string& word : app.remaining(true))
    if (word.starts_with('-'))
      text += fmt::format("{}{}{}", text.empty() ? "" : ", ", word, did_you_mean(word, names));
  return text;
}

// Rewords a message such as "--count: 1 required N missing".
std::string in_words(const std::string& error) {
  const std::string required = ": 1 required ", missing = " missing";
  const auto at = error.find(required);
  if (at == std::string::npos || !error.ends_with(missing)) return error;
  const auto value = error.substr(at + required.size());
  return error.substr(0, at) + ": needs a value, " + value.substr(0, value.size() - missing.size());
}

// The subcommand that was parsed. Options of its parent may stand before its name.
const Command& parsed(const CLI::App& app, const Command& command) {
  const auto those = app.get_subcommands();
  return those.empty() ? command : parsed(*those[0], *command.called(those[0]->get_name()));
}

// Parses the words and returns the action to run.
const Action& parse(CLI::App& app, const Command& program, const NumbersGiven& numbers, int argc,
                    char** argv) {
  const Called called = subcommand_of(app, program, "", argc, argv);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) throw;  // --help, --version
    const std::string options = unknown_options(app, called.command);
    throw InputError(fmt::format("{}; {} --help has all",
                                 options.empty() ? in_words(error.what()) : "no such option: " + options,
                                 called.name));
  }
  const Command& command = parsed(app, program);
  check_files(command);
  for (const auto& [option, text] : numbers)
    if (text) take_number(option, *text);
  for (const Option& option : command.options)
    if (option.traits & kCommas) split_at_commas(option);
  return command.act;
}

std::string called;  // the shell line

// Supports `lorentz help golden make` as another form of `lorentz golden make --help`.
void help_as_option(int argc, char** argv) {
  static char option[] = "--help";
  if (argc < 2 || std::string_view(argv[1]) != "help") return;
  std::rotate(argv + 1, argv + 2, argv + argc);
  argv[argc - 1] = option;
}

int parse_and_act(CLI::App& app, const Command& program, const NumbersGiven& numbers, int argc, char** argv) {
  try {
    help_as_option(argc, argv);
    return parse(app, program, numbers, argc, argv)();
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
  } catch (const std::filesystem::filesystem_error& error) {  // its own text is meant for programmers
    say("{}: {}", error.path1().string(), error.code().message());
    return kFailed;
  } catch (const std::system_error& error) {
    const bool no_thread = error.code() == std::errc::resource_unavailable_try_again;
    say("{}{}", error.code().message(),
        no_thread ? ": no thread could be started; ask for fewer (--jobs 1), or allow more (ulimit -u)" : "");
    return kFailed;
  } catch (const std::exception& error) {
    say_text(error.what(), Lines::kept);
    return kFailed;
  }
}

// Adds the help option in front of each command's own rows.
void add_help(Command& command) {
  command.options.insert(command.options.begin(), {"-h,--help", {}, "", "Print this help message and exit"});
  for (Command& one : command.commands) add_help(one);
}

Command program() {
  Command program{
      "lorentz",
      "Exact first hits in periodic Lorentz gases: the reference that engines are checked against.",
      {},
      "Engines: " + names_for_help() +
          " (docs/command_engines.md).\n"
          "Exit status: 0 done, 1 a wrong answer was found, 2 bad usage or bad input, 3 the work could not "
          "be done.\n"
          "Example: what is hit first from (0, 0.445) along (1, 0.0175), among discs of radius 0.1?\n"
          "  lorentz first-hit --scene square --radius 0.1 --x 0,0.445 --v 1,0.0175",
      {},
      {first_hit_command(), compare_command(), judge_command(), convergents_command(), horizon_command(),
       sample_command(), demo_command(), doctor_command(), bench_command(), scene_command(), golden_command(),
       fuzz_command(), flights_command(), trajectory_command(), lyapunov_command(), diffusion_command()}};
  add_help(program);
  program.options.push_back({"--version", {}, "", "Display program version information and exit"});
  return program;
}

}  // namespace

const std::string& command_line() {
  return called;
}

int run(int argc, char** argv) {
  reserve_standard_streams();
  end_in_order();
  called = "lorentz";
  for (int i = 1; i < argc; ++i) called += ' ' + shell_quoted(argv[i]);
  const Command commands = program();
  CLI::App app{commands.description};
  app.name(commands.name);
  app.set_version_flag("--version", versions());
  NumbersGiven numbers;
  add(app, commands, numbers);
  const int status = parse_and_act(app, commands, numbers, argc, argv);
  try {
    finish_output();
  } catch (const FileError& error) {
    say("{}", error.what());
    return kFailed;
  }
  return status;
}

}  // namespace lorentz::cli
