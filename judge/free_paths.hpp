// The free paths that an engine computes, compared with the exact ones of the same starts and with theory.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "question/question.hpp"
#include "report/curves.hpp"

namespace lorentz::judge {

/// The free paths in one scene. A flight that the engine did not decide is in neither of the two distributions. Both are
/// of the same flights, so any difference is due to the engine. No theory is about flights that the engine's domain
/// limits.
class FlownScene {
 public:
  using PathPoint = report::FreePathCurve::CurvePoint;  ///< with the exact share

  explicit FlownScene(std::string scene = "", double radius = 0)
      : scene_(std::move(scene)), radius_(radius) {}

  void add(const question::Question& question, const Answer& given);

  std::size_t flights() const { return given_.size(); }
  /// The mean over the flights that hit something; 0 if no flight does.
  double mean() const { return mean_of(given_); }
  double exact_mean() const { return mean_of(exact_); }

  /// P(free path > t) at powers of the square root of 2, from where a few paths have ended to where none goes
  /// on.
  std::vector<PathPoint> points() const;
  /// The point at which the two are farthest apart; nothing if they agree everywhere.
  std::optional<PathPoint> farthest_apart() const;

  std::string name() const;  ///< "square, r = 0.1"
  /// "square, r = 0.1: 2000 flights, mean 4.68 (exact 4.68; of infinitely many 4.686)", and how far P(tau >
  /// t) is off.
  std::string text() const;
  report::FreePathCurve curve(const std::string& engine) const;

 private:
  static double mean_of(const std::vector<double>& paths);

  std::string scene_;
  double radius_;
  bool is_limited_ = false;
  std::vector<double> given_, exact_;  // infinite: nothing is ever hit
};

/// Says how far the engine's P(tau > t) is from the exact one in the scene where the distance is largest;
/// empty if it is exact in all scenes.
std::string free_path_fault(const std::vector<FlownScene>& scenes);

}  // namespace lorentz::judge
