#include "cli/golden_questions.hpp"

#include <algorithm>
#include <cmath>

#include <lorentz/claim.hpp>
#include <lorentz/exchange.hpp>
#include "judge/golden/maker.hpp"
#include "report/files/messages.hpp"
#include "src/exchange/exchange_json.hpp"

namespace lorentz::cli {

bool is_set_name(const std::string& text) {
  const auto is_allowed = [](char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-'; };
  return !text.empty() && std::ranges::all_of(text, is_allowed);
}

namespace {

bool is_given_by_program(const std::string& tag) {
  return tag == golden::kNeedsJudge ||
         std::ranges::any_of(golden::seen_tags(), [&](const auto& seen) { return seen.first == tag; });
}

// The tags in the key `tags` of a query's line, except those that the program gives itself. Throws
// InputError.
std::vector<std::string> tags_in_line(const GivenQuery& given, const std::string& name) {
  std::vector<std::string> tags;
  if (given.line.find("\"tags\"") == given.line.npos) return tags;
  try {
    json::Document document;
    document.open(given.line);
    json::each_member(document.object(), [&](std::string_view key, json::Value value) {
      if (key != "tags") return skip(value);
      json::each_element(value, [&](json::Value tag) { tags.emplace_back(tag.text()); });
    });
  } catch (const NotJson&) {
    throw InputError(fmt::format("{}: query {}: tags: expected a list of texts", name, given.id));
  }
  for (const std::string& tag : tags)
    if (!is_set_name(tag))
      throw InputError(
          fmt::format("{}: query {}: tags: {} is not a tag; expected small letters, digits and hyphens", name,
                      given.id, json_quoted(tag)));
  std::erase_if(tags, is_given_by_program);
  return tags;
}

void add_tag(const std::string& tag, golden::SetQuestion& question, golden::Header& header) {
  if (std::ranges::find(question.tags, tag) == question.tags.end()) question.tags.push_back(tag);
  if (!header.explains(tag)) header.tags.emplace_back(tag, "given by the key tags of a query");
}

}  // namespace

golden::GivenQuestions questions_in(GivenQueries& queries, golden::Header header, std::size_t& others) {
  golden::GivenQuestions all(std::move(header));
  std::vector<std::string> tags;
  for (const auto& [tag, note] : all.header.tags) tags.push_back(tag);
  std::size_t repeated = 0;
  for (GivenQuery given; queries.next(given);) {
    if (!queries.scene()) continue;
    if (std::isfinite(given.max_time))
      throw InputError(fmt::format("{}: query {}: has a limit (max_time), which no record has; leave it out",
                                   queries.name(), given.id));
    const Scene& scene = *queries.scene();
    golden::SetQuestion question{scene, golden::question_in(given.line), given.query, tags};
    if (given.id != "null") question.source_id = given.id;
    if (given.query) {
      question.text = golden::question_of(*given.query, scene);
      if (!consists_of(scene, all.header.precision) || !consists_of(*given.query, all.header.precision)) {
        ++others;
        continue;
      }
    }
    if (question.text.empty()) continue;
    for (const std::string& tag : tags_in_line(given, queries.name())) add_tag(tag, question, all.header);
    repeated += !all.add(std::move(question));
  }
  if (repeated > 0)
    say("{}: {} questions come more than once; a record has the id of the first", queries.name(), repeated);
  return all;
}

std::pair<std::string, golden::RecordCounts> made_set(const golden::GivenQuestions& given) {
  std::string text;
  const golden::Order order{.count = given.questions.size(), .given = &given};
  const golden::RecordCounts counts =
      golden::produce(order, [&](std::string_view more) { text += more; }, {});
  return {std::move(text), counts};
}

void say_unproved(const golden::RecordCounts& counts) {
  if (counts.left_out > 0)
    say("{} questions were left out: their proofs take more steps than the checkers go through",
        counts.left_out);
}

}  // namespace lorentz::cli
