#include "judge/judging.hpp"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <future>

#include <fmt/format.h>

#include "files/scene_file.hpp"
#include "golden/find_sets.hpp"
#include "golden/reader.hpp"
#include "judge/free_paths.hpp"
#include "judge/questions.hpp"
#include "judge/simplest.hpp"
#include "question/race.hpp"

namespace lorentz::judge {

using starts::Kind;

namespace {

// The longest duration of each part, in seconds, and the number of flights that are drawn.
struct TimePlan {
  double drawn, hard, paths, golden, campaign, speed, simplest;
  std::size_t count;
  std::optional<std::size_t> questions = {};  // per row, instead of a time
  double seconds() const { return drawn + hard + paths + golden + campaign + speed + simplest; }
  /// The same plan, scaled to another total time.
  TimePlan lasting(double other) const {
    const double k = other / seconds();
    return {k * drawn, k * hard, k * paths, k * golden, k * campaign, k * speed, k * simplest, count};
  }
  /// `number` questions per row, however long they take. Only the measurement of speed keeps its time.
  TimePlan asking(std::size_t number) const {
    constexpr double kEver = 1e7;  // seconds
    return {kEver, kEver, kEver, kEver, kEver, speed, kEver, number, number};
  }
};
constexpr TimePlan kWhole{15, 8, 3, 24, 58, 4, 12, 4000}, kQuick{4, 2.5, 1, 3.5, 4.5, 1, 3, 500};

// The scenes of the catalogue that are examined, and their radii; scenes without radii keep their own sizes.
struct Scenery {
  const char* scene;
  std::vector<double> radii;
};
const std::vector<Scenery> kSceneries{{"square", {0.3, 0.1, 0.01, 0.001, 1e-6}},
                                      {"cubic", {0.3, 0.1, 0.01, 0.001}},
                                      {"triangular", {0.1, 0.001}},
                                      {"oblique", {}},
                                      {"honeycomb", {}},
                                      {"fcc", {}},
                                      {"hcp", {}},
                                      {"diamond", {}},
                                      {"superposition-pi-5", {}},
                                      {"overlapping", {}},
                                      {"ellipse", {}},
                                      {"ellipsoid", {}},
                                      {"ball", {}}};

std::vector<NamedPlace> places_of(const Scenery& scenery, const Claim& claim) {
  if (scenery.radii.empty()) return {{scenery.scene, place_for(read_scene(scenery.scene, {}), claim)}};
  std::vector<NamedPlace> places;
  for (const double radius : scenery.radii)
    places.push_back({fmt::format("{}, r = {:g}", scenery.scene, radius),
                      place_for(read_scene(scenery.scene, radius), claim)});
  return places;
}

using JudgingClock = std::chrono::steady_clock;

// A stretch of time.
class Countdown {
 public:
  explicit Countdown(double seconds)
      : end_(JudgingClock::now() +
             std::chrono::duration_cast<JudgingClock::duration>(std::chrono::duration<double>(seconds))) {}
  double left() const {
    return std::max(std::chrono::duration<double>(end_ - JudgingClock::now()).count(), 0.0);
  }

 private:
  JudgingClock::time_point end_;
};

// Parts of one stretch of time. The others get the time that one leaves.
class Shares {
 public:
  Shares(double seconds, std::size_t parts) : all_(seconds), parts_(parts) {}
  double next() { return all_.left() / static_cast<double>(std::max<std::size_t>(parts_--, 1)); }

 private:
  Countdown all_;
  std::size_t parts_;
};

// Drawn flights, one row per scene; then two rows of hard flights in all these scenes that have balls.
std::vector<NamedPlace> fly_drawn(Examination& examination, const TimePlan& plan, std::uint64_t seed) {
  std::vector<NamedPlace> all;
  Shares shares(plan.drawn, kSceneries.size());
  for (const Scenery& scenery : kSceneries) {
    const std::vector<NamedPlace> places = places_of(scenery, examination.claim());
    examination.run({fmt::format("drawn {}", scenery.scene), "uniform starts, isotropic directions", false},
                    drawn(places, Kind::uniform, seed, plan.count), shares.next());
    all.insert(all.end(), places.begin(), places.end());
  }
  Shares hard(plan.hard, 2);
  examination.run(
      {"near-rational", "directions along small lattice vectors but for ulps to 2^-40, in these scenes"},
      drawn(all, Kind::near_rational, seed, 2 * plan.count), hard.next());
  examination.run({"grazing", "the first ball is passed or met within r 2^-10 to r 2^-52 of its edge"},
                  drawn(all, Kind::grazing, seed, 2 * plan.count), hard.next());
  return all;
}

// The committed sets that an engine is asked about. Sets in binary32 are for engines in binary32 only; for
// other engines the same families are harder in binary64.
std::vector<std::string> golden_sets_for(NumberFormat precision) {
  std::vector<std::string> files = golden::committed_sets();
  if (precision == NumberFormat::binary64)
    std::erase_if(
        files, [&](const std::string& file) { return golden::Reader(file).header().precision != precision; });
  return files;
}

void check_golden_sets(Examination& examination, double seconds) {
  const std::vector<std::string> files = golden_sets_for(examination.claim().precision);
  Shares shares(seconds, files.size());
  for (const std::string& file : files) {
    const golden::Header header = golden::Reader(file).header();
    ExaminedRow row{"golden " + std::filesystem::path(file).stem().string(), header.description};
    row.records = header.count;
    examination.run(std::move(row), golden_set(file, examination.claim()), shares.next());
  }
}

// Runs each examination in its own thread, with scenes of its own.
void run_campaign(Examination& first, const std::vector<std::unique_ptr<Examination>>& others,
                  const fuzz::Scope& scope, std::uint64_t seed, const TimePlan& plan) {
  const auto parts = static_cast<unsigned>(1 + others.size());
  const Fairness fairness = plan.questions ? Fairness::of_scenes : Fairness::of_time;
  const auto run = [&](Examination& one, unsigned part) {
    one.run({"campaign", "constructed cases of all families, and variants of the smallest margin"},
            campaign(seed, scope, fairness, part, parts, one.claim()), plan.campaign);
  };
  std::vector<std::future<void>> threads;
  for (unsigned part = 1; part < parts; ++part)
    threads.push_back(std::async(std::launch::async, run, std::ref(*others[part - 1]), part));
  run(first, 0);
  for (std::future<void>& thread : threads) thread.get();
  for (const auto& other : others) {
    other->finish();
    first.take_over(*other);
  }
}

// The order, and how its engine is asked.
struct Terms {
  const JudgeOrder& order;
  question::AnswererOptions answerer;
  const std::atomic<bool>& stop;

  std::unique_ptr<Examination> examination() const {
    return std::make_unique<Examination>(order.engine, answerer, order.ulps, stop, order.claim);
  }
  /// An examination without a listener.
  std::unique_ptr<Examination> silent_examination() const {
    Terms silent = *this;
    silent.answerer.listener = {};
    return silent.examination();
  }
};

void find_simplest(std::vector<Finding>& findings, Examination& examination, double seconds) {
  examination.limit(seconds);  // also if the questions took too long
  Shares shares(seconds, findings.size());
  for (Finding& finding : findings) {
    const Question met = finding.simplest.question;
    finding.simplest = simplest(finding, examination, shares.next());
    const Question& left = finding.simplest.question;
    finding.was_shrunk = left.place->scene() != met.place->scene() || left.query.x != met.query.x ||
                         left.query.v != met.query.v || left.query.from != met.query.from;
    // A circumstance that the simpler case lacks is not essential.
    if (finding.circumstance && finding.simplest.question.is_query() &&
        !finding.circumstance->holds(features_in(finding.simplest)))
      finding.circumstance.reset();
  }
}

// Checks whether an external engine goes wrong on a simplest case by itself. Besides its share of the time, a
// new start gets kForOne times the first start's time until its answer; all starts together get kMost times
// that.
void recheck_all(std::vector<Finding>& findings, const Terms& terms, double seconds, double first_answer) {
  constexpr double kForOne = 4, kMost = 10;
  const Countdown all(seconds + kMost * first_answer);
  Shares shares(seconds, 2 * findings.size());
  for (Finding& finding : findings)
    if (finding.severity() != Severity::ill_posed)
      judge::recheck(
          finding, [&] { return terms.silent_examination(); },
          std::min(shares.next() + kForOne * first_answer, all.left()));
}

// Finds the simplest case of each finding.
void simplify(std::vector<Finding>& findings, Examination& examination, const Terms& terms, double seconds,
              double first_answer) {
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

// `count` questions of each place.
std::vector<question::Question> questions_to_race_in(const std::vector<const NamedPlace*>& places,
                                                     std::uint64_t seed, std::size_t count) {
  std::vector<question::Question> all;
  for (const NamedPlace* named : places)
    for (question::Question& question :
         question::questions_of(named->place, starts::free_starts(named->place->scene(), Kind::uniform, seed,
                                                                  count, named->place->claim().precision)))
      all.push_back(std::move(question));
  return all;
}

std::size_t affordable(const JudgeReport& report, int rounds, double seconds) {
  constexpr double kFewest = 32, kMost = 2000;
  double slowest = 1;
  for (const ExaminedRow& row : report.rows)
    if (!row.is_hard) slowest = std::max(slowest, row.tally.speed.ns_per_query);
  return static_cast<std::size_t>(std::clamp(1e9 * seconds / rounds / slowest, kFewest, kMost));
}

void race(JudgeReport& report, const std::vector<NamedPlace>& places, const Terms& terms, double seconds) {
  constexpr int kRounds = 5;
  constexpr double kTooLong = 2;  // times the planned duration
  const std::vector<const NamedPlace*> chosen = places_to_race_in(places);
  if (chosen.empty()) return;
  const std::size_t count = affordable(report, kRounds, seconds);
  const Countdown until(kTooLong * (seconds + report.start_up) + terms.answerer.timeout);
  question::RaceOptions options{kRounds, terms.answerer};
  options.answerer.enough = [&] { return terms.stop || until.left() == 0; };
  const std::vector<question::Speed> speeds =
      question::race(questions_to_race_in(chosen, report.seed, count),
                     {report.engine, question::engine_named("reduction")}, options);
  const bool is_cut = report.engine.runs_apart() && options.answerer.enough();
  if (speeds[0].failed || is_cut) return;
  report.ns_per_query = speeds[0].ns_per_query;
  report.own_ns = speeds[0].own_ns;
  report.ns_of_reduction = speeds[1].ns_per_query;
  report.processor_ns = speeds[0].processor_ns;
  report.processor_ns_of_reduction = speeds[1].processor_ns;
  std::vector<std::string> names;
  for (const NamedPlace* place : chosen) names.push_back(place->name);
  report.speed_of =
      fmt::format("{} drawn flights in each of {}, in turn with reduction", count, fmt::join(names, "; "));
}

// If the order has no timeout, it is much longer than any answer should take here, and a small part of the
// whole time. A program's first answer may take as long as elsewhere.
question::AnswererOptions options_of(const JudgeOrder& order, const TimePlan& plan) {
  constexpr double kShortest = 2, kPart = 0.1;
  const double most = question::AnswererOptions::kDefaultTimeout;
  question::AnswererOptions options;
  options.timeout = order.timeout.value_or(std::clamp(kPart * plan.seconds(), kShortest, most));
  options.start_timeout = most;
  options.listener = order.listener;
  return options;
}

// Asks everything in turn; returns the places.
std::vector<NamedPlace> examine(Examination& examination, const Terms& terms, const TimePlan& plan,
                                unsigned jobs, JudgeReport& report) {
  const Countdown all(plan.seconds());
  std::vector<NamedPlace> places = fly_drawn(examination, plan, report.seed);
  report.flown = fly_free_paths(examination, report.seed, plan.paths);
  check_golden_sets(examination, plan.golden);
  std::vector<std::unique_ptr<Examination>> others;
  for (unsigned i = 1; i < jobs; ++i) {
    others.push_back(terms.examination());
    others.back()->limit(all.left());
  }
  run_campaign(examination, others, scope_of(places), report.seed, plan);
  report.rows = examination.rows();
  report.findings = examination.findings();
  report.curves = examination.curves();
  if (!terms.stop) simplify(report.findings, examination, terms, plan.simplest, report.first_answer);
  return places;
}

TimePlan plan_of(const JudgeOrder& order) {
  const TimePlan& plan = order.quick ? kQuick : kWhole;
  if (order.questions) return plan.asking(*order.questions);
  return order.time ? plan.lasting(*order.time) : plan;
}

}  // namespace

double JudgeOrder::seconds() const {
  return plan_of(*this).seconds();
}

std::size_t number_of_rows(NumberFormat precision) {
  constexpr std::size_t kOthers = 4;  // near-rational, grazing, free paths, campaign
  return kSceneries.size() + golden_sets_for(precision).size() + kOthers;
}

JudgeReport judged(const JudgeOrder& order, const std::atomic<bool>& stop) {
  const TimePlan plan = plan_of(order);
  const Terms terms{order, options_of(order, plan), stop};
  JudgeReport report{order};
  report.timeout = terms.answerer.timeout;
  const std::unique_ptr<Examination> examination = terms.examination();
  if (plan.questions) {
    examination->ask_exactly(*plan.questions);
    examination->on_judged(order.on_judged);
  }
  examination->on_progress(order.on_progress);
  examination->limit(plan.seconds());
  const Examination::Start start = examination->warm_up();
  report.start_up = start.start_up, report.first_answer = start.first_answer;
  if (!examination->is_over()) examination->limit(plan.seconds());
  const std::vector<NamedPlace> places =
      examine(*examination, terms, plan, plan.questions ? 1 : order.jobs, report);
  report.misbehaved = examination->failed();
  examination->on_progress({});
  examination->finish();
  report.was_stopped = stop;
  if (!stop && !report.is_broken()) race(report, places, terms, plan.speed);
  return report;
}

}  // namespace lorentz::judge
