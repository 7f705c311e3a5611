// What the tests of golden sets share: records in files, and read again.
#pragma once

#include <functional>

#include "judge/golden/maker.hpp"
#include "judge/golden/production.hpp"
#include "judge/golden/reader.hpp"
#include "tests/support/command_line.hpp"
#include "tests/support/support.hpp"

namespace lorentz::test {

/// One record with its scene, made like those of a set.
struct GoldenCase {
  Scene scene;
  std::optional<Query> query;
  golden::Record record;
};

inline GoldenCase golden_case(const Scene& scene, const Query& query) {
  golden::Record record = golden::Maker(scene).make(golden::question_of(query, scene), query).record;
  record.tags.insert(record.tags.begin(), "drawn");
  return {scene, query, std::move(record)};
}

/// What the check of records says about it.
inline std::string flaw(const GoldenCase& c, bool ask_walk = false) {
  return golden::Maker(c.scene).flaw_of(c.record, c.query, ask_walk).value_or("");
}

inline std::string record_line(const golden::Record& record, const Components& count) {
  std::string line;
  golden::append_record_line(line, record, count);
  return line;
}

/// The text of a set of these records.
inline std::string set_of(const std::vector<GoldenCase>& cases) {
  std::string text;
  golden::append_header_line(text,
                             {.name = "drawn",
                              .description = "for a test",
                              .generator = "none",
                              .version = "0",
                              .count = cases.size(),
                              .tags = {{"drawn", "a tag"}, {golden::kNeedsJudge, golden::kNeedsJudgeNote}}});
  for (const GoldenCase& c : cases) {
    append_scene_line(text, c.scene);
    text += record_line(c.record, c.scene);
  }
  return text;
}

/// A question as it stands in a set, made into a record.
inline GoldenCase golden_case(const golden::Set& set, std::uint64_t seed, std::uint64_t index) {
  const golden::SetQuestion question = set.question(seed, index);
  golden::Record record = golden::Maker(question.scene).make(question.text, question.query).record;
  record.tags.insert(record.tags.begin(), question.tags.begin(), question.tags.end());
  return {question.scene, question.query, std::move(record)};
}

/// The beginning of a committed set, with the count of records that it has; in the file NAME.ndjson.
inline std::string beginning_of_set(const Folder& folder, const std::string& name, int most_lines) {
  std::ifstream in(LORENTZ_SOURCE_DIR "/data/golden/" + name + ".ndjson");
  std::string header, rest;
  std::getline(in, header);
  int records = 0;
  for (std::string line; most_lines > 1 && std::getline(in, line); --most_lines) {
    rest += line + '\n';
    records += line.starts_with("{\"id\"");
  }
  header.replace(header.find("\"count\":"), 11, "\"count\":" + std::to_string(records));
  folder.write(name + ".ndjson", header + '\n' + rest);
  return header + '\n' + rest;
}

/// What the text holds between `begin` and `end`.
inline std::string between(const std::string& text, const std::string& begin, const std::string& end) {
  const auto first = text.find(begin) + begin.size();
  return text.substr(first, text.find(end, first) - first);
}

}  // namespace lorentz::test
