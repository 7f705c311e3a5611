#include "judge/free_paths.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lorentz::judge {
namespace {

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

}  // namespace lorentz::judge
