// Keys that a format does not have: each gives one warning, or an error.
#pragma once

#include <set>
#include <string>

#include <lorentz/exchange.hpp>
#include "src/exchange/columns.hpp"

namespace lorentz {

/// The help text of --strict for commands that read streams.
inline constexpr const char* kStrictKeysHelp = "a key that is not known is an error";

/// The keys of one stream or file.
class KeyCheck {
 public:
  /// `name` is the stream's name, for messages. If `strict`, unknown keys are errors.
  KeyCheck(std::string name, bool strict) : name_(std::move(name)), strict_(strict) {}

  /// Called by a reader (ExchangeReader::on_unknown_key). Throws InputError if they are errors; else
  /// warns once about each of the first 20 keys.
  void operator()(const std::string& key);

  std::size_t line = 0;  ///< where the reader is; 0: unknown

 private:
  std::string name_;
  bool strict_;
  std::set<std::string> seen_;
};

/// Called by readers of columns: the same for columns that are not known.
OnUnknownColumn unknown_columns(const std::vector<std::string>& known, bool strict);

}  // namespace lorentz
