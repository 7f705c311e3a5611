#include "judge/judge_report.hpp"

#include <algorithm>

#include <fmt/format.h>

#include <lorentz/geometry.hpp>
#include "judge/plan.hpp"
#include "judge/simplest.hpp"
#include "question/race.hpp"
#include "src/problem/scene_geometry.hpp"
#include "src/problem/threads.hpp"

namespace lorentz::judge {

using starts::Kind;

namespace {

// The order, how its engine is asked, and the time until the end of the run.
struct Terms {
  const JudgeOrder& order;
  question::AnswererOptions answerer;
  const std::atomic<bool>& stop;
  const Countdown all;

  // The seconds of a part: all that it needs if questions are counted, except for the measurement of speed.
  double seconds_of(JudgePart part) const {
    if (order.questions && part != JudgePart::speed) return kEver;
    return judge::seconds_of(part, order, all.left());
  }

  unsigned jobs() const { return order.questions ? 1 : order.jobs; }
  std::unique_ptr<TimedExamination> examination(const JudgeOrder& its) const {
    auto one = std::make_unique<TimedExamination>(its, answerer, stop);
    one->limit(all.left());
    return one;
  }
  /// An examination without a listener.
  std::unique_ptr<TimedExamination> silent_examination(const question::Listener& listener = {}) const {
    Terms silent = *this;
    silent.answerer.listener = listener;
    JudgeOrder its = order;
    its.on_progress = {}, its.on_judged = {};
    return silent.examination(its);
  }
};

// ---- Questions

// The length of the flight in lattice vectors; infinite if it does not end.
double length_of_flight(const Question& question) {
  if (!question.is_query()) return 0;
  const Scene& scene = question.place->scene();
  const bool repeats = std::ranges::any_of(
      scene.lattices, [&](const Lattice& lattice) { return lattice.rank_in(scene.dimension) > 0; });
  if (question.exact.outcome == Outcome::inside || !repeats) return 0;
  if (question.exact.outcome != Outcome::hit) return std::numeric_limits<double>::infinity();
  return *question.exact.time * length_of_any(question.query.v) / shortest_vector(scene);
}

// Asks one question of each row, the one with the shortest flight first: an engine that is slow has then
// answered something everywhere before long flights take all the time.
void ask_one_each(TimedExamination& examination, JudgePlan& plan, const Terms& terms) {
  std::vector<std::tuple<double, const PlannedRow*, Question>> firsts;
  for (PlannedRow& row : plan.rows())
    if (const auto question = examination.is_over() ? std::nullopt : row.source())
      firsts.emplace_back(length_of_flight(*question), &row, *question);
  std::ranges::stable_sort(firsts, {}, [](const auto& first) { return std::get<double>(first); });
  for (const auto& [flight, row, question] : firsts)
    examination.run(row->row, question::all_of({&question, 1}), terms.all.left(), row->look, 1);
  examination.run(campaign_row(), plan.campaign(0, terms.jobs()), terms.all.left(), {}, 1);
}

// The campaign runs in threads, each with an examination and scenes of its own.
void run_campaign(TimedExamination& first, JudgePlan& plan, const Terms& terms) {
  const unsigned jobs = terms.jobs();
  const double seconds = terms.seconds_of(JudgePart::campaign);
  std::vector<std::unique_ptr<TimedExamination>> others;
  std::vector<std::future<void>> threads;
  for (unsigned part = 1; part < jobs; ++part) {
    others.push_back(terms.silent_examination(terms.answerer.listener));
    const auto work = [seconds, &its = *others.back(), source = plan.campaign(part, jobs)] {
      its.run(campaign_row(), source, seconds);
    };
    threads.push_back(std::async(kInThreadIfPossible, work));
  }
  first.run(campaign_row(), plan.campaign(0, jobs), seconds);
  for (std::future<void>& thread : threads) thread.get();
  for (const auto& other : others) {
    other->finish();
    first.results().add(other->results());
  }
}

// Asks the rows of each part in turn; then the campaign, which depends on what the engine did in them.
void ask_all(TimedExamination& examination, JudgePlan& plan, const Terms& terms) {
  for (const PlannedRow& row : plan.rows()) examination.results().row(row.row);
  examination.results().row(campaign_row());
  if (!terms.order.questions) ask_one_each(examination, plan, terms);
  for (const JudgePart part : {JudgePart::drawn, JudgePart::hard, JudgePart::paths, JudgePart::golden}) {
    auto rows = std::ranges::count(plan.rows(), part, &PlannedRow::part);
    const Countdown time(terms.seconds_of(part));
    for (const PlannedRow& row : plan.rows())
      if (row.part == part) examination.run(row.row, row.source, time.share(rows--), row.look);
  }
  run_campaign(examination, plan, terms);
}

// ---- The simplest case of each finding

void find_simplest(std::vector<Finding>& findings, TimedExamination& examination, double seconds) {
  examination.limit(seconds);
  const Countdown time(seconds);
  auto left_over = std::ssize(findings);
  for (Finding& finding : findings) {
    const Question met = finding.simplest.question;
    finding.simplest = simplest(finding, examination, time.share(left_over--));
    const Question& left = finding.simplest.question;
    finding.was_shrunk = left.place->scene() != met.place->scene() || left.query.x != met.query.x ||
                         left.query.v != met.query.v || left.query.from != met.query.from;
  }
}

// Checks whether an external engine goes wrong on a simplest case by itself. Besides its share of the time, a
// new start gets kForOne times the first start's time until its answer, if there is so much left.
void recheck_all(std::vector<Finding>& findings, const Terms& terms, double seconds, double first_answer) {
  constexpr double kForOne = 4;
  const Countdown time(seconds);
  auto parts = 2 * std::ssize(findings);
  for (Finding& finding : findings)
    if (finding.severity() != Severity::ill_posed)
      judge::recheck(
          finding, [&] { return terms.silent_examination(); },
          std::min(time.share(parts--) + kForOne * first_answer, terms.all.left()));
}

// Finds the simplest case of each finding.
void simplify(std::vector<Finding>& findings, TimedExamination& examination, const Terms& terms,
              double first_answer) {
  const double seconds = terms.seconds_of(JudgePart::simplest);
  if (!terms.order.engine.runs_apart()) return find_simplest(findings, examination, seconds);
  find_simplest(findings, examination, seconds / 2);
  recheck_all(findings, terms, seconds / 2, first_answer);
}

// ---- Speed

// The square and cubic lattice at r = 0.1, if the engine answered there; else the first place where it did.
std::vector<const NamedPlace*> places_to_race_in(const std::vector<NamedPlace>& places) {
  std::vector<const NamedPlace*> answered, chosen;
  for (const NamedPlace& place : places)
    if (place.place->was_answered() && !place.place->is_beyond_engine()) answered.push_back(&place);
  for (const NamedPlace* place : answered)
    if (place->name == "square, r = 0.1" || place->name == "cubic, r = 0.1") chosen.push_back(place);
  if (chosen.empty() && !answered.empty()) chosen.push_back(answered.front());
  return chosen;
}

// `count` questions of each place, or those of them that are in the engine's domain.
std::vector<question::Question> questions_to_race_in(const std::vector<const NamedPlace*>& places,
                                                     std::uint64_t seed, std::size_t count) {
  std::vector<question::Question> all;
  Outside outside = 0;
  for (const NamedPlace* named : places)
    for (const Query& start : starts::free_starts(named->place->scene(), Kind::uniform, seed, count,
                                                  named->place->claim().precision))
      if (auto question = question_in(named->place, start, named->name, outside))
        all.push_back(std::move(*question));
  return all;
}

constexpr std::size_t kFewestToRace = 32, kMostToRace = 2000;  // fewer say nothing

std::size_t affordable(const JudgeReport& report, int rounds, double seconds) {
  double slowest = 1;
  for (const ExaminedRow& row : report.rows)
    if (!row.is_hard) slowest = std::max(slowest, row.tally.speed.ns_per_query);
  return static_cast<std::size_t>(
      std::clamp<double>(1e9 * seconds / rounds / slowest, kFewestToRace, kMostToRace));
}

void race(JudgeReport& report, const std::vector<NamedPlace>& places, const Terms& terms) {
  constexpr int kRounds = 5;
  constexpr double kTooLong = 2;  // times the planned duration
  const double seconds = terms.seconds_of(JudgePart::speed);
  const std::vector<const NamedPlace*> chosen = places_to_race_in(places);
  if (chosen.empty() || seconds == 0) return;
  const std::size_t count = affordable(report, kRounds, seconds);
  const Countdown until(
      std::min(kTooLong * (seconds + report.start_up) + terms.answerer.timeout, terms.all.left()));
  question::RaceOptions options{kRounds, terms.answerer};
  options.answerer.enough = [&] { return terms.stop || until.left() == 0; };
  const std::vector<question::Question> questions = questions_to_race_in(chosen, report.seed, count);
  if (questions.size() < kFewestToRace) return;
  const std::vector<question::Speed> speeds =
      question::race(questions, {report.engine, question::engine_named("reduction")}, options);
  const bool is_cut = report.engine.runs_apart() && options.answerer.enough();
  if (speeds[0].failed || is_cut) return;
  report.ns_per_query = speeds[0].ns_per_query;
  report.own_ns = speeds[0].own_ns;
  report.ns_of_reduction = speeds[1].ns_per_query;
  report.processor_ns = speeds[0].processor_ns;
  report.processor_ns_of_reduction = speeds[1].processor_ns;
  std::vector<std::string> names;
  for (const NamedPlace* place : chosen)
    if (std::ranges::count(questions, place->name, &Question::where)) names.push_back(place->name);
  report.speed_of =
      fmt::format("{} drawn flights in {}, in turn with reduction", questions.size(), fmt::join(names, "; "));
}

// If the order has no timeout, it is much longer than any answer should take here, and a small part of the
// whole time. A program's first answer may take as long as elsewhere.
question::AnswererOptions options_of(const JudgeOrder& order) {
  constexpr double kShortest = 2, kPart = 0.1;
  const double most = question::AnswererOptions::kDefaultTimeout;
  question::AnswererOptions options;
  options.timeout = order.timeout     ? *order.timeout
                    : order.questions ? most
                                      : std::clamp(kPart * order.seconds(), kShortest, most);
  options.start_timeout = order.timeout.value_or(most);
  options.listener = order.listener;
  return options;
}

}  // namespace

std::size_t number_of_rows(const JudgeOrder& order) {
  return JudgePlan(order).rows().size() + 1;
}

JudgeReport judged(const JudgeOrder& order, const std::atomic<bool>& stop) {
  const Terms terms{order, options_of(order), stop,
                    order.questions ? Countdown(kEver) : Countdown(order.seconds(), order.begun)};
  JudgeReport report{order};
  report.longest_wait = terms.answerer.timeout;
  const std::unique_ptr<TimedExamination> examination = terms.examination(order);
  if (const std::vector<double> seconds = examination->warm_up(); !seconds.empty()) {
    report.first_answer = std::ranges::max(seconds);
    report.start_up = report.first_answer - seconds.back();
  }
  JudgePlan plan(order);
  ask_all(*examination, plan, terms);
  report.flown = plan.flown();
  report.outside = plan.outside();
  report.rows = examination->results().rows;
  report.findings = examination->results().all_findings();
  report.curves = examination->results().curves;
  report.times_in_binary32 = examination->results().all_in_binary32();
  if (order.claim.domain == Domain())
    report.free_domain = examination->results().findings.domain_without_fault();
  if (!stop) simplify(report.findings, *examination, terms, report.first_answer);
  report.misbehaved = examination->failed();
  examination->finish();
  report.was_stopped = stop;
  if (!stop && !report.is_broken()) race(report, plan.places(), terms);
  return report;
}

}  // namespace lorentz::judge
