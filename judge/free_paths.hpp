// The free paths that an engine computes, compared with the exact ones of the same starts and with theory.
#pragma once

#include <cmath>

#include <optional>
#include <string>
#include <vector>

#include "judge/examination.hpp"
#include "judge/questions.hpp"
#include "report/curves.hpp"

namespace lorentz::judge {

/// P(free path > t) twice, by the engine and exactly. Both are of the same flights, so any difference is due
/// to the engine.
struct PathPoint {
  double t = 0;
  double survival = 0, exact = 0;

  double apart() const { return std::fabs(survival - exact); }
};

/// The free paths in one scene. Paths are times of flight, because starts have unit speed. A flight that the
/// engine did not decide is in neither of the two.
class FreePaths {
 public:
  void add(const Question& question, const Answer& given);

  std::size_t flights() const { return given_.size(); }
  /// The mean over the flights that hit something; 0 if no flight does.
  double mean() const { return mean_of(given_); }
  double exact_mean() const { return mean_of(exact_); }

  /// The curve at powers of the square root of 2, from where a few paths have ended to where none goes on.
  std::vector<PathPoint> points() const;
  /// The point at which the two are farthest apart; nothing if they agree everywhere.
  std::optional<PathPoint> farthest_apart() const;

 private:
  static double mean_of(const std::vector<double>& paths);

  std::vector<double> given_, exact_;  // infinite: nothing is ever hit
};

/// The flights in one scene.
struct FlownScene {
  std::string scene;
  double radius = 0;
  FreePaths paths;

  std::string name() const;
  /// "square, r = 0.1: 2000 flights, mean 4.68 (exact 4.68; of infinitely many 4.686)", and how far P(tau >
  /// t) is off.
  std::string text() const;
  report::FreePathCurve curve(const std::string& engine) const;
};

/// Flights from collision to collision, in a few scenes. Source and look refer to this object.
class FreeFlights {
 public:
  FreeFlights(std::uint64_t seed, const Claim& claim);
  FreeFlights(const FreeFlights&) = delete;
  FreeFlights& operator=(const FreeFlights&) = delete;

  Source source() const;
  Look look();
  /// The flights of each scene in which the engine flew.
  std::vector<FlownScene> flown() const;

 private:
  const std::uint64_t seed_;
  std::vector<NamedPlace> places_;
  std::vector<FlownScene> flown_;  // in the order of the places
};

/// Says how far the engine's P(tau > t) is from the exact one in the scene where the distance is largest;
/// empty if it is exact in all scenes.
std::string free_path_fault(const std::vector<FlownScene>& scenes);

}  // namespace lorentz::judge
