// lorentz survival: how many collisions are right in arithmetic with a given number of bits.
#include <algorithm>
#include <cmath>

#include <lorentz/exchange.hpp>
#include <lorentz/itinerary.hpp>
#include "cli/app.hpp"
#include "cli/exit_status.hpp"
#include "cli/interrupt.hpp"
#include "cli/numbers.hpp"
#include "cli/output.hpp"
#include "cli/progress.hpp"
#include "cli/trajectory_rival.hpp"
#include "files/scene_file.hpp"
#include "files/whole_file.hpp"
#include "pictures/free_path_plot.hpp"
#include "question/engines.hpp"
#include "report/curves.hpp"
#include "report/manifest.hpp"
#include "report/page.hpp"
#include "report/table.hpp"
#include "src/exchange/json_writer.hpp"
#include "starts/free_starts.hpp"

namespace lorentz::cli {
namespace {

using oracle::CertifiedCollision;
using oracle::Itinerary;

struct SurvivalOptions {
  std::string scene = "square", engine = "reduction";
  std::uint64_t count = 100, collisions = 500, seed = starts::kDefaultSeed;
  std::vector<std::string> bits{"53,106,128,256"};
  std::optional<double> radius;
  std::optional<std::string> csv, svg, html;
  bool json = false;
};

/// Arithmetic of so many bits: 53 and 106 are an engine's trajectory in binary64 and double-double, others
/// the plain one of RoundedItinerary.
struct Arithmetic {
  long bits;
  std::vector<std::uint64_t> right{};  ///< of each start: collisions before the first wrong one

  std::string name(const std::string& engine) const {
    if (bits == 53) return engine + ", binary64";
    if (bits == 106) return engine + ", double-double";
    return fmt::format("{} bits", bits);
  }
  double mean() const {
    double sum = 0;
    for (const std::uint64_t collisions : right) sum += static_cast<double>(collisions);
    return sum / static_cast<double>(right.size());
  }
  /// The share of starts with at least k right collisions.
  double share(std::uint64_t k) const {
    const auto lasting = std::count_if(right.begin(), right.end(), [k](std::uint64_t n) { return n >= k; });
    return static_cast<double>(lasting) / static_cast<double>(right.size());
  }
};

// One start in one arithmetic, as long as it is right.
class Runner {
 public:
  Runner(const Arithmetic& arithmetic, const question::EngineInfo& engine, const RationalScene& scene,
         const Start& start) {
    if (arithmetic.bits == 53 || arithmetic.bits == 106)
      rival_ = std::make_unique<Rival>(
          engine, arithmetic.bits == 53 ? Precision::binary64 : Precision::double_double, scene, start);
    else
      rounded_ = std::make_unique<oracle::RoundedItinerary>(scene, start, arithmetic.bits);
  }

  /// False from the first wrong obstacle on.
  bool meet(const CertifiedCollision& truth) {
    if (!is_right_) return false;
    if (rival_) rival_->meet(truth);
    is_right_ = rival_ ? !rival_->diverged() : rounded_->next() == truth.obstacle;
    right_ += is_right_;
    return is_right_;
  }
  std::uint64_t right() const { return right_; }

 private:
  std::unique_ptr<Rival> rival_;
  std::unique_ptr<oracle::RoundedItinerary> rounded_;
  bool is_right_ = true;
  std::uint64_t right_ = 0;
};

struct Survival {
  std::string scene;
  question::EngineInfo engine;
  std::optional<double> radius;
  std::uint64_t seed = 0, collisions = 0;
  std::vector<Arithmetic> arithmetics;

  std::string table() const;
  std::string json() const;
  std::string csv() const;
  std::string svg() const;
  std::string page_json() const;
  /// Up to where a share is shown: its first 0, or the last collision that was looked at.
  std::uint64_t last_of(const Arithmetic& one) const {
    return std::min(collisions, *std::max_element(one.right.begin(), one.right.end()) + 1);
  }
};

std::string Survival::table() const {
  std::string text = fmt::format("right collisions from {} starts (of {} at most)\n\n",
                                 arithmetics[0].right.size(), collisions);
  text += fmt::format("{:<28} {:>8} {:>8} {:>8}\n", "arithmetic", "mean", "least", "most");
  for (const Arithmetic& one : arithmetics) {
    const auto [least, most] = std::minmax_element(one.right.begin(), one.right.end());
    text += fmt::format("{:<28} {:>8.2f} {:>8} {:>8}\n", one.name(engine.name), one.mean(), *least, *most);
  }
  const bool is_cut = std::any_of(arithmetics.begin(), arithmetics.end(),
                                  [&](const Arithmetic& one) { return one.share(collisions) > 0; });
  if (is_cut)
    text += fmt::format("some starts were right to the end, {} collisions: there the mean is too small\n",
                        collisions);
  return text;
}

std::string Survival::json() const {
  return json::line_of([&](json::Members& object) {
    object.add("scene", scene, "engine", engine.name, "seed", seed, "count", arithmetics[0].right.size(),
               "arithmetics",
               json::objects(arithmetics, [](json::Members& one, const Arithmetic& arithmetic) {
                 one.add("bits", arithmetic.bits, "mean", json::Raw{fmt::format("{:.6g}", arithmetic.mean())},
                         "right", arithmetic.right);
               }));
  });
}

std::string Survival::csv() const {
  std::string text = "collision";
  for (const Arithmetic& one : arithmetics) text += fmt::format(",bits{}", one.bits);
  text += '\n';
  std::uint64_t last = 0;
  for (const Arithmetic& one : arithmetics) last = std::max(last, last_of(one));
  for (std::uint64_t k = 1; k <= last; ++k) {
    text += std::to_string(k);
    for (const Arithmetic& one : arithmetics) text += fmt::format(",{}", one.share(k));
    text += '\n';
  }
  return text;
}

std::string Survival::svg() const {
  pictures::FreePathPlot plot;
  plot.title = fmt::format("trajectories that are still right: {}", scene);
  plot.axes = pictures::AxisScale::linear;
  plot.t_label = "collisions";
  plot.value_label = "share of starts";
  for (const Arithmetic& one : arithmetics) {
    pictures::PlotSeries series{one.name(engine.name), {}};
    for (std::uint64_t k = 1; k <= last_of(one); ++k)
      series.points.push_back({static_cast<double>(k), one.share(k), 0});
    plot.series.push_back(std::move(series));
  }
  return pictures::draw_free_paths(plot);
}

// The report of a page (docs/page.md), of kind "survival".
std::string Survival::page_json() const {
  const std::size_t starts = arithmetics[0].right.size();
  std::vector<report::SurvivalCurve> curves;
  std::string line = fmt::format("{} starts; right collisions, the mean:", starts);
  for (const Arithmetic& one : arithmetics) {
    report::SurvivalCurve curve{scene, one.name(engine.name), radius, {}};
    for (std::uint64_t k = 1; k <= last_of(one); ++k) {
      const double share = one.share(k);
      const auto right = static_cast<std::size_t>(std::llround(share * static_cast<double>(starts)));
      curve.points.push_back({k, share, report::share_of(right, starts)});
    }
    line +=
        fmt::format("{} {:.3g} in {}", &one == &arithmetics[0] ? "" : ",", one.mean(), one.name(engine.name));
    curves.push_back(std::move(curve));
  }
  return json::line_of([&](json::Members& page) {
    page.add("format", 1, "kind", "survival", "title", "How long trajectories stay right: " + scene, "line",
             line, "manifest", report::manifest_of(seed, command_line()), "survival", curves);
  });
}

Start start_of(const Query& query) {
  Start start;
  for (int i = 0; i < 3; ++i) start.x[i] = query.x[i], start.v[i] = Surd(Rational(query.v[i]));
  start.from = query.from;
  return start;
}

void follow(const RationalScene& scene, const Start& start, Survival& survival) {
  std::vector<Runner> runners;
  for (const Arithmetic& one : survival.arithmetics) runners.emplace_back(one, survival.engine, scene, start);
  oracle::Journey journey;
  journey.collisions = survival.collisions;
  journey.stop = &Interrupt::came();
  Itinerary(scene).follow(start, journey, [&](const CertifiedCollision& truth) {
    bool any = false;
    for (Runner& runner : runners) any |= runner.meet(truth);
    return any;
  });
  if (Interrupt::came()) return;  // the last start is not whole
  for (std::size_t i = 0; i < runners.size(); ++i)
    survival.arithmetics[i].right.push_back(runners[i].right());
}

std::vector<Arithmetic> arithmetics_of(const SurvivalOptions& options) {
  std::vector<Arithmetic> all;
  for (const std::string& name : question::names_in(options.bits))
    all.push_back({static_cast<long>(whole_number(name, "--bits", 24, 100'000))});
  return all;
}

int act(const SurvivalOptions& options) {
  if (options.html && !report::has_page()) report::page("");  // says why
  const question::EngineInfo engine = question::engine_named(options.engine);
  if (!engine.is_own())
    throw InputError(
        "--engine: survival is of engines of this program (lorentz trajectory --engine takes others)");
  const Scene scene = load_crystal(options.scene, options.radius, "right collisions are counted");
  Survival survival;
  survival.scene = options.scene;
  survival.radius = options.radius;
  survival.engine = engine;
  survival.seed = options.seed;
  survival.collisions = options.collisions;
  survival.arithmetics = arithmetics_of(options);
  const starts::FreeStarts starts(scene, starts::Kind::surface, survival.seed);
  const RationalScene exact = rational(scene);
  RequestedFile csv(options.csv), svg(options.svg), html(options.html);
  const Interrupt interrupt;
  Progress progress("following", options.count, 1);
  for (std::uint64_t i = 0; i < options.count && !Interrupt::came(); ++i, progress.at(i))
    follow(exact, start_of(starts[i]), survival);
  if (Interrupt::came())
    say("{}: after {} of {} starts", Interrupt::what(), survival.arithmetics[0].right.size(), options.count);
  if (survival.arithmetics[0].right.empty()) return kFailed;
  print(options.json ? survival.json() : survival.table());
  csv.write([&] { return survival.csv(); });
  svg.write([&] { return survival.svg(); });
  html.write([&] { return report::page(survival.page_json()); });
  return Interrupt::came() ? kFailed : kDone;
}

}  // namespace

Command survival_command() {
  auto options = std::make_shared<SurvivalOptions>();
  return {"survival",
          "How many collisions of a trajectory are right, in binary64 and in more bits.",
          {
              {"--scene", &options->scene, "SCENE", "a file, or a name of the catalogue"},
              {"--radius", Positive{&options->radius}, "R", "radius of every ball"},
              {"-e,--engine", &options->engine, "ENGINE",
               "whose flights binary64 and double-double have: one of " + question::names_for_help()},
              {"--bits", &options->bits, "LIST",
               "arithmetics: 53 is the engine in binary64, 106 in double-double, any other number plain "
               "arithmetic of that many bits"},
              {"--count", Whole{&options->count, 1, 10'000'000}, "N",
               "starts, off the surface of an obstacle (cosine law)"},
              {"--collisions", Whole{&options->collisions, 1, 1'000'000}, "N", "at most N of each start"},
              {"--seed", Whole{&options->seed}, "N", "of the starts"},
              {"--csv", &options->csv, "FILE",
               "shares of starts that are right after k collisions, to a file", kOutput},
              {"--svg", &options->svg, "FILE", "the same as a picture", kOutput},
              {"--html", &options->html, "FILE",
               "a page that opens offline: the same with 95 % bounds, and its numbers", kOutput},
              {"--json", &options->json, "", "one JSON object instead of a table"},
          },

          "Each start is followed with certainty (lorentz trajectory), and each arithmetic until it hits "
          "another\n"
          "obstacle. docs/itineraries.md has figures.\n"
          "Example:\n  lorentz survival --scene square --radius 0.1 --count 1000 --svg survival.svg",
          [options] { return act(*options); }};
}

}  // namespace lorentz::cli
