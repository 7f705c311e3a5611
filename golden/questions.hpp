// The records of a golden set as questions.
#pragma once

#include "golden/reader.hpp"
#include "question/question.hpp"

namespace lorentz::golden {

/// The next records; `where` is the record's id. Throws as the reader does. The reader must outlast the source.
question::Source questions_of(Reader& reader);

}  // namespace lorentz::golden
