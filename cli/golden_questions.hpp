// Questions that are to become a golden set.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/command.hpp"
#include "cli/given_queries.hpp"
#include "golden/production.hpp"

namespace lorentz::cli {

/// The options that say which questions become records.
struct QuestionOptions {
  std::optional<std::string> queries, scene;
  std::optional<double> radius;
  std::vector<std::string> tags;

  std::vector<Option> rows();
  bool are_given() const { return queries || scene || radius || !tags.empty(); }

  /// The questions, with the tags of the options, which the header gets, too. `had_bad_input`: some were not valid, or
  /// do not consist of numbers of the header's precision. Throws InputError if no question can be a record.
  golden::GivenQuestions read(golden::Header header, bool& had_bad_input) const;
};

/// Throws InputError if --name is not one: small letters, digits and hyphens.
void check_set_name(const std::string& name);

/// All of them, each once, with the header's tags; the invalid ones, too, if they are JSON. Numbers that are not of the
/// header's precision are complained of, and left out (`others` counts them).
golden::GivenQuestions questions_in(GivenQueries& queries, golden::Header header, std::size_t& others);

/// A set that is made of given questions, in memory.
struct MadeSet {
  std::string text;
  golden::RecordCounts counts;
};
MadeSet made_set(const golden::GivenQuestions& given, std::uint64_t jobs = 1,
                 const golden::OnProgress& on_progress = {});

/// How many questions were left out, and why; on stderr, if any.
void say_unproved(const golden::RecordCounts& counts);

/// What was made, on stderr. `origin`: " (seed 5)".
void report(const std::string& name, const golden::RecordCounts& counts, const std::string& origin = "");

}  // namespace lorentz::cli
