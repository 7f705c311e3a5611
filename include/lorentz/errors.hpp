// The two ways in which reading or writing goes wrong.
#pragma once

#include <stdexcept>

namespace lorentz {

/// Input that does not mean what it should: what() says where and why.
struct InputError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A file that cannot be opened, read or written.
struct FileError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace lorentz
