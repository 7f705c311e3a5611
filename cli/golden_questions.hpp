// Questions from which a golden set is made.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/command.hpp"
#include "cli/given_queries.hpp"
#include "judge/golden/production.hpp"

namespace lorentz::cli {

/// The options that select the questions for records.
struct QuestionOptions {
  std::optional<std::string> queries, scene;
  std::optional<double> radius;
  std::vector<std::string> tags;

  std::vector<Option> rows();
  bool are_given() const { return queries || scene || radius || !tags.empty(); }

  /// The questions with the tags of the options; the header gets these tags, too. `had_bad_input`: some
  /// questions were invalid, or their numbers do not have the header's precision. Throws InputError if no
  /// question can be a record.
  golden::GivenQuestions read(golden::Header header, bool& had_bad_input) const;
};

/// Throws InputError if --name is not a valid name: small letters, digits and hyphens.
void check_set_name(const std::string& name);

/// All queries, each once, with the header's tags; also the invalid ones, if they are JSON. Queries with
/// numbers that do not have the header's precision are reported and left out (`others` counts them).
golden::GivenQuestions questions_in(GivenQueries& queries, golden::Header header, std::size_t& others);

/// A set made from given questions, in memory.
struct MadeSet {
  std::string text;
  golden::RecordCounts counts;
};
MadeSet made_set(const golden::GivenQuestions& given, std::uint64_t jobs = 1,
                 const golden::OnProgress& on_progress = {});

/// Reports on stderr how many questions were left out, and why; silent if none were.
void say_unproved(const golden::RecordCounts& counts);

/// Reports on stderr which set was made. `origin`: for example " (seed 5)".
void report(const std::string& name, const golden::RecordCounts& counts, const std::string& origin = "");

}  // namespace lorentz::cli
