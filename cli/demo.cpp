// lorentz demo: the main job on real input, in a minute. What `./run demo` shows.
#include <cmath>
#include <numbers>

#include <lorentz/exchange.hpp>
#include "cli/app.hpp"
#include "cli/disagreement_file.hpp"
#include "cli/exit_status.hpp"
#include "cli/messages.hpp"
#include "cli/table.hpp"
#include "cli/terminal.hpp"
#include "compare/measure.hpp"
#include "compare/sampling.hpp"

namespace lorentz::cli {

using namespace compare;

namespace {

// The example of Kraemer, Kryukov and Sanders: r = 0.1, x = (0, 0.445), directions of 1 to 89 degrees.
CaseSet paper_example() {
  CaseSet set;
  set.scenes.push_back(unit_scene(2, 0.1));
  for (int degrees = 1; degrees < 90; ++degrees) {
    const double angle = degrees * std::numbers::pi / 180;
    set.cases.push_back({json_quoted(fmt::format("paper/{}", degrees)),
                         0,
                         {{0, 0.445, 0}, {std::cos(angle), std::sin(angle), 0}, {}}});
  }
  return set;
}

CaseSet set_of(std::string_view kind, int dimension, double radius, const std::vector<Query>& queries) {
  CaseSet set;
  set.scenes.push_back(unit_scene(dimension, radius));
  for (std::size_t i = 0; i < queries.size(); ++i)
    set.cases.push_back(
        {json_quoted(fmt::format("{}-{}d/{}/{}", kind, dimension, radius, i)), 0, queries[i]});
  return set;
}

// Where the published algorithm skips discs.
CaseSet leaving_flights(int dimension, double radius, std::size_t count) {
  return set_of("leaving", dimension, radius,
                draw_leaving_queries(dimension, radius, kDefaultSeed + 1, count));
}

CaseSet drawn(int dimension, double radius, std::size_t count) {
  const Scene scene = unit_scene(dimension, radius);
  return set_of("drawn", dimension, radius,
                draw_queries(scene, oracle::Oracle(scene), kDefaultSeed, count, terminal()));
}

class Report {
 public:
  explicit Report(const std::optional<std::string>& disagreements) : disagreements_(disagreements) {}

  void add(const std::string& what, const CaseSet& set) {
    disagreements_.begin(set);
    const OnWrong on_wrong = [&](const Case& one, const Answer& exact, const std::string& name,
                                 const Answer& given, const oracle::Judgement& judgement) {
      if (name == kPublished && judgement.verdict == oracle::Verdict::wrong)  // those that are counted below
        disagreements_.add(one, exact, name, given, judgement);
    };
    MeasureOptions options;
    options.listener = terminal();
    const auto tallies = measure(set, exact_answers(set, terminal()),
                                 engines_named({"classical", kPublished, "oracle"}), on_wrong, options);
    for (const Tally& t : tallies) {
      const bool is_first = &t == &tallies.front();
      table_.add({is_first ? what : "", is_first ? std::to_string(t.queries) : "", t.name,
                  std::to_string(t.agree), std::to_string(t.ill_posed), std::to_string(t.wrong),
                  std::to_string(t.wrong_time), std::to_string(t.undecided),
                  t.timed_hits ? fmt::format("{:.3g}", t.mean_ulp()) : "-",
                  t.timed_hits ? fmt::format("{:.3g}", t.max_ulp) : "-",
                  fmt::format("{:.2f}", t.ns_per_query / 1000)});
    }
    published_.add(tallies[1]);
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
        "The published algorithm was wrong {} times in {}; docs/published.md says why. Nobody has to believe "
        "it:\n"
        "lorentz demo --disagreements FILE writes these {} cases, to be run again by any program.\n",
        published_.wrong, published_.agree + published_.ill_posed + published_.wrong, published_.wrong));
  }

 private:
  static constexpr const char* kPublished = "published";

  DisagreementFile disagreements_;
  Table table_{{"flights", "number", "engine", "right", "ill-posed", "wrong", "wrong time", "undecided",
                "mean error", "worst", "us/query"}};
  Tally published_;  // of all flights together
};

int act(const std::optional<std::string>& disagreements) {
  print(fmt::format(
      "Which obstacle does the particle hit first? Two known algorithms against exact arithmetic (seed "
      "{}).\n\n",
      kDefaultSeed));
  Report report(disagreements);
  report.add("the paper's example, r = 0.1", paper_example());
  for (const double r : {0.3, 0.1, 1e-2, 1e-3})
    report.add(fmt::format("2D, drawn, r = {}", r), drawn(2, r, 5000));
  for (const double r : {0.3, 0.2, 0.1})
    report.add(fmt::format("2D, leaving a disc, r = {}", r), leaving_flights(2, r, 20000));
  for (const double r : {0.3, 0.1, 1e-2}) report.add(fmt::format("3D, drawn, r = {}", r), drawn(3, r, 5000));
  report.add("3D, drawn, r = 0.001", drawn(3, 1e-3, 100));
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
