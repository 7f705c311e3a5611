// What becomes of the questions when an engine breaks, and when the time is over. No clock decides here: the
// time is over when the test says so.
#include "judge/examination.hpp"

#include <catch2/catch.hpp>

#include <chrono>
#include <thread>

#include "compare/registry.hpp"
#include "compare/sampling.hpp"
#include "judge/repetition.hpp"

using namespace lorentz;
using namespace lorentz::judge;

namespace {

constexpr double kForEver = 1e9;
constexpr std::uint64_t kSeed = 20161115;

std::string tolerant(const std::string& fault) {
  return "cmd:exec " LORENTZ_TOLERANT_ENGINE " " + fault;
}

// Drawn questions in the square or cubic lattice.
Source questions(int dimension, std::size_t number) {
  const auto setting = std::make_shared<Setting>(unit_scene(dimension, 0.25));
  const auto queries = std::make_shared<std::vector<Query>>(
      compare::draw_queries(setting->scene(), setting->oracle(), kSeed, number));
  return [=, next = std::size_t{0}]() mutable -> std::optional<Question> {
    if (next == queries->size()) return std::nullopt;
    const Query& query = (*queries)[next++];
    return Question{setting, query, setting->oracle().first_hit(query), "here", ""};
  };
}

// An engine of ours that answers exactly, and sets a flag at its `at`-th question.
class Flagging final : public compare::Answerer {
 public:
  Flagging(std::atomic<bool>& flag, long at) : flag_(flag), left_(at) {}
  void set_scene(const Scene& scene) override { oracle_.emplace(scene); }
  void ask(const Id&, const Query& query) override {
    if (--left_ <= 0) flag_ = true;
    Answer answer = oracle_->first_hit(query);
    deliver(answer);
  }

 private:
  std::atomic<bool>& flag_;
  long left_;
  std::optional<oracle::Oracle> oracle_;
};

}  // namespace

TEST_CASE("A program is given up for a row, not for the run, and the row says why", "[judge][examination]") {
  const std::atomic<bool> stop = false;
  Examination examination(tolerant("dies-in 3"), {}, 4, stop);
  examination.run({"plane", ""}, questions(2, 20), kForEver);
  examination.run({"space", ""}, questions(3, 20), kForEver);
  examination.run({"plane again", ""}, questions(2, 20), kForEver);
  examination.run({"space again", ""}, questions(3, 20), kForEver);
  examination.finish();
  REQUIRE(examination.rows().size() == 4);
  for (const std::size_t i : {0, 2}) {
    const Row& row = examination.rows()[i];
    CHECK(row.tally.agree == 20);
    CHECK(row.given_up.empty());
    CHECK(row.is_exhausted);
  }
  for (const std::size_t i : {1, 3}) {
    const Row& row = examination.rows()[i];
    CHECK(row.tally.queries == 5);  // what was not asked is not counted
    CHECK(row.tally.missing == 5);
    CHECK(row.tally.error == 0);
    CHECK(row.given_up == "after 5 failures in a row, the last: cmd died (exit 3) on this query");
  }
  const std::vector<Finding> findings = examination.findings();
  REQUIRE(findings.size() == 1);
  CHECK(findings[0].cause() == Cause::no_answer);
  CHECK(findings[0].count == 10);
}

TEST_CASE("Nothing is asked when the time is over, and no answer is waited for", "[judge][examination]") {
  std::atomic<bool> stop = false;
  const compare::GuestEngine guest(
      "flagging", [&](const compare::AnswererOptions&) { return std::make_unique<Flagging>(stop, 30); });
  Examination examination("flagging", {}, 4, stop);
  examination.run({"asked", ""}, questions(2, 1000), kForEver);
  examination.run({"not asked", ""}, questions(2, 1000), kForEver);
  const std::size_t asked = examination.rows()[0].tally.queries;
  CHECK(asked >= 30);
  CHECK(asked < 30 + 32);  // those that were asked together with it
  CHECK(examination.rows()[1].tally.queries == 0);
  CHECK_FALSE(examination.rows()[1].is_exhausted);
  // A program that never answers, and would be waited for for years.
  std::atomic<bool> over = false;
  compare::AnswererOptions options;
  options.timeout = kForEver;
  Examination silent(tolerant("hangs 1"), options, 4, over);
  std::thread clock([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    over = true;
  });
  silent.run({"silent", ""}, questions(2, 1000), kForEver);
  silent.finish();
  clock.join();
  CHECK(silent.rows()[0].tally.queries == 0);
}

TEST_CASE("Asked again: it fails, it does not, or there is no time to see", "[judge][repetition]") {
  const std::atomic<bool> stop = false, stopped = true;
  const Question question = *questions(2, 1)();
  Finding finding{
      {question, Answer::error("cmd died"), {}, {Cause::no_answer, Severity::error}}, "here", 1, {}};
  const auto recheck_of = [&](const std::string& fault, const std::atomic<bool>& over) {
    recheck(
        finding,
        [&] { return std::make_unique<Examination>(tolerant(fault), compare::AnswererOptions{}, 4, over); },
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
