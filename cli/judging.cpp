#include "cli/judging.hpp"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <future>

#include <fmt/format.h>

#include "cli/golden.hpp"
#include "cli/numbers.hpp"
#include "cli/scene_option.hpp"
#include "compare/measure.hpp"
#include "judge/questions.hpp"
#include "judge/simplest.hpp"

namespace lorentz::cli {

using compare::Difficulty;
using judge::Examination;
using judge::Place;

namespace {

// How long each part takes at the most, in seconds, and how many flights are drawn.
struct Plan {
  double drawn, hard, golden, campaign, speed, simplest;
  std::size_t count;
  double seconds() const { return drawn + hard + golden + campaign + speed + simplest; }
  /// The same in another time.
  Plan lasting(double other) const {
    const double k = other / seconds();
    return {k * drawn, k * hard, k * golden, k * campaign, k * speed, k * simplest, count};
  }
};
constexpr Plan kWhole{15, 8, 25, 60, 4, 12, 4000}, kQuick{4, 2.5, 4, 5, 1, 3, 500};

// The catalogue's scenes that are flown in, and their radii; without any at their own size.
struct Scenery {
  const char* scene;
  std::vector<const char*> radii;
};
const std::vector<Scenery> kSceneries{{"square", {"0.3", "0.1", "0.01", "0.001", "1e-06"}},
                                      {"cubic", {"0.3", "0.1", "0.01", "0.001"}},
                                      {"triangular", {"0.1", "0.001"}},
                                      {"oblique", {}},
                                      {"honeycomb", {}},
                                      {"fcc", {}},
                                      {"hcp", {}},
                                      {"diamond", {}},
                                      {"superposition-pi-5", {}},
                                      {"overlapping", {}},
                                      {"ellipse", {}},
                                      {"ellipsoid", {}}};

std::vector<Place> places_of(const Scenery& scenery) {
  const auto place = [&](const std::optional<std::string>& radius) {
    const std::string name =
        radius ? fmt::format("{}, r = {}", scenery.scene, *radius) : std::string(scenery.scene);
    return Place{name, std::make_shared<judge::Setting>(
                           read_scene(scenery.scene, positive_number(radius, "--radius")))};
  };
  std::vector<Place> places;
  for (const char* radius : scenery.radii) places.push_back(place(radius));
  if (places.empty()) places.push_back(place(std::nullopt));
  return places;
}

// Parts of one stretch of time: what one leaves over is the others'.
class Shares {
 public:
  Shares(double seconds, std::size_t parts)
      : end_(Clock::now() +
             std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds))),
        parts_(parts) {}
  double next() {
    const std::chrono::duration<double> left = end_ - Clock::now();
    return std::max(left.count(), 0.0) / static_cast<double>(std::max<std::size_t>(parts_--, 1));
  }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point end_;
  std::size_t parts_;
};

// Flights as they are drawn, a row a scene; then two rows of hard ones in all these scenes that have balls.
std::vector<Place> fly_drawn(Examination& examination, const Plan& plan, std::uint64_t seed) {
  std::vector<Place> all;
  Shares drawn(plan.drawn, kSceneries.size());
  for (const Scenery& scenery : kSceneries) {
    const std::vector<Place> places = places_of(scenery);
    examination.run({fmt::format("drawn {}", scenery.scene), "uniform starts, isotropic directions", false},
                    judge::drawn(places, Difficulty::drawn, seed, plan.count), drawn.next());
    all.insert(all.end(), places.begin(), places.end());
  }
  Shares hard(plan.hard, 2);
  examination.run({"near-rational", "directions a few ulps from small integers, in these scenes"},
                  judge::drawn(all, Difficulty::near_rational, seed, 2 * plan.count), hard.next());
  examination.run({"grazing", "the first ball is passed or met within r 2^-10 to r 2^-50 of its edge"},
                  judge::drawn(all, Difficulty::grazing, seed, 2 * plan.count), hard.next());
  return all;
}

void check_golden_sets(Examination& examination, double seconds) {
  const std::vector<std::string> files = committed_sets();
  Shares shares(seconds, files.size());
  for (const std::string& file : files)
    examination.run(
        {"golden " + std::filesystem::path(file).stem().string(), "a committed set of hard cases"},
        judge::golden_set(file), shares.next());
}

// In a thread for each examination, each with scenes of its own.
void run_campaign(Examination& first, const std::vector<std::unique_ptr<Examination>>& others,
                  const fuzz::Scope& scope, std::uint64_t seed, double seconds) {
  const auto parts = static_cast<unsigned>(1 + others.size());
  const auto run = [&](Examination& one, unsigned part) {
    one.run({"campaign", "constructed cases of all families, and variants of the smallest margin"},
            judge::campaign(seed, scope, part, parts), seconds);
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

void simplify(std::vector<judge::Finding>& findings, Examination& examination, double seconds) {
  Shares shares(seconds, findings.size());
  for (judge::Finding& finding : findings)
    finding.simplest = judge::simplest(finding, examination, shares.next());
}

// ---- Speed

// Of the places where the engine answered: the square and cubic lattice at r = 0.1, if these are among them.
std::vector<const Place*> places_to_race_in(const std::vector<Place>& places) {
  std::vector<const Place*> chosen;
  for (const Place& place : places)
    if ((place.name == "square, r = 0.1" || place.name == "cubic, r = 0.1") &&
        place.setting->was_answered() && !place.setting->is_beyond_engine())
      chosen.push_back(&place);
  for (const Place& place : places)
    if (chosen.empty() && place.setting->was_answered() && !place.setting->is_beyond_engine())
      chosen.push_back(&place);
  return chosen;
}

void race(JudgeReport& report, const std::vector<Place>& places, double seconds, const JudgeOrder& order) {
  const std::vector<const Place*> chosen = places_to_race_in(places);
  if (chosen.empty()) return;
  double slowest = 0;
  for (const judge::Row& row : report.rows)
    if (!row.is_hard) slowest = std::max(slowest, row.tally.ns_per_query);
  constexpr int kRounds = 5;
  constexpr std::size_t kFewest = 32, kMost = 2000;
  const double affordable = 1e9 * seconds / kRounds / std::max(slowest, 1.0);
  const auto count = static_cast<std::size_t>(std::clamp<double>(affordable, kFewest, kMost));
  compare::CaseSet set;
  std::vector<std::string> names;
  for (const Place* place : chosen) {
    const Scene& scene = place->setting->scene();
    for (const Query& query : compare::draw_queries(scene, place->setting->oracle(), order.seed, count))
      set.cases.push_back({std::to_string(set.cases.size()), set.scenes.size(), query});
    set.scenes.push_back(scene);
    names.push_back(place->name);
  }
  const std::vector<compare::Tally> tallies =
      compare::measure(set, {}, {report.engine, "reduction"}, {},
                       {oracle::kDefaultUlps, kRounds, order.timeout, order.listener});
  report.failed |= tallies[0].failed;
  if (tallies[0].failed) return;
  report.ns_per_query = tallies[0].ns_per_query;
  report.ns_of_reduction = tallies[1].ns_per_query;
  report.speed_of =
      fmt::format("{} drawn flights in each of {}, in turn with reduction", count, fmt::join(names, "; "));
}

Plan plan_of(const JudgeOrder& order) {
  const Plan& plan = order.quick ? kQuick : kWhole;
  return order.time ? plan.lasting(*order.time) : plan;
}

}  // namespace

double JudgeOrder::seconds() const {
  return plan_of(*this).seconds();
}

JudgeReport judged(const JudgeOrder& order, const std::atomic<bool>& stop) {
  const Plan plan = plan_of(order);
  JudgeReport report;
  report.engine = order.engine;
  report.command = order.command;
  report.times = order.times;
  report.seed = order.seed;
  const auto examined = [&] {
    return std::make_unique<Examination>(
        order.engine, compare::AnswererOptions{{}, order.timeout, order.listener}, order.ulps, stop);
  };
  const std::unique_ptr<Examination> first = examined();
  Examination& examination = *first;
  examination.on_progress(order.on_progress);
  const std::vector<Place> places = fly_drawn(examination, plan, report.seed);
  check_golden_sets(examination, plan.golden);
  std::vector<std::unique_ptr<Examination>> others;
  for (unsigned i = 1; i < order.jobs; ++i) others.push_back(examined());
  run_campaign(examination, others, judge::scope_of(places), report.seed, plan.campaign);
  report.rows = examination.rows();
  report.findings = examination.findings().all();
  report.failed = examination.failed();
  if (!examination.is_over()) simplify(report.findings, examination, plan.simplest);
  const bool is_over = examination.is_over();
  examination.on_progress({});
  examination.finish();
  if (!is_over) race(report, places, plan.speed, order);
  return report;
}

}  // namespace lorentz::cli
