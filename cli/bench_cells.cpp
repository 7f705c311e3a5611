#include "cli/bench_cells.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <lorentz/margin.hpp>
#include "cli/messages.hpp"
#include "cli/numbers.hpp"
#include "cli/scene_option.hpp"
#include "cli/terminal.hpp"
#include "compare/measure.hpp"
#include "report/query_text.hpp"

namespace lorentz::cli {

using namespace compare;

namespace {

constexpr double kSecondsPerRound = 0.1;  // an engine that would take longer does fewer queries, or none
constexpr std::size_t kPilot = 16;
constexpr int kRounds = 5;

CaseSet cases_of(const BenchPlan& plan, const BenchGroup& group) {
  CaseSet set;
  set.scenes.push_back(load_scene(group.scene, positive_number(group.radius, "--radius")));
  const Scene& scene = set.scenes[0];
  const oracle::Oracle oracle(scene);
  for (const Query& query : hard_queries(group.difficulty, scene, oracle, plan.seed, plan.count, terminal()))
    set.cases.push_back({std::to_string(set.cases.size()), 0, query});
  return set;
}

// How many of the queries an engine does in the time of a round; by the first few, or the first two if these
// take so long that there is no hope.
std::size_t affordable(const BenchPlan& plan, const CaseSet& all, const EngineInfo& engine, bool& failed) {
  MeasureOptions options;
  options.rounds = engine.is_command() ? 3 : 1;  // the first round of another program has its start in it
  options.timeout = plan.timeout;
  options.listener = terminal();
  double count = 0;
  for (const std::size_t pilot : {std::size_t{2}, kPilot}) {
    options.counts = {pilot};
    const Tally t = measure(all, {}, {engine}, {}, options).front();
    failed |= t.failed;
    // A program that dies is not slow, however busy the machine is; one that is silent would be so each time.
    if (t.failed && t.ns_per_query * 1e-9 < plan.timeout / 4)
      return std::min(all.cases.size(), kFewestQueries);
    count = kSecondsPerRound * 1e9 / std::max(t.ns_per_query, 1.0);
    if (count < kFewestQueries / 8.0) break;
  }
  return std::min(all.cases.size(), static_cast<std::size_t>(count));
}

// What one ulp in each input makes of the time, in its ulps; 0 where there is none.
std::vector<double> conditions_of(const CaseSet& set, const std::vector<Answer>& exact) {
  const oracle::Margins margins(set.scenes[0]);
  std::vector<double> conditions(exact.size());
  for (std::size_t i = 0; i < exact.size(); ++i)
    if (exact[i].outcome == Outcome::hit && exact[i].time)
      conditions[i] = margins.condition(set.cases[i].query, exact[i]);
  return conditions;
}

// The mean length of the flights that hit: what a time is to be divided by for one a length, or a cell.
double mean_path(const std::vector<Answer>& exact, std::size_t count) {
  double sum = 0;
  std::size_t hits = 0;
  for (std::size_t i = 0; i < count; ++i)
    if (exact[i].outcome == Outcome::hit) sum += exact[i].time.value_or(0), ++hits;
  return hits > 0 ? sum / static_cast<double>(hits) : 0;
}

// Of the answers of one engine what a tally does not keep.
class Errors {
 public:
  void add(std::size_t index, const oracle::Judgement& judgement, double condition) {
    const double ulps = judgement.ulps.value_or(0);
    if (judgement.ulps && condition > 0 && std::isfinite(ulps / condition))
      in_conditions_.push_back(ulps / condition);
    const int rank = judgement.verdict == oracle::Verdict::wrong       ? 3
                     : judgement.verdict == oracle::Verdict::ill_posed ? 2
                     : judgement.ulps                                  ? 1
                                                                       : 0;
    const double size = rank > 1 ? judgement.departs : ulps;
    if (rank < rank_ || (rank == rank_ && !(size > size_)) || rank == 0) return;
    rank_ = rank, size_ = size, index_ = index;
    worst_ = judgement;
  }

  const std::vector<double>& in_conditions() const { return in_conditions_; }

  std::optional<report::Worst> worst(const BenchGroup& group, const std::string& engine,
                                     const CaseSet& set) const {
    if (rank_ == 0) return std::nullopt;
    report::Worst worst;
    worst.verdict = rank_ == 3          ? "wrong"
                    : rank_ == 2        ? "ill-posed"
                    : worst_.wrong_time ? "wrong-time"
                                        : "agree";
    worst.ulps = worst_.ulps;
    worst.query = report::hexadecimal_query(set.cases[index_].query, set.scenes[0].dimension);
    worst.command =
        fmt::format("echo '{}' | lorentz compare --scene {}{} --queries - --engine {}", worst.query,
                    shell_quoted(group.scene), group.radius ? " --radius " + shell_quoted(*group.radius) : "",
                    shell_quoted(engine));
    return worst;
  }

 private:
  std::vector<double> in_conditions_;
  int rank_ = 0;  // of the worst so far: 0 none, 1 right, 2 ill-posed, 3 wrong
  double size_ = -1;
  std::size_t index_ = 0;
  oracle::Judgement worst_;
};

report::Cell named_cell(const BenchGroup& group, const CaseSet& set, const std::string& engine) {
  report::Cell cell;
  cell.scene = group.scene;
  cell.radius = positive_number(group.radius, "--radius");
  cell.dimension = set.scenes[0].dimension;
  cell.difficulty = name_of(group.difficulty);
  cell.engine = engine;
  return cell;
}

void fill(report::Cell& cell, const Tally& t) {
  cell.queries = t.queries;
  cell.ns = {t.ns_median, t.ns_low, t.ns_high, t.ns_per_query};
  cell.instructions = t.instructions;
  cell.undecided = report::share_of(t.undecided, t.queries);
  cell.ill_posed = report::share_of(t.ill_posed, t.queries);
  cell.wrong = report::share_of(t.wrong, t.queries);
  cell.wrong_time = report::share_of(t.wrong_time, t.queries);
  cell.unsupported = t.unsupported;
  cell.error = t.error;
  cell.missing = t.missing;
  cell.ulps = report::histogram_of(t.ulps);
}

}  // namespace

BenchCells measure_cells(const BenchPlan& plan, const BenchGroup& group) {
  BenchCells result;
  CaseSet set = cases_of(plan, group);
  MeasureOptions options;
  options.rounds = kRounds;
  options.timeout = plan.timeout;
  options.listener = terminal();
  std::vector<EngineInfo> fast;  // those that are not skipped
  for (const EngineInfo& engine : plan.engines) {
    const std::size_t count = affordable(plan, set, engine, result.failed);
    if (count < kFewestQueries) continue;
    fast.push_back(engine);
    options.counts.push_back(count);
  }
  set.cases.resize(fast.empty() ? 0 : *std::max_element(options.counts.begin(), options.counts.end()));
  const std::vector<Answer> exact = exact_answers(set, terminal());
  const std::vector<double> conditions = conditions_of(set, exact);
  std::vector<Errors> errors(fast.size());
  options.on_judged = [&](std::size_t entrant, std::size_t index, const oracle::Judgement& judgement) {
    errors[entrant].add(index, judgement, conditions[index]);
  };
  const std::vector<Tally> tallies = measure(set, exact, fast, {}, options);
  std::size_t next = 0;
  for (const EngineInfo& engine : plan.engines) {
    report::Cell& cell = result.cells.emplace_back(named_cell(group, set, engine.name));
    cell.skipped = next == fast.size() || fast[next].name != engine.name;
    if (cell.skipped) continue;
    result.failed |= tallies[next].failed;
    fill(cell, tallies[next]);
    cell.skipped = cell.unsupported == cell.queries;  // how fast it says so is nobody's question
    cell.mean_path = mean_path(exact, options.counts[next]);
    cell.conditions = report::histogram_of(errors[next].in_conditions());
    cell.worst = errors[next].worst(group, engine.name, set);
    ++next;
  }
  return result;
}

}  // namespace lorentz::cli
