#include "cli/golden_questions.hpp"

#include <algorithm>
#include <cmath>

#include <lorentz/claim.hpp>
#include <lorentz/exchange.hpp>
#include "judge/golden/seen.hpp"
#include "report/files/messages.hpp"
#include "report/files/scene_file.hpp"
#include "src/exchange/exchange_json.hpp"

namespace lorentz::cli {
namespace {

bool is_name(const std::string& text) {
  const auto is_allowed = [](char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-'; };
  return !text.empty() && std::ranges::all_of(text, is_allowed);
}

// Parses "name" or "name=the sentence that explains it".
std::pair<std::string, std::string> tag_in(const std::string& text) {
  const std::size_t end = text.find('=');
  const std::string name = text.substr(0, end);
  if (!is_name(name))
    throw InputError("--tag: " + json_quoted(name) +
                     " is not a tag; expected small letters, digits and hyphens, and perhaps =SENTENCE");
  if (end + 1 == text.size()) throw InputError("--tag: " + name + "= lacks its sentence");
  return {name, end == text.npos ? "given by --tag" : text.substr(end + 1)};
}

bool is_given_by_program(const std::string& tag) {
  return tag == golden::kNeedsJudge ||
         std::ranges::any_of(golden::seen_tags(), [&](const auto& seen) { return seen.first == tag; });
}

// The tags, each once. The tags that the program gives itself are refused.
std::vector<std::pair<std::string, std::string>> tags_in(const std::vector<std::string>& texts) {
  std::vector<std::pair<std::string, std::string>> tags;
  for (const std::string& text : texts) {
    const auto tag = tag_in(text);
    const bool is_there =
        std::ranges::any_of(tags, [&](const auto& other) { return other.first == tag.first; });
    if (is_there || is_given_by_program(tag.first))
      throw InputError("--tag: " + tag.first + " is a tag already; name another");
    tags.push_back(tag);
  }
  return tags;
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
      json::each_element(value.array(), [&](json::Value tag) { tags.emplace_back(tag.text()); });
    });
  } catch (const json::Error&) {
    throw InputError(fmt::format("{}: query {}: tags: expected a list of texts", name, given.id));
  }
  for (const std::string& tag : tags)
    if (!is_name(tag))
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

std::vector<Option> QuestionOptions::rows() {
  return {{"--queries", &queries, "FILE",
           "records of these queries: a stream (- is standard input), or columns (.npy, .csv); invalid "
           "queries of a stream become records of errors"},
          {"--scene", &scene, "SCENE",
           "scene before the first scene line, and of columns: a file, or a name of the catalogue"},
          {"--radius", Positive{&radius}, "R", "radius of every ball of --scene"},
          {"--tag", &tags, "TAG[=SENTENCE]", "tag of each record of --queries", kOneAtATime}};
}

golden::GivenQuestions QuestionOptions::read(golden::Header header, bool& had_bad_input) const {
  const UnknownKeys unknown = UnknownKeys::warned;
  const NumberFormat precision = header.precision;
  header.tags = tags_in(tags);
  std::optional<Scene> first;
  if (scene) first = load_scene(*scene, radius, unknown);
  if (radius && !scene)
    throw InputError("--radius: needs --scene (the scenes of a stream say their radii themselves)");
  GivenQueries source(*queries, first, unknown);
  std::size_t others = 0;
  golden::GivenQuestions given = questions_in(source, std::move(header), others);
  given.look = true;
  if (others > 0)
    say("{}: {} queries left out, for they do not consist of numbers of {}", source.name(), others,
        name_of(precision));
  if (given.questions.empty())
    throw InputError(source.name() + ": no question in it can be a record; nothing is written");
  had_bad_input = source.had_bad_input() || others > 0;
  return given;
}

void check_set_name(const std::string& name) {
  if (!is_name(name))
    throw InputError("--name: " + json_quoted(name) +
                     " is not a name of a set; expected small letters, digits and hyphens");
}

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

MadeSet made_set(const golden::GivenQuestions& given, std::uint64_t jobs,
                 const golden::OnProgress& on_progress) {
  MadeSet made;
  const golden::Order order{.count = given.questions.size(), .jobs = jobs, .given = &given};
  made.counts = golden::produce(
      order, [&](std::string_view more) { made.text += more; }, on_progress);
  return made;
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
