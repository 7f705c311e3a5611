#include "cli/golden_questions.hpp"

#include <algorithm>

#include <lorentz/claim.hpp>
#include "files/messages.hpp"

namespace lorentz::cli {

std::pair<std::string, std::string> tag_in(const std::string& text) {
  const std::size_t end = text.find('=');
  const std::string name = text.substr(0, end);
  const auto is_allowed = [](char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-'; };
  if (name.empty() || !std::all_of(name.begin(), name.end(), is_allowed))
    throw InputError("--tag: " + json_quoted(name) +
                     " is not a tag; expected small letters, digits and hyphens, and perhaps =SENTENCE");
  return {name, end == text.npos ? "given by --tag" : text.substr(end + 1)};
}

golden::GivenQuestions questions_in(GivenQueries& queries, golden::Header header, std::size_t& others) {
  golden::GivenQuestions all(std::move(header));
  std::vector<std::string> tags;
  for (const auto& [tag, note] : all.header.tags) tags.push_back(tag);
  for (GivenQuery given; queries.next(given);) {
    if (!queries.scene()) continue;
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
    if (!question.text.empty()) all.add(std::move(question));
  }
  return all;
}

void say_unproved(const golden::RecordCounts& counts) {
  if (counts.left_out > 0)
    say("{} questions were left out: their proofs take more steps than the checkers go through",
        counts.left_out);
}

void report(const std::string& name, const golden::RecordCounts& counts, const std::string& origin) {
  say("{}: {} records{}: {} hit, {} inside, {} never, {} error", name, counts.records, origin, counts.hits,
      counts.insides, counts.nevers, counts.errors);
  if (const std::uint64_t answered = counts.records - counts.errors; answered > 0)
    say("{}: all {} answers agreed by their checked certificates, {} of them by walk, too", name, answered,
        counts.walked);
  if (counts.needing_judge > 0)
    say("{}: {} records have the tag {}: their acceptable answers are not listed", name, counts.needing_judge,
        golden::kNeedsJudge);
  say_unproved(counts);
}

}  // namespace lorentz::cli
