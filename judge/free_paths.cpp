#include "judge/free_paths.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "files/scene_file.hpp"
#include "statistics/theory/laws.hpp"

namespace lorentz::judge {
namespace {

struct Where {
  const char* scene;
  double radius;
};
constexpr Where kWhere[] = {{"square", 0.1}, {"square", 0.01}, {"cubic", 0.1}};
constexpr std::size_t kFlights = 30'000;  // in all

// How far a particle gets according to an answer; nothing if the answer does not say.
std::optional<double> path_of(const Answer& answer) {
  if (answer.outcome == Outcome::hit) return answer.time;
  if (answer.outcome == Outcome::never) return std::numeric_limits<double>::infinity();
  if (answer.outcome == Outcome::inside) return 0;
  return std::nullopt;
}

double share_longer(const std::vector<double>& sorted, double t) {
  const auto longer = sorted.end() - std::upper_bound(sorted.begin(), sorted.end(), t);
  return static_cast<double>(longer) / static_cast<double>(sorted.size());
}

std::vector<double> sorted(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values;
}

}  // namespace

void FreePaths::add(const Question& question, const Answer& given) {
  const auto path = path_of(given), exact = path_of(question.exact);
  if (!path || std::isnan(*path) || !exact) return;
  // Rounding must not carry a path across a point of the curve.
  constexpr double kSame = 0x1p-30;
  given_.push_back(std::fabs(*path - *exact) <= kSame * *exact ? *exact : *path);
  exact_.push_back(*exact);
}

double FreePaths::mean_of(const std::vector<double>& paths) {
  double sum = 0, hits = 0;
  for (const double path : paths)
    if (std::isfinite(path)) sum += path, ++hits;
  return hits > 0 ? sum / hits : 0;
}

std::vector<PathPoint> FreePaths::points() const {
  constexpr int kLowest = -80, kHighest = 120;  // half octaves
  constexpr double kNearlyAll = 0.995;
  std::vector<PathPoint> points;
  if (given_.empty()) return points;
  const std::vector<double> given = sorted(given_), exact = sorted(exact_);
  for (int i = kLowest; i <= kHighest; ++i) {
    const double t = std::exp2(0.5 * i);
    const PathPoint point{t, share_longer(given, t), share_longer(exact, t)};
    if (std::min(point.survival, point.exact) > kNearlyAll) continue;
    if (point.survival == 0 && point.exact == 0) break;
    points.push_back(point);
  }
  return points;
}

std::optional<PathPoint> FreePaths::farthest_apart() const {
  std::optional<PathPoint> farthest;
  for (const PathPoint& point : points())
    if (point.apart() > (farthest ? farthest->apart() : 0)) farthest = point;
  return farthest;
}

std::string FlownScene::name() const {
  return fmt::format("{}, r = {:g}", scene, radius);
}

std::string FlownScene::text() const {
  std::string text = fmt::format("{}: {} flights, mean {:.4g} (exact {:.4g}", name(), paths.flights(),
                                 paths.mean(), paths.exact_mean());
  if (const auto mean = flights::mean_free_path_of(read_scene(scene, radius)).value)
    text += fmt::format("; of infinitely many {:.4g}", *mean);
  text += ")";
  if (const auto farthest = paths.farthest_apart())
    return text + fmt::format(", P(tau > {:.3g}) is {:.3g} where {:.3g} is exact", farthest->t,
                              farthest->survival, farthest->exact);
  return text + ", P(tau > t) exact";
}

report::FreePathCurve FlownScene::curve(const std::string& engine) const {
  report::FreePathCurve curve{scene, engine, radius, "surface", "", {}};
  const flights::Laws laws = flights::laws_of(read_scene(scene, radius), flights::Ensemble::surface);
  if (!laws.laws.empty()) curve.law = fmt::format("{}, {}", laws.laws[0].name, laws.laws[0].when);
  for (const PathPoint& point : paths.points()) {
    report::FreePathCurve::CurvePoint shown{point.t, point.survival, point.exact, {}};
    if (!laws.laws.empty()) shown.theory = laws.laws[0].survival(point.t);
    curve.points.push_back(shown);
  }
  return curve;
}

FreeFlights::FreeFlights(std::uint64_t seed, const Claim& claim) : seed_(seed) {
  for (const auto& [scene, radius] : kWhere) {
    flown_.push_back({scene, radius, {}});
    places_.push_back({flown_.back().name(), place_for(read_scene(scene, radius), claim)});
  }
}

Source FreeFlights::source() const {
  return drawn(places_, starts::Kind::surface, seed_, kFlights);
}

Look FreeFlights::look() {
  return [this](const Question& question, const Answer& given) {
    for (std::size_t i = 0; i < places_.size(); ++i)
      if (question.place == places_[i].place) flown_[i].paths.add(question, given);
  };
}

std::vector<FlownScene> FreeFlights::flown() const {
  std::vector<FlownScene> flown = flown_;
  std::erase_if(flown, [](const FlownScene& scene) { return scene.paths.flights() == 0; });
  return flown;
}

std::string free_path_fault(const std::vector<FlownScene>& scenes) {
  std::optional<PathPoint> farthest;
  std::string where;
  for (const FlownScene& scene : scenes)
    if (const auto point = scene.paths.farthest_apart();
        point && (!farthest || point->apart() > farthest->apart()))
      farthest = point, where = scene.name();
  if (!farthest) return "";
  return fmt::format("P(free path > {:.3g}) {:.3g} where {:.3g} is exact ({})", farthest->t,
                     farthest->survival, farthest->exact, where);
}

}  // namespace lorentz::judge
