// The verdict on an engine, in three lines and in one.
#include "judge/judge_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/claim_words.hpp"
#include "report/manifest.hpp"
#include "report/reason.hpp"
#include "report/share.hpp"
#include "src/exchange/json_writer.hpp"
#include "src/problem/safe_text.hpp"

namespace lorentz::judge {

std::string two_digits(double a) {
  return a < 9.95 || a >= 1e6 ? fmt::format("{:.2g}", a) : fmt::format("{:.0f}", a);
}

std::optional<std::string> JudgeReport::library() const {
  if (!introduction || introduction->name.empty()) return std::nullopt;
  const question::Introduction& its = *introduction;
  return printable(its.name) + (its.version.empty() ? "" : " ") + printable(its.version);
}

namespace {

// The answers to which all shares refer.
std::size_t judged_of(const question::Tally& t) {
  return t.queries - t[Count::unsupported];
}

std::string percent(std::size_t part, std::size_t whole) {
  return whole == 0 ? "0 %" : two_digits(100 * static_cast<double>(part) / static_cast<double>(whole)) + " %";
}

// The largest radii_off of the rows that are hard, or of the others.
std::optional<double> largest_radii(const std::deque<ExaminedRow>& rows, bool hard) {
  std::optional<double> largest;
  for (const ExaminedRow& row : rows)
    if (row.is_hard == hard && row.max_radii) largest = std::max(largest.value_or(0), *row.max_radii);
  return largest;
}

// The sum over the hard rows, or over the others.
question::Tally sum_of(const std::deque<ExaminedRow>& rows, bool hard) {
  question::Tally sum;
  for (const ExaminedRow& row : rows)
    if (row.is_hard == hard) sum.add(row.tally);
  return sum;
}

// "undecided 0.2 % of drawn flights, 16 % of hard ones"; nothing if there are none.
std::string shares_text(const char* what, const std::deque<ExaminedRow>& rows, Count count) {
  const question::Tally drawn = sum_of(rows, false), hard = sum_of(rows, true);
  if (drawn[count] + hard[count] == 0) return "";
  return fmt::format("; {} {} of drawn flights, {} of hard ones", what,
                     percent(drawn[count], judged_of(drawn)), percent(hard[count], judged_of(hard)));
}

// "; wrong times 0.2 % (0.1 % are another quantity), by up to 0.003 radii along the ray"
std::string times_text(const JudgeReport& report) {
  question::Tally drawn = sum_of(report.rows, false), hard = sum_of(report.rows, true);
  if (drawn.ulps.empty() && hard.ulps.empty()) return "";
  const bool is_right = drawn[Count::wrong_time] + hard[Count::wrong_time] == 0;
  if (is_right && drawn.ulps.empty()) return "";
  const auto radii = json::finite(is_right ? largest_radii(report.rows, false) : report.max_radii());
  if (is_right && radii == 0) return "; times exact on drawn flights";
  const std::string along = radii ? fmt::format("{:.2g} radii along the ray", *radii) : "";
  if (is_right)
    return fmt::format("; times within {} ({}) on drawn flights, no wrong time", along,
                       report::ulps_text(drawn.max_ulp()));
  drawn.add(hard);
  std::string text = fmt::format("; wrong times {}", percent(drawn[Count::wrong_time], judged_of(drawn)));
  if (drawn[Count::other_quantity] > 0)
    text +=
        fmt::format(" ({} are another quantity)", percent(drawn[Count::other_quantity], judged_of(drawn)));
  return along.empty() ? text : text + ", by up to " + along;
}

std::string paths_text(const std::vector<FlownScene>& flown) {
  const std::string fault = free_path_fault(flown);
  return fault.empty() ? "" : "; " + fault;
}

// "; 314016 ns a query (298000 of processors), 1104 times lorentz's own engine". The two are compared in
// processor time if it is known for both, because wall-clock time includes other programs.
std::string speed_text(const JudgeReport& report) {
  if (!report.ns_per_query) return "";
  std::string text = fmt::format("; {} ns a query", two_digits(*report.ns_per_query));
  const double spent = report.processor_ns.value_or(0), own = report.processor_ns_of_reduction.value_or(0);
  const bool by_processors = spent > 0 && own > 0;
  if (by_processors && report.engine.is_command())
    text += fmt::format(" ({} of processors)", two_digits(spent));
  if (report.ns_of_reduction)
    text +=
        fmt::format(", {} times lorentz's own engine",
                    two_digits(by_processors ? spent / own : *report.ns_per_query / *report.ns_of_reduction));
  return text;
}

bool condemns(const Finding& finding, const JudgeReport& report) {
  if (finding.cause() == Cause::no_answer || finding.cause() == Cause::bad_line) return false;
  switch (finding.severity()) {
    case Severity::wrong_time:
      return report.times;
    case Severity::nonsense:
      return report.strict;
    default:
      return finding.severity() != Severity::ill_posed;
  }
}

// The first finding that condemns the engine, else the first that rounding does not excuse; null if there is
// neither.
const Finding* worst_of(const JudgeReport& report) {
  const auto first_that = [&](const auto& holds) {
    const auto place = std::ranges::find_if(report.findings, holds);
    return place == report.findings.end() ? nullptr : &*place;
  };
  const Finding* worst = first_that([&](const Finding& f) { return condemns(f, report); });
  return worst ? worst : first_that([](const Finding& f) { return f.severity() != Severity::ill_posed; });
}

// The kinds of fault that condemn the engine, and the first of them: the most frequent of the worst.
std::string faults_text(const JudgeReport& report) {
  const auto kinds =
      std::ranges::count_if(report.findings, [&](const Finding& f) { return condemns(f, report); });
  if (kinds == 0) return "";
  const std::string main = worst_of(report)->summary();
  return kinds == 1 ? main : fmt::format("{} kinds of fault, above all: {}", kinds, main);
}

std::string heading(const JudgeReport& report) {
  const question::Tally total = report.total();
  const std::string verdict = report.verdict(), faults = faults_text(report);
  if (verdict == "broken")
    return fmt::format("broken: {} of {} {} without an answer that could be read", total[Count::missing],
                       total.queries, total.queries == 1 ? "query" : "queries") +
           (faults.empty() ? "" : "; wrong: " + faults);
  if (verdict == "wrong") return "wrong: " + faults;
  if (verdict == "ill-posed")
    return fmt::format("ill-posed: no wrong answer in {}; {} that rounding of the inputs explains",
                       total.counts.answers(), total[Count::ill_posed]);
  if (verdict == "undecided" && total.queries == 0) return "undecided: no answer was judged";
  if (verdict == "undecided")
    return fmt::format("undecided: it decided {} of {} queries, none of them wrong", total.counts.answers(),
                       total.queries);
  return fmt::format("right: no wrong answer in {}", total.counts.answers());
}

// The number of missing answers, and of rows in which it was given up or too slow; empty if there are none.
std::string missing_text(const JudgeReport& report) {
  const question::Tally total = report.total();
  std::string text;
  if (total[Count::missing] > 0 && !report.is_broken())
    text += fmt::format("; {} of {} answers missing", total[Count::missing], total.queries);
  if (const std::size_t rows = report.rows_given_up(); rows > 0)
    text += fmt::format("; given up in {} of {} rows", rows, report.rows.size());
  if (const std::size_t rows = report.rows_too_slow(); rows > 0)
    text += fmt::format("; too slow to ask in {} of {} rows", rows, report.rows.size());
  return text;
}

std::string nonsense_text(const JudgeReport& report) {
  const std::size_t number = report.total()[Count::nonsense];
  return number == 0
             ? ""
             : fmt::format("; {} invalid {} answered", number, number == 1 ? "question" : "questions");
}

// ---- Three lines

std::string name_text(const JudgeReport& report) {
  const auto library = report.library();
  return library ? fmt::format("{} ({})", *library, report.engine.name) : report.engine.name;
}

// "published, of lorentz 0.1.0; judged in binary64, times to 4 ulps of the inputs"
std::string what_text(const JudgeReport& report) {
  const auto& tolerance = report.claim.time_tolerance;
  const std::string times = !tolerance ? fmt::format("times to {} ulps of the inputs", report.ulps)
                            : std::isinf(*tolerance) ? "times not judged"
                                                     : fmt::format("times to {} of themselves", *tolerance);
  return fmt::format("{}{}; judged in {}, {}", name_text(report),
                     report.engine.is_own() ? ", of lorentz " + report::manifest_of(0, "").version : "",
                     name_of(report.claim.precision), times);
}

// 46000 as "46 000".
std::string grouped(std::size_t number) {
  std::string text = std::to_string(number);
  for (std::size_t at = text.size(); at > 3; text.insert(at -= 3, " ")) {
  }
  return text;
}

std::string wrong_text(const question::Tally& t) {
  const std::size_t wrong = t.counts.sum({Count::wrong, Count::error});
  return wrong == 0 ? "none wrong" : percent(wrong, judged_of(t)) + " wrong";
}

// "none wrong of 46 000 drawn; hard cases: 4.7 % wrong (of 3 210); 10 % of all undecided"
std::string how_bad_text(const JudgeReport& report) {
  const question::Tally drawn = sum_of(report.rows, false), hard = sum_of(report.rows, true),
                        all = report.total();
  if (judged_of(all) == 0 && report.rows_too_slow() > 0) return "nothing was judged: it is too slow to ask";
  if (judged_of(all) == 0)
    return all.queries > 0 ? "nothing was judged: all is unsupported" : "nothing was asked";
  if (all[Count::missing] == judged_of(all))
    return fmt::format("nothing was judged: {} questions, and no answer", grouped(all[Count::missing]));
  std::vector<std::string> parts;
  if (judged_of(drawn) > 0)
    parts.push_back(fmt::format("{} of {} drawn", wrong_text(drawn), grouped(judged_of(drawn))));
  if (judged_of(hard) > 0)
    parts.push_back(fmt::format("hard cases: {} (of {})", wrong_text(hard), grouped(judged_of(hard))));
  const auto add = [&](std::size_t number, const char* what) {
    if (number > 0) parts.push_back(percent(number, judged_of(all)) + " of all " + what);
  };
  add(all[Count::missing], "without an answer");
  add(all[Count::wrong_time], "with a wrong time");
  add(all[Count::undecided], "undecided");
  if (report.was_stopped) parts.push_back("interrupted");
  return fmt::format("{}", fmt::join(parts, "; "));
}

std::string nothing_wrong_text(const JudgeReport& report) {
  const question::Tally drawn = sum_of(report.rows, false);
  if (drawn.counts.answers() == 0) return "nothing wrong was found";
  return fmt::format(
      "nothing wrong was found: of flights like the drawn ones fewer than {} % are wrong (with 95 %)",
      two_digits(100 * report::bound_of_none(drawn.counts.answers())));
}

// " at speeds from 0.001 to 1000 and coordinates up to 1e+06"
std::string words_of(const Domain& domain) {
  const auto range = [](const char* what, const Domain::Range& its) {
    return its == Domain::Range() ? std::string()
           : its.low == 0         ? fmt::format("{} up to {:g}", what, its.high)
           : std::isinf(its.high) ? fmt::format("{} from {:g} on", what, its.low)
                                  : fmt::format("{} from {:g} to {:g}", what, its.low, its.high);
  };
  const std::string speed = range("speeds", domain.speed),
                    coordinates = range("coordinates", domain.coordinates);
  return speed + (speed.empty() || coordinates.empty() ? "" : " and ") + coordinates;
}

std::vector<std::string> next_steps(const JudgeReport& report) {
  std::vector<std::string> steps;
  if (report.times_in_binary32 > 0 && report.claim.precision == NumberFormat::binary64)
    steps.push_back(fmt::format(
        "all {} times are binary32 numbers: if it computes in binary32, judge it so, --precision binary32 "
        "(docs/judging_yours.md#if-your-engine-cannot-do-all-of-this)",
        report.times_in_binary32));
  if (report.free_domain)
    steps.push_back(
        fmt::format("no fault was found at {}: if more is not needed, declare it,{} "
                    "(docs/judging_yours.md#a-declared-domain)",
                    words_of(*report.free_domain), report::arguments_of({.domain = *report.free_domain})));
  if (worst_of(report))
    steps.push_back("mend the first, and judge again: one line of code often makes several findings");
  return steps;
}

}  // namespace

question::Tally JudgeReport::total() const {
  question::Tally total = sum_of(rows, false);
  total.add(sum_of(rows, true));
  return total;
}

std::size_t JudgeReport::rows_given_up() const {
  return static_cast<std::size_t>(
      std::ranges::count_if(rows, [](const ExaminedRow& row) { return row.scenes_given_up > 0; }));
}

std::size_t JudgeReport::rows_too_slow() const {
  return static_cast<std::size_t>(
      std::ranges::count_if(rows, [](const ExaminedRow& row) { return row.tally[Count::too_slow] > 0; }));
}

std::optional<double> JudgeReport::max_radii() const {
  const auto drawn = largest_radii(rows, false), hard = largest_radii(rows, true);
  return std::max(drawn, hard);
}

bool JudgeReport::is_broken() const {
  const question::Tally t = total();
  return 100 * t[Count::missing] > t.queries;
}

std::string JudgeReport::verdict() const {
  const question::Tally t = total();
  if (is_broken()) return "broken";
  if (t.counts.sum({Count::wrong, Count::error}) > 0 || (times && t[Count::wrong_time] > 0) ||
      (strict && t[Count::nonsense] > 0))
    return "wrong";
  if (t[Count::agree] + t[Count::ill_posed] <= t[Count::undecided]) return "undecided";
  return t[Count::ill_posed] > 0 ? "ill-posed" : "right";
}

std::string JudgeReport::line() const {
  const std::string words = report::words_of(claim);
  return heading(*this) + (words.empty() ? "" : "; judged" + words.substr(1)) +
         (was_stopped ? "; interrupted before all was asked" : "") + missing_text(*this) +
         shares_text("ill-posed", rows, Count::ill_posed) + shares_text("undecided", rows, Count::undecided) +
         times_text(*this) + paths_text(flown) + speed_text(*this) + nonsense_text(*this);
}

ThreeLines JudgeReport::summary() const {
  const Finding* worst = worst_of(*this);
  return {what_text(*this), how_bad_text(*this), worst ? worst->summary() : nothing_wrong_text(*this),
          next_steps(*this), worst};
}

}  // namespace lorentz::judge
