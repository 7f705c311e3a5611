// The Python literals in which headers of .npy files are written. Private to the formats.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace lorentz {

/// A string, an integer, True or False, None, a tuple or list, or a dictionary.
struct PythonValue {
  enum class Kind { string, integer, boolean, none, tuple, list, dictionary };
  Kind kind = Kind::none;
  std::string text;                ///< of a string
  std::int64_t number = 0;         ///< of an integer; of a boolean 0 or 1
  std::vector<PythonValue> items;  ///< of a tuple or list; of a dictionary its values
  std::vector<std::string> keys;   ///< of a dictionary; here they are strings

  bool is(Kind asked) const { return kind == asked; }
  const PythonValue* at(std::string_view key) const;
};

/// Reads the whole text, and ignores spaces. Throws InputError, also beyond 32 levels and for integers beyond
/// 64 bits.
PythonValue read_python_literal(std::string_view text);

}  // namespace lorentz
