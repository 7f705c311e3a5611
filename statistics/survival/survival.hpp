// The number of right collisions of a trajectory in arithmetic with a given number of bits.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <lorentz/scene.hpp>
#include "question/engines.hpp"
#include "question/starts/free_starts.hpp"

namespace lorentz::survival {

/// Arithmetic with a given number of bits. 53 and 106 bits are the engine's trajectory in binary64 and
/// double-double; other numbers of bits are the plain arithmetic of RoundedItinerary.
struct Arithmetic {
  long bits;
  std::vector<std::uint64_t> right{};  ///< for each start: collisions before the first wrong one

  std::string name(const std::string& engine) const;
  double mean() const;
  double share(std::uint64_t k) const;  ///< the share of starts with at least k right collisions
};

struct SurvivalPlan {
  std::string scene_name;  ///< as given by the user
  Scene scene;             ///< lattices that repeat in all directions, without flaws
  std::optional<double> radius;
  question::EngineInfo engine;     ///< an engine of this program
  std::uint64_t count = 100;       ///< starts, on the surface of an obstacle (cosine law)
  std::uint64_t collisions = 500;  ///< at most, for each start
  std::uint64_t seed = starts::kDefaultSeed;
  std::vector<long> bits{53, 106, 128, 256};
};

struct Survival {
  SurvivalPlan plan;
  std::vector<Arithmetic> arithmetics;

  /// The number of starts that were followed to the end. It is smaller than `count` if the run was stopped.
  std::uint64_t starts() const { return arithmetics.empty() ? 0 : arithmetics[0].right.size(); }

  std::string table() const;
  std::string json() const;  ///< one object on one line
  std::string csv() const;   ///< the shares of each arithmetic by number of collisions
  std::string page_json(const std::string& command) const;  ///< the report for a page, kind "survival"

 private:
  std::uint64_t last_of(const Arithmetic& one) const;
};

/// Follows each start with certainty, and in each arithmetic until that hits a wrong obstacle. Ends early
/// when `stop` becomes true. `on_progress` gets the number of finished starts. Throws InputError for an
/// unsupported scene or number of bits.
Survival survival_of(const SurvivalPlan& plan, const std::atomic<bool>& stop,
                     const std::function<void(std::uint64_t)>& on_progress = {});

}  // namespace lorentz::survival
