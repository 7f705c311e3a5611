// The ledger: equal times for all targets however slow the engine, and what is shrunk when.
#include "fuzz/campaign/ledger.hpp"

#include <catch2/catch.hpp>

#include "tests/fuzz/campaign_support.hpp"

using namespace lorentz;
using namespace lorentz::test;
using fuzz::Shrinking;

namespace {

constexpr std::uint64_t kManyAtOnce = 256;  // what a cmd: engine likes

class NoJournal final : public fuzz::Journal {
  void record(const cases::Target&, const fuzz::TargetTally&, const std::vector<fuzz::Finding>&) override {}
  void tick() override {}
};

fuzz::Plan plan_of(std::initializer_list<const char*> names) {
  fuzz::Plan plan;
  for (const char* name : names) plan.targets.push_back(cases::target_named(name));
  return plan;
}

fuzz::Finding finding_of(const char* target, const char* kind, std::uint64_t index) {
  fuzz::Finding one;
  one.target = target;
  one.kind = one.sort = kind;
  one.index = index;
  return one;
}

// A stint that was done, with findings of these kinds.
fuzz::Done done_with(const fuzz::Stint& stint, double seconds,
                     std::initializer_list<const char*> kinds = {}) {
  fuzz::Done done{stint, fuzz::StintResult{}, {}, seconds};
  done.result->met.cases = stint.end - stint.begin;
  for (const char* kind : kinds) {
    ++done.result->met.sorts[kind];
    done.result->kept.push_back({finding_of("generic", kind, stint.begin), 1});
  }
  return done;
}

// An answerer with a clock of its own: seconds for each target when the time is up.
std::vector<double> times_of(const std::vector<double>& seconds_a_case, double seconds,
                             std::initializer_list<const char*> kinds = {}) {
  const fuzz::Plan plan = plan_of({"generic", "grazing", "leaving", "tie"});
  fuzz::Bounds bounds;
  bounds.seconds = seconds;
  std::vector<fuzz::TargetTally> tallies(4);
  NoJournal journal;
  fuzz::Ledger ledger(plan, bounds, 1, tallies, journal);
  std::vector<double> times(4);
  for (double now = 0; now < seconds;) {
    const fuzz::Assignment next = *ledger.take(kManyAtOnce);
    const std::size_t t = next.stint.target;
    double took = static_cast<double>(next.stint.end - next.stint.begin) * seconds_a_case[t];
    fuzz::Done done;
    if (next.due) {
      took = next.most_seconds;  // it would go on and on
      done = {next.stint, {}, next.due, took};
    } else {
      done = done_with(next.stint, took, t == 0 ? kinds : std::initializer_list<const char*>{});
    }
    now += took;
    if (now < seconds) times[t] += took;
    ledger.hand_in(std::move(done));
    ledger.record();
  }
  return times;
}

void check_fair(const std::vector<double>& times, double factor = 2) {
  const auto [least, most] = std::minmax_element(times.begin(), times.end());
  INFO(times[0] << ' ' << times[1] << ' ' << times[2] << ' ' << times[3]);
  CHECK(*least > 0);
  CHECK(*most <= factor * *least);
}

}  // namespace

TEST_CASE("Targets get equal times from engines that are slow, or slow at some of them", "[fuzz][ledger]") {
  check_fair(times_of({0.0175, 0.0175, 0.0175, 0.0175}, 30));
  check_fair(times_of({0.0175, 0.0175, 0.0175, 0.0175}, 3));
  check_fair(times_of({1e-6, 1e-3, 0.02, 0.5}, 30));
  check_fair(times_of({0.4, 0.4, 0.4, 0.4}, 30));
}

TEST_CASE("Shrinking is of a target's own time, and has its share of that", "[fuzz][ledger]") {
  check_fair(times_of({0.0175, 0.0175, 0.0175, 0.0175}, 30, {"wrong", "undecided", "wrong time", "error"}),
             1.3);
  check_fair(times_of({0.001, 0.5, 0.001, 0.001}, 60, {"wrong", "error"}), 1.3);
}

TEST_CASE("A stint is one case at first, and as long as it was quick then", "[fuzz][ledger]") {
  const fuzz::Plan plan = plan_of({"generic"});
  std::vector<fuzz::TargetTally> tallies(1);
  NoJournal journal;
  const auto second_batch = [&](double seconds, std::uint64_t liked) {
    fuzz::Ledger ledger(plan, {}, 1, tallies, journal);
    const fuzz::Assignment first = *ledger.take(liked);
    CHECK(first.stint.end - first.stint.begin == 1);
    ledger.hand_in(done_with(first.stint, seconds));
    const fuzz::Assignment next = *ledger.take(liked);
    return next.stint.end;
  };
  CHECK(second_batch(0.0175, kManyAtOnce) == 8);
  CHECK(second_batch(0.5, kManyAtOnce) == 2);
  CHECK(second_batch(1e-4, kManyAtOnce) == kManyAtOnce);
  CHECK(second_batch(1e-4, 1) == 128);
  CHECK(second_batch(1e-8, 1) == 1024);
}

TEST_CASE("What is wrong is shrunk first, and what was cut short when there is time", "[fuzz][ledger]") {
  const fuzz::Plan plan = plan_of({"generic"});
  std::vector<fuzz::TargetTally> tallies(1);
  NoJournal journal;
  fuzz::Bounds bounds;
  bounds.count = 0;  // no more cases
  std::vector<fuzz::Finding> unshrunk;
  for (const char* kind : {"undecided", "error", "wrong time", "wrong"})
    unshrunk.push_back(finding_of("generic", kind, unshrunk.size()));
  unshrunk.push_back(finding_of("grazing", "wrong", 77));  // no target of the plan
  unshrunk.push_back(finding_of("generic", "wrong", 99));
  unshrunk.back().shrinking = Shrinking::cut_short;
  const auto order = [&] {
    fuzz::Ledger ledger(plan, bounds, 1, tallies, journal, unshrunk);
    std::vector<std::uint64_t> indices;
    for (const fuzz::Assignment& one : ledger.take_some(10, 1)) {
      REQUIRE(one.due);
      CHECK((one.most_seconds < 1e9) == bounds.limits_time());
      indices.push_back(one.due->index);
      CHECK(ledger.record());
      ledger.hand_in({one.stint, {}, one.due, 0.1});
    }
    CHECK_FALSE(ledger.record());
    return indices;
  };
  CHECK(order() == std::vector<std::uint64_t>{3, 99, 2, 1, 0});
  bounds.seconds = 60;
  CHECK(order() == std::vector<std::uint64_t>{3, 2, 1, 0});
}

TEST_CASE("A target that has more under way than others comes after them, however little its time",
          "[fuzz][ledger]") {
  const fuzz::Plan plan = plan_of({"generic", "grazing"});
  std::vector<fuzz::TargetTally> tallies(2);
  NoJournal journal;
  std::vector<fuzz::Finding> unshrunk;
  for (std::uint64_t i = 0; i < 6; ++i)
    for (const char* target : {"generic", "grazing"}) unshrunk.push_back(finding_of(target, "wrong", i));
  fuzz::Bounds bounds;
  bounds.count = 0;
  fuzz::Ledger ledger(plan, bounds, 1, tallies, journal, unshrunk);
  const auto take = [&] {
    const fuzz::Assignment next = *ledger.take(1);
    REQUIRE(next.due);
    return next;
  };
  const fuzz::Assignment first = take(), other = take();
  CHECK(first.stint.target == 0);  // of equal ones the first
  CHECK(other.stint.target == 1);
  const auto hand_in = [&](const fuzz::Assignment& one, double seconds) {
    ledger.hand_in({one.stint, {}, one.due, seconds});
  };
  hand_in(first, 0.1);
  hand_in(other, 0.35);
  hand_in(take(), 0.1);
  std::string targets;  // the times are 0.2 and 0.35 all the while
  for (int i = 0; i < 5; ++i) targets += std::to_string(take().stint.target);
  CHECK(targets == "01010");
}

TEST_CASE("What a campaign that goes on has to shrink comes before its first case", "[fuzz][ledger]") {
  const fuzz::Plan plan = plan_of({"generic"});
  std::vector<fuzz::TargetTally> tallies(1);
  NoJournal journal;
  fuzz::Ledger ledger(plan, {}, 1, tallies, journal, {finding_of("generic", "wrong", 3)});
  CHECK(ledger.take(1)->due);
  CHECK_FALSE(ledger.take(1)->due);
}
