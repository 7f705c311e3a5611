#include "cli/app.hpp"

#include <CLI/Version.hpp>
#include <cerrno>
#include <cstring>
#include <iostream>

#include <lorentz/exchange.hpp>
#include <lorentz/oracle.hpp>
#include <lorentz/walk.hpp>
#include "cli/exit_status.hpp"
#include "cli/messages.hpp"

namespace lorentz::cli {
namespace {

std::string versions() {
  return fmt::format("lorentz {}\nexchange format 1\n{}\n{}\n{}\nCLI11 {}\nfmt {}.{}.{}", LORENTZ_VERSION,
                     oracle::oracle_libraries(), oracle::walk_libraries(), exchange_libraries(),
                     CLI11_VERSION, FMT_VERSION / 10000, FMT_VERSION / 100 % 100, FMT_VERSION % 100);
}

// The subcommand that was meant must exist, and so must its own; the parser itself would only say that one is
// required.
void check_subcommand(const CLI::App& app, int argc, char** argv) {
  const auto commands = app.get_subcommands({});
  if (argc < 2 || argv[1][0] == '-' || commands.empty()) return;
  std::vector<std::string> names;
  for (const CLI::App* command : commands) {
    if (command->get_name() == argv[1]) return check_subcommand(*command, argc - 1, argv + 1);
    names.push_back(command->get_name());
  }
  throw InputError(
      fmt::format("no subcommand is called {}; there are {}", json_quoted(argv[1]), fmt::join(names, ", ")));
}

int parse_and_act(CLI::App& app, const Action& action, int argc, char** argv) {
  try {
    check_subcommand(app, argc, argv);
    app.parse(argc, argv);
    return action();
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kDone : kBadInput;
  } catch (const InputError& error) {
    say("{}", error.what());
    return kBadInput;
  } catch (const FileError& error) {
    say("{}", error.what());
    return kFailed;
  } catch (const std::bad_alloc&) {
    say("out of memory");
    return kFailed;
  } catch (const std::exception& error) {
    say("{}", error.what());
    return kFailed;
  }
}

}  // namespace

void finish_output() {
  std::cout.flush();
  const bool flushed = std::fflush(stdout) == 0;
  if (!flushed || std::ferror(stdout) || !std::cout)
    throw FileError(std::string("standard output: ") + std::strerror(errno));
}

int run(int argc, char** argv) {
  CLI::App app{"Exact first hits in periodic Lorentz gases: the reference that engines are checked against."};
  app.name("lorentz");
  app.set_version_flag("--version", versions());
  app.require_subcommand(1);
  app.failure_message([](const CLI::App* failed, const CLI::Error& error) {
    return "lorentz: " + CLI::FailureMessage::simple(failed, error);
  });
  app.footer(
      "Exit status: 0 done, 1 a wrong answer was found, 2 bad usage or bad input, 3 the work could not be "
      "done.");
  Action action;
  add_first_hit(app, action);
  add_compare(app, action);
  add_convergents(app, action);
  add_horizon(app, action);
  add_demo(app, action);
  add_bench(app, action);
  add_scene(app, action);
  add_golden(app, action);
  add_fuzz(app, action);
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
