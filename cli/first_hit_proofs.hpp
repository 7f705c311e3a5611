// lorentz first-hit --prove: writes answers with their proofs, line by line or as a golden set.
#pragma once

#include "cli/given_queries.hpp"
#include "question/answerer.hpp"

namespace lorentz::cli {

/// Adds `time_decimal` and `certificate` to each answer that is exactly right. Other answers are written
/// without them and counted. Returns the exit status.
int answer_with_proofs(QueryStream& stream, question::Answerer& answerer);

/// Writes a golden set of the exact answers. `source` is the source of the queries. Returns the exit status.
int write_records(GivenQueries& queries, const std::string& source);

}  // namespace lorentz::cli
