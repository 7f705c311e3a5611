// `cmd:COMMAND`: an external program as an engine, which reads a query stream and writes an answer stream.
// docs/command_engines.md says what it is asked and how its faults are treated.
#pragma once

#include <memory>
#include <string>

#include "question/answerer.hpp"

namespace lorentz::question {

/// Each query gets one answer, in order: an `error` if the program gives none. A program that dies or falls
/// silent is started again for the queries after the one at fault.
std::unique_ptr<Answerer> command_engine(std::string command, const AnswererOptions& options);

}  // namespace lorentz::question
