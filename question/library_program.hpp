// `lib:FILE.so`: the program that makes a `cmd:` engine of a shared library (question/library_host/main.cpp).
#pragma once

#include <string>

#include "question/process.hpp"

namespace lorentz::question {

/// `threads`: for the library. `row_by_row`: it gets one query a call, so that the one that it dies of shows.
/// Throws FileError if there is no room for the program.
Executable library_program(const std::string& file, int threads, bool row_by_row);

}  // namespace lorentz::question
