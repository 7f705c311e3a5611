// Questions from which a golden set is made.
#pragma once

#include <string>
#include <utility>

#include "cli/given_queries.hpp"
#include "judge/golden/production.hpp"

namespace lorentz::cli {

/// Whether a name of a set or of a tag is valid: small letters, digits and hyphens.
bool is_set_name(const std::string& text);

/// All queries, each once, with the header's tags; also the invalid ones, if they are JSON. Queries with
/// numbers that do not have the header's precision are reported and left out (`others` counts them).
golden::GivenQuestions questions_in(GivenQueries& queries, golden::Header header, std::size_t& others);

/// The text of a set that is made from given questions.
std::pair<std::string, golden::RecordCounts> made_set(const golden::GivenQuestions& given);

/// Reports on stderr how many questions were left out, and why; silent if none were.
void say_unproved(const golden::RecordCounts& counts);

}  // namespace lorentz::cli
