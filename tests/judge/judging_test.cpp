// More than one of a thing: threads of a campaign, parts of a source, examinations that are added up, flaws
// of one engine.
#include "judge/judge_report.hpp"

#include <catch2/catch.hpp>

#include <map>
#include <mutex>
#include <set>
#include <thread>

#include <lorentz/geometry.hpp>
#include "fuzz/campaign/shrink.hpp"
#include "fuzz/families/family.hpp"
#include "judge/golden/sets.hpp"
#include "judge/plan.hpp"
#include "judge/simplest.hpp"
#include "question/engines.hpp"
#include "report/files/scene_file.hpp"
#include "tests/judge/judge_support.hpp"
#include "tests/support/support.hpp"

using namespace lorentz;
using namespace lorentz::test;
using namespace lorentz::judge;

namespace {

Outside outside = 0;  // of all sources here

constexpr std::uint64_t kSeed = 20161116;
constexpr double kForEver = 1e9;

// What was asked, by thread.
struct Log {
  std::mutex mutex;
  std::map<std::thread::id, std::map<std::string, int>> by_thread;
  std::atomic<bool> is_on = false;  // else nothing is answered, nor written down
  std::atomic<bool> is_enough = false;

  bool write(const Scene& scene, const Query& query) {
    constexpr std::size_t kEnough = 100;  // of each thread
    const std::lock_guard lock(mutex);
    if (!is_on) return false;
    ++by_thread[std::this_thread::get_id()][stream(scene, query)];
    std::size_t threads = 0;
    for (const auto& [thread, questions] : by_thread) threads += questions.size() >= kEnough;
    if (threads == 2) is_enough = true;
    return true;
  }
};

// Leaves the disc it comes from at once in 2D, and sees nothing in 3D in the direction -x.
void two_faults(const Scene& scene, const Query& query, double, Answer& answer) {
  if (scene.dimension == 2 && query.v[1] > 0 && answer.outcome == Outcome::hit)
    answer.obstacle.cell[1] = 77777;
  if (scene.dimension == 3 && query.v[0] < 0 && answer.outcome == Outcome::hit) answer = Answer::never();
}

// All that a finding says.
std::string text_of(const Finding& finding) {
  std::string text = finding.explanation() + ", " + std::to_string(finding.count) + ", " + finding.where +
                     ", " +
                     stream(finding.simplest.question.place->scene(), finding.simplest.question.query) +
                     std::to_string(finding.by_radii.value_or(-1)) + ", " +
                     std::to_string(finding.share_of_plain) + ", " + std::to_string(finding.share_of_hard);
  for (const auto& [row, count] : finding.by_row) text += ", " + row + " " + std::to_string(count);
  return text;
}

std::string text_of(const report::Calls& calls) {
  std::string text;
  for (const auto& [decade, call] : calls.by_decade())
    text += std::to_string(decade) + ": " +
            question::counted_text(call.counts,
                                   {Count::agree, Count::ill_posed, Count::wrong, Count::undecided}) +
            '\n';
  return text;
}

}  // namespace

TEST_CASE("Each case of a campaign is one part's, whatever their number", "[judge][questions]") {
  const auto first_of = [](unsigned part, unsigned parts, std::size_t number) {
    const Source source = campaign(kSeed, {fuzz::Scope::Scenes::unit, 2}, true, part, parts, {}, outside);
    std::set<std::string> where;
    for (std::size_t i = 0; i < number; ++i)
      if (const auto question = source()) where.insert(question->where);
    return where;
  };
  constexpr std::size_t kNumber = 500;
  std::map<std::string, int> met;
  for (unsigned part = 0; part < 3; ++part) {
    const auto its = first_of(part, 3, kNumber);
    CHECK(its.size() == kNumber);
    std::set<std::string> targets;
    for (const std::string& where : its) {
      ++met[where];
      const auto slash = where.find('/');
      targets.insert(where.substr(0, slash));
      CHECK(std::stoul(where.substr(slash + 1)) / cases::kCasesPerScene % 3 == part);
    }
    CHECK(targets.size() >= 10);  // one has its second turn when all have had one
  }
  CHECK(met.size() == 3 * kNumber);
}

TEST_CASE("Where scenes are counted, families take turns in one order, whatever each takes",
          "[judge][questions]") {
  const Source source = campaign(kSeed, {}, false, 0, 1, {}, outside);
  std::vector<std::string> turns;  // the family of each scene, in the order in which they come
  std::map<std::string, int> met;
  std::size_t again = 0;
  while (again < 10) {
    const std::string where = source()->where, family = where.substr(0, where.find('/'));
    if (!turns.empty() && turns.back() == family) continue;
    turns.push_back(family);
    again += ++met[family] == 2;
  }
  const auto second = std::find(turns.begin() + 1, turns.end(), turns[0]);
  REQUIRE(turns.end() - second >= 10);
  CHECK(std::equal(second, turns.end(), turns.begin()));
}

TEST_CASE("An engine in binary32 is asked what consists of such numbers", "[judge][claim]") {
  const Claim claim{NumberFormat::binary32, {}};
  const NamedPlace place{"triangular", place_for(all_scenes().at("triangular"), claim)};
  const std::vector<NamedPlace> places{place};
  const auto asked = [&](const Source& source, std::size_t most) {
    std::size_t count = 0;
    for (std::optional<Question> one; count < most && (one = source()); ++count) {
      INFO(one->where);
      CHECK(consists_of(one->place->scene(), claim.precision));
      CHECK(consists_of(one->query, claim.precision));
      CHECK(one->place->claim() == claim);
      if (!one->is_query()) continue;
      const Answer exact = one->place->exact(one->query);
      CHECK((exact.outcome == one->exact.outcome && exact.obstacle == one->exact.obstacle));
    }
    return count;
  };
  for (const starts::Kind kind : {starts::Kind::uniform, starts::Kind::near_rational, starts::Kind::grazing})
    CHECK(asked(drawn(places, kind, kSeed, 50, outside), 50) == 50);
  for (const std::string& file : golden::committed_sets())
    if (file.ends_with("ball-3d.ndjson")) CHECK(asked(golden_set(file, claim, outside), 1000) == 17);
  CHECK(asked(campaign(kSeed, {}, false, 0, 1, claim, outside), 500) == 500);
}

TEST_CASE("Only questions in the engine's domain are asked, and what is too fast alone is slowed down",
          "[judge][judging]") {
  Claim claim;
  claim.domain.speed = {1e-3, 1e3};
  claim.domain.coordinates = {0, 1e6};
  claim.domain.radius = {0.01, 10};
  claim.domain.ellipsoids = false;
  claim.inside = StartInside::unsupported;
  Outside passed_over = 0;
  std::size_t asked = 0, insides = 0;
  const auto ask = [&](const Source& source, std::size_t most) {
    std::size_t count = 0;
    for (std::optional<Question> one; count < most && (one = source()); ++count) {
      INFO(one->where);
      CHECK(claim.domain.has(one->place->scene()));
      if (!one->is_query()) continue;
      CHECK(claim.domain.has(one->query));
      insides += one->exact.outcome == Outcome::inside;
    }
    asked += count;
  };
  ask(campaign(kSeed, {}, false, 0, 1, claim, passed_over), 3000);
  CHECK(asked == 3000);
  CHECK(passed_over > 300);
  const std::size_t of_campaign = passed_over;
  for (const std::string& file : golden::committed_sets())
    if (file.ends_with("ellipsoid-alone.ndjson")) ask(golden_set(file, claim, passed_over), 1000);
  CHECK(passed_over > of_campaign);
  const std::vector<NamedPlace> places{{"tiny", place_for(unit_scene(2, 1e-6), claim)},
                                       {"square", place_for(unit_scene(2, 0.1), claim)}};
  ask(drawn(places, starts::Kind::uniform, kSeed, 90, passed_over), 1000);
  CHECK(asked > 3000 + 40);  // half of the 90 are in the square
  CHECK(insides == 0);
  claim.domain.dimension_2 = false;
  for (const std::string& file : golden::committed_sets())
    if (file.ends_with("bad-queries.ndjson")) CHECK_FALSE(golden_set(file, claim, passed_over)());
  // Nor is anything else where the speed is measured.
  claim.domain.speed = {10, 20};
  std::size_t beyond = 0;
  JudgeOrder order = order_of(
      guest("fast", [&](const Scene& scene, const Query& query, double,
                        Answer&) { beyond += !(claim.domain.has(scene) && claim.domain.has(query)); }),
      1);
  order.claim = claim;
  const std::atomic<bool> stop = false;
  CHECK_FALSE(judge::judged(order, stop).speed_of.empty());
  CHECK(beyond == 0);
}

TEST_CASE("The parts of a run share all of its time, and what is left", "[judge][judging]") {
  judge::JudgeOrder order;
  for (const bool quick : {false, true}) {
    order.quick = quick;
    double all = 0;
    for (int part = 0; part <= static_cast<int>(judge::JudgePart::speed); ++part)
      all += judge::seconds_of(static_cast<judge::JudgePart>(part), order, 1e6);
    CHECK(all == Approx(order.seconds()));
    CHECK(judge::seconds_of(judge::JudgePart::speed, order, 0.25) == Approx(0.25));
  }
}

TEST_CASE("Two threads of a judge's campaign ask different questions, and all of them count",
          "[judge][judging]") {
  Log asked;
  const auto engine =
      guest("two-threads", [&](const Scene& scene, const Query& query, double limit, Answer& answer) {
        if (!asked.write(scene, query)) answer = Answer::unsupported_because("this is no campaign");
        two_faults(scene, query, limit, answer);
      });
  judge::JudgeOrder order;
  order.engine = engine;
  order.quick = true;
  order.time = 1e6;  // it ends when both have asked enough, however long that takes
  order.jobs = 2;
  order.on_progress = [&](const std::string& row) { asked.is_on = row == "campaign"; };
  const judge::JudgeReport report = judge::judged(order, asked.is_enough);
  REQUIRE(asked.by_thread.size() == 2);
  const auto& first = asked.by_thread[std::this_thread::get_id()];
  std::size_t both = 0, second = 0;
  for (const auto& [thread, questions] : asked.by_thread)
    if (thread != std::this_thread::get_id())
      for (const auto& [text, times] : questions) both += first.contains(text), ++second;
  INFO(second << " of the second, " << both << " of both");
  CHECK(second >= 100);
  CHECK(both * 4 < second);  // constructed cases may be equal
  const judge::ExaminedRow& last = report.rows.back();
  CHECK(last.name == "campaign");
  CHECK(last.asked() > second);
  CHECK(last.tally[Count::wrong] > 0);
  // Both of its faults are told, each with what sets it apart.
  std::map<Cause, const Finding*> worst;
  for (const Finding& finding : report.findings)
    if (finding.severity() == Severity::wrong) worst[finding.cause()] = &finding;
  REQUIRE(worst.contains(Cause::never_for_hit));
  CHECK(worst[Cause::never_for_hit]->simplest.question.place->scene().dimension == 3);
  CHECK(worst.contains(Cause::false_hit));
  CHECK(report.verdict() == "wrong");
}

TEST_CASE("What several examinations come to is what one comes to", "[judge][examination]") {
  const auto engine = guest("two-faults", two_faults);
  const std::atomic<bool> stop = false;
  const auto examined = [&](const std::vector<std::uint64_t>& seeds) {
    std::unique_ptr<TimedExamination> first;
    for (const std::uint64_t seed : seeds) {
      auto one = std::make_unique<TimedExamination>(order_of(engine), question::AnswererOptions{}, stop);
      one->run({"row", ""}, drawn_in({2, 3}, 30, seed), kForEver);
      if (first)
        first->results().add(one->results());
      else
        first = std::move(one);
    }
    return first;
  };
  // One that asks the same in one row.
  TimedExamination whole(order_of(engine), {}, stop);
  const std::vector<std::uint64_t> seeds{1, 2, 3};
  std::vector<Source> sources;
  for (const std::uint64_t seed : seeds) sources.push_back(drawn_in({2, 3}, 30, seed));
  std::size_t at = 0;
  whole.run(
      {"row", ""},
      [&]() -> std::optional<Question> {
        for (; at < sources.size(); ++at)
          if (auto question = sources[at]()) return question;
        return std::nullopt;
      },
      kForEver);
  const auto parts = examined(seeds), backwards = examined({3, 2, 1});
  for (TimedExamination* one : {parts.get(), backwards.get()}) {
    REQUIRE(one->results().rows.size() == 1);
    const question::Tally &its = one->results().rows[0].tally, &all = whole.results().rows[0].tally;
    CHECK(its.queries == 3 * 2 * 30);
    CHECK(its[Count::agree] == all[Count::agree]);
    CHECK(its[Count::wrong] == all[Count::wrong]);
    CHECK(all[Count::wrong] > 30);
    CHECK(its.speed.ns_per_query > 0);
    CHECK(text_of(one->results().curves[0]) == text_of(whole.results().curves[0]));
    const auto found = one->results().all_findings(), expected = whole.results().all_findings();
    REQUIRE(found.size() == expected.size());
    REQUIRE(found.size() >= 2);
    for (std::size_t i = 0; i < found.size(); ++i) CHECK(text_of(found[i]) == text_of(expected[i]));
  }
}

namespace {

Example example_in(int dimension, Cause cause) {
  const auto place = std::make_shared<Place>(unit_scene(dimension, 0.25));
  const Query query{{0.5, 0, 0}, {1, 0, 0}, {}};
  return {{place, query, place->oracle().first_hit(query), "here", ""},
          Answer::never(),
          {oracle::Verdict::wrong},
          {cause, Severity::wrong, 1}};
}

NamedPlace place_of(Scene scene, bool is_answered = true) {
  NamedPlace place{"place", std::make_shared<Place>(std::move(scene))};
  place.place->note(!is_answered);
  return place;
}

std::string text_of(const fuzz::Scope& scope) {
  constexpr const char* kNames[] = {"any", "lattice", "unit", "ball"};
  return std::string(kNames[static_cast<int>(scope.scenes)]) + ' ' + std::to_string(scope.dimension);
}

}  // namespace

TEST_CASE("What another program failed in, and what was nonsense, is added up, too", "[judge][examination]") {
  const std::atomic<bool> stop = false;
  const auto examined = [&](const question::EngineInfo& engine, const Source& source) {
    // Counted: no scene is left because starting takes long here.
    auto one = std::make_unique<TimedExamination>(order_of(engine, 1000), question::AnswererOptions{}, stop);
    one->run({"row", ""}, source, kForEver);
    one->finish();
    return one;
  };
  const auto fragile = question::engine_named("cmd:exec " LORENTZ_TOLERANT_ENGINE " dies-in 3");
  const auto fine = examined(fragile, drawn_in({2}, 5, 1)), broken = examined(fragile, drawn_in({3}, 20, 1)),
             also = examined(fragile, drawn_in({3}, 20, 2));
  CHECK_FALSE(fine->failed());
  fine->results().add(broken->results());
  CHECK(fine->failed());
  CHECK(fine->results().rows[0].scenes_given_up == 1);
  CHECK(fine->results().rows[0].last_failure == broken->results().rows[0].last_failure);
  fine->results().add(also->results());
  CHECK(fine->results().rows[0].scenes_given_up == 2);
  CHECK(fine->results().all_findings().size() == 1);
  CHECK(fine->results().all_findings()[0].count == fine->results().rows[0].tally[Count::missing]);
  const auto gullible =
      guest("gullible", [](const Scene&, const Query&, double, Answer& answer) { answer = Answer::never(); });
  const auto nonsense = [&](std::size_t number) {
    const auto place = std::make_shared<Place>(unit_scene(2, 0.25));
    return examined(gullible, [=, left = number]() mutable -> std::optional<Question> {
      if (left == 0) return std::nullopt;
      --left;
      return Question{.place = place,
                      .exact = Answer::error("no query"),
                      .where = "here",
                      .text = R"("x":[0.5,0],"v":[0,0])"};
    });
  };
  const auto two = nonsense(2), three = nonsense(3);
  two->results().add(three->results());
  CHECK(two->results().rows[0].tally[Count::nonsense] == 5);
  CHECK(two->results().rows[0].asked() == 5);
  CHECK(two->results().all_findings()[0].count == 5);
}

TEST_CASE("What sets failures apart is true of all that were added up, equal ones keep their order",
          "[judge][examination]") {
  Findings flat, solid, of_one_row;
  for (int i = 0; i < 20; ++i) {
    flat.add(example_in(2, Cause::never_for_hit), "row");
    solid.add(example_in(3, Cause::never_for_hit), i % 2 == 0 ? "row" : "other row");
    of_one_row.add(example_in(3, Cause::never_for_hit), "row");
    Features right = features_of(example_in(2, Cause::tie).question);
    flat.add_right(right);
    right.in_space = true;
    solid.add_right(right);
    of_one_row.add_right(features_of(example_in(2, Cause::tie).question));
  }
  CHECK_FALSE(of_one_row.all({})[0].circumstance);  // the row may have been in 3D by accident
  std::deque<ExaminedRow> asked(1);
  asked[0].name = "row", asked[0].is_hard = false, asked[0].tally.queries = 100;
  Findings both = solid;
  both.add(flat);
  for (const Finding& finding : both.all(asked))
    if (finding.circumstance) CHECK_FALSE(finding.circumstance->text.starts_with("in "));
  Findings half = solid;  // what is true of half of the right answers still sets apart
  for (int i = 0; i < 20; ++i) half.add_right(features_of(example_in(2, Cause::tie).question));
  REQUIRE(half.all(asked)[0].circumstance);
  CHECK(half.all(asked)[0].circumstance->text == "in 3D");
  CHECK(half.all(asked)[0].circumstance->share == 0.5);
  Findings equal;
  for (const Cause cause : {Cause::tie, Cause::behind, Cause::false_hit, Cause::leaving})
    equal.add(example_in(2, cause), "row");
  const auto all = equal.all(asked);
  REQUIRE(all.size() == 4);
  for (std::size_t i = 1; i < all.size(); ++i) CHECK(all[i - 1].cause() < all[i].cause());
}

TEST_CASE("A grazing fault says once that it is about grazing", "[judge][examination]") {
  for (const Cause cause : {Cause::never_for_grazing, Cause::passed_over_grazing, Cause::never_for_hit}) {
    Finding finding{example_in(2, cause), "here", 1, 3e-10};
    finding.circumstance = Circumstance{"depth", "where the line enters"};
    CHECK((finding.summary().find(", only") == std::string::npos) == (cause != Cause::never_for_hit));
    finding.circumstance = Circumstance{"in-3d", "in 3D"};
    CHECK(finding.summary().ends_with(", only in 3D"));
  }
}

TEST_CASE("A fault is made again in cause and severity, or not at all", "[judge][repetition]") {
  const auto engine = guest("two-faults", two_faults);
  const std::atomic<bool> stop = false;
  TimedExamination examination(order_of(engine), {}, stop);
  const Query query{{0.5, 0.5, 0.5}, {-1, 0.125, 0.25}, {}};
  const auto place = std::make_shared<Place>(unit_scene(3, 0.25));
  const Question question{.place = place, .query = query, .exact = place->exact(query), .where = "here"};
  bool all_answered = false;
  const auto failed = [&](const Diagnosis& like) {
    return failed_copy(question, 3, like, examination, all_answered);
  };
  CHECK(failed({Cause::never_for_hit, Severity::wrong}) == 1);
  CHECK_FALSE(failed({Cause::never_for_hit, Severity::ill_posed}));
  CHECK_FALSE(failed({Cause::false_hit, Severity::wrong}));
  CHECK(all_answered);
}

TEST_CASE("The scope of a campaign is the narrowest with all that was answered", "[judge][questions]") {
  Scene skewed = unit_scene(2, 0.2), motif = unit_scene(3, 0.2);
  skewed.lattices[0].vectors[1][0] = 0.25;
  motif.lattices[0].atoms.push_back({{0.5, 0.5, 0.5}, 0.1, {}});
  const Scene flat = unit_scene(2, 0.2), solid = unit_scene(3, 0.2);
  CHECK(text_of(scope_of({place_of(flat)})) == "unit 2");
  CHECK(text_of(scope_of({place_of(solid)})) == "unit 3");
  CHECK(text_of(scope_of({place_of(flat), place_of(solid)})) == "unit 0");
  CHECK(text_of(scope_of({place_of(flat), place_of(skewed)})) == "lattice 2");
  CHECK(text_of(scope_of({place_of(solid), place_of(skewed)})) == "lattice 0");
  CHECK(text_of(scope_of({place_of(motif), place_of(solid)})) == "any 3");
  CHECK(text_of(scope_of({place_of(motif, false), place_of(solid)})) == "unit 3");
  CHECK(text_of(scope_of({place_of(flat, false)})) == "any 0");
  const Scene ball = load_scene("ball", std::nullopt);
  CHECK(text_of(scope_of({place_of(flat, false), place_of(ball)})) == "ball 0");
  CHECK(text_of(scope_of({place_of(solid), place_of(ball)})) == "any 3");
}

TEST_CASE("Drawn and flown questions come in blocks of each place, and none is left out or comes twice",
          "[judge][questions]") {
  const std::vector<NamedPlace> places{place_of(unit_scene(2, 0.1)), place_of(unit_scene(2, 0.2)),
                                       place_of(unit_scene(3, 0.3))};
  const auto by_place = [&](const Source& source) {
    std::vector<std::vector<Query>> all(places.size());
    while (const auto question = source())
      for (std::size_t p = 0; p < places.size(); ++p)
        if (question->place == places[p].place) all[p].push_back(question->query);
    return all;
  };
  const auto drawn_ones = by_place(drawn(places, starts::Kind::uniform, kSeed, 90, outside)),
             flown_ones = by_place(drawn(places, starts::Kind::surface, kSeed, 90, outside));
  for (std::size_t p = 0; p < places.size(); ++p) {
    const Place& place = *places[p].place;
    REQUIRE(drawn_ones[p].size() == (p == 2 ? 26 : 32));
    REQUIRE(flown_ones[p].size() == drawn_ones[p].size());
    const starts::VariedStarts varied(place.scene(), kSeed);
    const starts::FreeStarts surface(place.scene(), starts::Kind::surface, kSeed);
    for (std::size_t i = 0; i < drawn_ones[p].size(); ++i) {
      CHECK(stream(place.scene(), drawn_ones[p][i]) == stream(place.scene(), varied[i].query));
      CHECK(stream(place.scene(), flown_ones[p][i]) == stream(place.scene(), surface[i]));
    }
  }
}

TEST_CASE("The simplest case keeps what was said, and what is true", "[judge][simplest]") {
  // Starts in a disc: a flight with many bits is said to hit something, others never end.
  const auto engine = guest("two-sayings", [](const Scene&, const Query& query, double, Answer& answer) {
    if (answer.outcome != Outcome::inside) return;
    answer = fuzz::bits_of(query.x[0]) > 3 ? Answer::hit({0, 0, {5, 0, 0}}, 1) : Answer::never();
  });
  const auto liar = guest("inside", [](const Scene&, const Query&, double, Answer& answer) {
    answer = Answer::inside({0, 0, {7, 7, 0}});
  });
  const std::atomic<bool> stop = false;
  const auto simplest_of = [&](const question::EngineInfo& one, const Query& query) {
    TimedExamination examination(order_of(one), {}, stop);
    const auto place = std::make_shared<Place>(unit_scene(2, 0.25));
    const auto example =
        example_of({place, query, place->oracle().first_hit(query), "here", ""}, examination);
    REQUIRE(example);
    const Example kept = simplest({*example, "here", 1, 1e300}, examination, 1e9);
    CHECK(kept.diagnosis.cause == example->diagnosis.cause);
    CHECK(fuzz::complexity(kept.question.place->scene(), kept.question.query) <
          fuzz::complexity(place->scene(), query));
    return kept;
  };
  CHECK(simplest_of(engine, {{0.123456789, 0.0123, 0}, {1, 0.3333, 0}, {}}).given.outcome == Outcome::hit);
  CHECK(simplest_of(liar, {{0.123456789, 0.5, 0}, {1, 0, 0}, {}}).question.exact.outcome == Outcome::never);
  CHECK(simplest_of(liar, {{0.5123456, 0.01, 0}, {1, 0.001, 0}, {}}).question.exact.outcome == Outcome::hit);
}

TEST_CASE("The simplest case keeps the circumstance that its finding states", "[judge][simplest]") {
  const auto never =
      guest("never", [](const Scene&, const Query&, double, Answer& answer) { answer = Answer::never(); });
  const std::atomic<bool> stop = false;
  TimedExamination examination(order_of(never), {}, stop);
  const auto place = std::make_shared<Place>(unit_scene(2, 0.25));
  const Query query{{0.512345, 0.01, 0}, {3.1, 0.07, 0}, {}};
  const auto example = example_of({place, query, place->oracle().first_hit(query), "here", ""}, examination);
  REQUIRE(example);
  Finding finding{*example, "here", 1, 1e300};
  CHECK(length(simplest(finding, examination, 1e9).question.query.v) == 1);
  finding.circumstance.emplace().holds = [](const Features& f) { return !f.is_unit_speed; };
  CHECK(length(simplest(finding, examination, 1e9).question.query.v) != 1);
  // The simplest of all flies farther than this engine claims to do.
  JudgeOrder order = order_of(never);
  order.claim.domain.flight = {0.23, 0.245};
  TimedExamination near(order, {}, stop);
  const Question kept = simplest({*example, "here", 1, 1e300}, near, 1e9).question;
  CHECK((is_in_domain(kept) && fuzz::most_bits(kept.place->scene(), kept.query) < 20));
}
