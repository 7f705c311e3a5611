// More than one of a thing: threads of a campaign, parts of a source, examinations that are added up, flaws
// of one engine.
#include "cli/judging.hpp"

#include <catch2/catch.hpp>

#include <map>
#include <mutex>
#include <set>
#include <thread>

#include <lorentz/geometry.hpp>
#include "cases/families/target.hpp"
#include "compare/registry.hpp"
#include "compare/sampling.hpp"
#include "judge/questions.hpp"
#include "tests/support/support.hpp"

using namespace lorentz;
using namespace lorentz::test;
using namespace lorentz::judge;

namespace {

constexpr std::uint64_t kSeed = 20161116;
constexpr double kForEver = 1e9;

// What was asked, by thread.
struct Log {
  std::mutex mutex;
  std::map<std::thread::id, std::map<std::string, int>> by_thread;
  std::atomic<bool> is_on = false;  // else nothing is answered, nor written down
  std::atomic<bool> is_enough = false;
};

// An engine of ours that is exact but for flights that a fault changes.
class Faulty final : public compare::Answerer {
 public:
  using Fault = std::function<void(const Scene&, const Query&, Answer&)>;
  explicit Faulty(Fault fault, Log* asked = nullptr) : fault_(std::move(fault)), asked_(asked) {}
  void set_scene(const Scene& scene) override { scene_ = scene, oracle_.emplace(scene); }
  void ask(const Id&, const Query& query) override {
    if (asked_ && !write(query)) {
      Answer no = Answer::unsupported_because("this is no campaign");
      return deliver(no);
    }
    Answer answer = oracle_->first_hit(query);
    fault_(scene_, query, answer);
    deliver(answer);
  }

 private:
  bool write(const Query& query) {
    constexpr std::size_t kEnough = 100;  // of each thread
    const std::lock_guard lock(asked_->mutex);
    if (!asked_->is_on) return false;
    ++asked_->by_thread[std::this_thread::get_id()][stream(scene_, query)];
    std::size_t threads = 0;
    for (const auto& [thread, questions] : asked_->by_thread) threads += questions.size() >= kEnough;
    if (threads == 2) asked_->is_enough = true;
    return true;
  }

  Fault fault_;
  Log* asked_;
  Scene scene_;
  std::optional<oracle::Oracle> oracle_;
};

compare::GuestEngine guest(const std::string& name, Faulty::Fault fault, Log* asked = nullptr) {
  return {name, [=](const compare::AnswererOptions&) { return std::make_unique<Faulty>(fault, asked); }};
}

// Leaves the disc it comes from at once in 2D, and sees nothing in 3D in the direction -x.
void two_faults(const Scene& scene, const Query& query, Answer& answer) {
  if (scene.dimension == 2 && query.v[1] > 0 && answer.outcome == Outcome::hit)
    answer.obstacle.cell[1] = 77777;
  if (scene.dimension == 3 && query.v[0] < 0 && answer.outcome == Outcome::hit) answer = Answer::never();
}

Source drawn_in(const std::vector<int>& dimensions, std::uint64_t seed, std::size_t number) {
  const auto all = std::make_shared<std::vector<Question>>();
  for (const int dimension : dimensions) {
    const auto setting = std::make_shared<Setting>(unit_scene(dimension, 0.25));
    for (const Query& query : compare::draw_queries(setting->scene(), setting->oracle(), seed, number))
      all->push_back(
          {setting, query, setting->oracle().first_hit(query), "seed " + std::to_string(seed), ""});
  }
  return [=, next = std::size_t{0}]() mutable -> std::optional<Question> {
    return next < all->size() ? std::optional((*all)[next++]) : std::nullopt;
  };
}

// All that a finding says.
std::string text_of(const Finding& finding) {
  std::string text = finding.explanation() + ", " + std::to_string(finding.count) + ", " + finding.where +
                     ", " +
                     stream(finding.simplest.question.setting->scene(), finding.simplest.question.query) +
                     std::to_string(finding.by_radii.value_or(-1)) + ", " +
                     std::to_string(finding.share_of_plain) + ", " + std::to_string(finding.share_of_hard);
  for (const auto& [row, count] : finding.by_row) text += ", " + row + " " + std::to_string(count);
  return text;
}

std::string text_of(const Calls& calls) {
  std::string text;
  for (const auto& [decade, call] : calls.by_decade())
    text += std::to_string(decade) + ": " + std::to_string(call.right) + ' ' +
            std::to_string(call.ill_posed) + ' ' + std::to_string(call.wrong) + ' ' +
            std::to_string(call.undecided) + '\n';
  return text;
}

}  // namespace

TEST_CASE("Each case of a campaign is one part's, whatever their number", "[judge][questions]") {
  const auto first_of = [](unsigned part, unsigned parts, std::size_t number) {
    const Source source = campaign(kSeed, {fuzz::Scope::Scenes::unit, 2}, part, parts);
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

TEST_CASE("Two threads of a judge's campaign ask different questions, and all of them count",
          "[judge][judging]") {
  Log asked;
  const auto engine = guest("two-threads", two_faults, &asked);
  cli::JudgeOrder order;
  order.engine = "two-threads";
  order.quick = true;
  order.time = 1e6;  // it ends when both have asked enough, however long that takes
  order.jobs = 2;
  order.on_progress = [&](const std::string& row) { asked.is_on = row == "campaign"; };
  const cli::JudgeReport report = cli::judged(order, asked.is_enough);
  REQUIRE(asked.by_thread.size() == 2);
  const auto& first = asked.by_thread[std::this_thread::get_id()];
  std::size_t both = 0, second = 0;
  for (const auto& [thread, questions] : asked.by_thread)
    if (thread != std::this_thread::get_id())
      for (const auto& [text, times] : questions) both += first.contains(text), ++second;
  INFO(second << " of the second, " << both << " of both");
  CHECK(second >= 100);
  CHECK(both * 4 < second);  // constructed cases may be equal
  const judge::Row& last = report.rows.back();
  CHECK(last.name == "campaign");
  CHECK(last.asked() > second);
  CHECK(last.tally.wrong > 0);
  // Both of its faults are told, each with what sets it apart.
  std::map<Cause, const Finding*> worst;
  for (const Finding& finding : report.findings)
    if (finding.severity() == Severity::wrong) worst[finding.cause()] = &finding;
  REQUIRE(worst.contains(Cause::never_for_hit));
  CHECK(worst[Cause::never_for_hit]->simplest.question.setting->scene().dimension == 3);
  CHECK(worst.contains(Cause::false_hit));
  CHECK(report.verdict() == "wrong");
}

TEST_CASE("What several examinations come to is what one comes to", "[judge][examination]") {
  const auto engine = guest("two-faults", two_faults);
  const std::atomic<bool> stop = false;
  const auto examined = [&](const std::vector<std::uint64_t>& seeds) {
    std::unique_ptr<Examination> first;
    for (const std::uint64_t seed : seeds) {
      auto one = std::make_unique<Examination>("two-faults", compare::AnswererOptions{}, 4, stop);
      one->run({"row", ""}, drawn_in({2, 3}, seed, 30), kForEver);
      if (first)
        first->take_over(*one);
      else
        first = std::move(one);
    }
    return first;
  };
  // One that asks the same in one row.
  Examination whole("two-faults", {}, 4, stop);
  const std::vector<std::uint64_t> seeds{1, 2, 3};
  std::vector<Source> sources;
  for (const std::uint64_t seed : seeds) sources.push_back(drawn_in({2, 3}, seed, 30));
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
  for (const Examination* one : {parts.get(), backwards.get()}) {
    REQUIRE(one->rows().size() == 1);
    const compare::Tally &its = one->rows()[0].tally, &all = whole.rows()[0].tally;
    CHECK(its.queries == 3 * 2 * 30);
    CHECK(its.agree == all.agree);
    CHECK(its.wrong == all.wrong);
    CHECK(all.wrong > 30);
    CHECK(its.ns_per_query > 0);
    CHECK(text_of(one->calls()) == text_of(whole.calls()));
    const auto found = one->findings(), expected = whole.findings();
    REQUIRE(found.size() == expected.size());
    REQUIRE(found.size() >= 2);
    for (std::size_t i = 0; i < found.size(); ++i) CHECK(text_of(found[i]) == text_of(expected[i]));
  }
}
