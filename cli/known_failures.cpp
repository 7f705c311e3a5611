#include "cli/known_failures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <sstream>

#include <lorentz/errors.hpp>
#include "cli/output.hpp"
#include "report/pictures/svg.hpp"

namespace lorentz::cli {

using pictures::xml_escaped;

namespace {

std::string baseline_text(const std::map<RecordKey, std::string>& failures) {
  std::string text = "# Known failures: the set, the record's id, the verdict.\n";
  for (const auto& [record, verdict] : failures)
    text += fmt::format("{} {} {}\n", record.first, record.second, verdict);
  return text;
}

// The set's name as one word of a line.
std::string word_of(std::string set) {
  for (char& c : set)
    if (std::isspace(static_cast<unsigned char>(c)) || c == '#') c = '-';
  return set.empty() ? "-" : set;
}

// Prints the first lines, and the number of further lines.
void say_first(const std::vector<std::string>& lines) {
  constexpr std::size_t kMost = 10;
  for (std::size_t i = 0; i < std::min(lines.size(), kMost); ++i) say("{}", lines[i]);
  if (lines.size() > kMost) say("and {} more", lines.size() - kMost);
}

// A file of another kind has words, too.
void check_is_list(const std::string& text, const std::string& name) {
  const std::size_t first = std::min(text.find_first_not_of(" \t\r\n"), text.size());
  const bool is_binary = std::ranges::any_of(
      text, [](unsigned char c) { return c < ' ' && c != '\n' && c != '\t' && c != '\r'; });
  const char begin = first < text.size() ? text[first] : '#';
  const char* kind = is_binary                      ? "is a binary file"
                     : begin == '{' || begin == '[' ? "is JSON"
                     : begin == '<'                 ? "is XML"
                                                    : nullptr;
  if (kind)
    throw InputError(
        fmt::format("--baseline: {} {}, not a list of known failures as --baseline writes it", name, kind));
}

// The records that a baseline names, and the lines that do.
std::map<RecordKey, std::size_t> records_in(const std::string& text, const std::string& name) {
  check_is_list(text, name);
  std::map<RecordKey, std::size_t> records;
  std::istringstream lines(text);
  std::size_t number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    std::istringstream words(line.substr(0, line.find('#')));
    RecordKey record;
    if (!(words >> record.first)) continue;
    if (!(words >> record.second))
      throw InputError(fmt::format(
          "{}:{}: expected a set and the id of a record, as in \"ties 9cbb135e0a1b2c3d\"", name, number));
    records.emplace(record, number);
  }
  return records;
}

}  // namespace

Option FailureFiles::baseline_row() {
  return {"--baseline", &baseline, "FILE",
          "failures that are known, lines \"SET ID\" (SET: the set, row or target): only others count, and "
          "lines that no longer fail are reported. If FILE does not exist, the failures of this run are "
          "written to it",
          kOutput};
}

Option FailureFiles::junit_row() {
  return {"--junit", &junit, "FILE", "write a report in JUnit's XML there", kOutput};
}

std::optional<std::string> FailureFiles::first_option() const {
  return baseline ? std::optional<std::string>("--baseline")
         : junit  ? std::optional<std::string>("--junit")
                  : std::nullopt;
}

std::optional<std::string> failure_of(const oracle::Judgement& judgement, bool times, bool strict) {
  using oracle::Verdict;
  switch (judgement.verdict) {
    case Verdict::wrong:
      return "wrong";
    case Verdict::error:
      return "error";
    case Verdict::missing:
      return "missing";
    case Verdict::ill_posed:
      return strict ? std::optional("ill-posed") : std::nullopt;
    case Verdict::undecided:
      return strict ? std::optional("undecided") : std::nullopt;
    default:
      return times && judgement.wrong_time ? std::optional("wrong-time") : std::nullopt;
  }
}

FailureLedger::FailureLedger(const FailureFiles& files)
    : makes_junit_(files.junit.has_value()),
      baseline_(files.baseline.value_or("")),
      junit_file_(files.junit) {
  if (!files.baseline) return;
  std::error_code error;
  if (std::filesystem::exists(*files.baseline, error))
    known_ = records_in(text_of_file(*files.baseline), *files.baseline);
  else
    baseline_file_.emplace(files.baseline);
}

bool FailureLedger::take(const std::string& set, const std::string& id,
                         const std::optional<std::string>& failure) {
  const RecordKey record{word_of(set), id};
  const bool is_known = known_ && known_->contains(record), is_new = failure && !is_known;
  if (is_known) {
    asked_.insert(record);
    if (!failure) stale_.push_back(record);
    met_ += failure.has_value();
  }
  number_of_new_ += is_new;
  if (is_new && known_) new_.push_back(fmt::format("new: {} {} {}", record.first, record.second, *failure));
  if (failure && baseline_file_) failures_.emplace(record, *failure);
  if (makes_junit_) add_case(record, failure, is_known);
  return is_new;
}

std::size_t FailureLedger::failures(const question::Counts& counts, bool times, bool strict) const {
  using question::Count;
  if (known_) return number_of_new_;
  return counts.sum({Count::wrong, Count::error, Count::missing}) + (times ? counts[Count::wrong_time] : 0) +
         (strict ? counts.sum({Count::ill_posed, Count::undecided, Count::nonsense}) : 0);
}

void FailureLedger::end(const std::string& set) {
  if (!known_) return;
  const std::string word = word_of(set);
  for (auto known = known_->lower_bound({word, ""}); known != known_->end() && known->first.first == word;
       ++known)
    if (!asked_.contains(known->first)) stale_.push_back(known->first);
}

void FailureLedger::finish(const std::string& engine) {
  if (known_) {
    say("{} failures are known, {} are new", met_, number_of_new_);
    say_first(new_);
    std::vector<std::string> stale;
    for (const auto& [set, id] : stale_)
      stale.push_back(fmt::format("stale: {} {} fails no more; take it out of the baseline", set, id));
    say_first(stale);
  }
  if (baseline_file_) {
    baseline_file_->write([&] { return baseline_text(failures_); });
    say("--baseline: there was no such file; it has the {} failures of this run now", failures_.size());
  }
  junit_file_.write([&] { return junit_text(engine); });
}

void FailureLedger::add_case(const RecordKey& record, const std::optional<std::string>& failure,
                             bool is_known) {
  Suite& suite = suites_[record.first];
  ++suite.cases;
  suite.text += fmt::format("    <testcase classname=\"{}\" name=\"{}\"", xml_escaped(record.first),
                            xml_escaped(record.second));
  std::string element = "/>\n";
  if (failure && is_known) {
    ++suite.skipped;
    const std::string why = fmt::format("{}; known by {}:{}", *failure, baseline_, known_->at(record));
    element = fmt::format("><skipped message=\"{}\"/></testcase>\n", xml_escaped(why));
  } else if (failure) {
    ++suite.failures;
    element = fmt::format("><failure message=\"{}\"/></testcase>\n", xml_escaped(*failure));
  }
  suite.text += element;
}

std::string FailureLedger::junit_text(const std::string& engine) const {
  std::string text = fmt::format("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"{}\">\n",
                                 xml_escaped(engine));
  for (const auto& [name, suite] : suites_)
    text += fmt::format(
        "  <testsuite name=\"{}\" tests=\"{}\" failures=\"{}\" skipped=\"{}\">\n{}  </testsuite>\n",
        xml_escaped(name), suite.cases, suite.failures, suite.skipped, suite.text);
  return text + "</testsuites>\n";
}

}  // namespace lorentz::cli
