// Mean squared displacements of particles, and the diffusion coefficient from them.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <lorentz/scene.hpp>
#include "statistics/chaos/groups.hpp"
#include "statistics/theory/laws.hpp"

namespace lorentz::chaos {

struct DiffusionPlan {
  Scene scene;  ///< without flaws
  flights::Ensemble from = flights::Ensemble::uniform;
  std::uint64_t seed = 0;
  std::uint64_t count = 100'000;  ///< particles
  double time = 100;              ///< T, in units in which the speed is 1
  std::string scene_name = {};    ///< as given by the user
};

/// The times at which displacements are measured: T / 2^k and T / 2^(k + 1/2), down to T / 2^8, increasing.
inline constexpr int kTimes = 17;
std::vector<double> times_of(double longest);

struct Displacement {
  double time;
  Estimate square;         ///< <|x|^2>
  Estimate from_velocity;  ///< 2 <v(0) . integral of x>: equal to it for uniform starts
};

/// The result, with theory for comparison.
struct Diffusion {
  DiffusionPlan plan;
  std::vector<Displacement> displacements;
  Estimate coefficient;         ///< (MSD(T) - MSD(T/2)) / (d T): the diffusion coefficient, if it exists
  Estimate logarithmic;         ///< the slope of MSD / t in ln t from T / 16 to T: 2 C if MSD ~ 2 C t ln t
  std::uint64_t particles = 0;  ///< counted
  std::uint64_t collisions = 0;
  std::uint64_t stopped = 0;          ///< particles that ended before T; they are not counted
  bool is_whole = true;               ///< false: the work was stopped
  std::optional<double> random_walk;  ///< Machta and Zwanzig's coefficient
  std::optional<double> mean_free_path;
  flights::Tail tail;  ///< of free paths from uniform starts, t -> infinity

  /// False if no particle got beyond its first obstacle, or no group was finished. When particles ended early
  /// and no collision is counted, the remaining particles are those that hit nothing.
  bool has_content() const { return particles > 0 && !(collisions == 0 && stopped > 0); }

  std::string table() const;
  std::string csv() const;   ///< one line per displacement
  std::string json() const;  ///< one object on one line

 private:
  static constexpr double kLeastPaths = 20;
  bool is_uniform() const { return plan.from == flights::Ensemble::uniform; }
  /// T in mean free paths: in collisions of a particle, if the exact mean is not known.
  double paths() const {
    return mean_free_path ? plan.time / *mean_free_path
                          : static_cast<double>(collisions) / static_cast<double>(particles + stopped);
  }
  /// True if the particles have hardly collided, so that the MSD does not grow linearly yet.
  bool is_too_short() const { return paths() < kLeastPaths; }
  bool has_corridors() const { return tail.open.value_or(false); }
  Estimate rate(const Displacement& at) const;  ///< MSD / (2 d t)
  std::string lines_of_coefficient() const;
  std::string lines_of_theory() const;
};

/// The result does not depend on the number of jobs. Throws InputError as lyapunov_of does.
Diffusion diffusion_of(const DiffusionPlan& plan, const Work& work = {});

}  // namespace lorentz::chaos
