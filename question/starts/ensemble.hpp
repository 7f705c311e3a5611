// The ensembles from which free flights start. The statistics depend on the ensemble.
#pragma once

namespace lorentz::flights {

/// uniform: starts are uniform in the space outside the obstacles, directions are isotropic.
///
/// surface: starts are uniform on the surfaces of the obstacles, directions follow the cosine law about the
/// outward normal. This is the ensemble of flights between collisions in a gas in equilibrium.
enum class Ensemble { uniform, surface };

constexpr const char* name_of(Ensemble ensemble) {
  return ensemble == Ensemble::uniform ? "uniform" : "surface";
}

}  // namespace lorentz::flights
