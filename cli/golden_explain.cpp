// lorentz golden explain: shows one record in full.
#include <set>

#include <lorentz/exchange.hpp>
#include <lorentz/margin.hpp>
#include "cli/app.hpp"
#include "cli/case_report.hpp"
#include "cli/output.hpp"
#include "judge/golden/reader.hpp"
#include "judge/golden/sets.hpp"
#include "report/reason.hpp"
#include "report/table.hpp"

namespace lorentz::cli {
namespace {

// The record in question, with what its set says of it.
struct ExplainedRecord {
  std::string path, scene_line;
  golden::Header header;
  Scene scene;
  golden::ReadRecord read;
};

struct ExplainOptions {
  std::string id;
  std::vector<std::string> sets;
  CaseFiles files;
};

std::string passed_table(const std::vector<oracle::PassedObstacle>& passed, const ObstacleId& hit,
                         const Components& count) {
  report::Table table({"obstacle", "time nearest", "passed by (radii)", "margin (ulps)", ""});
  for (const oracle::PassedObstacle& one : passed)
    table.add({report::name_of(one.obstacle, count), one.time_decimal, fmt::format("{:.6g}", one.gap),
               fmt::format("{:.6g}", one.margin), one.obstacle == hit ? "hit" : ""});
  return table.text();
}

void explain(const ExplainedRecord& found) {
  constexpr std::size_t kMostPassed = 12;
  const golden::ReadRecord& read = found.read;
  const golden::Record& record = read.record;
  const Components count(found.scene);
  print(
      fmt::format("{}:{}: {}\n\n{}\n{}\n\n", found.path, read.line, record.id, found.scene_line, read.text));
  for (const auto& [tag, note] : found.header.tags)
    for (const std::string& own : record.tags)
      if (own == tag) print(fmt::format("{}: {}\n", tag, note));
  if (!read.query) {
    print(fmt::format("\nIt is not a valid query: {}. The answer is `error`.\n", read.flaw));
    return;
  }
  const NumberFormat precision = found.header.precision;
  const oracle::Margins margins(found.scene, precision);
  const Answer& expect = record.expect;
  const auto decision = margins.hardest_decision(*read.query, expect);
  if (expect.outcome == Outcome::never) {
    print(decision
              ? "\nNothing is ever hit.\n" + report::decision_text(*decision, count) + '\n'
              : "\nNothing is ever hit: the flight is periodic, and no row of obstacles along it is met. "
                "There is no margin.\n");
    return;
  }
  const bool hit = expect.outcome == Outcome::hit;
  print(fmt::format("\n{} {}{}\n", hit ? "It hits" : "It starts inside",
                    report::name_of(expect.obstacle, count), hit ? " at t = " + expect.time_decimal : ""));
  if (hit)
    print(fmt::format("An ulp in each input moves that time by up to {:.4g} of its ulps (its condition).\n",
                      margins.condition(*read.query, expect)));
  if (precision != NumberFormat::binary64)
    print(fmt::format("An ulp here is one of {}, of {} bits.\n", name_of(precision), bits_of(precision)));
  print(report::decision_text(*decision, count) + '\n');
  if (hit)
    print("\nThe nearest obstacles on the way (below 0: met):\n\n" +
          passed_table(margins.passed(*read.query, expect, kMostPassed), expect.obstacle, count));
}

// The tags say what the record is designed to break. They name the case, and their notes explain it.
CaseReport case_report(const ExplainedRecord& found, const ExplainOptions& options) {
  const golden::Record& record = found.read.record;
  CaseReport report;
  report.title = fmt::format("golden record {} of {}", record.id, found.header.name);
  report.command = "lorentz golden explain " + shell_quoted(record.id);
  for (const std::string& set : options.sets) report.command += ' ' + shell_quoted(set);
  report.command += options.files.as_typed();
  report.where = "golden " + found.header.name;
  report.verdict = "exact";
  for (const auto& [tag, note] : found.header.tags)
    for (const std::string& own : record.tags)
      if (own == tag) {
        report.cause += (report.cause.empty() ? "" : ", ") + tag;
        report.explanation += (report.explanation.empty() ? "" : "; ") + note;
      }
  if (report.cause.empty()) report.cause = found.header.name;
  report.claim.precision = found.header.precision;
  report.scene = found.scene;
  report.query = *found.read.query;
  report.exact = record.expect;
  if (record.condition)
    report.more.push_back(
        fmt::format("An ulp in each input moves the time by up to {:.4g} of its ulps{}.", *record.condition,
                    found.header.precision == NumberFormat::binary64 ? "" : ", which are of binary32"));
  return report;
}

int run_golden_explain(const ExplainOptions& options) {
  std::set<std::string> ids;
  std::optional<ExplainedRecord> found;  // the first
  for (const std::string& path : golden::find_sets(options.sets)) {
    golden::Reader reader(path);
    for (golden::ReadRecord read; reader.next(read);) {
      if (!read.record.id.starts_with(options.id)) continue;
      ids.insert(read.record.id);
      if (!found) found = {path, reader.scene_line(), reader.header(), reader.scene(), read};
    }
  }
  if (ids.empty()) throw InputError("no record has the id " + json_quoted(options.id));
  if (ids.size() > 1)
    throw InputError(fmt::format("{} records have ids that begin with {}; the first is {}", ids.size(),
                                 json_quoted(options.id), *ids.begin()));
  if (options.files.any() && !found->read.query)
    throw InputError(
        fmt::format("{}: the record is not a valid query, so there is nothing to draw", *ids.begin()));
  if (options.files.any()) options.files.write(case_report(*found, options));
  explain(*found);
  return kDone;
}

}  // namespace

Command golden_explain_command() {
  auto options = std::make_shared<ExplainOptions>();
  return {"explain",
          "One record in full: the line, the obstacles passed and by how much, the decision that is hard.",
          joined(
              {
                  {"id", &options->id, "TEXT", "the record's id, or its first characters", kRequired},
                  {"sets", &options->sets, "SET",
                   "files, folders, or names of committed sets, to look in (default: all of these)"},
              },
              options->files.rows()),
          "Example:\n  lorentz golden explain 9cbb135e --html record.html",
          [options] { return run_golden_explain(*options); }};
}

}  // namespace lorentz::cli
