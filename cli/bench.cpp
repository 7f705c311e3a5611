// lorentz bench: speed and error for all combinations of engines, scenes, radii and difficulties.
#include <algorithm>
#include <cmath>
#include <span>

#include <lorentz/exchange.hpp>
#include <lorentz/margin.hpp>
#include "cli/app.hpp"
#include "cli/examination_options.hpp"
#include "cli/numbers.hpp"
#include "cli/output.hpp"
#include "cli/terminal.hpp"
#include "question/examination.hpp"
#include "question/race.hpp"
#include "question/starts/free_starts.hpp"
#include "report/bench_report.hpp"
#include "report/claim_words.hpp"
#include "report/files/scene_file.hpp"
#include "report/files/whole_file.hpp"
#include "report/manifest.hpp"
#include "report/page.hpp"
#include "report/query_text.hpp"
#include "src/exchange/json_writer.hpp"
#include "src/exchange/nearest_name.hpp"

namespace lorentz::cli {

using namespace question;
using report::Cell;

namespace {

// Fewer queries than this say nothing.
constexpr std::size_t kFewestQueries = 32;
constexpr double kSecondsPerRound = 0.1;  // a slower engine gets fewer queries, or none
constexpr std::size_t kPilot = 16;
constexpr int kRounds = 5;

// What does not depend on the scene.
struct Bench {
  const ExaminationOptions& options;
  const std::vector<EngineInfo>& engines;
  const Claim claim = options.claim.claim();
  const AnswererOptions asking{.timeout = options.longest_wait(), .listener = terminal()};
};

// What the engines claim to answer, with the exact answers.
std::vector<Question> questions_in(const Bench& bench, const Cell& like,
                                   const std::shared_ptr<Place>& place) {
  const starts::Kind kind = like.difficulty == "drawn" ? starts::Kind::uniform
                                                       : starts::kind_named(like.difficulty, "--difficulty");
  std::vector<Question> questions =
      question::questions_of(place, starts::free_starts(place->scene(), kind, bench.options.seed,
                                                        bench.options.count, bench.claim.precision));
  std::erase_if(questions, [&](const Question& one) { return !place->takes(one.query); });
  answer_exactly(questions, bench.asking.listener);
  std::erase_if(questions, [&](const Question& one) { return !place->takes(one.query, one.exact); });
  return questions;
}

// How many of the queries an engine answers in the time of a round, estimated from the first kPilot, or from
// the first two if these already take too long.
std::size_t affordable(const Bench& bench, const std::vector<Question>& all, const EngineInfo& engine,
                       bool& failed) {
  if (all.size() < kFewestQueries) return 0;
  RaceOptions options;
  options.rounds = engine.runs_apart() ? 3 : 1;  // the first round of an external engine includes its start
  options.answerer = bench.asking;
  double count = 0;
  for (const std::size_t pilot : {std::size_t{2}, kPilot}) {
    options.counts = {pilot};
    const Speed t = question::race(all, {engine}, options).front();
    failed |= t.failed;
    // A program that dies is not slow, however busy the machine is; one that is silent would be silent each
    // time.
    if (t.failed && t.ns_per_query * 1e-9 < bench.asking.timeout / 4)
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
                                                                       : judgement.ulps.has_value();
    const double size = rank > 1 ? judgement.departs : ulps;
    if (rank < rank_ || (rank == rank_ && !(size > size_)) || rank == 0) return;
    rank_ = rank, size_ = size, question_ = question;
    worst_ = judgement;
  }

  const std::vector<double>& in_conditions() const { return in_conditions_; }
  const report::Calls& calls() const { return calls_; }

  std::optional<report::Worst> worst(const Cell& cell) const {
    if (rank_ == 0) return std::nullopt;
    report::Worst worst;
    constexpr const char* kVerdicts[] = {"", "agree", "ill-posed", "wrong"};
    worst.verdict = worst_.wrong_time ? "wrong-time" : kVerdicts[rank_];
    worst.ulps = worst_.ulps;
    worst.query = report::hexadecimal_query(question_.query, question_.place->scene());
    worst.command = command_of(cell, worst.query) + shell_quoted(cell.engine);
    return worst;
  }

 private:
  // The command without the engine. A scene whose numbers were rounded is written in full.
  std::string command_of(const Cell& cell, const std::string& query) const {
    const Place& place = *question_.place;
    if (place.claim() == Claim())
      return fmt::format("echo '{}' | lorentz compare --scene {}{} --queries - --engine ", query,
                         shell_quoted(cell.scene),
                         cell.radius ? " --radius " + json::text_of(*cell.radius) : "");
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

// Asks an engine the questions and judges its answers.
void examine_into(Cell& cell, Examination& examination, std::span<const Question> questions, double ulps) {
  ExaminedRow row;
  Errors errors;
  examination.ask(questions, [&](const Judged& judged) {
    row.tally.count(judged.judgement);
    errors.add(judged);
  });
  cell.queries = row.tally.queries;
  cell.counts = row.tally.counts;
  cell.ulps = report::histogram_of(row.tally.ulps);
  if (row.tally[Count::unsupported] == cell.queries) cell.skipped = "unsupported";  // at no speed
  cell.mean_path = mean_path(questions);
  cell.conditions = report::histogram_of(errors.in_conditions());
  cell.calls = errors.calls();
  cell.worst = errors.worst(cell);
  if (cell.worst) cell.worst->command += report::arguments_of({}, ulps);
}

// Times the engines with these numbers, and writes the times into their cells. True if one of them failed.
bool race(const Bench& bench, const std::vector<Question>& questions, const std::vector<std::size_t>& numbers,
          const std::vector<std::size_t>& counts, std::vector<Cell>& cells) {
  RaceOptions options{kRounds, bench.asking};
  std::vector<EngineInfo> engines;
  for (const std::size_t i : numbers)
    engines.push_back(bench.engines[i]), options.counts.push_back(counts[i]);
  const std::vector<Speed> speeds = question::race(questions, engines, options);
  for (std::size_t i = 0; i < speeds.size(); ++i) cells[numbers[i]].speed = speeds[i];
  return std::ranges::any_of(speeds, &Speed::failed);
}

// The cells of all engines over the same queries, in the engines' order. `like`: a cell's scene, radius and
// difficulty. Scenes and queries are rounded to the precision of the claim, by which all are judged. `failed` becomes
// true if an external engine failed.
std::vector<Cell> measured_cells(const Bench& bench, const Cell& like, bool& failed) {
  std::vector<Cell> cells;
  const auto place = std::make_shared<Place>(
      rounded_scene(load_scene(like.scene, like.radius), bench.claim.precision, like.scene), bench.claim);
  std::vector<Question> questions = questions_in(bench, like, place);
  const std::size_t outside = bench.options.count - questions.size();
  const std::string_view why = questions.size() < kFewestQueries ? "outside the domain" : report::kTooSlow;
  std::vector<std::size_t> counts;
  for (const EngineInfo& engine : bench.engines)
    counts.push_back(affordable(bench, questions, engine, failed));
  const std::size_t most = *std::max_element(counts.begin(), counts.end());
  questions.resize(most < kFewestQueries ? 0 : most);
  for (Question& question : questions) question.condition = condition_of(question);
  std::vector<std::size_t> racing;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    Cell& cell = cells.emplace_back(like);
    cell.dimension = place->scene().dimension, cell.engine = bench.engines[i].name, cell.outside = outside;
    if (counts[i] < kFewestQueries) cell.skipped = why;
    if (!cell.skipped.empty()) continue;
    Examination examination(bench.engines[i], bench.asking, bench.options.tolerance());
    examine_into(cell, examination, std::span(questions).first(counts[i]), bench.options.tolerance());
    if (cell.skipped.empty() && !examination.failed()) racing.push_back(i);
    examination.finish();
    failed |= examination.failed();
  }
  failed |= race(bench, questions, racing, counts, cells);
  return cells;
}

// The radii at which a scene is run: the given ones or the defaults. A scene with semiaxes runs at its own
// size.
std::vector<std::optional<std::string>> radii_of(const ExaminationOptions& options,
                                                 const std::string& scene_name) {
  if (!options.radii.empty()) return {options.radii.begin(), options.radii.end()};
  for (const Lattice& lattice : read_scene(scene_name, {}).lattices)
    for (const Atom& atom : lattice.atoms)
      if (!atom.is_ball()) return {std::nullopt};
  return {"0.3", "0.1", "0.01", "0.001", "1e-06"};
}

// What all engines are asked together, as cells without results.
std::vector<Cell> groups_of(const ExaminationOptions& options) {
  std::vector<Cell> groups;
  for (const std::string& difficulty : options.difficulties)
    index_of_name(difficulty, {"drawn", "near-rational", "grazing"}, "--difficulty");
  for (const std::string& scene : options.scenes)
    for (const auto& radius : radii_of(options, scene))
      for (const std::string& difficulty : options.difficulties)
        groups.push_back(
            {.scene = scene, .radius = positive_number(radius, "--radius"), .difficulty = difficulty});
  return groups;
}

int run_bench(ExaminationOptions options) {
  if (options.count < kFewestQueries)
    throw InputError(
        fmt::format("--count: {} queries say nothing; give {} or more", options.count, kFewestQueries));
  const std::vector<EngineInfo> engines = options.named_engines();
  options.claim.ask(engines);
  const std::vector<Cell> groups = groups_of(options);
  if (options.html && !report::has_page()) report::page("");  // throws with the reason
  RequestedFile csv(options.csv), html(options.html);
  const std::string manifest = json::text_of(report::manifest_of(options.seed, command_line()));
  std::vector<Cell> cells;
  const Bench bench{options, engines};
  bool failed = false;
  for (const Cell& group : groups)
    std::ranges::move(measured_cells(bench, group, failed), std::back_inserter(cells));
  const std::string json = report::bench_json(cells, manifest, bench.claim);
  print(options.json
            ? json
            : fmt::format("Speed against error, one thread (seed {}{}).\n\n{}", options.seed,
                          report::words_of(bench.claim), report::bench_text(cells, names_of(engines))));
  csv.write([&] { return report::bench_csv(cells); });
  html.write([&] { return report::page(json); });
  return failed ? kFailed : kDone;
}

}  // namespace

Command bench_command() {
  auto options = std::make_shared<ExaminationOptions>();
  options->engines = {"classical", "published", "reduction", "certified", "oracle"};
  options->scenes = {"square", "cubic"};
  options->difficulties = {"drawn", "near-rational", "grazing"};
  options->count = 2000;
  return {
      "bench", "Speed against error: engines by scenes by radii by difficulty.",
      options->rows({"--engine", "--scene", "--radius", "--difficulty", "--count", "--seed", "--ulps",
                     "--precision", "--time-tolerance", "--timeout", "--json", "--csv", "--html"}),

      "Without --engine: classical, published, reduction, certified and oracle. Without --scene: square and "
      "cubic. Without --radius: 0.3, 0.1, 0.01, 0.001 and 1e-06; scenes with semiaxes at their own size.\n"
      "drawn: uniform starts, isotropic directions.\n"
      "near-rational: directions along small lattice vectors but for ulps to 2^-40.\n"
      "grazing: the first ball is passed or met within r 2^-10 to r 2^-52 of its edge.\nExample:\n"
      "  lorentz bench --scene square --radius 0.1,1e-6 --engine published,reduction --csv speed.csv",
      [options] { return run_bench(*options); }};
}

}  // namespace lorentz::cli
