// Questions that are to become a golden set.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "cli/given_queries.hpp"
#include "golden/production.hpp"

namespace lorentz::cli {

/// "name" or "name=the sentence that explains it". Throws InputError.
std::pair<std::string, std::string> tag_in(const std::string& text);

/// All of them, each once, with these tags; the invalid ones, too, if they are JSON. Numbers that are not of the
/// header's precision are complained of, and left out (`others` counts them).
golden::GivenQuestions questions_in(GivenQueries& queries, golden::Header header, std::size_t& others);

/// How many questions were left out, and why; on stderr, if any.
void say_unproved(const golden::RecordCounts& counts);

/// What was made, on stderr. `origin`: " (seed 5)".
void report(const std::string& name, const golden::RecordCounts& counts, const std::string& origin = "");

}  // namespace lorentz::cli
