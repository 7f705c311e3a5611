// The report of `lorentz judge`, for people, for programs, and for the page.
#include "judge/judge_report.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include <lorentz/exchange.hpp>
#include "judge/simplest.hpp"
#include "report/claim_words.hpp"
#include "report/files/messages.hpp"
#include "report/manifest.hpp"
#include "report/pictures/finding_drawing.hpp"
#include "report/query_text.hpp"
#include "report/reason.hpp"
#include "report/table.hpp"
#include "src/exchange/exchange_write.hpp"
#include "src/problem/safe_text.hpp"

namespace lorentz::judge {

namespace {

Components components_of(const Example& example) {
  return example.question.place->scene();
}

// An invalid question is shown as it was asked.
std::string members_of(const Example& example) {
  return example.question.is_query() ? report::query_members(example.question.query, components_of(example),
                                                             example.question.max_time)
                                     : example.question.text;
}

std::string readable_query(const Example& example) {
  if (!example.question.is_query()) return fmt::format("{{{}}}", example.question.text);
  return json::text_of([&](json::Members& object) {
    add_query(object, example.question.query, components_of(example), example.question.max_time);
  });
}

Answer exact_of(const Example& example) {
  return example.question.is_query() ? example.question.exact : Answer::error("");
}

// ---- Findings

const char* option_for(Severity severity) {
  if (severity == Severity::wrong_time) return " --times";
  return severity == Severity::wrong ? "" : " --strict";
}

std::vector<std::string> commands_of(const Finding& finding, const JudgeReport& report) {
  if (report.engine.kind == question::EngineInfo::Kind::guest)
    return {};                                                      // a function of the caller has no command
  if (finding.recheck == Recheck::passes) return {report.command};  // the question alone does not show it
  const std::string lines = report::printed(finding.simplest.question.place->scene(),
                                            members_of(finding.simplest), finding.repetitions);
  std::string engine = shell_quoted(report.engine.name);
  const std::string claim = report::arguments_of(report.claim, report.ulps);
  if (finding.cause() == Cause::no_answer) engine += fmt::format(" --timeout {:g}", report.longest_wait);
  if (finding.simplest.question.is_query())
    return {fmt::format("{} | lorentz compare --queries - --engine {}{}{}", lines, engine, claim,
                        option_for(finding.severity())),
            fmt::format("{} | lorentz first-hit --engine {}", lines, engine)};
  // Only golden sets pass invalid questions on, and only to a program, which reads them by itself.
  if (!report.engine.is_command()) return {};
  return {fmt::format("{} | sh -c {}", lines,
                      shell_quoted(report.engine.name.substr(std::string_view("cmd:").size())))};
}

// Why an answer is not the exact one: what decides, and whether rounding explains it.
std::vector<std::string> lines_of_dispute(const Example& example) {
  const question::Place& place = *example.question.place;
  std::vector<std::string> lines;
  if (const auto dispute =
          report::dispute_of(place.margins(), place.scene(), example.question.query, example.question.exact,
                             example.given, example.judgement.obstacle))
    lines.push_back(dispute->text);
  const double departs = example.judgement.departs;
  if (example.diagnosis.severity == Severity::ill_posed && departs == 0)
    lines.push_back("inputs moved by however little would make it right");
  else if (example.diagnosis.severity == Severity::ill_posed)
    lines.push_back(fmt::format("inputs moved by {} would make it right", report::ulps_text(departs)));
  else if (departs < oracle::kLargestMargin)
    lines.push_back(fmt::format("rounding does not explain it: inputs would have to move by {} or more",
                                report::ulps_text(departs)));
  else if (std::isfinite(departs))
    lines.push_back("rounding does not explain it: inputs would have to move by " +
                    report::ulps_text(departs));
  else
    lines.push_back("rounding does not explain it: no inputs near these make it right");
  return lines;
}

// By how much the time is off: along the ray, and relative to the effect of rounding the inputs.
std::string words_of_time_error(const Example& example) {
  const auto radii = json::finite(example.diagnosis.by_radii);
  const double ulps = example.judgement.departs;
  std::string text = radii ? fmt::format("the time is off by {:.3g} radii along the ray", *radii)
                           : std::string("the time is not one of a place on the ray");
  return text + (ulps < oracle::kLargestMargin
                     ? fmt::format(", {:.3g} times what an ulp in each input makes of it", ulps)
                     : std::string(", far more than an ulp in each input makes of it"));
}

std::vector<std::string> reason_lines(const Finding& finding) {
  const Example& example = finding.simplest;
  std::vector<std::string> lines;
  if (!example.question.is_query())
    lines = {"the question is invalid: the right answer is an error"};
  else if (finding.severity() == Severity::error)
    lines = {"the question is a valid one"};
  else if (example.judgement.wrong_time)
    lines = {words_of_time_error(example)};
  else
    lines = lines_of_dispute(example);
  if (finding.recheck == Recheck::passes)
    lines.push_back(
        fmt::format("asked alone, or {} times in a row, it is answered otherwise: this takes the questions "
                    "before it, or chance",
                    kMostRepetitions));
  else if (finding.recheck == Recheck::no_time)
    lines.push_back("not asked again: no time; whether it goes wrong by itself is not known");
  else if (finding.repetitions > 1)
    lines.push_back(fmt::format(
        "asked alone it is answered otherwise; asked again and again, this comes at time number {}",
        finding.repetitions));
  return lines;
}

// The rows in which the finding is most frequent: "17 % of grazing, 9.1 % of golden ties, .."
std::string often(const Finding& finding, const JudgeReport& report) {
  constexpr std::size_t kMost = 3;
  std::vector<std::pair<double, std::string>> shares;
  for (const ExaminedRow& row : report.rows)
    if (const auto its = finding.by_row.find(row.name); its != finding.by_row.end())
      shares.emplace_back(static_cast<double>(its->second) / static_cast<double>(row.asked()), row.name);
  std::stable_sort(shares.begin(), shares.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  std::string text;
  for (std::size_t i = 0; i < std::min(kMost, shares.size()); ++i)
    text += fmt::format("{}{} % of {}", i ? ", " : "", two_digits(100 * shares[i].first), shares[i].second);
  return text + (shares.size() > kMost ? ", .." : "");
}

// The ray and the obstacle that decides; nothing if question and answer involve no obstacle.
std::optional<report::Primitive> primitive_for(const Example& example) {
  const auto obstacle = obstacle_in_question(example);
  if (!obstacle) return std::nullopt;
  const question::Place& place = *example.question.place;
  return report::primitive_of(place.margins(), place.scene(), example.question.query, *obstacle);
}

// The finding in three lines.
std::string lines_of(const Finding& finding, int number) {
  const std::string why = finding.severity() == Severity::ill_posed ? "" : finding.why();
  return fmt::format("{}. {}: {}\n   {}\n", number, name_of(finding.severity()), title_of(finding.cause()),
                     finding.explanation()) +
         (why.empty() ? "" : fmt::format("   likely: {}\n", why));
}

// The finding in full, but shorter if rounding of the inputs explains it.
std::string text_of(const Finding& finding, const JudgeReport& report, int number) {
  const Example& example = finding.simplest;
  const Components dimension = components_of(example);
  std::string text = '\n' + lines_of(finding, number);
  text += fmt::format("   {} {}: {}\n", finding.count, finding.count == 1 ? "answer" : "answers",
                      often(finding, report));
  if (finding.severity() == Severity::ill_posed) return text;
  text += fmt::format("   the simplest, {} {}:\n   {}\n   {}\n   says  {}\n   truth {}\n",
                      finding.was_shrunk ? "shrunk from" : "from", finding.where,
                      scene_line(example.question.place->scene()), readable_query(example),
                      json::text_of(json_of(example.given, dimension)),
                      json::text_of(json_of(exact_of(example), dimension)));
  for (const std::string& line : reason_lines(finding)) text += "   " + line + '\n';
  if (!example.last_words.empty())
    text += fmt::format("   its last line on stderr: {}\n", printable(example.last_words));
  if (const auto primitive = primitive_for(example))
    text += fmt::format("   the one question: {}\n", primitive->json);
  for (const std::string& command : commands_of(finding, report)) text += "   $ " + command + '\n';
  return text;
}

// The findings of a group, numbered on from `number`.
std::string text_of(Blame group, const JudgeReport& report, int& number) {
  std::string text;
  for (const Finding& finding : report.findings)
    if (finding.simplest.diagnosis.blame() == group) text += text_of(finding, report, ++number);
  return text;
}

// Nothing for an invalid question, or if the case cannot be drawn.
std::optional<std::string> drawing_of(const Example& example) {
  if (!example.question.is_query()) return std::nullopt;
  std::string drawing = pictures::finding_drawing(
      example.question.place->scene(), example.question.query, example.given, example.question.exact,
      example.judgement.obstacle, example.question.place->claim().precision);
  return drawing.empty() ? std::nullopt : std::optional(std::move(drawing));
}

void add_finding(json::Members& object, const Finding& finding, const JudgeReport& report) {
  const Example& example = finding.simplest;
  const Components dimension = components_of(example);
  const double departs = example.judgement.departs;  // of the inputs, or the tolerance that the time needs
  object.add("cause", name_of(finding.cause()), "explanation", finding.explanation(), "why", finding.why(),
             "count", finding.count, "share_of_plain", finding.share_of_plain, "share_of_hard",
             finding.share_of_hard, "often", often(finding, report), "where", finding.where, "shrunk",
             finding.was_shrunk, "verdict", name_of(finding.severity()));
  object.add("scene", example.question.place->scene(), "query", json::Raw{'{' + members_of(example) + '}'},
             "given", json_of(example.given, dimension), "exact", json_of(exact_of(example), dimension));
  const auto primitive = primitive_for(example);
  object.add("title", title_of(finding.cause()), "group", title_of(finding.simplest.diagnosis.blame()),
             "last_words", example.last_words.empty() ? std::nullopt : std::optional(example.last_words),
             "primitive", primitive ? std::optional(json::Raw{primitive->json}) : std::nullopt,
             "primitive_cpp", primitive ? std::optional(primitive->cpp) : std::nullopt);
  object.add("by_radii", json::finite(example.diagnosis.by_radii), "by_ulps",
             json::finite(departs > 0 ? std::optional(departs) : std::nullopt), "reason",
             reason_lines(finding), "commands", commands_of(finding, report), "drawing", drawing_of(example));
}

constexpr double kSlowStart = 0.05;  // seconds; less is not worth a line

// For times near 0, ulps are not informative.
std::string largest_ulp(const question::Tally& t) {
  if (t.ulps.empty()) return "-";
  return t.max_ulp() < oracle::kLargestMargin ? fmt::format("{:.3g}", t.max_ulp()) : "> 2^20";
}

std::vector<std::string> cells_of(const question::Tally& t, const std::optional<double>& radii) {
  return question::cells_counted(
      t.counts, Counted::judge, {t.name, std::to_string(t.queries)},
      {radii ? fmt::format("{:.2g}", *radii) : "-", largest_ulp(t),
       t.speed.ns_per_query > 0 ? fmt::format("{:.0f}", t.speed.ns_per_query) : "-"},
      question::dash_for_none);
}

std::string_view state_of(const ExaminedRow& row, const JudgeReport& report) {
  if (row.scenes_given_up > 0) return "given up";
  if (row.tally[Count::too_slow] > 0) return "too slow";
  if (row.asked() > 0) return row.tally[Count::unsupported] == row.asked() ? "unsupported" : "asked";
  // Its scenes had been left before: either all were unsupported, or some were too slow to be asked again.
  const question::Tally all = report.total();
  if (!row.is_exhausted) return "no time";
  if (all.queries == all[Count::unsupported]) return "unsupported";
  return report.claim == Claim{.time_tolerance = report.claim.time_tolerance} ? "too slow" : "other numbers";
}

// A line for each failure: "given up in scenes of: drawn cubic (4), golden ties (20); cmd died (exit 3) .."
std::string given_up_lines(const JudgeReport& report) {
  std::map<std::string, std::vector<std::string>> by_failure;
  for (const ExaminedRow& row : report.rows)
    if (row.scenes_given_up > 0)
      by_failure[row.last_failure].push_back(fmt::format("{} ({})", row.name, row.scenes_given_up));
  std::string text;
  for (const auto& [failure, names] : by_failure)
    text += fmt::format("given up in scenes of: {}; {}\n", fmt::join(names, ", "), failure);
  return text;
}

// "unsupported: drawn ball, golden ties"; nothing if there are no such rows.
std::string line_of(std::string_view state, const std::string& what, const JudgeReport& report) {
  std::vector<std::string> names;
  for (const ExaminedRow& row : report.rows)
    if (state_of(row, report) == state) names.push_back(row.name);
  return names.empty() ? "" : fmt::format("{}: {}\n", what, fmt::join(names, ", "));
}

std::string table_of(const JudgeReport& report) {
  report::Table table(question::titles_counted(Counted::judge, {"questions", "number"},
                                               {"radii off", "max ulp", "ns/query"}));
  for (const ExaminedRow& row : report.rows)
    if (row.tally[Count::unsupported] < row.asked()) table.add(cells_of(row.tally, row.max_radii));
  question::Tally total = report.total();
  total.name = "all";
  table.add(cells_of(total, report.max_radii()));
  return table.text() + line_of("unsupported", "unsupported", report) +
         line_of("no time", "not asked, no time", report) +
         line_of("too slow",
                 fmt::format("too slow to ask (no answer within {:.3g} s, or more than "
                             "0.1 s each in earlier rows)",
                             report.longest_wait),
                 report) +
         line_of("other numbers", "not asked, numbers of another precision or outside of the domain",
                 report) +
         (report.outside > 0
              ? fmt::format("not asked: {} questions outside of the declared domain\n", report.outside)
              : "") +
         given_up_lines(report);
}

void add_row(json::Members& object, const ExaminedRow& row, const JudgeReport& report) {
  const question::Tally& t = row.tally;
  object.add("name", row.name, "explanation", row.explanation, "state", state_of(row, report),
             "scenes_given_up", row.scenes_given_up, "why",
             row.scenes_given_up == 0 ? std::nullopt : std::optional(row.last_failure));
  object.add("queries", t.queries);
  question::add_counts(object, t.counts, Counted::judge);
  object.add("max_radii", json::finite(row.max_radii), "records", row.records);
  object.add("max_ulp", t.ulps.empty() ? std::nullopt : json::finite(t.max_ulp()), "ns_per_query",
             t.speed.ns_per_query > 0 ? json::finite(t.speed.ns_per_query) : std::nullopt);
}

// The table, and each finding in full.
std::string details_of(const JudgeReport& report) {
  std::string text = fmt::format("\nSeed {}.\n\n{}", report.seed, table_of(report));
  for (const FlownScene& scene : report.flown) text += "Free paths: " + scene.text() + ".\n";
  if (report.ns_per_query) text += fmt::format("Speed: {}.\n", report.speed_of);
  if (report.start_up >= kSlowStart)
    text += fmt::format("Start: {:.2g} s until the first answer, which is in no other figure.\n",
                        report.start_up);
  if (report.misbehaved && report.total()[Count::missing] == 0)
    text += "It did what it should not, and lost no answer by it: stderr has it.\n";
  int number = 0;
  for (const Blame group : kBlames) {
    const std::string its = text_of(group, report, number);
    if (!its.empty()) text += fmt::format("\n-- {}\n", title_of(group)) + its;
  }
  return text;
}

// The first findings in three lines each: what it is, in which circumstance, and why.
std::string first_findings(const JudgeReport& report) {
  constexpr std::size_t kFirst = 3;
  std::string text;
  for (std::size_t i = 0; i < std::min(kFirst, report.findings.size()); ++i)
    text += lines_of(report.findings[i], static_cast<int>(i + 1));
  if (report.findings.size() > kFirst) text += fmt::format("and {} more\n", report.findings.size() - kFirst);
  return text.empty() ? text : '\n' + text;
}

}  // namespace

std::string JudgeReport::text(bool all) const {
  const ThreeLines its = summary();
  std::string text =
      fmt::format("what:    {}\nhow bad: {}\nworst:   {}\n", printable(its.what), its.how_bad, its.worst);
  text += all ? details_of(*this) : first_findings(*this);
  for (const std::string& step : its.next) text += "\nnext:    " + step;
  return text + (its.next.empty() ? "\n" : "\n\n") + line() + '\n';
}

std::string JudgeReport::json() const {
  constexpr std::size_t kOthers[] = {1, 2, 3, 4};  // measures besides `calls`
  static_assert(std::size(kOthers) + 1 == kMeasures.size());
  const question::Tally t = total();
  std::vector<report::FreePathCurve> paths;
  for (const FlownScene& scene : flown) paths.push_back(scene.curve(engine.name));
  return json::line_of([&](json::Members& page) {
    page.add("format", 1, "kind", "judge", "title", engine.name + ", judged", "manifest",
             report::manifest_of(seed, command), "engine", engine.name, "library", library(), "verdict",
             verdict(), "line", line());
    report::add_claim(page, claim);
    page.add("summary", [this](json::Members& object) {
      const ThreeLines its = summary();
      object.add("what", its.what, "how_bad", its.how_bad, "worst", its.worst, "finding",
                 its.finding ? std::optional(its.finding - findings.data()) : std::nullopt, "next", its.next);
    });
    page.add("queries", t.queries, "outside_domain", outside);
    question::add_counts(page, t.counts, Counted::judge);
    page.add("ns_per_query", json::finite(ns_per_query), "ns_of_reduction", json::finite(ns_of_reduction),
             "processor_ns_per_query", json::finite(processor_ns), "processor_ns_of_reduction",
             json::finite(processor_ns_of_reduction), "engine_ns", json::finite(own_ns), "start_up_seconds",
             json::finite(start_up));
    page.add("difficulties", json::objects(rows, [&](json::Members& one, const ExaminedRow& row) {
               add_row(one, row, *this);
             }));
    page.add("findings", json::objects(findings, [&](json::Members& one, const Finding& finding) {
               add_finding(one, finding, *this);
             }));
    page.add("calls", curves[0], "curves", json::objects(kOthers, [this](json::Members& one, std::size_t i) {
               one.add("by", kMeasures[i], "decades", curves[i]);
             }));
    page.add("free_paths", paths);
  });
}

}  // namespace lorentz::judge
