#include "cli/lineup.hpp"

#include <algorithm>
#include <cmath>

#include <lorentz/exchange.hpp>
#include <lorentz/margin.hpp>
#include "cli/terminal.hpp"
#include "judge/diagnosis.hpp"
#include "judge/golden/record.hpp"
#include "question/race.hpp"
#include "report/reason.hpp"
#include "report/share.hpp"
#include "report/table.hpp"
#include "src/problem/safe_text.hpp"

namespace lorentz::cli {

using namespace question;
using oracle::Verdict;

namespace {

// ---- A failure for people

// The margin in the record, or a computed one if the record's is in ulps of another precision.
std::optional<double> margin_of(const Question& question) {
  if (question.margin || !question.is_query()) return question.margin;
  const auto decision = question.place->margins().hardest_decision(question.query, question.exact);
  return decision ? std::optional(decision->margin) : std::nullopt;
}

// What the time of the right obstacle is.
std::string words_of_time(const Question& question, const Answer& given, bool other_quantity) {
  const std::string_view quantity = judge::quantity_of(question, given);
  if (!quantity.empty()) return fmt::format("{}, not the time of the entry", quantity);
  return other_quantity ? "another quantity than a time of that collision"
                        : "a wrong time of the right obstacle";
}

// What is wrong with the answer.
std::string fault_of(const Judged& judged) {
  const auto& [question, reply, judgement] = judged;
  const Answer &exact = question.exact, &given = reply.answer;
  if (judgement.verdict == Verdict::missing) return "there is no answer";
  if (given.outcome == Outcome::hit && exact.outcome == Outcome::hit && given.obstacle == exact.obstacle)
    return fmt::format("{}: off by {:.3g} times what an ulp in each input makes of the time",
                       words_of_time(question, given, judgement.other_quantity), judgement.departs);
  if (std::isfinite(judgement.departs) && judgement.verdict == Verdict::wrong)
    return fmt::format("right only if the inputs moved by {:.4g} ulps", judgement.departs);
  return judgement.verdict == Verdict::error ? "the question is a good one"
                                             : "no error in the inputs explains it";
}

// The question, both answers, and why they differ; for a record also where it is, and how to ask it again.
std::string description(const Judged& judged, const std::string& engine, const AskedPart& part) {
  const auto& [question, reply, judgement] = judged;
  const Place& place = *question.place;
  const Scene& scene = place.scene();
  std::string asked = '{' + question.text + "}\n", truth, says;
  if (question.is_query())
    asked.clear(), append_query_line(asked, question.id, question.query, scene, question.max_time);
  Answer exact = question.has_limit() && is_later(question) ? Answer::later() : question.exact;
  exact.time_decimal.clear();
  append_answer_line(truth, question.id, exact, scene);
  append_answer_line(says, question.id, reply.answer, scene);
  std::string text = "  " + asked;
  if (!part.set.empty()) {
    const auto margin = margin_of(question);
    text += printable(fmt::format("    of {}: {}", part.set, fmt::join(question.tags, ", "))) +
            (margin ? fmt::format("; its margin: {:.4g} ulps\n", *margin) : "\n");
  }
  text += fmt::format("    says  {}    truth {}    {}\n", says, truth, fault_of(judged));
  if (question.is_query() && judgement.verdict == Verdict::wrong)
    for (const std::string& line : report::reason_of(place.margins(), scene, question.query, question.exact,
                                                     reply.answer, judgement.obstacle))
      text += "    " + line + '\n';
  if (part.set.empty()) return text;
  return text + fmt::format("    again: lorentz golden check --engine {}{} --id {} {}\n",
                            shell_quoted(engine), part.claim, shell_quoted(question.where),
                            shell_quoted(part.set));
}

// A record's id, or the one that it would have.
std::string id_of(const Question& question) {
  if (!question.where.empty()) return question.where;
  return golden::id_of(question.place->scene(), question.query);
}

}  // namespace

Tally LineupEntry::total() const {
  Tally total = examination.total();
  total.speed = speed;
  return total;
}

Lineup::Lineup(const ExaminationOptions& options, const std::vector<EngineInfo>& engines)
    : options_(options),
      asking_{{}, options.longest_wait(), terminal(), options.strict},
      disagreements_(options.disagreements) {
  for (const EngineInfo& engine : engines)
    all_.emplace_back(Examination(engine, asking_, options.tolerance(), options.jobs), options.files).engine =
        engine;
}

void Lineup::add(const std::string& name, std::unique_ptr<LoggedAnswers> answers) {
  LoggedAnswers* const logged = answers.get();
  all_.emplace_back(Examination(name, std::move(answers), options_.tolerance()), options_.files).logged =
      logged;
}

void Lineup::begin(const std::string& row) {
  for (LineupEntry& one : all_) {
    one.examination.try_again();
    one.row = one.examination.answerer().is_hopeless() ? nullptr : &one.examination.add({row});
  }
}

void Lineup::ask(const AskedPart& part) {
  if (!part.questions.empty()) disagreements_.begin(part.questions[0].place);
  for (LineupEntry& one : all_)
    if (one.row) one.examination.ask(part.questions, [&](const Judged& judged) { take(judged, part, one); });
}

void Lineup::take(const Judged& judged, const AskedPart& part, LineupEntry& one) {
  const auto& [question, reply, judgement] = judged;
  if (!reply.was_asked() && !part.set.empty()) {
    ++one.row->not_asked;
    return;
  }
  one.row->count(judged);
  const auto failure = failure_of(judgement, options_.times, options_.strict);
  const bool is_new =
      one.ledger.needs_ids() ? one.ledger.take(one.row->name, id_of(question), failure) : failure.has_value();
  if (departs(judgement) && (!judgement.wrong_time || options_.times))
    disagreements_.add(judged, one.examination.name());
  const bool is_lenient = judgement.verdict == Verdict::ill_posed || judgement.verdict == Verdict::undecided;
  if (!is_new || is_lenient || !reply.was_asked() || options_.json ||
      one.failures.size() >= options_.failures)
    return;
  one.failures.push_back(description(judged, one.examination.name(), part));
}

void Lineup::pass_over(const std::vector<Question>& questions) {
  for (LineupEntry& one : all_)
    if (one.logged) one.examination.ask(questions, [](const Judged&) {});
}

void Lineup::end(bool is_whole) {
  for (LineupEntry& one : all_) {
    if (!one.row) continue;
    const std::size_t not_asked = one.row->not_asked;
    if (not_asked > 0)
      say("{}: given up in {}: {} records were not asked", one.examination.name(), one.row->name, not_asked);
    else if (is_whole)
      one.ledger.end(one.row->name);
  }
}

void Lineup::race(const std::vector<Question>& questions) {
  RaceOptions options{.answerer = asking_};
  std::vector<EngineInfo> engines;
  std::vector<LineupEntry*> racing;
  for (LineupEntry& one : all_)
    if (one.engine && !one.examination.failed()) {
      engines.push_back(*one.engine), racing.push_back(&one);
      options.running.push_back(&one.examination.answerer());
    }
  const std::vector<Speed> speeds = question::race(questions, engines, options);
  for (std::size_t i = 0; i < speeds.size(); ++i) racing[i]->speed = speeds[i];
}

int Lineup::finish(bool had_bad_input) {
  int status = kDone;
  const auto at_least = [&](bool applies, ExitStatus its) {
    if (applies) status = std::max<int>(status, its);
  };
  for (LineupEntry& one : all_) {
    one.examination.finish();
    if (const auto time = one.examination.answerer().own_time()) one.speed.own_ns = time->ns_per_query();
    one.ledger.finish(one.examination.name());
    at_least(one.examination.failed(), kFailed);
    at_least(had_bad_input || (one.logged && one.logged->had_bad_input()), kBadInput);
    const Counts counts = one.examination.total().counts;
    at_least(one.ledger.failures(counts, options_.times, options_.strict) > 0, kDisagreement);
  }
  disagreements_.close();
  return status;
}

// ---- Tables and sentences

namespace {

std::string share(std::size_t part, std::size_t whole) {
  if (part == 0 || whole == 0) return std::to_string(part);
  return fmt::format("{} ({:.3g} %)", part, 100.0 * static_cast<double>(part) / static_cast<double>(whole));
}

std::string nanoseconds(double ns) {
  return ns == 0 ? "-" : fmt::format("{:.0f}", ns);
}

// ": off by 3 ulps (median), 7 (99 %), 9 (largest);", and the same in units of the condition.
std::string wrong_times_of(const Tally& t) {
  return fmt::format(
      "\n  {} of right obstacles: off by {:.3g} ulps (median), {:.3g} (99 %), {:.3g} (largest);\n"
      "  {:.3g}, {:.3g}, {:.3g} times what an ulp in each input makes of them",
      counted_text(t.counts, {Count::wrong_time}), quantile(t.wrong_ulps, 0.5), quantile(t.wrong_ulps, 0.99),
      quantile(t.wrong_ulps, 1), quantile(t.wrong_conditions, 0.5), quantile(t.wrong_conditions, 0.99),
      quantile(t.wrong_conditions, 1));
}

}  // namespace

std::string times_of(const std::list<LineupEntry>& all) {
  report::Table table({"engine", "queries", "ns/query", "ns median"});
  for (const LineupEntry& one : all) {
    const Tally t = one.total();
    table.add({t.name, std::to_string(t.queries), nanoseconds(t.speed.ns_per_query),
               nanoseconds(t.speed.ns_median)});
  }
  return table.text();
}

std::string table_of(const std::list<LineupEntry>& all) {
  report::Table table(titles_counted(Counted::examinations, {"engine", "queries"},
                                     {"max ulp", "mean ulp", "ns/query", "ns median"}));
  for (const LineupEntry& one : all) {
    const Tally t = one.total();
    const auto text = [&](Count count, std::size_t number) {
      return count == Count::wrong || count == Count::wrong_time ? share(number, t.counts.answers())
                                                                 : std::to_string(number);
    };
    const auto ulps = [&](double number) { return t.ulps.empty() ? "-" : fmt::format("{:.3g}", number); };
    table.add(cells_counted(t.counts, Counted::examinations, {t.name, std::to_string(t.queries)},
                            {ulps(t.max_ulp()), ulps(t.mean_ulp()), nanoseconds(t.speed.ns_per_query),
                             nanoseconds(t.speed.ns_median)},
                            text));
  }
  return table.text();
}

std::string verdict_of(const Tally& t) {
  const std::size_t answers = t.counts.answers();
  const std::string others =
      t[Count::agree] + t[Count::wrong] == t.queries
          ? ""
          : "; " + counted_text(t.counts, {Count::ill_posed, Count::undecided, Count::unsupported,
                                           Count::error, Count::missing});
  if (answers == 0) return fmt::format("{}: no answer to judge{}", t.name, others);
  std::string text =
      t[Count::wrong]
          ? fmt::format("{}: wrong in {} of {} answers", t.name, t[Count::wrong], answers)
          : fmt::format("{}: no wrong answer in {} (with 95 %: in fewer than {:.2g} % of such questions)",
                        t.name, answers, 100 * report::bound_of_none(answers));
  text += others;
  if (const std::size_t others_of_time = t[Count::other_quantity]; others_of_time > 0)
    text += fmt::format("; in {} the time is another quantity", others_of_time);
  if (t.speed.own_ns)
    text += fmt::format("; over all of its calls its process counted {:.3g} ns a query", *t.speed.own_ns);
  return t[Count::wrong_time] == 0 ? text : text + wrong_times_of(t);
}

}  // namespace lorentz::cli
