// What `lorentz judge` found, for people, for programs, and for the page.
#include "judge/judge_report.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include <lorentz/exchange.hpp>
#include "files/messages.hpp"
#include "judge/repetition.hpp"
#include "pictures/finding_drawing.hpp"
#include "report/claim_words.hpp"
#include "report/finding_json.hpp"
#include "report/manifest.hpp"
#include "report/reason.hpp"
#include "report/table.hpp"
#include "src/exchange/exchange_write.hpp"

namespace lorentz::judge {

namespace {

Components components_of(const Example& example) {
  return example.question.place->scene();
}

// An invalid question stands as it was asked.
std::string members_of(const Example& example) {
  return example.question.is_query() ? report::query_members(example.question.query, components_of(example))
                                     : example.question.text;
}

std::string readable_query(const Example& example) {
  if (!example.question.is_query()) return fmt::format("{{{}}}", example.question.text);
  return json::text_of(json_of(example.question.query, components_of(example)));
}

Answer exact_of(const Example& example) {
  return example.question.is_query() ? example.question.exact : Answer::error("");
}

// ---- Findings

// Two digits, or all before the point.
std::string two_digits(double a) {
  return a < 9.95 || a >= 1e6 ? fmt::format("{:.2g}", a) : fmt::format("{:.0f}", a);
}

const char* option_for(Severity severity) {
  if (severity == Severity::wrong_time) return " --times";
  return severity == Severity::wrong ? "" : " --strict";
}

// The shell command that prints the question, as often as it takes.
std::string lines_of_question(const Finding& finding) {
  return report::printed(finding.simplest.question.place->scene(), members_of(finding.simplest),
                         finding.repetitions);
}

std::vector<std::string> commands_of(const Finding& finding, const JudgeReport& report) {
  if (report.engine.kind == question::EngineInfo::Kind::guest)
    return {};                                                      // a function of a caller's has no command
  if (finding.recheck == Recheck::passes) return {report.command};  // the question alone does not show it
  const std::string lines = lines_of_question(finding);
  std::string engine = shell_quoted(report.engine.name);
  const std::string claim = report::arguments_of(report.claim);
  if (finding.cause() == Cause::no_answer) engine += fmt::format(" --timeout {:g}", report.timeout);
  if (finding.simplest.question.is_query())
    return {fmt::format("{} | lorentz compare --queries - --engine {}{}{}", lines, engine, claim,
                        option_for(finding.severity())),
            fmt::format("{} | lorentz first-hit --engine {}", lines, engine)};
  // Invalid questions only golden sets hand on; a program reads them by itself.
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
    lines.push_back(fmt::format("inputs moved by {:.3g} ulps would make it right", departs));
  else if (std::isfinite(departs))
    lines.push_back(fmt::format(
        "rounding does not explain it: inputs would have to move by {:.3g} ulps or more", departs));
  else
    lines.push_back("rounding does not explain it: no inputs near these make it right");
  return lines;
}

std::vector<std::string> reason_lines(const Finding& finding) {
  const Example& example = finding.simplest;
  std::vector<std::string> lines;
  if (!example.question.is_query())
    lines = {"the question is invalid: the right answer is an error"};
  else if (finding.severity() == Severity::error)
    lines = {"the question is a valid one"};
  else if (example.judgement.wrong_time)
    lines = {fmt::format("off by {:.3g} times what an ulp in each input makes of the time",
                         example.judgement.departs)};
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
        "asked alone it is answered otherwise; asked again and again, this comes at the {}th time",
        finding.repetitions));
  return lines;
}

// The rows in which it is met most often: "17 % of grazing, 9.1 % of golden ties, .."
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

// In full, but for what rounding of the inputs explains.
std::string text_of(const Finding& finding, const JudgeReport& report, int number) {
  const Example& example = finding.simplest;
  const Components dimension = components_of(example);
  std::string text =
      fmt::format("\n{}. {}: {}\n", number, name_of(finding.severity()), finding.explanation());
  text += fmt::format("   {} {}: {}\n", finding.count, finding.count == 1 ? "answer" : "answers",
                      often(finding, report));
  if (finding.severity() == Severity::ill_posed) return text;
  text += fmt::format("   the simplest, from {}:\n   {}\n   {}\n   says  {}\n   truth {}\n", finding.where,
                      report::scene_line(example.question.place->scene()), readable_query(example),
                      json::text_of(json_of(example.given, dimension)),
                      json::text_of(json_of(exact_of(example), dimension)));
  for (const std::string& line : reason_lines(finding)) text += "   " + line + '\n';
  for (const std::string& command : commands_of(finding, report)) text += "   $ " + command + '\n';
  return text;
}

// Nothing is drawn of an invalid question, nor where nothing can be.
std::optional<std::string> drawing_of(const Example& example) {
  if (!example.question.is_query()) return std::nullopt;
  std::string drawing =
      pictures::finding_drawing(example.question.place->scene(), example.question.query, example.given,
                                example.question.exact, example.judgement.obstacle);
  return drawing.empty() ? std::nullopt : std::optional(std::move(drawing));
}

// How far the inputs must move for the answer to be right, or how much tolerance the time would need.
std::optional<double> ulps_of(const Example& example) {
  const double departs = example.judgement.departs;
  return departs > 0 ? std::optional(departs) : std::nullopt;
}

void add_finding(json::Members& object, const Finding& finding, const JudgeReport& report) {
  const Example& example = finding.simplest;
  const Components dimension = components_of(example);
  object.add("cause", name_of(finding.cause()), "explanation", finding.explanation(), "count", finding.count,
             "share_of_plain", finding.share_of_plain, "share_of_hard", finding.share_of_hard, "often",
             often(finding, report), "where", finding.where, "verdict", name_of(finding.severity()));
  object.add("scene", example.question.place->scene(), "query", json::Raw{'{' + members_of(example) + '}'},
             "given", json_of(example.given, dimension), "exact", json_of(exact_of(example), dimension));
  object.add("by_radii", json::finite(example.diagnosis.by_radii), "by_ulps", json::finite(ulps_of(example)),
             "reason", reason_lines(finding), "commands", commands_of(finding, report), "drawing",
             drawing_of(example));
}

// ---- The verdict

std::size_t answers(const question::Tally& t) {
  return t.agree + t.ill_posed + t.wrong;
}

std::string percent(std::size_t part, std::size_t whole) {
  return whole == 0 ? "0 %" : two_digits(100 * static_cast<double>(part) / static_cast<double>(whole)) + " %";
}

// Of all the rows that are hard, or of the others.
question::Tally sum_of(const std::vector<ExaminedRow>& rows, bool hard) {
  question::Tally sum;
  for (const ExaminedRow& row : rows)
    if (row.is_hard == hard) sum.add(row.tally);
  return sum;
}

// "undecided 0.2 % of drawn flights, 16 % of hard ones"; nothing if there are none.
std::string shares_text(const char* what, const std::vector<ExaminedRow>& rows,
                        std::size_t question::Tally::*count) {
  const question::Tally drawn = sum_of(rows, false), hard = sum_of(rows, true);
  if (drawn.*count + hard.*count == 0) return "";
  return fmt::format("; {} {} of drawn flights, {} of hard ones", what, percent(drawn.*count, drawn.queries),
                     percent(hard.*count, hard.queries));
}

std::string times_text(const std::vector<ExaminedRow>& rows) {
  question::Tally drawn = sum_of(rows, false), hard = sum_of(rows, true);
  if (drawn.timed_hits + hard.timed_hits == 0) return "";
  const std::size_t wrong = drawn.wrong_time + hard.wrong_time;
  if (wrong == 0)
    return drawn.timed_hits == 0
               ? std::string()
               : fmt::format("; times within {:.2g} ulps on drawn flights, no wrong time", drawn.max_ulp());
  drawn.add(hard);
  std::string text = fmt::format("; wrong times {}", percent(wrong, answers(drawn)));
  if (drawn.other_quantity > 0)
    text += fmt::format(" ({} are another quantity)", percent(drawn.other_quantity, answers(drawn)));
  const double largest = question::quantile(drawn.wrong_ulps, 1);
  return std::isfinite(largest) ? text + fmt::format(", by up to {:.2g} ulps", largest) : text;
}

std::string paths_text(const std::vector<FlownScene>& flown) {
  const std::string fault = free_path_fault(flown);
  return fault.empty() ? "" : "; " + fault;
}

std::string speed_text(const JudgeReport& report) {
  if (!report.ns_per_query) return "";
  std::string text = fmt::format("; {} ns a query", two_digits(*report.ns_per_query));
  if (report.ns_of_reduction)
    text += fmt::format(", {} x reduction", two_digits(*report.ns_per_query / *report.ns_of_reduction));
  return text;
}

bool condemns(const Finding& finding, const JudgeReport& report) {
  if (finding.cause() == Cause::no_answer) return false;
  switch (finding.severity()) {
    case Severity::wrong_time:
      return report.times;
    case Severity::nonsense:
      return report.strict;
    default:
      return finding.severity() != Severity::ill_posed;
  }
}

// The kinds of fault that condemn, and the first of them: the worst, of these the most frequent.
std::string faults_text(const JudgeReport& report) {
  const Finding* main = nullptr;
  std::size_t kinds = 0;
  for (const Finding& finding : report.findings)
    if (condemns(finding, report) && kinds++ == 0) main = &finding;
  if (!main) return "";
  return kinds == 1 ? main->summary()
                    : fmt::format("{} kinds of fault, above all: {}", kinds, main->summary());
}

std::string heading(const JudgeReport& report) {
  const question::Tally total = report.total();
  const std::string verdict = report.verdict(), faults = faults_text(report);
  if (verdict == "broken")
    return fmt::format("broken: {} of {} {} without an answer that could be read", total.missing,
                       total.queries, total.queries == 1 ? "query" : "queries") +
           (faults.empty() ? "" : "; wrong: " + faults);
  if (verdict == "wrong") return "wrong: " + faults;
  if (verdict == "ill-posed")
    return fmt::format("ill-posed: no wrong answer in {}; {} that rounding of the inputs explains",
                       answers(total), total.ill_posed);
  if (verdict == "undecided")
    return fmt::format("undecided: it decided {} of {} queries, none of them wrong", answers(total),
                       total.queries);
  return fmt::format("right: no wrong answer in {}", answers(total));
}

// What it was asked and did not answer, and what it was not asked; nothing if there is nothing.
std::string missing_text(const JudgeReport& report) {
  const question::Tally total = report.total();
  std::string text;
  if (total.missing > 0 && !report.is_broken())
    text += fmt::format("; {} of {} answers missing", total.missing, total.queries);
  if (const std::size_t rows = report.rows_given_up(); rows > 0)
    text += fmt::format("; given up in {} of {} rows", rows, report.rows.size());
  return text;
}

std::string nonsense_text(const JudgeReport& report) {
  const std::size_t number = report.nonsense();
  return number == 0
             ? ""
             : fmt::format("; {} invalid {} answered", number, number == 1 ? "question" : "questions");
}

constexpr double kSlowStart = 0.05;  // seconds; less is not worth a line

const std::vector<std::string> kColumns{"questions",  "number",    "agree",       "ill-posed", "wrong",
                                        "wrong time", "undecided", "unsupported", "error",     "missing",
                                        "nonsense",   "max ulp",   "ns/query"};

std::vector<std::string> cells_of(const question::Tally& t, std::size_t nonsense) {
  const auto number = [](std::size_t n) { return n ? std::to_string(n) : std::string("-"); };
  return {t.name,
          std::to_string(t.queries),
          number(t.agree),
          number(t.ill_posed),
          number(t.wrong),
          number(t.wrong_time),
          number(t.undecided),
          number(t.unsupported),
          number(t.error),
          number(t.missing),
          number(nonsense),
          t.timed_hits ? fmt::format("{:.3g}", t.max_ulp()) : "-",
          t.speed.ns_per_query > 0 ? fmt::format("{:.0f}", t.speed.ns_per_query) : "-"};
}

enum class RowState { asked, unsupported, no_time, given_up, other_numbers };
constexpr const char* kRowStates[] = {"asked", "unsupported", "no time", "given up", "other numbers"};

RowState state_of(const ExaminedRow& row, const JudgeReport& report) {
  if (row.scenes_given_up > 0) return RowState::given_up;
  if (row.asked() > 0) return row.tally.unsupported == row.asked() ? RowState::unsupported : RowState::asked;
  // Its scenes had been left before: all of them unsupported, or some too slow to be asked again?
  const question::Tally all = report.total();
  if (!row.is_exhausted) return RowState::no_time;
  if (all.queries == all.unsupported) return RowState::unsupported;
  return report.claim.precision == NumberFormat::binary64 ? RowState::no_time : RowState::other_numbers;
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

std::string table_of(const JudgeReport& report) {
  report::Table table(kColumns);
  std::vector<std::string> unsupported, no_time, other_numbers;
  for (const ExaminedRow& row : report.rows) {
    const RowState state = state_of(row, report);
    if (state == RowState::unsupported) unsupported.push_back(row.name);
    if (state == RowState::no_time) no_time.push_back(row.name);
    if (state == RowState::other_numbers) other_numbers.push_back(row.name);
    if (row.tally.unsupported < row.asked()) table.add(cells_of(row.tally, row.nonsense));
  }
  question::Tally total = report.total();
  total.name = "all";
  table.add(cells_of(total, report.nonsense()));
  std::string text = table.text();
  if (!unsupported.empty()) text += fmt::format("unsupported: {}\n", fmt::join(unsupported, ", "));
  if (!no_time.empty()) text += fmt::format("not asked, no time: {}\n", fmt::join(no_time, ", "));
  if (!other_numbers.empty())
    text += fmt::format("not asked, numbers of another precision: {}\n", fmt::join(other_numbers, ", "));
  return text + given_up_lines(report);
}

void add_row(json::Members& object, const ExaminedRow& row, const JudgeReport& report) {
  const question::Tally& t = row.tally;
  object.add("name", row.name, "explanation", row.explanation, "state",
             kRowStates[static_cast<int>(state_of(row, report))], "scenes_given_up", row.scenes_given_up,
             "why", row.scenes_given_up == 0 ? std::nullopt : std::optional(row.last_failure));
  object.add("queries", t.queries, "agree", t.agree, "ill_posed", t.ill_posed, "wrong", t.wrong, "wrong_time",
             t.wrong_time, "other_quantity", t.other_quantity, "undecided", t.undecided, "unsupported",
             t.unsupported, "error", t.error, "missing", t.missing, "nonsense", row.nonsense);
  object.add("max_ulp", t.timed_hits ? json::finite(t.max_ulp()) : std::nullopt, "ns_per_query",
             t.speed.ns_per_query > 0 ? json::finite(t.speed.ns_per_query) : std::nullopt);
}

}  // namespace

question::Tally JudgeReport::total() const {
  question::Tally total = sum_of(rows, false);
  total.add(sum_of(rows, true));
  return total;
}

std::size_t JudgeReport::nonsense() const {
  std::size_t number = 0;
  for (const ExaminedRow& row : rows) number += row.nonsense;
  return number;
}

std::size_t JudgeReport::rows_given_up() const {
  return static_cast<std::size_t>(std::count_if(
      rows.begin(), rows.end(), [](const ExaminedRow& row) { return row.scenes_given_up > 0; }));
}

bool JudgeReport::is_broken() const {
  const question::Tally t = total();
  return 100 * t.missing > t.queries;
}

std::string JudgeReport::verdict() const {
  const question::Tally t = total();
  if (is_broken()) return "broken";
  if (t.wrong + t.error > 0 || (times && t.wrong_time > 0) || (strict && nonsense() > 0)) return "wrong";
  if (t.agree + t.ill_posed <= t.undecided) return "undecided";
  return t.ill_posed > 0 ? "ill-posed" : "right";
}

std::string JudgeReport::line() const {
  const std::string words = report::words_of(claim);
  return heading(*this) + (words.empty() ? "" : "; judged" + words.substr(1)) +
         (was_stopped ? "; interrupted before all was asked" : "") + missing_text(*this) +
         shares_text("ill-posed", rows, &question::Tally::ill_posed) +
         shares_text("undecided", rows, &question::Tally::undecided) + times_text(rows) + paths_text(flown) +
         speed_text(*this) + nonsense_text(*this);
}

std::string JudgeReport::text() const {
  std::string text = fmt::format("{}, seed {}, judged by the oracle{}\n\n{}", engine.name, seed,
                                 report::words_of(claim), table_of(*this));
  for (const FlownScene& scene : flown) text += "Free paths: " + scene.text() + ".\n";
  if (ns_per_query) text += fmt::format("Speed: {}.\n", speed_of);
  if (start_up >= kSlowStart)
    text += fmt::format("Start: {:.2g} s until the first answer, which is in no other figure.\n", start_up);
  if (misbehaved && total().missing == 0)
    text += "It did what it should not, and lost no answer by it: stderr has it.\n";
  int number = 0;
  for (const Finding& finding : findings) text += text_of(finding, *this, ++number);
  return text + '\n' + line() + '\n';
}

std::string JudgeReport::json() const {
  const question::Tally t = total();
  std::vector<report::FreePathCurve> curves;
  for (const FlownScene& scene : flown) curves.push_back(scene.curve(engine.name));
  return json::line_of([&](json::Members& page) {
    page.add("format", 1, "kind", "judge", "title", engine.name + ", judged", "manifest",
             report::manifest_of(seed, command), "engine", engine.name, "verdict", verdict(), "line", line());
    report::add_claim(page, claim);
    page.add("queries", t.queries, "wrong", t.wrong, "ill_posed", t.ill_posed, "wrong_time", t.wrong_time,
             "other_quantity", t.other_quantity, "undecided", t.undecided, "unsupported", t.unsupported,
             "error", t.error, "missing", t.missing, "nonsense", nonsense(), "ns_per_query",
             json::finite(ns_per_query), "ns_of_reduction", json::finite(ns_of_reduction), "start_up_seconds",
             json::finite(start_up));
    page.add("difficulties", json::objects(rows, [&](json::Members& one, const ExaminedRow& row) {
               add_row(one, row, *this);
             }));
    page.add("findings", json::objects(findings, [&](json::Members& one, const Finding& finding) {
               add_finding(one, finding, *this);
             }));
    page.add("calls", json::objects(calls.by_decade(), [](json::Members& one, const auto& decade) {
               const auto& [exponent, call] = decade;
               one.add("decade", exponent, "right", call.right, "ill_posed", call.ill_posed, "wrong",
                       call.wrong, "undecided", call.undecided);
             }));
    page.add("free_paths", curves);
  });
}

}  // namespace lorentz::judge
