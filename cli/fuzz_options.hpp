// Private to cli/fuzz*.cpp: what the options of a campaign say.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "cli/claim_options.hpp"
#include "cli/command.hpp"
#include "cli/known_failures.hpp"
#include "fuzz/campaign/store.hpp"
#include "starts/free_starts.hpp"

namespace lorentz::cli {

inline constexpr double kDefaultSeconds = 60;
inline constexpr std::uint64_t kMostCases = 1'000'000'000'000;

struct FuzzOptions {
  std::vector<std::string> targets;
  std::optional<std::string> store;
  std::optional<double> seconds, ulps, timeout, progress;
  std::optional<std::uint64_t> count, dimension;
  std::uint64_t seed = starts::kDefaultSeed, jobs = 1, keep = 3, mutate = 32, reword = 1;
  std::string engine = "reduction", shard = "0/1", judge = "oracle", scenes = "any";
  ClaimOptions claim;
  FailureFiles files;
  bool json = false, first = false, times = false, undecided = false, no_undecided = false;
};

std::vector<Option> rows_of(FuzzOptions& options);

/// What the options say. Each throws InputError, naming the option, if they say nothing.
fuzz::Plan plan_of(FuzzOptions options);
fuzz::Bounds bounds_of(const FuzzOptions& options);
fuzz::CampaignManifest manifest_of(const fuzz::Plan& plan, const std::string& engine);

/// By which claim a campaign was judged: its manifest's options say so.
Claim claim_of(const fuzz::CampaignManifest& manifest);

/// The command with these options, as a shell takes it.
std::string command_of(const FuzzOptions& options);

}  // namespace lorentz::cli
