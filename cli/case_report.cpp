#include "cli/case_report.hpp"

#include <fmt/format.h>

#include <lorentz/exchange.hpp>
#include "report/claim_words.hpp"
#include "report/files/messages.hpp"
#include "report/files/whole_file.hpp"
#include "report/manifest.hpp"
#include "report/page.hpp"
#include "report/pictures/finding_drawing.hpp"
#include "report/query_text.hpp"
#include "report/reason.hpp"
#include "src/exchange/exchange_write.hpp"

namespace lorentz::cli {
namespace {

// Commands that reproduce this answer with the program alone.
std::vector<std::string> commands_of(const CaseReport& report) {
  const std::string lines = report::printed(report.scene, report::query_members(report.query, report.scene));
  std::vector<std::string> commands{report.command, lines + " | lorentz first-hit --engine oracle --detail"};
  if (!report.engine.empty())
    commands.push_back(fmt::format("{} | lorentz compare --queries - --engine {}{}", lines,
                                   shell_quoted(report.engine),
                                   report::arguments_of(report.claim, report.ulps)));
  return commands;
}

std::vector<std::string> reason_lines(const CaseReport& report, const oracle::Margins& margins) {
  std::vector<std::string> lines;
  if (report.given) {
    lines =
        report::reason_of(margins, report.scene, report.query, report.exact, *report.given, report.decisive);
  } else if (const auto decision = margins.hardest_decision(report.query, report.exact)) {
    lines.push_back(report::decision_text(*decision, report.scene));
  }
  lines.insert(lines.end(), report.more.begin(), report.more.end());
  return lines;
}

std::optional<double> radii_of(const CaseReport& report, const oracle::Margins& margins) {
  if (!report.given) return std::nullopt;
  const auto dispute =
      report::dispute_of(margins, report.scene, report.query, report.exact, *report.given, report.decisive);
  return dispute ? std::optional(dispute->radii) : std::nullopt;
}

// The drawing, or an empty text if there is nothing to draw.
std::string drawing_of(const CaseReport& report) {
  return pictures::finding_drawing(report.scene, report.query, report.given, report.exact, report.decisive,
                                   report.claim.precision);
}

void add_report(json::Members& object, const CaseReport& report) {
  const Components dimension(report.scene);
  const oracle::Margins margins(report.scene, report.claim.precision);
  const std::string drawing = drawing_of(report);
  object.add("cause", report.cause, "explanation", report.explanation, "count", 1, "where", report.where,
             "verdict", report.verdict, "scene", report.scene, "query",
             json::Raw{report::hexadecimal_query(report.query, dimension)});
  object.add("given", report.given ? std::optional(json_of(*report.given, dimension)) : std::nullopt, "exact",
             json_of(report.exact, dimension), "by_radii", json::finite(radii_of(report, margins)), "by_ulps",
             json::finite(report.by_ulps), "reason", reason_lines(report, margins), "commands",
             commands_of(report), "drawing", drawing.empty() ? std::nullopt : std::optional(drawing));
}

// The report of kind "case" with one finding, in the form of docs/page.md.
std::string page_json(const CaseReport& report) {
  return json::line_of([&](json::Members& page) {
    page.add("format", 1, "kind", "case", "title", report.title, "manifest",
             report::manifest_of(report.seed, report.command), "findings",
             json::objects(std::span(&report, 1), add_report));
  });
}

}  // namespace

std::vector<Option> CaseFiles::rows() {
  return {{"--html", &html, "FILE",
           "write a page, whole or not at all: the flight drawn, what decides it, commands", kOutput},
          {"--svg", &svg, "FILE", "write the drawing alone", kOutput}};
}

std::string CaseFiles::as_typed() const {
  return (html ? " --html " + shell_quoted(*html) : "") + (svg ? " --svg " + shell_quoted(*svg) : "");
}

void CaseFiles::write(const CaseReport& report) const {
  const std::string page = html ? report::page(page_json(report)) : "",
                    drawing = svg ? drawing_of(report) : "";
  if (svg && drawing.empty())
    throw InputError("--svg: there is nothing to draw: the question is invalid, or it has no exact answer");
  if (html) write_whole(*html, page);
  if (svg) write_whole(*svg, drawing);
}

}  // namespace lorentz::cli
