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

// The example of Kraemer, Kryukov and Sanders: r = 0.1, x = (0, 0.445), directions from 1 to 89 degrees.
std::vector<Question> paper_example() {
  std::vector<Query> queries;
  for (int degrees = 1; degrees < 90; ++degrees) {
    const double angle = degrees * std::numbers::pi / 180;
    queries.push_back({{0, 0.445, 0}, {std::cos(angle), std::sin(angle), 0}, {}});
  }
  return questions_of(std::make_shared<Place>(unit_scene(2, 0.1)), queries);
}

std::vector<Question> drawn(starts::Kind kind, int dimension, double radius, std::size_t count) {
  const Scene scene = unit_scene(dimension, radius);
  return questions_of(std::make_shared<Place>(scene),
                      starts::free_starts(scene, kind, starts::kDefaultSeed, count));
}

std::string microseconds(double ns) {
  return fmt::format("{:.{}f}", ns / 1000, ns < 1e5 ? 2 : 0);
}

// Each answer is in one of the columns from "right" to "undecided".
std::vector<std::string> row(const std::string& engine, const Tally& t, const std::string& plane,
                             const std::string& space) {
  std::vector<std::string> cells{engine};
  for (const std::size_t number : {t[Count::agree] - t[Count::wrong_time], t[Count::wrong_time],
                                   t[Count::ill_posed], t[Count::wrong], t[Count::undecided]})
    cells.push_back(std::to_string(number));
  cells.push_back(t.ulps.empty() ? "-" : fmt::format("{:.3g}", t.mean_ulp()));
  cells.insert(cells.end(), {plane, space});
  return cells;
}

constexpr const char* kWords = R"(
right: obstacle and time. wrong time: of the right obstacle, off by more than 4 times what an ulp in each input
makes of it. ill-posed: another obstacle, but errors of 4 ulps in the inputs would explain it. Why the published
algorithm is wrong: docs/published.md. To go on:
  lorentz judge --engine published         judges an engine, in two minutes; yours: docs/judging_yours.md
  lorentz first-hit --scene square --radius 0.1 --x 0,0.445 --v 1,0.0175                one exact answer
  lorentz trajectory --scene square --radius 1/5 --x 1/2,1/3 --v 1,golden --collisions 15 -e reduction --svg path.svg
                                           a certified path, and where binary64 leaves it, drawn
)";

class DemoReport {
 public:
  void add(const std::string& what, std::vector<Question> questions) {
    const int dimension = questions.front().place->scene().dimension;
    answer_exactly(questions, terminal());
    lineup_.begin(what);
    const AskedPart part{std::move(questions)};
    lineup_.ask(part);
    lineup_.race(part.questions);
    for (const LineupEntry& one : lineup_.all()) {
      const double ns = one.speed.ns_per_query * static_cast<double>(one.row->tally.queries);
      for (const int of : {dimension, 0}) ns_[one.examination.name()][of] += ns;
    }
    for (const int of : {dimension, 0}) queries_[of] += static_cast<double>(part.questions.size());
  }

  void show() {
    lineup_.finish();
    print(fmt::format(
        "The published algorithm gets {} of {} first hits wrong ({} us each), the exact oracle {} ({} us), "
        "certified-batch {} ({} us).\n\n",
        wrong_of("published"), queries_[0], mean("published"), wrong_of("oracle"), mean("oracle"),
        wrong_of("certified-batch"), mean("certified-batch")));
    report::Table engines({"engine", "right", "wrong time", "ill-posed", "wrong obstacle", "undecided",
                           "mean error, ulps", "2D, us each", "3D, us each"});
    for (const LineupEntry& one : lineup_.all()) {
      const std::string& engine = one.examination.name();
      engines.add(row(engine, one.total(), mean(engine, 2), mean(engine, 3)));
    }
    print(engines.text() + kWords);
  }

 private:
  std::string wrong_of(const std::string& engine) const {
    for (const LineupEntry& one : lineup_.all())
      if (one.examination.name() == engine && one.total()[Count::wrong] > 0)
        return std::to_string(one.total()[Count::wrong]);
    return "none";
  }

  std::string mean(const std::string& engine, int dimension = 0) {
    return microseconds(ns_[engine][dimension] / queries_[dimension]);
  }

  const ExaminationOptions options_{
      .engines = {"classical", "published", "reduction", "certified", "certified-batch", "oracle"}};
  Lineup lineup_{options_, options_.named_engines()};
  std::map<std::string, std::map<int, double>> ns_;  // by engine and dimension; of both: 0
  std::map<int, double> queries_;
};

int run_demo() {
  DemoReport report;
  report.add("the paper's example, r = 0.1", paper_example());
  using enum starts::Kind;
  for (const double r : {0.3, 0.1, 1e-2, 1e-3})
    report.add(fmt::format("2D, drawn, r = {}", r), drawn(uniform, 2, r, 5000));
  for (const double r : {0.3, 0.2, 0.1})  // on these flights the published algorithm skips discs
    report.add(fmt::format("2D, leaving a disc, r = {}", r), drawn(surface, 2, r, 20000));
  for (const double r : {0.3, 0.1, 1e-2})
    report.add(fmt::format("3D, drawn, r = {}", r), drawn(uniform, 3, r, 5000));
  report.add("3D, drawn, r = 0.001", drawn(uniform, 3, 1e-3, 100));
  report.show();
  return kDone;
}

}  // namespace

Command demo_command() {
  return {"demo",
          "The known algorithms against the oracle, on the paper's example and on drawn queries.",
          {},
          "Exits with 0 when all was done: the wrong answers of the known algorithms are what it shows.\n"
          "Example:\n  lorentz demo",
          run_demo};
}

}  // namespace lorentz::cli
