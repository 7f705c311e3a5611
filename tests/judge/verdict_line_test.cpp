// The verdict in one line: which fault comes first, and how numbers are written.
#include <catch2/catch.hpp>

#include <algorithm>

#include "judge/judge_report.hpp"
#include "tests/support/command_line.hpp"

using namespace lorentz;
using namespace lorentz::judge;
using lorentz::test::contains;

namespace {

judge::ExaminedRow row(bool hard, std::size_t queries) {
  judge::ExaminedRow row{hard ? "hard" : "plain", "", hard};
  row.tally.name = row.name;
  row.tally.queries = row.tally.counts[Count::agree] = queries;
  return row;
}

// Gives `number` answers that agreed another verdict.
void turn(judge::ExaminedRow& row, Count verdict, std::size_t number) {
  row.tally.counts[Count::agree] -= number;
  row.tally.counts[verdict] += number;
}

JudgeReport report_of(std::deque<judge::ExaminedRow> rows) {
  JudgeReport report;
  report.engine = question::engine_named("cmd:it");
  report.rows = std::move(rows);
  return report;
}

judge::Finding finding(const judge::Question& question, judge::Cause cause, judge::Severity severity) {
  return {{question, Answer::never(), {}, {cause, severity, 0.5}}, "here", 1, 0.5};
}

judge::Question one_question() {
  const auto place = std::make_shared<question::Place>(unit_scene(2, 0.25));
  const Query query{{0.5, 0, 0}, {1, 0, 0}, {}};
  return {.place = place, .query = query, .exact = place->exact(query), .where = "here"};
}

}  // namespace

TEST_CASE("The verdict line: two digits of shares and speed, all before the point of what is larger",
          "[judge][verdict_line]") {
  JudgeReport report = report_of({row(false, 1000), row(true, 300)});
  CHECK(report.line() == "right: no wrong answer in 1300");
  turn(report.rows[0], Count::undecided, 1);
  turn(report.rows[1], Count::undecided, 47);
  report.ns_per_query = 1812.4;
  report.ns_of_reduction = 300.0;
  CHECK(
      report.line() ==
      "right: no wrong answer in 1252; undecided 0.1 % of drawn flights, 16 % of hard ones; 1812 ns a query, "
      "6 times lorentz's own engine");
  report.ns_per_query = 2.5e7;
  CHECK(contains(report.line(), "; 2.5e+07 ns a query, 83333 times lorentz's own engine"));
  // Where processors were timed on both sides it is they that are compared: the wall's time is others', too.
  report.processor_ns = 9000;
  CHECK(contains(report.line(), ", 83333 times lorentz's own engine"));
  report.processor_ns_of_reduction = 281;
  CHECK(contains(report.line(), "; 2.5e+07 ns a query (9000 of processors), 32 times lorentz's own engine"));
  CHECK(contains(report.json(), R"("processor_ns_per_query":9000,"processor_ns_of_reduction":281,)"));
  turn(report.rows[1], Count::ill_posed, 1);
  CHECK(
      report.line().starts_with("ill-posed: no wrong answer in 1252; 1 that rounding of the inputs explains; "
                                "ill-posed 0 % of drawn flights, "
                                "0.33 % of hard ones; undecided 0.1 %"));
  turn(report.rows[1], Count::undecided, 250);
  turn(report.rows[0], Count::undecided, 900);
  CHECK(report.line().starts_with("undecided: it decided 102 of 1300 queries, none of them wrong; "));
}

TEST_CASE("The verdict line: wrong times are told with the share of answers, and condemn if they are to",
          "[judge][verdict_line]") {
  JudgeReport report = report_of({row(false, 1000), row(true, 0)});
  report.rows[0].tally.ulps = {1, 3.14159, 0.5};
  report.rows[0].max_radii = 2.5e-16;
  CHECK(report.line() ==
        "right: no wrong answer in 1000; times within 2.5e-16 radii along the ray (3.14159 ulps) on drawn "
        "flights, no wrong time");
  report.rows[0].tally.counts[Count::wrong_time] = 2;
  report.rows[0].tally.wrong_ulps = {12, 1234567};
  report.rows[0].max_radii = 0.003;
  CHECK(report.line() ==
        "right: no wrong answer in 1000; wrong times 0.2 %, by up to 0.003 radii along the ray");
  report.rows[0].tally.ulps = {1e132};  // of a time near 0
  CHECK(contains(report.text(true), "0.003   > 2^20"));
  CHECK_FALSE(contains(report.text(true), "e+132"));
  CHECK(report.verdict() == "right");
  report.times = true;
  CHECK(report.verdict() == "wrong");
}

TEST_CASE("The verdict line names the first fault that condemns, and counts the others",
          "[judge][verdict_line]") {
  JudgeReport report = report_of({row(false, 1000), row(true, 300)});
  turn(report.rows[0], Count::wrong, 5);
  const judge::Question question = one_question();
  const auto add = [&](judge::Cause cause, judge::Severity severity) {
    report.findings.push_back(finding(question, cause, severity));
  };
  add(judge::Cause::never_for_hit, judge::Severity::wrong);
  const std::string main = "says never where an obstacle is hit (entered by up to 0.5 of its radii)";
  CHECK(report.line() == "wrong: " + main);
  add(judge::Cause::no_answer, judge::Severity::error);
  add(judge::Cause::wrong_time, judge::Severity::wrong_time);
  add(judge::Cause::passed_over, judge::Severity::ill_posed);
  CHECK(report.line() == "wrong: " + main);
  report.times = true;
  CHECK(report.line() == "wrong: 2 kinds of fault, above all: " + main);
  turn(report.rows[1], Count::missing, 13);
  CHECK(report.verdict() == "wrong");
  CHECK(report.line() == "wrong: 2 kinds of fault, above all: " + main + "; 13 of 1300 answers missing");
  turn(report.rows[1], Count::missing, 1);
  CHECK(report.verdict() == "broken");
  CHECK(report.line() ==
        "broken: 14 of 1300 queries without an answer that could be read; wrong: 2 kinds of fault, "
        "above all: " +
            main);
}

TEST_CASE("Without an answer to a drawn question nothing is said of these", "[judge][verdict_line]") {
  JudgeReport report = report_of({row(false, 100), row(true, 10)});
  turn(report.rows[0], Count::unsupported, 100);
  CHECK(contains(report.text(false), "\nworst:   nothing wrong was found\n"));
}

TEST_CASE("Three lines come first: what, how bad, and the worst of it", "[judge][verdict_line]") {
  JudgeReport report = report_of({row(false, 46000), row(true, 3210)});
  const auto begins = [&](const std::string& how_bad, const std::string& worst) {
    const std::string text = report.text(false);
    INFO(text);
    return text.starts_with("what:    cmd:it; judged in binary64, times to 4 ulps of the inputs\nhow bad: " +
                            how_bad + "\nworst:   " + worst + "\n\n");
  };
  CHECK(begins(
      "none wrong of 46 000 drawn; hard cases: none wrong (of 3 210)",
      "nothing wrong was found: of flights like the drawn ones fewer than 0.0065 % are wrong (with 95 %)"));
  turn(report.rows[1], Count::wrong, 151);
  turn(report.rows[1], Count::undecided, 492);
  turn(report.rows[0], Count::unsupported, 6000);
  const judge::Question question = one_question();
  report.findings.push_back(finding(question, judge::Cause::wrong_time, judge::Severity::wrong_time));
  report.findings.push_back(finding(question, judge::Cause::never_for_hit, judge::Severity::wrong));
  CHECK(begins("none wrong of 40 000 drawn; hard cases: 4.7 % wrong (of 3 210); 1.1 % of all undecided",
               "says never where an obstacle is hit (entered by up to 0.5 of its radii)"));
  CHECK(contains(
      report.json(),
      R"x("worst":"says never where an obstacle is hit (entered by up to 0.5 of its radii)","finding":1,"next":["mend the first)x"));
  report.findings.pop_back();
  CHECK(report.summary().finding == report.findings.data());  // nothing condemns, but not all is well
  report.claim = {NumberFormat::binary32, 1e-4};
  CHECK(report.summary().what == "cmd:it; judged in binary32, times to 0.0001 of themselves");
  report.engine = question::engine_named("reduction");
  CHECK(report.summary().what.starts_with("reduction, of lorentz "));
}

TEST_CASE("Findings are told in groups, the engine's own faults first", "[judge][verdict_line]") {
  JudgeReport report = report_of({row(false, 1000)});
  const judge::Question question = one_question();
  const auto add = [&](judge::Cause cause, judge::Severity severity) {
    report.findings.push_back(finding(question, cause, severity));
  };
  add(judge::Cause::never_for_hit, judge::Severity::wrong);
  add(judge::Cause::no_answer, judge::Severity::error);
  report.findings.back().simplest.last_words = "Segmentation \x1b[31mfault";
  add(judge::Cause::bad_line, judge::Severity::error);
  add(judge::Cause::passed_over, judge::Severity::ill_posed);
  const std::string text = report.text(true);
  INFO(text);
  std::size_t at = 0;
  for (const char* next : {"-- the engine's own faults", "1. wrong: misses what it hits", "-- died or silent",
                           "2. error: died or silent", "its last line on stderr: Segmentation \\x1b[31mfault",
                           "-- protocol: bad lines", "3. error: bad lines", "-- of floating point, no blame",
                           "4. ill-posed: passes through an obstacle"}) {
    INFO(next);
    const std::size_t place_of_next = text.find(next);
    REQUIRE(place_of_next != std::string::npos);
    CHECK(place_of_next >= at);
    at = place_of_next;
  }
  CHECK(contains(report.json(), R"("title":"misses what it hits","group":"the engine's own faults",)"));
  CHECK(contains(report.json(), R"("primitive":{"origin":["0x1p-1","0x0p+0"],)"));
}

TEST_CASE("The speed of each row is its mean, in the table and as JSON", "[judge][verdict_line]") {
  JudgeReport report = report_of({row(false, 1000), row(true, 300)});
  report.rows[0].tally.speed = {.ns_per_query = 1812, .ns_median = 1700};
  CHECK(contains(report.json(), R"("max_ulp":null,"ns_per_query":1812})"));
  CHECK(contains(report.json(), R"("max_ulp":null,"ns_per_query":null})"));
  CHECK(contains(report.text(true), "1812"));
  CHECK_FALSE(contains(report.text(true), "1700"));
}

TEST_CASE("Answers to invalid questions are counted apart, told last, and count if they are to",
          "[judge][verdict_line]") {
  JudgeReport report = report_of({row(false, 1000), row(true, 300)});
  report.rows[1].tally.counts[Count::nonsense] = 115;
  CHECK(report.line() == "right: no wrong answer in 1300; 115 invalid questions answered");
  CHECK(
      contains(report.json(), R"("queries":1300,"outside_domain":0,"agree":1300,"ill_posed":0,"wrong":0,)"));
  CHECK(contains(report.json(), R"("missing":0,"nonsense":115,"too_slow":0,)"));
  report.strict = true;
  CHECK(report.verdict() == "wrong");
}

TEST_CASE("What was unsupported, what there was no time for, and what was given up are three lists",
          "[judge][verdict_line]") {
  JudgeReport report = report_of({row(false, 1000), row(true, 30), row(true, 0), row(true, 7)});
  const auto name = [&](std::size_t i, const char* text) {
    report.rows[i].name = report.rows[i].tally.name = text;
  };
  name(1, "ellipses"), name(2, "ties"), name(3, "far starts");
  turn(report.rows[1], Count::unsupported, 30);
  turn(report.rows[3], Count::missing, 5);
  report.rows[3].scenes_given_up = 2;
  report.rows[3].last_failure = "cmd died (exit 3) on this query";
  CHECK(contains(report.text(true),
                 "\nunsupported: ellipses\nnot asked, no time: ties\n"
                 "given up in scenes of: far starts (2); cmd died (exit 3) on this query\n"));
  CHECK_FALSE(contains(report.text(true), "\nellipses "));  // nor is there a row of it in the table
  CHECK(report.line() ==
        "right: no wrong answer in 1002; 5 of 1037 answers missing; given up in 1 of 4 rows");
  for (const char* state : {"asked", "unsupported", "no time", "given up"})
    CHECK(contains(report.json(), R"("state":")" + std::string(state) + '"'));
  CHECK_FALSE(contains(report.json(), R"("state":"too slow")"));
  turn(report.rows[1], Count::too_slow, 1);
  CHECK(contains(report.json(), R"("state":"too slow")"));
}

TEST_CASE("The first twenty lines have three findings with what to do, and the verdict",
          "[judge][verdict_line]") {
  JudgeReport report = report_of({row(false, 1000)});
  turn(report.rows[0], Count::wrong, 5);
  const judge::Question question = one_question();
  for (const judge::Cause cause : {judge::Cause::never_for_hit, judge::Cause::behind, judge::Cause::tie,
                                   judge::Cause::false_hit, judge::Cause::inside_unseen})
    report.findings.push_back(finding(question, cause, judge::Severity::wrong));
  report.times_in_binary32 = 40;
  report.free_domain.emplace().speed = {1e-3, 1e3};
  const std::string text = report.text(false);
  INFO(text);
  CHECK(std::ranges::count(text, '\n') <= 20);
  CHECK(contains(
      text, "\n3. wrong: names the other of a tie\n   names one of several obstacles that are entered "));
  CHECK(contains(text,
                 "\n   likely: of hits at the same time name the smallest obstacle (lattice, atom, cell) "
                 "(docs/formats.md#answers)\nand 2 more\n"));
  CHECK_FALSE(contains(text, "4. wrong"));
  CHECK(contains(text, "\nnext:    all 40 times are binary32 numbers: "));
  CHECK(contains(text, "\nnext:    no fault was found at speeds from 0.001 to 1000: "));
  CHECK(contains(text, " --domain speed=0.001..1000 ("));
  CHECK(text.ends_with("\n\n" + report.line() + '\n'));
  CHECK(contains(report.json(), R"("why":"of hits at the same time )"));
  CHECK(contains(report.json(), R"("next":["all 40 times are )"));
  report.claim.precision = NumberFormat::binary32;
  CHECK_FALSE(contains(report.text(false), "are binary32 numbers"));
  CHECK(contains(report.text(true), "5. wrong: starts inside unseen"));
}
