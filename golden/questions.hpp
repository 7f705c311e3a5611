// The records of a golden set as questions.
#pragma once

#include "compare/question.hpp"
#include "golden/reader.hpp"

namespace lorentz::golden {

/// The next records; `where` is the record's id. Throws as the reader does. The reader must outlast the source.
compare::Source questions_of(Reader& reader);

}  // namespace lorentz::golden
