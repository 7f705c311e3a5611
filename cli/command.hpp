// A subcommand as data. Its options are rows of a table. The parser, the check of files and the
// manual pages use this table (app.cpp passes the rows to the parser).
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace lorentz::cli {

/// The exit status of the program. If several apply, it is the largest.
enum ExitStatus : int {
  kDone = 0,
  kDisagreement = 1,  ///< a wrong answer was found
  kBadInput = 2,      ///< bad usage or bad input
  kFailed = 3         ///< the work could not be done because of a file, a store or a subprocess
};

/// The action of a subcommand after its options are parsed. Returns an ExitStatus.
using Action = std::function<int()>;

/// Kinds of numbers: Whole is an integer from `least` to `most`, with a default or optional. Positive is a
/// number above zero. Tolerance is the tolerance k of the verdicts.
struct Whole {
  std::variant<std::uint64_t*, std::optional<std::uint64_t>*> to;
  std::uint64_t least = 0, most = ~std::uint64_t{0};
};
struct Positive {
  std::optional<double>* to;
};
struct Tolerance {
  std::optional<double>* to;
};

/// Where an option's value is stored: a flag, an option with a default (no default if empty), an optional
/// value, an option that may be given several times, a number. monostate: an option of the parser itself.
using Destination = std::variant<std::monostate, bool*, std::string*, std::optional<std::string>*,
                                 std::vector<std::string>*, Whole, Positive, Tolerance>;

enum Trait : unsigned {
  kPlain = 0,
  kRequired = 1,
  kOutput = 2,        ///< names a file that is written, or a store, which is written and read
  kCommas = 4,        ///< several values are separated by commas
  kOneAtATime = 8,    ///< each of several values follows the option's name
  kToldDefault = 16,  ///< its help line states the default
  kTakesStdout = 32   ///< an output that may be `-`, standard output
};

/// One option, or one argument.
struct Option {
  std::string names;  ///< "-e,--engine"; for an argument, its name
  Destination target;
  std::string
      type;  ///< the value's name in help: FILE, N, .., or the values themselves, a|b|c; empty for a flag
  std::string help;
  unsigned traits = kPlain;
  std::string excludes = {};  ///< an option with which it cannot be combined: "--queries"

  bool is_argument() const { return !names.starts_with('-'); }

  std::vector<std::string> long_names() const;  ///< with dashes, as all names here
  std::string name() const;                     ///< "--engine", or the argument's name
  bool is_called(const std::string& word) const;

  std::string default_text() const;         ///< valid before parsing; empty: no default
  std::vector<std::string> values() const;  ///< the given values, or the default
};

struct Command {
  std::string name, description;
  std::vector<Option> options;
  std::string footer;
  Action act = {};  ///< empty: one of its commands is required
  std::vector<Command> commands = {};

  const Command* called(const std::string& name) const;  ///< one of its commands
  const Option* option_called(const std::string& word) const;
};

/// Joins rows that several commands share with a command's own rows.
std::vector<Option> joined(std::vector<Option> first, const std::vector<Option>& second);

}  // namespace lorentz::cli
