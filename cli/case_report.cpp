#include "cli/case_report.hpp"

#include <fmt/format.h>

#include <lorentz/exchange.hpp>
#include "cli/finding_json.hpp"
#include "cli/messages.hpp"
#include "cli/reason.hpp"
#include "cli/whole_file.hpp"
#include "pictures/finding_drawing.hpp"
#include "report/manifest.hpp"
#include "report/page.hpp"

namespace lorentz::cli {
namespace {

// What makes this answer again from nothing but the program.
std::vector<std::string> commands_of(const CaseReport& report) {
  const std::string lines = printed(report.scene, query_members(report.query, report.scene.dimension));
  std::vector<std::string> commands{report.command, lines + " | lorentz first-hit --engine oracle --detail"};
  if (!report.engine.empty())
    commands.push_back(
        fmt::format("{} | lorentz compare --queries - --engine {}", lines, shell_quoted(report.engine)));
  return commands;
}

std::vector<std::string> reason_lines(const CaseReport& report, const oracle::Margins& margins) {
  std::vector<std::string> lines;
  if (report.given) {
    lines = lines_of(
        reason_of(margins, report.scene, report.query, report.exact, *report.given, report.decisive, ""));
  } else if (const auto decision = margins.hardest_decision(report.query, report.exact)) {
    lines.push_back(decision_text(*decision, report.scene.dimension));
  }
  lines.insert(lines.end(), report.more.begin(), report.more.end());
  return lines;
}

std::optional<double> radii_of(const CaseReport& report, const oracle::Margins& margins) {
  if (!report.given) return std::nullopt;
  const auto dispute =
      dispute_of(margins, report.scene, report.query, report.exact, *report.given, report.decisive);
  return dispute ? std::optional(dispute->radii) : std::nullopt;
}

std::string finding_of(const CaseReport& report) {
  const int dimension = report.scene.dimension;
  const oracle::Margins margins(report.scene);
  const std::string drawing = drawing_of(report);
  return fmt::format(
      "{{\"cause\":{},\"explanation\":{},\"count\":1,\"where\":{},\"verdict\":{},\"scene\":{},\"query\":{{{}}"
      "},"
      "\"given\":{},\"exact\":{},\"by_radii\":{},\"by_ulps\":{},\"reason\":{},\"commands\":{},\"drawing\":{}}"
      "}",
      json_quoted(report.cause), json_quoted(report.explanation), json_quoted(report.where),
      json_quoted(report.verdict), scene_object(report.scene), query_members(report.query, dimension),
      report.given ? answer_object(*report.given, dimension) : "null", answer_object(report.exact, dimension),
      number_or_null(radii_of(report, margins)), number_or_null(report.by_ulps),
      array_of(reason_lines(report, margins)), array_of(commands_of(report)),
      drawing.empty() ? "null" : json_quoted(drawing));
}

}  // namespace

std::string drawing_of(const CaseReport& report) {
  return report.given ? pictures::finding_drawing(report.scene, report.query, *report.given, report.exact,
                                                  report.decisive)
                      : pictures::finding_drawing(report.scene, report.query, report.exact);
}

std::string json_of(const CaseReport& report) {
  std::string out =
      fmt::format("{{\"format\":1,\"kind\":\"case\",\"title\":{},\"manifest\":", json_quoted(report.title));
  report::append_manifest(out, report::manifest_of(0, report.command));
  return out + ",\"findings\":[" + finding_of(report) + "]}\n";
}

std::vector<Option> CaseFiles::rows() {
  return {{"--html", &html, "FILE",
           "write a page, whole or not at all: the flight drawn, what decides it, commands", kOutput},
          {"--svg", &svg, "FILE", "write the drawing alone", kOutput}};
}

std::string CaseFiles::as_typed() const {
  return (html ? " --html " + shell_quoted(*html) : "") + (svg ? " --svg " + shell_quoted(*svg) : "");
}

void CaseFiles::write(const CaseReport& report) const {
  const auto text_for = [&](bool page) {
    if (page) return report::page(json_of(report));
    std::string drawing = drawing_of(report);
    if (drawing.empty())
      throw InputError(
          "--svg: there is nothing to be drawn: the question is none, or it has no exact answer");
    return drawing;
  };
  std::vector<std::pair<std::string, std::string>> files;
  if (html) files.emplace_back(*html, text_for(true));
  if (svg) files.emplace_back(*svg, text_for(false));
  for (const auto& [path, text] : files) write_whole(path, text);
}

}  // namespace lorentz::cli
