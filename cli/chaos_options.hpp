// Private to cli/lyapunov.cpp and cli/diffusion.cpp: the parts that both statistics of trajectories share.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "cli/scan.hpp"
#include "runs/piece_store.hpp"
#include "statistics/chaos/groups.hpp"

namespace lorentz::cli {

struct ChaosOptions : ScanOptions {
  std::uint64_t jobs = 1;
  std::optional<std::string> store;
};

/// The options that both commands have.
std::vector<Option> chaos_rows(ChaosOptions& options, const std::string& rows_of_csv);

/// Throws InputError if a store is requested for several scenes or radii.
void check_store(const ChaosOptions& options);

/// Calls `run(work)` with threads, progress, Ctrl-C, and the store of this kind and plan, if requested.
/// Reports how long it took.
void with_work(const ChaosOptions& options, const std::string& kind, const runs::Plan& plan,
               const std::function<void(const chaos::Work&)>& run);

}  // namespace lorentz::cli
