// `lib:FILE.so`: a shared library as an engine, asked by columns in a process of its own
// (docs/command_engines.md).
#pragma once

#include <memory>
#include <string>

#include "question/answerer.hpp"

namespace lorentz::question {

/// Each query gets one answer, in order: an `error` if the library gives none. After a crash or a timeout the
/// process is started again.
std::unique_ptr<Answerer> library_engine(std::string file, const AnswererOptions& options);

}  // namespace lorentz::question
