// Private to cli/fuzz*.cpp: the options of a campaign.
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

/// The plan, bounds and manifest that the options describe. Each throws InputError with the option's name if
/// the options are invalid.
fuzz::Plan plan_of(FuzzOptions options);
fuzz::Bounds bounds_of(const FuzzOptions& options);
fuzz::CampaignManifest manifest_of(const fuzz::Plan& plan, const std::string& engine);

/// The claim by which a campaign was judged, from the options in its manifest.
Claim claim_of(const fuzz::CampaignManifest& manifest);

/// The command with these options, quoted for a shell.
std::string command_of(const FuzzOptions& options);

}  // namespace lorentz::cli
