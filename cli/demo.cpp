// lorentz demo: the main task on real input, in a minute. `./run demo` shows it.
#include <cmath>
#include <numbers>

#include <lorentz/exchange.hpp>
#include "cli/app.hpp"
#include "cli/lineup.hpp"
#include "cli/output.hpp"
#include "cli/terminal.hpp"
#include "question/examine.hpp"
#include "question/starts/free_starts.hpp"
#include "report/table.hpp"

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

constexpr const char* kPublished = "published";

ExaminationOptions options_for(const std::optional<std::string>& disagreements) {
  ExaminationOptions options;
  options.engines = {"classical", kPublished, "oracle"};
  options.disagreements = disagreements;
  return options;
}

class DemoReport {
 public:
  explicit DemoReport(const std::optional<std::string>& disagreements)
      : options_(options_for(disagreements)), lineup_(options_, options_.named_engines()) {}

  void add(const std::string& what, std::vector<Question> questions) {
    answer_exactly(questions, terminal());
    lineup_.begin(what);
    const AskedPart part{std::move(questions)};
    lineup_.ask(part);
    lineup_.race(part.questions);
    for (const LineupEntry& one : lineup_.all()) {
      const Tally& t = one.row->tally;
      const bool is_first = &one == &lineup_.all().front();
      const auto error = [&](double ulps) { return t.timed_hits ? fmt::format("{:.3g}", ulps) : "-"; };
      std::vector<std::string> row{is_first ? what : "", is_first ? std::to_string(t.queries) : "",
                                   one.examination.name()};
      for (const Count count : kShown) row.push_back(std::to_string(t[count]));
      for (const std::string& cell :
           {error(t.mean_ulp()), error(t.max_ulp()), fmt::format("{:.2f}", one.speed.ns_per_query / 1000)})
        row.push_back(cell);
      table_.add(row);
    }
  }

  void show() {
    lineup_.finish();
    std::size_t departing = 0;
    Tally published;
    for (const LineupEntry& one : lineup_.all()) {
      const Tally t = one.total();
      departing += t.counts.sum({Count::wrong, Count::ill_posed});
      if (t.name == kPublished) published = t;
    }
    print(table_.text());
    print(fmt::format(
        "\nright, wrong, undecided: the obstacle that each engine says is hit first, against the exact "
        "oracle; ill-posed:\nanother one, but errors of 4 ulps in the inputs would explain it.\n"
        "wrong time: of those right, the times that are off by more than 4 times what an ulp in each input "
        "makes of them.\nerror: of the time of the hits it got right, in units in the last place (ulp) of a "
        "binary64.\nThe published algorithm was wrong {} times in {}; docs/published.md says why. To check "
        "it:\nlorentz demo --disagreements FILE writes the {} wrong or ill-posed answers for any program to "
        "run again.\n",
        published[Count::wrong], published.counts.answers(), departing));
  }

 private:
  // As the table's header has them; "right" is what agrees.
  static constexpr Count kShown[] = {Count::agree, Count::ill_posed, Count::wrong, Count::wrong_time,
                                     Count::undecided};

  const ExaminationOptions options_;
  Lineup lineup_;
  report::Table table_{{"flights", "number", "engine", "right", "ill-posed", "wrong", "wrong time",
                        "undecided", "mean error", "worst", "us/query"}};
};

int run_demo(const std::optional<std::string>& disagreements) {
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
  auto options = std::make_shared<ExaminationOptions>();
  return {
      "demo", "The known algorithms against the oracle, on the paper's example and on drawn queries.",
      options->rows({"--disagreements"}),

      "Exits with 0 when all was done: the wrong answers of the known algorithms are what it shows.\n"
      "Example:\n  lorentz demo --disagreements wrong.ndjson && lorentz compare --queries wrong.ndjson -e "
      "classical",
      [options] { return run_demo(options->disagreements); }};
}

}  // namespace lorentz::cli
