// From where free flights start: what their statistics depend on.
#pragma once

namespace lorentz::flights {

/// uniform: a start uniform in the space that the obstacles leave free, a direction that is isotropic.
/// surface: a start uniform on the obstacles' surfaces, a direction by the cosine law about the outward
/// normal: the flights from collision to collision of a gas in equilibrium.
enum class Ensemble { uniform, surface };

constexpr const char* name_of(Ensemble ensemble) {
  return ensemble == Ensemble::uniform ? "uniform" : "surface";
}

}  // namespace lorentz::flights
