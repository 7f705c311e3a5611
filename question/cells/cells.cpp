#include "question/cells/cells.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include <lorentz/exchange.hpp>
#include <lorentz/margin.hpp>
#include "files/messages.hpp"
#include "files/scene_file.hpp"
#include "question/examine.hpp"
#include "question/race.hpp"
#include "question/radii.hpp"
#include "report/claim_words.hpp"
#include "report/query_text.hpp"
#include "src/exchange/json_writer.hpp"
#include "starts/free_starts.hpp"

namespace lorentz::question {

namespace {

constexpr double kSecondsPerRound = 0.1;  // a slower engine gets fewer queries, or none
constexpr std::size_t kPilot = 16;
constexpr int kRounds = 5;

std::vector<Question> questions_of(const BenchPlan& plan, const BenchGroup& group) {
  const NumberFormat format = plan.claim.precision;
  const auto place = std::make_shared<Place>(
      rounded_scene(load_scene(group.scene, group.radius), format, group.scene), Truth::oracle, plan.claim);
  const starts::Kind kind = group.difficulty == "drawn"
                                ? starts::Kind::uniform
                                : starts::kind_named(group.difficulty, "--difficulty");
  return question::questions_of(place,
                                starts::free_starts(place->scene(), kind, plan.seed, plan.count, format));
}

// How many of the queries an engine answers in the time of a round, estimated from the first kPilot, or from
// the first two if these already take too long.
std::size_t affordable(const BenchPlan& plan, const std::vector<Question>& all, const EngineInfo& engine,
                       bool& failed) {
  RaceOptions options;
  options.rounds = engine.runs_apart() ? 3 : 1;  // the first round of an external engine includes its start
  options.answerer = plan.answerer;
  double count = 0;
  for (const std::size_t pilot : {std::size_t{2}, kPilot}) {
    options.counts = {pilot};
    const Speed t = race(all, {engine}, options).front();
    failed |= t.failed;
    // A program that dies is not slow, however busy the machine is; one that is silent would be silent each
    // time.
    if (t.failed && t.ns_per_query * 1e-9 < plan.answerer.timeout / 4)
      return std::min(all.size(), kFewestQueries);
    count = kSecondsPerRound * 1e9 / std::max(t.ns_per_query, 1.0);
    if (count < kFewestQueries / 8.0) break;
  }
  return std::min(all.size(), static_cast<std::size_t>(count));
}

// How much one ulp in each input changes the time, in ulps of the time; 0 if there is no time.
double condition_of(const Question& question) {
  const Answer& exact = question.exact;
  return exact.outcome == Outcome::hit && exact.time
             ? question.place->margins().condition(question.query, exact)
             : 0;
}

// The mean length of the flights that hit. Dividing a time by it gives the time per length, or per cell.
double mean_path(std::span<const Question> questions) {
  double sum = 0;
  std::size_t hits = 0;
  for (const Question& question : questions)
    if (question.exact.outcome == Outcome::hit) sum += question.exact.time.value_or(0), ++hits;
  return hits > 0 ? sum / static_cast<double>(hits) : 0;
}

// By how many of its radii the line enters or misses the obstacle in question.
std::optional<double> call_of(const Question& question, const oracle::Judgement& judgement) {
  const bool names_one = question.exact.outcome == Outcome::hit;
  if (!judgement.obstacle && !names_one) return std::nullopt;
  const ObstacleId& obstacle = judgement.obstacle ? *judgement.obstacle : question.exact.obstacle;
  return question.place->margins().approach(question.query, obstacle).gap;
}

// What a tally does not keep of one engine's answers.
class Errors {
 public:
  void add(const Judged& judged) {
    const auto& [question, reply, judgement] = judged;
    calls_.add(call_of(question, judgement), judgement.verdict,
               judgement.ulps ? radii_off(question, reply.answer) : std::nullopt);
    const double condition = question.condition;
    const double ulps = judgement.ulps.value_or(0);
    if (judgement.ulps && condition > 0 && std::isfinite(ulps / condition))
      in_conditions_.push_back(ulps / condition);
    const int rank = judgement.verdict == oracle::Verdict::wrong       ? 3
                     : judgement.verdict == oracle::Verdict::ill_posed ? 2
                     : judgement.ulps                                  ? 1
                                                                       : 0;
    const double size = rank > 1 ? judgement.departs : ulps;
    if (rank < rank_ || (rank == rank_ && !(size > size_)) || rank == 0) return;
    rank_ = rank, size_ = size, question_ = question;
    worst_ = judgement;
  }

  const std::vector<double>& in_conditions() const { return in_conditions_; }
  const report::Calls& calls() const { return calls_; }

  std::optional<report::Worst> worst(const BenchGroup& group, const std::string& engine) const {
    if (rank_ == 0) return std::nullopt;
    report::Worst worst;
    worst.verdict = rank_ == 3          ? "wrong"
                    : rank_ == 2        ? "ill-posed"
                    : worst_.wrong_time ? "wrong-time"
                                        : "agree";
    worst.ulps = worst_.ulps;
    worst.query = report::hexadecimal_query(question_.query, question_.place->scene());
    worst.command = command_of(group, worst.query) + shell_quoted(engine);
    return worst;
  }

 private:
  // The command without the engine. A scene whose numbers were rounded is written in full.
  std::string command_of(const BenchGroup& group, const std::string& query) const {
    const Place& place = *question_.place;
    if (place.claim() == Claim())
      return fmt::format("echo '{}' | lorentz compare --scene {}{} --queries - --engine ", query,
                         shell_quoted(group.scene),
                         group.radius ? " --radius " + json::text_of(*group.radius) : "");
    std::string scene;
    append_scene_line(scene, place.scene());
    return fmt::format("echo '{}{}' | lorentz compare --queries -{} --engine ", scene, query,
                       report::arguments_of(place.claim()));
  }

  std::vector<double> in_conditions_;
  report::Calls calls_;
  int rank_ = 0;  // of the worst so far: 0 none, 1 right, 2 ill-posed, 3 wrong
  double size_ = -1;
  Question question_;
  oracle::Judgement worst_;
};

report::Cell named_cell(const BenchGroup& group, const Scene& scene, const std::string& engine) {
  report::Cell cell;
  cell.scene = group.scene;
  cell.radius = group.radius;
  cell.dimension = scene.dimension;
  cell.difficulty = group.difficulty;
  cell.engine = engine;
  return cell;
}

void fill(report::Cell& cell, const Tally& t) {
  cell.queries = t.queries;
  cell.counts = t.counts;
  cell.ulps = report::histogram_of(t.ulps);
  cell.skipped = t[Count::unsupported] == cell.queries;  // the speed of refusals means nothing
}

// Asks an engine the questions and judges its answers.
void examine_into(report::Cell& cell, Answerer& answerer, const BenchGroup& group,
                  std::span<const Question> questions) {
  Tally tally;
  Errors errors;
  examine(all_of(questions), answerer, oracle::kDefaultUlps, [&](const Judged& judged) {
    tally.count(judged.judgement);
    errors.add(judged);
  });
  fill(cell, tally);
  cell.mean_path = mean_path(questions);
  cell.conditions = report::histogram_of(errors.in_conditions());
  cell.calls = errors.calls();
  cell.worst = errors.worst(group, cell.engine);
}

// Times the engines with these numbers in plan.engines, and writes the times into their cells. True if one of
// them failed.
bool race(const BenchPlan& plan, const std::vector<Question>& questions,
          const std::vector<std::size_t>& numbers, const std::vector<std::size_t>& counts,
          std::vector<report::Cell>& cells) {
  RaceOptions options{kRounds, plan.answerer};
  std::vector<EngineInfo> engines;
  for (const std::size_t i : numbers) engines.push_back(plan.engines[i]), options.counts.push_back(counts[i]);
  const std::vector<Speed> speeds = question::race(questions, engines, options);
  for (std::size_t i = 0; i < speeds.size(); ++i) {
    const Speed& speed = speeds[i];
    report::Cell& cell = cells[numbers[i]];
    cell.ns = report::CellTimes{speed.ns_median, speed.ns_low, speed.ns_high, speed.ns_per_query};
    cell.instructions = speed.instructions;
  }
  return std::ranges::any_of(speeds, &Speed::failed);
}

}  // namespace

BenchCells measure_cells(const BenchPlan& plan, const BenchGroup& group) {
  BenchCells result;
  std::vector<Question> questions = questions_of(plan, group);
  const Scene scene = questions[0].place->scene();
  std::vector<std::size_t> counts;
  for (const EngineInfo& engine : plan.engines)
    counts.push_back(affordable(plan, questions, engine, result.failed));
  const std::size_t most = *std::max_element(counts.begin(), counts.end());
  questions.resize(most < kFewestQueries ? 0 : most);
  answer_exactly(questions, Truth::oracle, plan.answerer.listener);
  for (Question& question : questions) question.condition = condition_of(question);
  std::vector<std::size_t> racing;
  for (std::size_t i = 0; i < plan.engines.size(); ++i) {
    report::Cell& cell = result.cells.emplace_back(named_cell(group, scene, plan.engines[i].name));
    if ((cell.skipped = counts[i] < kFewestQueries)) continue;
    const auto answerer = plan.engines[i].answerer(plan.answerer);
    examine_into(cell, *answerer, group, std::span(questions).first(counts[i]));
    if (!cell.skipped && !answerer->failed()) racing.push_back(i);
    answerer->finish();
    result.failed |= answerer->failed();
  }
  result.failed |= race(plan, questions, racing, counts, result.cells);
  return result;
}

}  // namespace lorentz::question
