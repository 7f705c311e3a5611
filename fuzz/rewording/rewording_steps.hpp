// The steps of which rewordings are chains.
#pragma once

#include <memory>
#include <string>

#include <lorentz/obstacle.hpp>
#include <lorentz/scene.hpp>
#include "cases/random.hpp"

namespace lorentz::fuzz {

/// Other words for one scene. What both say of obstacles and times is exactly the same.
class RewordingStep {
 public:
  virtual ~RewordingStep() = default;

  /// Like "basis 2^37".
  virtual std::string words() const = 0;

  /// The same start and velocity in the new words; false if they are not binary64 values there.
  virtual bool reword(Vec& /*x*/, Vec& /*v*/) const { return true; }

  virtual void there(ObstacleId&) const {}
  virtual void back(ObstacleId&) const {}

  /// Times are multiplied by 2^time_exponent().
  virtual int time_exponent() const { return 0; }
};

/// Draws a step and rewords the scene. Null, with the scene unchanged, if the step is impossible or would
/// change nothing. The size of the step is drawn, too: small and extreme steps are as frequent as all
/// between.
using DrawStep = std::unique_ptr<RewordingStep> (*)(cases::Random&, Scene&);

// cell_rewording.cpp
std::unique_ptr<RewordingStep> draw_basis(cases::Random&, Scene&);
std::unique_ptr<RewordingStep> draw_superlattice(cases::Random&, Scene&);

// frame_rewording.cpp
std::unique_ptr<RewordingStep> draw_axes(cases::Random&, Scene&);
std::unique_ptr<RewordingStep> draw_moved_scene(cases::Random&, Scene&);
std::unique_ptr<RewordingStep> draw_scaled(cases::Random&, Scene&);
std::unique_ptr<RewordingStep> draw_order(cases::Random&, Scene&);
std::unique_ptr<RewordingStep> draw_plane_in_space(cases::Random&, Scene&);
std::unique_ptr<RewordingStep> draw_ellipsoids(cases::Random&, Scene&);

}  // namespace lorentz::fuzz
