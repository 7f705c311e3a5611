#include "judge/baseline.hpp"

#include <fmt/format.h>

#include "src/exchange/exchange_json.hpp"

namespace lorentz::judge {
namespace {

std::string text_in(json::Object object, const char* key) {
  return std::string(object[key].text());
}

std::size_t failed_of(const question::Tally& tally) {
  return tally.counts.sum({Count::wrong, Count::error, Count::missing});
}

std::pair<std::string, std::string> fault_of(const Finding& finding) {
  return {std::string(name_of(finding.severity())), std::string(name_of(finding.cause()))};
}

bool is_fault(Severity severity, bool times) {
  return severity == Severity::wrong || severity == Severity::error ||
         (times && severity == Severity::wrong_time);
}

}  // namespace

Baseline::Baseline(const std::string& json, const std::string& name) {
  try {
    json::Document document;
    document.open(json);
    json::Object report = document.object();
    if (text_in(report, "kind") != "judge")
      throw InputError(name + ": is not a report of `lorentz judge --json`");
    json::each_element(report["difficulties"].array(), [&](json::Value value) {
      json::Object row = value.object();
      rows_[text_in(row, "name")] = {
          row["queries"].natural(),
          row["wrong"].natural() + row["error"].natural() + row["missing"].natural()};
    });
    json::each_element(report["findings"].array(), [&](json::Value value) {
      json::Object finding = value.object();
      faults_.emplace(text_in(finding, "verdict"), text_in(finding, "cause"));
    });
  } catch (const json::Error& error) {
    throw InputError(fmt::format("{}: is not a report of `lorentz judge --json`: {}", name, error.what()));
  }
}

std::vector<std::string> Baseline::worse(const JudgeReport& report, bool times) const {
  std::vector<std::string> found;
  for (const Finding& finding : report.findings)
    if (is_fault(finding.severity(), times) && !faults_.contains(fault_of(finding)))
      found.push_back("new: " + finding.summary());
  for (const ExaminedRow& row : report.rows) {
    const auto before = rows_.find(row.name);
    const std::size_t failed = failed_of(row.tally);
    if (before == rows_.end() || before->second.queries != row.tally.queries ||
        failed <= before->second.failed)
      continue;
    found.push_back(fmt::format("{}: {} of {} answers are wrong, errors or missing, {} before", row.name,
                                failed, row.tally.queries, before->second.failed));
  }
  return found;
}

std::vector<std::string> Baseline::not_compared(const JudgeReport& report) const {
  std::vector<std::string> names;
  for (const ExaminedRow& row : report.rows)
    if (const auto before = rows_.find(row.name);
        row.asked() > 0 && (before == rows_.end() || before->second.queries != row.tally.queries))
      names.push_back(row.name);
  return names;
}

}  // namespace lorentz::judge
