// The steps of which rewordings are chains.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include <lorentz/obstacle.hpp>
#include <lorentz/scene.hpp>
#include "question/cases/random.hpp"

namespace lorentz::fuzz {

/// Other words for one scene. What both say of obstacles and times is exactly the same.
struct RewordingStep {
  std::string words;  ///< like "basis 2^37"

  /// The same start and velocity in the new words; false if they are not binary64 values there.
  std::function<bool(Vec& x, Vec& v)> reword = [](Vec&, Vec&) { return true; };

  std::function<void(ObstacleId&)> there = [](ObstacleId&) {};
  std::function<void(ObstacleId&)> back = [](ObstacleId&) {};

  int time_exponent = 0;  ///< times are multiplied by 2^time_exponent
};

/// Draws a step and rewords the scene. Nothing, with the scene unchanged, if the step is impossible or would
/// change nothing. The size of the step is drawn, too: small and extreme steps are as frequent as all
/// between.
using DrawStep = std::optional<RewordingStep> (*)(cases::Random&, Scene&);

// cell_rewording.cpp
std::optional<RewordingStep> draw_basis(cases::Random&, Scene&);
std::optional<RewordingStep> draw_superlattice(cases::Random&, Scene&);

// frame_rewording.cpp
std::optional<RewordingStep> draw_axes(cases::Random&, Scene&);
std::optional<RewordingStep> draw_moved_scene(cases::Random&, Scene&);
std::optional<RewordingStep> draw_scaled(cases::Random&, Scene&);
std::optional<RewordingStep> draw_order(cases::Random&, Scene&);
std::optional<RewordingStep> draw_plane_in_space(cases::Random&, Scene&);
std::optional<RewordingStep> draw_ellipsoids(cases::Random&, Scene&);

}  // namespace lorentz::fuzz
