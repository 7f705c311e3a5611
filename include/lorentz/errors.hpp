// Exceptions: invalid input, unsupported input, and file errors.
#pragma once

#include <stdexcept>

namespace lorentz {

/// Invalid input, in a file or from a caller: what() says where and why.
struct InputError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Valid input that an engine or a class does not support: what() says why.
struct UnsupportedError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A file that cannot be opened, read or written.
struct FileError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace lorentz
