// Keys that a format does not have: warned about once each, or errors.
#pragma once

#include <set>
#include <string>

#include <lorentz/exchange.hpp>
#include "src/exchange/columns.hpp"

namespace lorentz {

enum class UnknownKeys { warned, errors };

/// What the help texts say of --strict of commands that read streams.
inline constexpr const char* kStrictKeysHelp = "a key that is not known is an error";

/// The keys of one stream or file.
class KeyCheck {
 public:
  /// `name` is the stream's, for messages.
  KeyCheck(std::string name, UnknownKeys policy) : name_(std::move(name)), policy_(policy) {}

  /// What a reader calls (ExchangeReader::on_unknown_key). Throws InputError if they are errors; else it
  /// warns of each key once, of the first kMost.
  void operator()(const std::string& key);

  std::size_t line = 0;  ///< where the reader is; 0: not said

 private:
  static constexpr std::size_t kMost = 20;

  std::string name_;
  UnknownKeys policy_;
  std::set<std::string> seen_;
};

/// What readers of columns call: the same of columns beside the known ones.
OnUnknownColumn unknown_columns(const std::vector<std::string>& known, UnknownKeys policy);

}  // namespace lorentz
