// How many collisions of a trajectory are right in arithmetic with a given number of bits.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <lorentz/scene.hpp>
#include "question/engines.hpp"
#include "starts/free_starts.hpp"

namespace lorentz::survival {

/// Arithmetic of so many bits: 53 and 106 are an engine's trajectory in binary64 and double-double, others
/// the plain one of RoundedItinerary.
struct Arithmetic {
  long bits;
  std::vector<std::uint64_t> right{};  ///< of each start: collisions before the first wrong one

  std::string name(const std::string& engine) const;
  double mean() const;
  double share(std::uint64_t k) const;  ///< of the starts with at least k right collisions
};

struct SurvivalPlan {
  std::string scene_name;  ///< as it was asked for
  Scene scene;             ///< of lattices in all directions, without flaws
  std::optional<double> radius;
  question::EngineInfo engine;     ///< of this program
  std::uint64_t count = 100;       ///< starts, off the surface of an obstacle (cosine law)
  std::uint64_t collisions = 500;  ///< at most, of each start
  std::uint64_t seed = starts::kDefaultSeed;
  std::vector<long> bits{53, 106, 128, 256};
};

struct Survival {
  SurvivalPlan plan;
  std::vector<Arithmetic> arithmetics;

  /// Starts that were followed to the end: fewer than were asked for if it was stopped.
  std::uint64_t starts() const { return arithmetics.empty() ? 0 : arithmetics[0].right.size(); }

  std::string table() const;
  std::string json() const;  ///< one object, in a line
  std::string csv() const;   ///< the share of each arithmetic, collision by collision
  std::string svg() const;
  std::string page_json(const std::string& command) const;  ///< the report of a page, of kind "survival"

 private:
  std::uint64_t last_of(const Arithmetic& one) const;
};

/// Follows each start with certainty, and in each arithmetic until that hits another obstacle. Ends early when
/// `stop` becomes true; `on_progress` hears how many starts are done. Throws InputError for a scene or bits that
/// cannot be had.
Survival survival_of(const SurvivalPlan& plan, const std::atomic<bool>& stop,
                     const std::function<void(std::uint64_t)>& on_progress = {});

}  // namespace lorentz::survival
