// The records of a golden set as questions.
#pragma once

#include "judge/golden/reader.hpp"
#include "question/question.hpp"

namespace lorentz::golden {

/// A source of the next records, judged by the claim; `where` is the record's id. Throws as the reader does.
/// The reader must outlast the source. Margins are those of the records if the claim's precision is the
/// set's; otherwise they are recomputed.
question::Source questions_of(Reader& reader, const Claim& claim = {});

}  // namespace lorentz::golden
