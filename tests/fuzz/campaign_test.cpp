// Campaigns: the same whatever the number of threads and interruptions; targets, variants, kinds.
#include "fuzz/campaign/campaign.hpp"

#include <catch2/catch.hpp>

#include <set>
#include <thread>

#include <lorentz/geometry.hpp>
#include <lorentz/oracle.hpp>
#include <lorentz/scene_check.hpp>
#include "fuzz/campaign/variants.hpp"
#include "fuzz/families/family.hpp"
#include "question/cases/integer_vectors.hpp"
#include "tests/fuzz/campaign_support.hpp"
#include "tests/support/command_line.hpp"
#include "tests/support/support.hpp"

using namespace lorentz;
using namespace lorentz::test;
using fuzz::Kind;
using fuzz::Plan;
using fuzz::TargetTally;

namespace {

constexpr std::uint64_t kSeed = 5;

Plan plan_of(std::initializer_list<const char*> names) {
  Plan plan;
  for (const char* name : names) plan.targets.push_back(cases::target_named(name));
  plan.seed = kSeed;
  plan.mutate = 8;
  return plan;
}

// A campaign up to a number of cases, in a store.
void run_in(fuzz::Store& store, const Plan& plan, std::uint64_t count, unsigned jobs,
            const question::MakeAnswerer& answerers = skewed_answerers(),
            double seconds = std::numeric_limits<double>::infinity()) {
  fuzz::CampaignManifest manifest{"1", "skewed", {}, plan.seed, "keep " + std::to_string(plan.keep), {}};
  for (const cases::Target* target : plan.targets) manifest.targets.emplace_back(target->name());
  const std::int64_t id = store.open_campaign(manifest);
  std::vector<TargetTally> tallies;
  for (const cases::Target* target : plan.targets) tallies.push_back(store.tally(id, target->name()));
  fuzz::StoreJournal journal(store, id);
  fuzz::Bounds bounds;
  bounds.count = count;
  bounds.jobs = jobs;
  bounds.seconds = seconds;
  std::vector<fuzz::Finding> unshrunk;
  for (const fuzz::Stored& one : store.findings()) unshrunk.push_back(one.finding);
  fuzz::run(plan, bounds, answerers, tallies, journal, nullptr, unshrunk);
}

std::string one_run(const Plan& plan, std::uint64_t count, unsigned jobs) {
  fuzz::Store store(":memory:", fuzz::Store::Access::write);
  run_in(store, plan, count, jobs);
  return text_of(store);
}

// Gives up where |v_1| < |v_2| / 8, and errs where |v_1| > 8 |v_2|.
question::MakeAnswerer failing_answerers() {
  return told([](const question::Place& place, const Query& query) {
    if (std::fabs(query.v[0]) < std::fabs(query.v[1]) / 8) return Answer::undecided();
    if (std::fabs(query.v[0]) > 8 * std::fabs(query.v[1])) return Answer::error("what?");
    return place.exact(query);
  });
}

// What an answer is taken for with a tolerance in ulps.
Kind kind_of(const Scene& scene, const Query& query, const Answer& answer, double ulps) {
  ToldAnswerer answerer([&](const question::Place&, const Query&) { return answer; });
  return fuzz::Examiner(answerer, std::make_shared<question::Place>(scene), ulps).examine(query).kind;
}

std::string outcome_in(const std::string& answer) {
  const std::string key = "\"outcome\":\"";
  const std::size_t begin = answer.find(key) + key.size();
  return answer.substr(begin, answer.find('"', begin) - begin);
}

// Right in cells of an ordinary size; in others it sees nothing. With a time limit it takes rounded times for
// exact ones.
class Parochial final : public question::Answerer {
 public:
  void ask(const Id&, const Query& query) override { deliver({answer(query)}); }
  bool takes_limits() const override { return true; }
  void ask_until(const Id&, const Query& query, double max_time) override {
    deliver({limited(answer(query), max_time)});
  }

 private:
  void enter(const Scene& scene) override {
    const double size = length(scene.lattices[0].vectors[0]);
    knows_ = size > 0x1p-60 && size < 0x1p60;
    oracle_.emplace(scene);
  }
  Answer answer(const Query& query) const { return knows_ ? oracle_->first_hit(query) : Answer::never(); }
  std::optional<oracle::Oracle> oracle_;
  bool knows_ = true;
};

// What a campaign of a few targets finds in an engine that errs in other words alone.
std::vector<fuzz::Stored> findings_in_other_words(std::uint64_t reword, TargetTally& all) {
  Plan plan = plan_of({"generic", "grazing", "superpositions"});
  plan.sought.ulps = 0;
  plan.reword = reword;
  fuzz::Store store(":memory:", fuzz::Store::Access::write);
  run_in(store, plan, 128, 2, [](const auto&) { return std::make_unique<Parochial>(); });
  for (const cases::Target* target : plan.targets) all.add(store.tally(1, target->name()));
  return store.findings();
}

}  // namespace

TEST_CASE("What goes wrong in other words alone is found, and keeps its words", "[fuzz][campaign]") {
  INFO("seed " << kSeed);
  TargetTally without, with;
  CHECK(findings_in_other_words(0, without).empty());
  CHECK(without.reworded == 0);
  int lengths = 0, limits = 0;
  for (const fuzz::Stored& one : findings_in_other_words(1, with)) {
    const fuzz::Finding& f = one.finding;
    INFO(one.label() << ": " << f.words << '\n' << f.text.scene << '\n' << f.text.query);
    CHECK(f.kind == "wrong");
    CHECK(one.label().ends_with('r'));
    CHECK(f.sort.ends_with("in other words"));
    const bool limit = f.words.find("limit") != std::string::npos;
    limits += limit;
    if (limit) continue;
    ++lengths;
    CHECK(f.words.find("2^") != std::string::npos);
    CHECK(f.text.given.find("never") != std::string::npos);
  }
  CHECK(lengths > 15);  // 20 seen
  CHECK(limits > 15);   // 20 seen
  CHECK(with.reworded > (with.cases + with.variants) / 2);
  CHECK(with.reworded <= with.cases + with.variants);
}

TEST_CASE("A campaign is the same for any number of threads", "[fuzz][campaign]") {
  INFO("seed " << kSeed);
  const Plan plan = plan_of({"leaving", "boundary", "generic"});
  const std::string once = one_run(plan, 300, 1);
  CHECK(once.find("leaving/") != std::string::npos);
  CHECK(once.find("boundary/") != std::string::npos);
  fuzz::Store store(":memory:", fuzz::Store::Access::write);
  run_in(store, plan, 300, 1);
  std::uint64_t variants = 0;
  for (const cases::Target* target : plan.targets) variants += store.tally(1, target->name()).variants;
  CHECK(variants > 900 / 16 * 12);  // one case in 8 has up to 24
  CHECK(variants < 900 / 4 * 24);
  for (const unsigned jobs : {2u, 5u}) CHECK(one_run(plan, 300, jobs) == once);
}

TEST_CASE("A campaign that is gone on with is the one that was never stopped", "[fuzz][campaign]") {
  INFO("seed " << kSeed);
  const Plan plan = plan_of({"leaving", "boundary"});
  fuzz::Store store(":memory:", fuzz::Store::Access::write);
  for (const std::uint64_t count : {1, 7, 40, 41, 150}) run_in(store, plan, count, 2);
  CHECK(text_of(store) == one_run(plan, 150, 1));
}

TEST_CASE("Stopped on the way, it has whole stretches of cases, and goes on from there", "[fuzz][campaign]") {
  INFO("seed " << kSeed);
  const Plan plan = plan_of({"leaving", "boundary"});
  std::vector<TargetTally> tallies(2);
  std::atomic<bool> stop = false;
  // Stops it when something of each target is recorded.
  struct Stopping final : fuzz::Journal {
    explicit Stopping(std::atomic<bool>& stop) : stop(stop) {}
    void record(const cases::Target& target, const TargetTally&, const std::vector<fuzz::Finding>&) override {
      met.insert(target.name());
      if (met.size() == 2) stop = true;
    }
    void tick() override {}
    std::atomic<bool>& stop;
    std::set<std::string_view> met;
  } journal(stop);
  fuzz::Bounds bounds;
  bounds.stop = &stop;
  bounds.jobs = 2;
  fuzz::run(plan, bounds, skewed_answerers(), tallies, journal);
  for (const TargetTally& tally : tallies) {
    CHECK(tally.next > 0);
    CHECK(tally.cases == tally.next);
    std::size_t counted = 0;
    for (const question::CountName& name : question::kCountNames) counted += tally.counts[name.count];
    CHECK(counted == tally.cases + tally.variants + tally.reworded);
  }
}

TEST_CASE("The report does not wait for the threads, and a case without an answer is asked again next time",
          "[fuzz][campaign]") {
  INFO("seed " << kSeed);
  const Plan plan = plan_of({"leaving"});
  // Answers 10 questions, and the 11th only when the report is there. (The minute is for a test that fails.)
  std::atomic<bool> is_reported = false;
  std::atomic<int> asked = 0;
  const auto hanging = told([&](const question::Place& place, const Query& query) {
    for (int i = 0; ++asked > 10 && !is_reported && i < 6000; ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    return place.exact(query);
  });
  struct Reporting final : fuzz::Journal {
    Reporting(std::atomic<bool>& is_reported, std::atomic<int>& asked, std::atomic<bool>& stop)
        : is_reported(is_reported), asked(asked), stop(stop) {}
    void record(const cases::Target&, const TargetTally& tally, const std::vector<fuzz::Finding>&) override {
      cases = tally.cases;
    }
    void tick() override { stop = asked > 10; }
    void ended() override { is_reported = true, reported = cases; }
    std::atomic<bool>& is_reported;
    std::atomic<int>& asked;
    std::atomic<bool>& stop;
    std::uint64_t cases = 0, reported = 0;
  };
  std::atomic<bool> stop = false;
  Reporting journal(is_reported, asked, stop);
  fuzz::Bounds bounds;
  bounds.stop = &stop;
  std::vector<TargetTally> tallies(1);
  fuzz::run(plan, bounds, hanging, tallies, journal);
  CHECK(is_reported);
  CHECK(asked < 6000);
  CHECK(journal.reported == journal.cases);  // nothing is recorded behind the report
  CHECK(tallies[0].cases == journal.reported);
  // It goes on from the case that had no answer.
  fuzz::Store store(":memory:", fuzz::Store::Access::write);
  fuzz::StoreJournal on(store, 1);
  bounds = {.count = tallies[0].next + 5};
  fuzz::run(plan, bounds, told([](const auto& place, const Query& query) { return place.exact(query); }),
            tallies, on);
  std::vector<TargetTally> whole(1);
  fuzz::StoreJournal at_once(store, 2);
  fuzz::run(plan, bounds, told([](const auto& place, const Query& query) { return place.exact(query); }),
            whole, at_once);
  CHECK(text_of(tallies[0]) == text_of(whole[0]));
}

TEST_CASE("What the time cut short is shrunk to the end when there is time", "[fuzz][campaign]") {
  INFO("seed " << kSeed);
  const Plan plan = plan_of({"leaving", "boundary"});
  // Slow: its findings are not shrunk in the time.
  const auto slow = told([](const question::Place& place, const Query& query) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    return skewed_answer(place, query);
  });
  fuzz::Store store(":memory:", fuzz::Store::Access::write);
  run_in(store, plan, 150, 2, slow, 1.5);
  std::map<fuzz::Shrinking, int> states;
  for (const fuzz::Stored& one : store.findings()) ++states[one.finding.shrinking];
  CHECK(states[fuzz::Shrinking::cut_short] > 0);  // 3 seen
  CHECK(store.tally(1, "leaving").next < 150);
  run_in(store, plan, 150, 2);
  CHECK(text_of(store) == one_run(plan, 150, 1));
}

TEST_CASE("No engine is asked beyond the scope or its claim: cases, other words, shrinking",
          "[fuzz][campaign]") {
  INFO("seed " << kSeed);
  static fuzz::Scope scope;
  static Claim claim;
  claim.inside = StartInside::unsupported, claim.domain.flight = {0, 1000};
  static std::atomic<int> asked, beyond;
  // Gives up, so that there is something to shrink.
  const auto careful = told([](const question::Place& place, const Query& query) {
    ++asked;
    const question::Place claimed(place.scene(), claim);
    if (!scope.admits(place.scene()) || !claimed.takes(query, place.exact(query))) ++beyond;
    return Answer::undecided();
  });
  using Scenes = fuzz::Scope::Scenes;
  for (const auto& [scenes, dimension] :
       {std::pair{Scenes::unit, 0}, {Scenes::lattice, 2}, {Scenes::any, 3}, {Scenes::unit, 2}}) {
    Plan plan = plan_of({"generic", "mixture", "crystals"});
    plan.scope = scope = {scenes, dimension}, plan.claim = claim;
    fuzz::Store store(":memory:", fuzz::Store::Access::write);
    asked = beyond = 0;
    run_in(store, plan, 256, 2, careful);
    std::uint64_t cases = 0, reworded = 0;
    for (const cases::Target* target : plan.targets) {
      CHECK(store.tally(1, target->name()).next == 256);
      cases += store.tally(1, target->name()).cases;
      reworded += store.tally(1, target->name()).reworded;
    }
    CHECK(cases >= 64);
    CHECK(cases < 3 * 256);
    CHECK(reworded > 0);
    CHECK(asked > 500);
    CHECK(beyond == 0);
    CHECK(store.findings().size() > 3);
  }
}

TEST_CASE("What scopes admit", "[fuzz][campaign]") {
  using Scenes = fuzz::Scope::Scenes;
  Scene two = unit_scene(3, 0.2), stretched = unit_scene(2, 0.2);
  two.lattices[0].atoms.push_back({{0.5, 0.5, 0.5}, 0.1, {}});
  stretched.lattices[0].vectors[0] = {2, 0};
  Scene ball = unit_scene(2, 0.2), row = ball;
  for (Vec& vector : ball.lattices[0].vectors) vector = {};
  ball.lattices[0].rank = 0;
  row.lattices[0].vectors[1] = {};
  row.lattices[0].rank = 1;
  const auto admitted = [&](const fuzz::Scope& scope) {
    std::string text;
    for (const Scene& scene : {unit_scene(2, 0.2), unit_scene(3, 0.2), stretched, two, ball, row})
      text += scope.admits(scene) ? '1' : '0';
    return text;
  };
  CHECK(admitted({}) == "111111");
  CHECK(admitted({Scenes::any, 3}) == "010100");
  CHECK(admitted({Scenes::lattice, 0}) == "111000");
  CHECK(admitted({Scenes::ball, 0}) == "000010");
  CHECK(admitted({Scenes::unit, 0}) == "110000");
  CHECK(admitted({Scenes::unit, 3}) == "010000");
}

TEST_CASE("A target keeps the first few findings of each sort, and counts all", "[fuzz][campaign]") {
  INFO("seed " << kSeed);
  Plan plan = plan_of({"leaving"});
  plan.keep = 2;
  plan.mutate = 0;
  fuzz::Store store(":memory:", fuzz::Store::Access::write);
  run_in(store, plan, 200, 3);
  const TargetTally tally = store.tally(1, "leaving");
  std::map<std::string, std::vector<std::uint64_t>> kept;
  for (const fuzz::Stored& one : store.findings()) kept[one.finding.sort].push_back(one.finding.index);
  std::uint64_t all = 0;
  REQUIRE(tally.sorts.size() > 1);
  for (const auto& [sort, number] : tally.sorts) {
    INFO(sort);
    CHECK(kept[sort].size() == std::min<std::uint64_t>(number, 2));
    all += number;
  }
  CHECK(all == tally.counts[Kind::wrong] + tally.counts[Kind::error]);  // of the readers
  CHECK(all > 40);                                                      // 52 seen

  plan.mutate = 1;  // a case and its variants, which usually fail alike, are one finding
  fuzz::Store mutated(":memory:", fuzz::Store::Access::write);
  run_in(mutated, plan, 40, 2);
  std::set<std::pair<std::string, std::uint64_t>> seen;
  for (const fuzz::Stored& one : mutated.findings())
    CHECK(seen.emplace(one.finding.sort, one.finding.index).second);
  CHECK(seen.size() >= 2);  // 6 seen
}

TEST_CASE("Undecided and erroneous answers are told apart, and findings as asked for", "[fuzz][campaign]") {
  INFO("seed " << kSeed);
  Plan plan = plan_of({"corner"});
  plan.mutate = 0;
  std::vector<TargetTally> tallies(1);
  fuzz::Store store(":memory:", fuzz::Store::Access::write);
  fuzz::Bounds bounds;
  bounds.count = 100;
  for (const bool undecided : {true, false}) {
    tallies = {{}};
    plan.sought.undecided = undecided;
    fuzz::StoreJournal journal(store, undecided);
    fuzz::run(plan, bounds, failing_answerers(), tallies, journal);
  }
  const auto number = [&](Kind kind) { return tallies[0].counts[kind]; };
  CHECK(number(Kind::undecided) > 30);  // 40 seen
  CHECK(number(Kind::error) > 40);      // 55 seen
  CHECK(number(Kind::wrong) == 0);
  std::map<std::pair<std::int64_t, std::string>, int> found;
  for (const fuzz::Stored& one : store.findings()) ++found[{one.campaign, one.finding.kind}];
  CHECK(found[{1, "undecided"}] > 0);
  CHECK(found[{0, "undecided"}] == 0);
  CHECK(found[{0, "error"}] > 0);
}

TEST_CASE("With no ulp forgiven a tie decided the other way is wrong, and so is a tangent that is hit",
          "[fuzz][campaign]") {
  Scene two = unit_scene(2, 0.625);  // above and below the line, entered together
  two.lattices[0].vectors = {Vec{4, 0}, Vec{0, 1}};
  Scene same_place = unit_scene(2, 0.25);
  same_place.lattices[0].atoms.push_back(same_place.lattices[0].atoms[0]);
  const ObstacleId below{0, 0, {Integer(1)}}, above{0, 0, {Integer(1), Integer(1)}}, second{0, 1, {}};
  struct {
    Scene scene;
    Query query;
    Answer right, wrong;
  } const cases[] = {
      {two, {{1, 0.5}, {1, 0}, {}}, Answer::hit(below, 2.625), Answer::hit(above, 2.625)},
      {same_place, {{-0.5, 0}, {1, 0}, {}}, Answer::hit({}, 0.25), Answer::hit(second, 0.25)},
      {unit_scene(2, 0.25), {{0.5, 0.25}, {1, 0}, {}}, Answer::never(), Answer::hit(below, 0.5)},
      {unit_scene(2, 0.25), {{0.25, 0}, {1, 0.5}, {}}, {}, Answer::inside({})},  // on the surface
  };
  for (const auto& one : cases) {
    INFO(stream(one.scene, one.query) << line(one.wrong, 2));
    Answer right = oracle::Oracle(one.scene).first_hit(one.query);
    if (one.right.outcome != Outcome::undecided) REQUIRE(same_obstacle(right, one.right));
    Answer wrong = one.wrong;
    if (right.time && wrong.time) wrong.time = right.time;
    CHECK(kind_of(one.scene, one.query, right, 0) == Kind::agree);
    CHECK(kind_of(one.scene, one.query, wrong, 0) == Kind::wrong);
    CHECK(kind_of(one.scene, one.query, wrong, 4) == Kind::agree);
    if (!right.time) continue;
    right.time = std::nextafter(*right.time, 10);
    CHECK(kind_of(one.scene, one.query, right, 0) == Kind::wrong_time);
    CHECK(kind_of(one.scene, one.query, right, 4) == Kind::agree);
  }
}

TEST_CASE("The cause of a finding says what is special about it, and nothing else", "[fuzz][campaign]") {
  fuzz::Examined wrong;
  wrong.kind = Kind::wrong;
  wrong.given = Answer::never();
  wrong.exact = Answer::hit({}, 1);
  const auto features = [&](const Scene& scene, const Query& query) {
    const std::string cause = fuzz::cause_of(scene, query, wrong);
    const auto at = cause.find("unit lattice");
    REQUIRE(at != std::string::npos);
    return cause.substr(at + 12);
  };
  const Scene flat = unit_scene(2, 0.25), solid = unit_scene(3, 0.25);
  CHECK(features(flat, {{0.5, 0.5}, {1, 2}, {}}) == "");
  CHECK(features(solid, {{0.5, 0.5, 0.5}, {1, 2, 3}, {}}) == "");
  CHECK(features(flat, {{0.5, 0.5}, {0, 2}, {}}) == ", along an axis");
  CHECK(features(solid, {{0.5, 0.5, 0.5}, {1, 0, 0}, {}}) == ", along an axis");
  CHECK(features(solid, {{0.5, 0.5, 0.5}, {1, 0, 2}, {}}) == ", in a plane of axes");
  CHECK(features(flat, {{0.5, 0.5}, {1, 2}, cases::obstacle({0, 0})}) == ", leaving");
  CHECK(features(flat, {{0.5, 0x1p200}, {1, 2}, {}}).find(", far start") == 0);
  for (const double extreme : {0x1p900, -0x1p900, 0x1p-900, -0x1p-900}) {
    CHECK(features(flat, {{0.5, 0.5}, {1, extreme}, {}}) == ", extreme numbers");
    CHECK(features(solid, {{0.5, 0.5, 0.5}, {1, 1, extreme}, {}}) == ", extreme numbers");
  }
  CHECK(features(flat, {{0.5, 0x1p-900}, {1, 1}, {}}) == ", extreme numbers");
  for (const double end : {1e100, 1e-100}) CHECK(features(flat, {{0.5, 0.5}, {1, end}, {}}) == "");
}

TEST_CASE("A case that is shrunk keeps both outcomes: what was said, and what is true", "[fuzz][campaign]") {
  INFO("seed " << kSeed);
  Plan plan = plan_of({"generic", "boundary", "never"});
  plan.mutate = 0;
  plan.reword = 0;
  plan.keep = 4;
  // Wrong in two ways, and about hits, starts inside, and flights without end.
  const auto wrong = told([](const question::Place&, const Query& query) {
    return query.v[0] > 0 ? Answer::never() : Answer::inside(cases::obstacle({7, 7}));
  });
  fuzz::Store store(":memory:", fuzz::Store::Access::write);
  run_in(store, plan, 60, 2, wrong);
  std::map<std::string, int> met;
  for (const fuzz::Stored& one : store.findings()) {
    const auto& [text, shrunk] = std::tie(one.finding.text, one.finding.shrunk);
    INFO(text.scene << text.query << '\n' << shrunk.scene << shrunk.query);
    CHECK(outcome_in(shrunk.given) == outcome_in(text.given));
    CHECK(outcome_in(shrunk.exact) == outcome_in(text.exact));
    CHECK(one.finding.complexity < 6000);  // 3 110 seen at most
    ++met[outcome_in(text.given) + " for " + outcome_in(text.exact)];
  }
  for (const char* sort :
       {"never for hit", "inside for hit", "never for inside", "inside for inside", "inside for never"}) {
    INFO(sort);
    CHECK(met[sort] > 0);
  }
}

TEST_CASE("A case of a target depends on seed, target and index, new families keep the rules of all",
          "[fuzz][campaign]") {
  INFO("seed " << kSeed);
  for (const cases::Target& target : cases::targets()) {
    INFO(target.name());
    CHECK(cases::target_named(target.name()) == &target);
    std::string again;
    const std::string first = stream(target.make(kSeed, 77).scene, target.make(kSeed, 77).query);
    std::thread([&] {
      target.make(kSeed, 3);
      const cases::Case one = target.make(kSeed, 77);
      again = stream(one.scene, one.query);
    }).join();
    CHECK(again == first);
  }
  CHECK(cases::target_named("generic")->make(kSeed, 31).scene.dimension == 2);
  CHECK(cases::target_named("generic")->make(kSeed, 32).scene.dimension == 3);
  std::set<std::string_view> of_golden_sets;
  for (const cases::Family& family : cases::families()) of_golden_sets.insert(family.name());
  std::vector<cases::Family> others;
  for (const cases::Target& target : cases::targets())
    for (const cases::Family& family : target.families())
      if (!of_golden_sets.contains(family.name())) others.push_back(family);
  CHECK(others.size() >= 19);
  for (const cases::Family& family : others) {
    std::map<std::string, int> met;
    for (const cases::Tag& tag : family.tags()) met[std::string(tag.name)] = 0;
    const std::size_t explained = met.size();
    for (std::uint64_t index = 0; index < 2000; ++index) {
      const cases::Case one = family.make(kSeed, index);
      INFO(family.name() << ' ' << index << ' ' << stream(one.scene, one.query));
      if (index % 32 == 0) REQUIRE_FALSE((flaw_of(one.scene) || oracle::dependence_in(one.scene)));
      REQUIRE(one.scene == family.make(kSeed, index / 32 * 32).scene);
      REQUIRE_FALSE(flaw_of(one.query, one.scene));
      if (one.scene.dimension == 2) REQUIRE((one.query.x[2] == 0 && one.query.v[2] == 0));
      for (const std::string& tag : one.tags) ++met[tag];
    }
    CHECK(met.size() == explained);
    for (const auto& [tag, count] : met) {
      INFO(tag);
      CHECK(count > 0);
    }
  }
}

TEST_CASE("Flights of the target leaving start on the obstacle they leave, and go outwards",
          "[fuzz][campaign]") {
  INFO("seed " << kSeed);
  int on_surface = 0;
  for (std::uint64_t index = 0; index < 500; ++index) {
    const cases::Case one = cases::target_named("leaving")->make(kSeed, index);
    REQUIRE(one.query.from);
    const Vec centre = centre_of(one.scene, *one.query.from);
    Vec arm{};
    for (int i = 0; i < 3; ++i) arm[i] = one.query.x[i] - centre[i];
    const double r = one.scene.lattices[0].atoms[one.query.from->atom].radius;
    on_surface += std::fabs(std::hypot(arm[0], arm[1], arm[2]) / r - 1) < 1e-9;
    if (std::find(one.tags.begin(), one.tags.end(), "few-bits") == one.tags.end())
      REQUIRE(arm[0] * one.query.v[0] + arm[1] * one.query.v[1] + arm[2] * one.query.v[2] > 0);
  }
  CHECK(on_surface > 300);  // 389 seen
}

TEST_CASE("A climb is repeatable and comes to smaller margins, its variants are queries with their answers",
          "[fuzz][campaign]") {
  INFO("seed " << kSeed);
  int improved = 0, at_the_edge = 0;
  for (std::uint64_t index = 0; index < 60; ++index) {
    const cases::Case base = cases::target_named("generic")->make(kSeed, index);
    const oracle::Oracle oracle(base.scene);
    const question::Place place(base.scene);
    const auto variants = fuzz::climb(cases::Random(1, "climb", index), base.query, place);
    const auto again = fuzz::climb(cases::Random(1, "climb", index), base.query, place);
    REQUIRE(variants.size() <= fuzz::kRounds * fuzz::kMovesPerRound);
    REQUIRE(variants.size() == again.size());
    double least = 1e300;
    for (std::size_t i = 0; i < variants.size(); ++i) {
      REQUIRE(stream(base.scene, variants[i].query) == stream(base.scene, again[i].query));
      REQUIRE_FALSE(flaw_of(variants[i].query, base.scene));
      REQUIRE(same(variants[i].exact, oracle.first_hit(variants[i].query)));
      least = std::min(least, variants[i].margin());
    }
    // Each round goes on from the best before it.
    cases::Random random(1, "climb", index);
    fuzz::Variant best = fuzz::seen(place, base.query);
    REQUIRE_FALSE(fuzz::along_semiaxis(random, place, best));  // it is balls
    improved += least < best.margin();
    at_the_edge += least < 4;
    for (std::size_t i = 0; i < variants.size();) {
      const fuzz::Variant here = best;
      for (int move = 0; move < fuzz::kMovesPerRound; ++move, ++i) {
        const Query query = fuzz::next_query(random, place, here, move);
        REQUIRE(stream(base.scene, variants[i].query) == stream(base.scene, query));
        if (variants[i].margin() < best.margin()) best = variants[i];
      }
    }
    CHECK(best.margin() <= least);
  }
  CHECK(improved > 50);     // 53 seen
  CHECK(at_the_edge > 40);  // 53 seen
}
