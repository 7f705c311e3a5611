// What becomes of the questions when an engine breaks, and when the time is over. No clock decides here: the
// time is over when the test says so.
#include "judge/examination.hpp"

#include <catch2/catch.hpp>

#include <chrono>
#include <cmath>
#include <thread>

#include "judge/simplest.hpp"
#include "question/engines.hpp"
#include "tests/judge/judge_support.hpp"
#include "tests/support/command_line.hpp"

using namespace lorentz;
using namespace lorentz::test;
using namespace lorentz::judge;

namespace {

constexpr double kForEver = 1e9;

std::string tolerant(const std::string& fault) {
  return "cmd:exec " LORENTZ_TOLERANT_ENGINE " " + fault;
}

}  // namespace

TEST_CASE("A program is given up for a scene, not for the run, and the row says why",
          "[judge][examination]") {
  const std::atomic<bool> stop = false;
  // Counted: no scene is left because starting takes long here.
  TimedExamination examination(order_of(question::engine_named(tolerant("dies-in 3")), 1000), {}, stop);
  examination.run({"plane", ""}, drawn_in({2}, 20), kForEver);
  examination.run({"space", ""}, drawn_in({3}, 20), kForEver);
  examination.run({"plane again", ""}, drawn_in({2}, 20), kForEver);
  examination.run({"both", ""}, drawn_in({3, 2, 3}, 20), kForEver);
  examination.finish();
  const std::deque<ExaminedRow>& rows = examination.results().rows;
  REQUIRE(rows.size() == 4);
  for (const std::size_t i : {0, 2}) {
    CHECK(rows[i].tally[Count::agree] == 20);
    CHECK(rows[i].scenes_given_up == 0);
    CHECK(rows[i].is_exhausted);
  }
  CHECK(rows[1].tally.queries == 5);  // what was not asked is not counted
  CHECK(rows[1].tally[Count::missing] == 5);
  CHECK(rows[1].tally[Count::error] == 0);
  CHECK(rows[1].scenes_given_up == 1);
  CHECK(rows[1].last_failure == "cmd died (exit 3) on this query");
  CHECK(rows[3].tally[Count::agree] == 20);
  CHECK(rows[3].tally[Count::missing] == 10);
  CHECK(rows[3].scenes_given_up == 2);
  const std::vector<Finding> findings = examination.results().all_findings();
  REQUIRE(findings.size() == 1);
  CHECK(findings[0].cause() == Cause::no_answer);
  CHECK(findings[0].count == 15);
}

TEST_CASE("An invalid answer is told apart from a missing one, with what the program said on stderr",
          "[judge][examination]") {
  const std::atomic<bool> stop = false;
  const auto finding_of = [&](const std::string& command) {
    TimedExamination examination(order_of(question::engine_named("cmd:" + command)), {}, stop);
    examination.run({"plane", ""}, drawn_in({2}, 1), kForEver);
    examination.finish();
    const std::vector<Finding> findings = examination.results().all_findings();
    REQUIRE(findings.size() == 1);
    return findings[0];
  };
  const Finding bad = finding_of(R"(while read -r line; do echo "{\"id\":1,\"outcome\":\"perhaps\"}"; done)");
  CHECK(bad.cause() == Cause::bad_line);
  CHECK(bad.simplest.diagnosis.blame() == Blame::protocol);
  CHECK(bad.simplest.last_words.empty());
  const Finding died = finding_of("read -r line; echo 'out of luck' >&2; exit 3");
  CHECK(died.cause() == Cause::no_answer);
  CHECK(died.simplest.diagnosis.blame() == Blame::ended);
  CHECK(died.simplest.last_words == "out of luck");
}

TEST_CASE("A program that never answered is not asked on and on", "[judge][examination]") {
  const std::atomic<bool> stop = false;
  // Counted: no scene is left because starting takes long here.
  TimedExamination examination(order_of(question::engine_named("cmd:exit 3"), 1000), {}, stop);
  examination.run({"first", ""}, drawn_in({2, 3}, 20), kForEver);
  examination.run({"second", ""}, drawn_in({2, 3}, 20), kForEver);
  examination.finish();
  CHECK(examination.results().rows[0].tally[Count::missing] == 5);
  CHECK(examination.results().rows[1].tally.queries == 0);
  CHECK(examination.results().rows[1].scenes_given_up > 0);
}

TEST_CASE("An engine is asked no more where it is slow, or does none of the first questions",
          "[judge][examination]") {
  const auto setting_with = [](int asked, int unsupported, double seconds) {
    Place place(unit_scene(2, 0.25));
    for (int i = 0; i < asked; ++i) place.note(i < unsupported);
    place.note_time(seconds / 2), place.note_time(seconds / 2);
    return place;
  };
  CHECK_FALSE(setting_with(4, 0, 0.1 * 4).is_beyond_engine());
  CHECK(setting_with(4, 0, std::nextafter(0.1 * 4, 1)).is_beyond_engine());
  CHECK_FALSE(setting_with(3, 0, 100).is_beyond_engine());
  CHECK(setting_with(4, 4, 0).is_beyond_engine());
  CHECK_FALSE(setting_with(4, 3, 0).is_beyond_engine());
  CHECK_FALSE(setting_with(3, 3, 0).is_beyond_engine());
  CHECK(setting_with(4, 3, 0).was_answered());
  CHECK_FALSE(setting_with(4, 4, 0).was_answered());
  Place given_up = setting_with(1, 0, 0);
  given_up.give_up();
  CHECK((given_up.is_beyond_engine() && !given_up.was_answered()));
}

TEST_CASE("Counted questions: each row asks its number, in slow scenes, too", "[judge][examination]") {
  const std::atomic<bool> stop = false;
  const std::string slow =
      "cmd:while read line; do case $line in *'\"x\"'*) sleep 0.12;; esac; "
      "printf '%s\\n' \"$line\"; done | exec " LORENTZ_TOLERANT_ENGINE;
  TimedExamination timed(order_of(question::engine_named(slow)), {}, stop),
      counted(order_of(question::engine_named(slow), 12), {}, stop);
  timed.run({"row", ""}, drawn_in({2, 3}, 8), kForEver);
  counted.run({"row", ""}, drawn_in({2, 3}, 8), kForEver);
  counted.run({"few", ""}, drawn_in({2}, 8), kForEver);
  timed.finish(), counted.finish();
  CHECK(timed.results().rows[0].tally.queries < 16);  // both scenes are left
  CHECK(counted.results().rows[0].tally.queries == 12);
  CHECK(counted.results().rows[1].tally.queries == 8);
}

TEST_CASE("Counted questions: where scenes are left, each row asks the same, however long an answer takes",
          "[judge][examination]") {
  const std::atomic<bool> stop = false;
  const auto asked = [&](int milliseconds) {
    // Supports no 3D, and takes this long.
    const auto planar = guest("planar" + std::to_string(milliseconds),
                              [=](const Scene& scene, const Query&, double, Answer& answer) {
                                std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
                                if (scene.dimension == 3)
                                  answer = Answer::unsupported_because("it is planar");
                              });
    TimedExamination examination(order_of(planar, 60), {}, stop);
    examination.run({"row", ""}, drawn_in({2, 3}, 40), kForEver);
    return examination.results().rows[0].tally;
  };
  const question::Tally fast = asked(0), slow = asked(30);
  CHECK(fast.queries == slow.queries);
  CHECK(fast[Count::unsupported] == slow[Count::unsupported]);
  CHECK(fast[Count::agree] == 40);
  CHECK(fast[Count::unsupported] < 40);  // the scene is left
}

TEST_CASE(
    "Silence is slowness, if the run is told so, of an engine that has answered, and it leaves the scene",
    "[judge][examination]") {
  const std::atomic<bool> stop = false;
  question::AnswererOptions options;
  options.timeout = 0.5;
  options.start_timeout = 60;
  const auto examined = [&](bool is_slowness, const std::string& fault) {
    JudgeOrder order = order_of(question::engine_named(tolerant(fault)));
    if (is_slowness) order.timeout.reset();
    auto one = std::make_unique<TimedExamination>(order, options, stop);
    one->run({"plane", ""}, drawn_in({2}, 40), kForEver);
    one->finish();
    return one;
  };
  const auto slow = examined(true, "hangs 10"), broken = examined(false, "hangs 10");
  CHECK(slow->results().rows[0].tally[Count::missing] == 0);
  CHECK(slow->results().rows[0].tally[Count::too_slow] > 0);
  CHECK(slow->results().rows[0].is_exhausted);        // the scene is left
  CHECK(slow->results().all_findings().size() == 1);  // with the question
  CHECK(broken->results().rows[0].tally[Count::too_slow] == 0);
  CHECK(broken->results().rows[0].tally[Count::missing] > 0);
}

TEST_CASE("The first 500 questions of each row are compared, and a row without any has no speed",
          "[judge][examination]") {
  const std::atomic<bool> stop = false;
  TimedExamination whole(order_of(question::engine_named("oracle")), {}, stop),
      none(order_of(question::engine_named("oracle")), {}, stop);
  whole.run({"row", ""}, drawn_in({2}, 510), kForEver);
  long calls = 0;
  for (const auto& [decade, call] : whole.results().curves[0].by_decade())
    calls += static_cast<long>(call.counts.answers() + call.counts[Count::undecided]);
  CHECK(whole.results().rows[0].tally[Count::agree] == 510);
  CHECK(calls == 500);
  none.run({"row", ""}, drawn_in({2}, 0), kForEver);
  TimedExamination more(order_of(question::engine_named("oracle")), {}, stop);
  more.run({"row", ""}, drawn_in({2}, 0), kForEver);
  more.results().add(none.results());
  CHECK(more.results().rows[0].tally.speed.ns_per_query == 0);
}

TEST_CASE("The first question to another program is in its domain, if anything is", "[judge][examination]") {
  const Folder folder;
  const std::atomic<bool> stop = false;
  JudgeOrder order = order_of(
      question::engine_named("cmd:tee " + folder.file("asked") + " | exec " LORENTZ_TOLERANT_ENGINE));
  const auto asked = [&] {
    folder.write("asked", "");
    TimedExamination examination(order, {}, stop);
    examination.warm_up();
    examination.finish();
    return folder.read("asked");
  };
  CHECK(contains(asked(), R"("radius":0.1)"));
  order.claim.domain.dimension_2 = false, order.claim.domain.radius.high = 0.05;
  CHECK((contains(asked(), R"({"dimension":3,)") && !contains(asked(), R"("radius":0.1)")));
  order.claim.domain.balls = false, order.claim.domain.radius = {};
  CHECK(contains(asked(), R"("semiaxes":)"));
  order.claim.domain.dimension_3 = false;
  CHECK(asked().empty());
}

TEST_CASE("Nothing is asked when the time is over, and no answer is waited for", "[judge][examination]") {
  std::atomic<bool> stop = false;
  long left = 30;
  const auto flagging =
      guest("flagging", [&](const Scene&, const Query&, double, Answer&) { stop = --left <= 0; });
  TimedExamination examination(order_of(flagging), {}, stop);
  examination.run({"asked", ""}, drawn_in({2}, 1000), kForEver);
  examination.run({"not asked", ""}, drawn_in({2}, 1000), kForEver);
  const std::size_t asked = examination.results().rows[0].tally.queries;
  CHECK(asked >= 30);
  CHECK(asked < 30 + 32);  // those that were asked together with it
  CHECK(examination.results().rows[1].tally.queries == 0);
  CHECK_FALSE(examination.results().rows[1].is_exhausted);
  // A program that never answers, and would be waited for for years.
  std::atomic<bool> over = false;
  question::AnswererOptions options;
  options.timeout = kForEver;
  TimedExamination silent(order_of(question::engine_named(tolerant("hangs 1"))), options, over);
  std::thread clock([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    over = true;
  });
  silent.run({"silent", ""}, drawn_in({2}, 1000), kForEver);
  silent.finish();
  clock.join();
  CHECK(silent.results().rows[0].tally.queries == 0);
}

TEST_CASE("Asked again: it fails, it does not, or there is no time to see", "[judge][repetition]") {
  const std::atomic<bool> stop = false, stopped = true;
  const Question question = *drawn_in({2}, 1)();
  Finding finding{
      {question, Answer::error("cmd died"), {}, {Cause::no_answer, Severity::error}}, "here", 1, {}};
  const auto recheck_of = [&](const std::string& fault, const std::atomic<bool>& over) {
    recheck(
        finding,
        [&] {
          return std::make_unique<TimedExamination>(order_of(question::engine_named(tolerant(fault))),
                                                    question::AnswererOptions{}, over);
        },
        kForEver);
    return finding.recheck;
  };
  CHECK(recheck_of("dies 1", stop) == Recheck::fails);
  CHECK(finding.repetitions == 1);
  CHECK(recheck_of("dies 7", stop) == Recheck::fails);
  CHECK(finding.repetitions >= 7);  // a program that is slow to start is started twice
  CHECK(recheck_of("starts 0", stop) == Recheck::passes);
  CHECK(recheck_of("dies 1", stopped) == Recheck::no_time);
}
