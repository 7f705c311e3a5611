// `cmd:COMMAND`: an external program as an engine, which reads a query stream and writes an answer stream; and
// `lib:FILE.so`, a shared library, which a program of ours asks. docs/command_engines.md says what they are
// asked and how their faults are treated.
#pragma once

#include <memory>
#include <string>

#include "question/answerer.hpp"
#include "question/process.hpp"

namespace lorentz::question {

/// Each query gets one answer, in order: an `error` if the program gives none. A program that dies or falls
/// silent is started again for the queries after the one at fault.
std::unique_ptr<Answerer> command_engine(const std::string& command, const AnswererOptions& options);
std::unique_ptr<Answerer> library_engine(const std::string& file, const AnswererOptions& options);

/// The program that makes a `cmd:` engine of a shared library (question/library_host/main.cpp).
/// `threads`: for the library. `row_by_row`: it gets one query a call, so that the one that it dies of shows.
/// Throws FileError if there is no room for the program.
Executable library_program(const std::string& file, int threads, bool row_by_row);

}  // namespace lorentz::question
