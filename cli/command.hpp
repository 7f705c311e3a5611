// A subcommand as data: its options are rows of a table, of which parsing, the check of files, completion and
// the manual pages are made (app.cpp hands them to the parser).
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace lorentz::cli {

/// What a subcommand does once its options are parsed; returns an ExitStatus.
using Action = std::function<int()>;

/// Numbers: a whole one from `least` to `most`, with a default or to be left out; one above zero; the
/// tolerance k of the verdicts.
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

/// Where an option's value goes: a flag's, that of an option with a default (none if empty), one that may be
/// left out, one that may be given several times; a number. Nothing: the parser's own.
using Destination = std::variant<std::monostate, bool*, std::string*, std::optional<std::string>*,
                                 std::vector<std::string>*, Whole, Positive, Tolerance>;

enum Trait : unsigned {
  kPlain = 0,
  kRequired = 1,
  kOutput = 2,       ///< names a file that is written, or (a store) written and read
  kCommas = 4,       ///< of several values: with commas between them
  kOneAtATime = 8,   ///< of several values: each with the option's name before it
  kHidden = 16,      ///< from help: for tests
  kToldDefault = 32  ///< its help line says what the default is
};

/// One option, or one argument.
struct Option {
  std::string names;  ///< "-e,--engine"; of an argument its name
  Destination target;
  std::string
      type;  ///< what help calls the value: FILE, N, .., or the values themselves, a|b|c; of a flag empty
  std::string help;
  unsigned traits = kPlain;
  std::string excludes = {};  ///< with which it cannot be given: "--queries"

  bool is_argument() const { return !names.starts_with('-'); }
  bool is_hidden() const { return traits & kHidden; }
  bool takes_value() const;
  bool takes_many() const { return std::holds_alternative<std::vector<std::string>*>(target); }

  std::vector<std::string> long_names() const;    ///< without dashes
  std::vector<std::string> short_names() const;   ///< without dashes
  std::string name() const;                       ///< "--engine", or the argument's
  bool is_called(const std::string& word) const;  ///< with dashes

  std::string default_text() const;         ///< before anything is parsed; empty: none
  std::vector<std::string> values() const;  ///< that it was given, or its default
};

struct Command {
  std::string name, description;
  std::vector<Option> options;
  std::string footer;
  Action act = {};  ///< nothing: it wants one of its commands
  std::vector<Command> commands = {};

  const Command* called(const std::string& name) const;  ///< one of its commands
  const Option* option_called(const std::string& word) const;
};

/// Rows that several commands share, before or behind a command's own.
std::vector<Option> joined(std::vector<Option> first, const std::vector<Option>& second);

}  // namespace lorentz::cli
