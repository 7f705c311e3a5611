// Mean squared displacements of particles, and the diffusion coefficient from them.
#pragma once

#include <cstdint>
#include <vector>

#include <lorentz/scene.hpp>
#include "statistics/chaos/estimate.hpp"
#include "statistics/chaos/groups.hpp"
#include "statistics/theory/ensemble.hpp"

namespace lorentz::chaos {

struct DiffusionPlan {
  Scene scene;  ///< without flaws
  flights::Ensemble from = flights::Ensemble::uniform;
  std::uint64_t seed = 0;
  std::uint64_t count = 100'000;  ///< particles
  double time = 100;              ///< T, in units in which the speed is 1
};

/// The times at which displacements are measured: T / 2^k and T / 2^(k + 1/2), down to T / 2^8, increasing.
inline constexpr int kTimes = 17;
std::vector<double> times_of(double longest);

struct Displacement {
  double time;
  Estimate square;         ///< <|x|^2>
  Estimate from_velocity;  ///< 2 <v(0) . integral of x>: equal to it for uniform starts
};

struct Diffusion {
  std::vector<Displacement> displacements;
  Estimate coefficient;         ///< (MSD(T) - MSD(T/2)) / (d T): the diffusion coefficient, if it exists
  Estimate logarithmic;         ///< the slope of MSD / t in ln t from T / 16 to T: 2 C if MSD ~ 2 C t ln t
  std::uint64_t particles = 0;  ///< counted
  std::uint64_t collisions = 0;
  std::uint64_t stopped = 0;  ///< particles that ended before T; they are not counted
  bool is_whole = true;       ///< false: the work was stopped
};

/// The result does not depend on the number of jobs. Throws InputError as lyapunov_of does.
Diffusion diffusion_of(const DiffusionPlan& plan, const Work& work = {});

}  // namespace lorentz::chaos
