// What goes wrong: the input, what is asked of it, a file.
#pragma once

#include <stdexcept>

namespace lorentz {

/// Input that does not mean what it should, in a file or from a caller: what() says where and why.
struct InputError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Good input that an engine or a class does not do: what() says why.
struct UnsupportedError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A file that cannot be opened, read or written.
struct FileError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace lorentz
