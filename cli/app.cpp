#include "app.hpp"

#include <fmt/core.h>
#include <gmp.h>
#include <simdjson.h>
#include <toml++/toml.h>
#include <CLI/Version.hpp>
#include <boost/version.hpp>

#include "exchange.hpp"
#include "exit_status.hpp"
#include "walk.hpp"

namespace lorentz::cli {
namespace {

std::string versions() {
  const auto dotted = [](int major, int minor, int patch) {
    return fmt::format("{}.{}.{}", major, minor, patch);
  };
  return fmt::format(
      "lorentz {}\nexchange format 1\nGMP {}\nCGAL {}\nBoost {}\nCLI11 {}\nfmt {}\nsimdjson {}\ntoml++ {}",
      LORENTZ_VERSION, gmp_version, oracle::walk_arithmetic(),
      dotted(BOOST_VERSION / 100000, BOOST_VERSION / 100 % 1000, BOOST_VERSION % 100), CLI11_VERSION,
      dotted(FMT_VERSION / 10000, FMT_VERSION / 100 % 100, FMT_VERSION % 100),
      dotted(simdjson::SIMDJSON_VERSION_MAJOR, simdjson::SIMDJSON_VERSION_MINOR,
             simdjson::SIMDJSON_VERSION_REVISION),
      dotted(TOML_LIB_MAJOR, TOML_LIB_MINOR, TOML_LIB_PATCH));
}

}  // namespace

int run(int argc, char** argv) {
  CLI::App app{"Exact first hits in periodic Lorentz gases: the reference that engines are checked against."};
  app.name("lorentz");
  app.set_version_flag("--version", versions());
  app.require_subcommand(1);
  app.footer(
      "Exit status: 0 done, 1 a wrong answer was found, 2 bad usage or bad input, 3 the work could not be "
      "done.");
  Action action;
  add_first_hit(app, action);
  add_compare(app, action);
  add_convergents(app, action);
  add_demo(app, action);
  try {
    app.parse(argc, argv);
    return action();
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kDone : kBadInput;
  } catch (const InputError& error) {
    fmt::print(stderr, "lorentz: {}\n", error.what());
    return kBadInput;
  } catch (const FileError& error) {
    fmt::print(stderr, "lorentz: {}\n", error.what());
    return kFailed;
  } catch (const std::bad_alloc&) {
    fmt::print(stderr, "lorentz: out of memory\n");
    return kFailed;
  }
}

}  // namespace lorentz::cli
