#include "judge/free_paths.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include <lorentz/geometry.hpp>
#include "report/files/scene_file.hpp"
#include "statistics/theory/laws.hpp"

namespace lorentz::judge {
namespace {

// How long a particle flies according to an answer; nothing if the answer does not say.
std::optional<double> flight_of(const Answer& answer) {
  if (answer.outcome == Outcome::hit) return answer.time;
  if (answer.outcome == Outcome::never) return std::numeric_limits<double>::infinity();
  if (answer.outcome == Outcome::inside) return 0;
  return std::nullopt;
}

double apart(const FlownScene::PathPoint& point) {
  return std::fabs(point.survival - *point.exact);
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

void FlownScene::add(const question::Question& question, const Answer& given) {
  const auto time = flight_of(given), exact = flight_of(question.exact);
  if (!time || std::isnan(*time) || !exact) return;
  is_limited_ |= question.place->claim().domain.flight != Domain::Range();
  // Directions are of unit length; the domain may have other speeds, by powers of two.
  const double speed = std::exp2(std::round(std::log2(length_of_any(question.query.v))));
  // Rounding must not carry a path across a point of the curve.
  constexpr double kSame = 0x1p-30;
  given_.push_back(speed * (std::fabs(*time - *exact) <= kSame * *exact ? *exact : *time));
  exact_.push_back(speed * *exact);
}

double FlownScene::mean_of(const std::vector<double>& paths) {
  double sum = 0, hits = 0;
  for (const double path : paths)
    if (std::isfinite(path)) sum += path, ++hits;
  return hits > 0 ? sum / hits : 0;
}

std::vector<FlownScene::PathPoint> FlownScene::points() const {
  constexpr int kLowest = -80, kHighest = 120;  // half octaves
  constexpr double kNearlyAll = 0.995;
  std::vector<PathPoint> points;
  if (given_.empty()) return points;
  const std::vector<double> given = sorted(given_), exact = sorted(exact_);
  for (int i = kLowest; i <= kHighest; ++i) {
    const double t = std::exp2(0.5 * i);
    const PathPoint point{t, share_longer(given, t), share_longer(exact, t), {}};
    if (std::min(point.survival, *point.exact) > kNearlyAll) continue;
    if (point.survival == 0 && *point.exact == 0) break;
    points.push_back(point);
  }
  return points;
}

std::optional<FlownScene::PathPoint> FlownScene::farthest_apart() const {
  std::optional<PathPoint> farthest;
  for (const PathPoint& point : points())
    if (apart(point) > (farthest ? apart(*farthest) : 0)) farthest = point;
  return farthest;
}

std::string FlownScene::name() const {
  return fmt::format("{}, r = {:g}", scene_, radius_);
}

std::string FlownScene::text() const {
  std::string text =
      fmt::format("{}: {} flights, mean {:.4g} (exact {:.4g}", name(), flights(), mean(), exact_mean());
  const auto mean_of_all = flights::mean_free_path_of(read_scene(scene_, radius_)).value;
  if (mean_of_all && !is_limited_) text += fmt::format("; of infinitely many {:.4g}", *mean_of_all);
  text += ")";
  if (const auto farthest = farthest_apart())
    return text + fmt::format(", P(tau > {:.3g}) is {:.3g} where {:.3g} is exact", farthest->t,
                              farthest->survival, *farthest->exact);
  return text + ", P(tau > t) exact";
}

report::FreePathCurve FlownScene::curve(const std::string& engine) const {
  report::FreePathCurve curve{scene_, engine, radius_, "surface", "", {}};
  const auto law =
      is_limited_ ? std::nullopt : flights::law_of(read_scene(scene_, radius_), flights::Ensemble::surface);
  if (law) curve.law = fmt::format("{}, {}", law->name, law->when);
  curve.points = points();
  if (law)
    for (PathPoint& point : curve.points) point.theory = law->survival(point.t);
  return curve;
}

std::string free_path_fault(const std::vector<FlownScene>& scenes) {
  std::optional<FlownScene::PathPoint> farthest;
  std::string where;
  for (const FlownScene& scene : scenes)
    if (const auto point = scene.farthest_apart(); point && (!farthest || apart(*point) > apart(*farthest)))
      farthest = point, where = scene.name();
  if (!farthest) return "";
  return fmt::format("P(free path > {:.3g}) {:.3g} where {:.3g} is exact ({})", farthest->t,
                     farthest->survival, *farthest->exact, where);
}

}  // namespace lorentz::judge
