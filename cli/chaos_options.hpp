// Private to cli/lyapunov.cpp and cli/diffusion.cpp: what the statistics of trajectories have in common.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include <lorentz/scene.hpp>
#include "cli/command.hpp"
#include "runs/piece_store.hpp"
#include "starts/free_starts.hpp"
#include "statistics/chaos/groups.hpp"

namespace lorentz::cli {

struct ChaosOptions {
  std::string scene = "square";
  std::uint64_t seed = starts::kDefaultSeed, jobs = 1;
  std::optional<double> radius;
  std::optional<std::string> store;
  bool json = false;
};

/// The options that both have.
std::vector<Option> chaos_rows(ChaosOptions& options);

/// The scene, with its radii. Throws InputError or FileError.
Scene scene_of(const ChaosOptions& options);

/// Calls `run(work)` with threads, progress, Ctrl-C, and the store of this kind and plan, if one is asked
/// for; says how long it took.
void with_work(const ChaosOptions& options, const std::string& kind, const runs::Plan& plan,
               const std::function<void(const chaos::Work&)>& run);

/// "square", or "square, r = 0.1" if all are balls of one radius.
std::string name_with_radius(const std::string& name, const Scene& scene);

/// What a result that is not whole says of itself, or nothing.
std::string remark_on_end(bool is_whole);

}  // namespace lorentz::cli
