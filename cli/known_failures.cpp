#include "cli/known_failures.hpp"

#include <fmt/format.h>

#include <sstream>

#include <lorentz/errors.hpp>
#include <lorentz/line_reader.hpp>

namespace lorentz::cli {

KnownFailures::KnownFailures(const std::string& path) {
  LineReader lines(path);
  for (LineReader::Line line; lines.next(line);) {
    std::istringstream words{std::string(line.text.substr(0, line.text.find('#')))};
    RecordKey record;
    if (!(words >> record.first)) continue;
    if (!(words >> record.second))
      throw InputError(
          fmt::format("{}:{}: expected a set and the id of a record, as in \"ties 9cbb135e0a1b2c3d\"",
                      lines.name(), line.number));
    known_.insert(record);
  }
}

bool KnownFailures::is_new(const RecordKey& record, bool failed) {
  const bool is_known = known_.contains(record);
  if (is_known && !failed) stale_.push_back(record);
  met_ += is_known && failed;
  return failed && !is_known;
}

std::string known_failures_text(const std::map<RecordKey, std::string>& failures) {
  std::string text = "# Known failures: the set, the record's id, the verdict.\n";
  for (const auto& [record, verdict] : failures)
    text += fmt::format("{} {} {}\n", record.first, record.second, verdict);
  return text;
}

namespace {

std::string in_xml(const std::string& text) {
  std::string out;
  for (const char c : text)
    out += c == '&'                                           ? "&amp;"
           : c == '<'                                         ? "&lt;"
           : c == '>'                                         ? "&gt;"
           : c == '"'                                         ? "&quot;"
           : static_cast<unsigned char>(c) < ' ' && c != '\n' ? "?"
                                                              : std::string(1, c);
  return out;
}

}  // namespace

void JUnit::add(const RecordKey& record, const std::optional<std::string>& failure) {
  Suite& suite = suites_[record.first];
  ++suite.cases, suite.failures += failure.has_value();
  suite.text +=
      fmt::format("    <testcase classname=\"{}\" name=\"{}\"", in_xml(record.first), in_xml(record.second));
  suite.text += failure ? fmt::format("><failure message=\"{}\"/></testcase>\n", in_xml(*failure)) : "/>\n";
}

std::string JUnit::text(const std::string& engine) const {
  std::string text =
      fmt::format("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"{}\">\n", in_xml(engine));
  for (const auto& [name, suite] : suites_)
    text += fmt::format("  <testsuite name=\"{}\" tests=\"{}\" failures=\"{}\">\n{}  </testsuite>\n",
                        in_xml(name), suite.cases, suite.failures, suite.text);
  return text + "</testsuites>\n";
}

}  // namespace lorentz::cli
