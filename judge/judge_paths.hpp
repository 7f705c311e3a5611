// The free paths of the judged engine, compared with the exact ones and with theory.
#pragma once

#include <string>
#include <vector>

#include "judge/examination.hpp"
#include "judge/free_paths.hpp"
#include "judge/questions.hpp"
#include "report/curves.hpp"

namespace lorentz::judge {

/// The flights in one scene.
struct FlownScene {
  std::string scene;
  double radius = 0;
  FreePaths paths;

  std::string name() const;
  /// "square, r = 0.1: 2000 flights, mean 4.68 (exact 4.68, theory 4.6858)", and how far P(tau > t) is off.
  std::string text() const;
  report::FreePathCurve curve(const std::string& engine) const;
};

/// Flies in a few scenes, from collision to collision, for at most `seconds`. Returns the flights of each
/// scene in which the engine flew.
std::vector<FlownScene> fly_free_paths(Examination& examination, std::uint64_t seed, double seconds);

/// Says how far the engine's P(tau > t) is from the exact one in the scene where the distance is largest;
/// empty if it is exact in all scenes.
std::string free_path_fault(const std::vector<FlownScene>& scenes);

}  // namespace lorentz::judge
