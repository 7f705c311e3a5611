// The records of a golden set as questions.
#pragma once

#include "golden/reader.hpp"
#include "question/question.hpp"

namespace lorentz::golden {

/// The next records; `where` is the record's id. Throws as the reader does. The reader must outlast the source.
/// Judged by the claim. Margins are those of the records if the claim's precision is the set's, else recomputed.
question::Source questions_of(Reader& reader, const Claim& claim = {});

}  // namespace lorentz::golden
