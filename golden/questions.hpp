// The records of a golden set as questions.
#pragma once

#include "golden/reader.hpp"
#include "question/question.hpp"

namespace lorentz::golden {

/// The next records; `where` is the record's id. Throws as the reader does. The reader must outlast the source.
/// Judged by the claim; margins are those of the records, of binary64 only.
question::Source questions_of(Reader& reader, const Claim& claim = {});

}  // namespace lorentz::golden
