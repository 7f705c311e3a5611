#include "cli/known_failures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <sstream>

#include <lorentz/errors.hpp>
#include "cli/output.hpp"

namespace lorentz::cli {

KnownFailures::KnownFailures(const std::string& text, const std::string& name) {
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
    known_.insert(record);
  }
}

bool KnownFailures::is_new(const RecordKey& record, bool failed) {
  const bool is_known = known_.contains(record);
  if (is_known) asked_.insert(record);
  if (is_known && !failed) stale_.push_back(record);
  met_ += is_known && failed;
  return failed && !is_known;
}

void KnownFailures::end(const std::string& set) {
  for (auto record = known_.lower_bound({set, ""}); record != known_.end() && record->first == set; ++record)
    if (!asked_.contains(*record)) stale_.push_back(*record);
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

std::optional<KnownFailures> FailureFiles::known() const {
  return baseline ? std::optional(KnownFailures(text_of_file(*baseline), *baseline)) : std::nullopt;
}

Option FailureFiles::baseline_row(const std::string& baseline_help) {
  return {"--baseline", &baseline, "FILE",
          baseline_help.empty()
              ? "failures that are known, lines \"SET ID\": only others count, and stale lines are told of"
              : baseline_help};
}

Option FailureFiles::write_baseline_row() {
  return {"--write-baseline", &write_baseline, "FILE", "write all failures there as such a file", kOutput};
}

Option FailureFiles::junit_row() {
  return {"--junit", &junit, "FILE", "write a report in JUnit's XML there", kOutput};
}

std::optional<std::string> FailureFiles::first_option() const {
  if (baseline) return "--baseline";
  if (write_baseline) return "--write-baseline";
  return junit ? std::optional<std::string>("--junit") : std::nullopt;
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

}  // namespace

FailureLedger::FailureLedger(const FailureFiles& files, std::optional<KnownFailures> known)
    : known_(std::move(known)), baseline_file_(files.write_baseline), junit_file_(files.junit) {
  if (files.junit) junit_.emplace();
}

bool FailureLedger::take(const std::string& set, const std::string& id,
                         const std::optional<std::string>& failure) {
  const RecordKey record{word_of(set), id};
  const bool is_new = known_ ? known_->is_new(record, failure.has_value()) : failure.has_value();
  if (is_new) new_.push_back(fmt::format("new: {} {} {}", record.first, record.second, *failure));
  if (failure) failures_.emplace(record, *failure);
  if (junit_) junit_->add(record, is_new ? failure : std::nullopt);
  return is_new;
}

void FailureLedger::end(const std::string& set) {
  if (known_) known_->end(word_of(set));
}

void FailureLedger::finish(const std::string& engine) {
  if (known_) {
    say("{} failures are known, {} are new", known_->number_met(), new_.size());
    say_first(new_);
    std::vector<std::string> stale;
    for (const auto& [set, id] : known_->stale())
      stale.push_back(fmt::format("stale: {} {} fails no more; take it out of the baseline", set, id));
    say_first(stale);
  }
  baseline_file_.write([&] { return baseline_text(failures_); });
  junit_file_.write([&] { return junit_->text(engine); });
}

}  // namespace lorentz::cli
