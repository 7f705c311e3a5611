// lorentz demo: the main task on real input, in a minute. `./run demo` shows it.
#include <cmath>
#include <numbers>

#include <lorentz/exchange.hpp>
#include "cli/app.hpp"
#include "cli/disagreement_file.hpp"
#include "cli/output.hpp"
#include "cli/terminal.hpp"
#include "question/examine.hpp"
#include "question/race.hpp"
#include "report/table.hpp"
#include "starts/free_starts.hpp"

namespace lorentz::cli {

using namespace question;

namespace {

std::vector<Question> questions_of(std::string_view kind, const Scene& scene,
                                   const std::vector<Query>& queries, std::size_t first = 0) {
  const auto place = std::make_shared<Place>(scene);
  std::vector<Question> questions;
  for (const Query& query : queries)
    questions.push_back({.place = place,
                         .query = query,
                         .id = json_quoted(fmt::format("{}/{}", kind, first + questions.size()))});
  return questions;
}

// The example of Kraemer, Kryukov and Sanders: r = 0.1, x = (0, 0.445), directions from 1 to 89 degrees.
std::vector<Question> paper_example() {
  std::vector<Query> queries;
  for (int degrees = 1; degrees < 90; ++degrees) {
    const double angle = degrees * std::numbers::pi / 180;
    queries.push_back({{0, 0.445, 0}, {std::cos(angle), std::sin(angle), 0}, {}});
  }
  return questions_of("paper", unit_scene(2, 0.1), queries, 1);
}

std::vector<Question> drawn(const std::string& name, starts::Kind kind, int dimension, double radius,
                            std::size_t count) {
  const Scene scene = unit_scene(dimension, radius);
  return questions_of(fmt::format("{}-{}d/{}", name, dimension, radius), scene,
                      starts::free_starts(scene, kind, starts::kDefaultSeed, count));
}

class DemoReport {
 public:
  explicit DemoReport(const std::optional<std::string>& disagreements) : disagreements_(disagreements) {}

  void add(const std::string& what, std::vector<Question> questions) {
    disagreements_.begin(questions[0].place);
    answer_exactly(questions, Truth::oracle, terminal());
    const std::vector<EngineInfo> engines = engines_named({"classical", kPublished, "oracle"});
    RaceOptions options;
    options.answerer.listener = terminal();
    const std::vector<Speed> speeds = race(questions, engines, options);
    for (std::size_t i = 0; i < engines.size(); ++i) {
      const Tally t = tally_of(engines[i], questions);
      const auto error = [&](double ulps) { return t.timed_hits ? fmt::format("{:.3g}", ulps) : "-"; };
      std::vector<std::string> row{i == 0 ? what : "", i == 0 ? std::to_string(t.queries) : "",
                                   engines[i].name};
      for (const Count count : kShown) row.push_back(std::to_string(t[count]));
      for (const std::string& cell :
           {error(t.mean_ulp()), error(t.max_ulp()), fmt::format("{:.2f}", speeds[i].ns_per_query / 1000)})
        row.push_back(cell);
      table_.add(row);
      if (engines[i].name == kPublished) published_.add(t);
    }
  }

  void show() {
    disagreements_.close();
    print(table_.text());
    print(fmt::format(
        "\nright, wrong, undecided: the obstacle that each engine says is hit first, against the exact "
        "oracle; ill-posed:\nanother one, but errors of 4 ulps in the inputs would explain it.\n"
        "wrong time: of those right, the times that are off by more than 4 times what an ulp in each input "
        "makes of them.\n"
        "error: of the time of the hits it got right, in units in the last place (ulp) of a binary64.\n"
        "The published algorithm was wrong {} times in {}; docs/published.md says why. To check it:\n"
        "lorentz demo --disagreements FILE writes these {} cases for any program to run again.\n",
        published_[Count::wrong], published_.counts.answers(), published_[Count::wrong]));
  }

 private:
  static constexpr const char* kPublished = "published";
  // As the table's header has them; "right" is what agrees.
  static constexpr Count kShown[] = {Count::agree, Count::ill_posed, Count::wrong, Count::wrong_time,
                                     Count::undecided};

  Tally tally_of(const EngineInfo& engine, const std::vector<Question>& questions) {
    Tally tally;
    examine(all_of(questions), *engine.answerer({}), oracle::kDefaultUlps, [&](const Judged& judged) {
      tally.count(judged.judgement);
      if (engine.name == kPublished && judged.judgement.verdict == oracle::Verdict::wrong)
        disagreements_.add(judged, engine.name);  // counted below
    });
    return tally;
  }

  DisagreementFile disagreements_;
  report::Table table_{{"flights", "number", "engine", "right", "ill-posed", "wrong", "wrong time",
                        "undecided", "mean error", "worst", "us/query"}};
  Tally published_;  // of all flights together
};

int act(const std::optional<std::string>& disagreements) {
  print(fmt::format(
      "Which obstacle does the particle hit first? Two known algorithms against exact arithmetic (seed "
      "{}).\n\n",
      starts::kDefaultSeed));
  DemoReport report(disagreements);
  report.add("the paper's example, r = 0.1", paper_example());
  using starts::Kind;
  for (const double r : {0.3, 0.1, 1e-2, 1e-3})
    report.add(fmt::format("2D, drawn, r = {}", r), drawn("drawn", Kind::uniform, 2, r, 5000));
  for (const double r : {0.3, 0.2, 0.1})  // on these flights the published algorithm skips discs
    report.add(fmt::format("2D, leaving a disc, r = {}", r), drawn("leaving", Kind::surface, 2, r, 20000));
  for (const double r : {0.3, 0.1, 1e-2})
    report.add(fmt::format("3D, drawn, r = {}", r), drawn("drawn", Kind::uniform, 3, r, 5000));
  report.add("3D, drawn, r = 0.001", drawn("drawn", Kind::uniform, 3, 1e-3, 100));
  report.show();
  return kDone;
}

}  // namespace

Command demo_command() {
  auto disagreements = std::make_shared<std::optional<std::string>>();
  return {
      "demo",
      "The known algorithms against the oracle, on the paper's example and on drawn queries.",
      {
          {"--disagreements", disagreements.get(), "FILE", "write each wrong answer there, as a query stream",
           kOutput},
      },

      "Exits with 0 when all was done: the wrong answers of the known algorithms are what it shows.\n"
      "Example:\n  lorentz demo --disagreements wrong.ndjson && lorentz compare --queries wrong.ndjson -e "
      "classical",
      [disagreements] { return act(*disagreements); }};
}

}  // namespace lorentz::cli
