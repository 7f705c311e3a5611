// Private to cli/fuzz*.cpp: the options of a campaign, and its report.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "cli/examination_options.hpp"
#include "fuzz/campaign/store.hpp"
#include "src/exchange/json_writer.hpp"

namespace lorentz::cli {

inline constexpr double kDefaultSeconds = 60;
inline constexpr std::uint64_t kMostCases = 1'000'000'000'000;

/// The options of a campaign besides those that it has in common with other examinations.
struct FuzzOptions : ExaminationOptions {
  std::vector<std::string> targets;
  std::optional<std::string> store, undecided;
  std::optional<std::uint64_t> cases;
  std::uint64_t keep = 3, mutate = 32, reword = 1;
  std::string scope = "any";
  bool to_first = false;

  /// The name of the engine. Throws InputError if there are several.
  const std::string& engine() const;
};

std::vector<Option> rows_of(FuzzOptions& options);

/// The plan, bounds and manifest that the options describe. Each throws InputError with the option's name if
/// the options are invalid.
fuzz::Plan plan_of(FuzzOptions options, const question::EngineInfo& engine);
fuzz::Bounds bounds_of(const FuzzOptions& options);
fuzz::CampaignManifest manifest_of(const fuzz::Plan& plan, const std::string& engine);

/// The result of a campaign: its manifest, the tally of each target, and its findings.
struct FuzzReport {
  fuzz::CampaignManifest manifest;
  std::vector<fuzz::TargetTally> tallies;  ///< one for each of its targets
  std::int64_t campaign = 0;               ///< its id in the store
  std::vector<fuzz::Stored> findings;      ///< of this campaign
  bool is_stored = true;                   ///< false: the findings remain only in text()

  std::uint64_t total(fuzz::Kind kind) const;
  std::string text() const;
  std::string json() const;

  /// The parts of both that describe what was asked, and how much.
  std::string target_table() const;
  void add_targets(json::Members& object) const;
};

/// A campaign from the store, with its findings.
FuzzReport report_of(const fuzz::Store& store, const fuzz::Campaign& campaign);

/// The findings of one cause: their number, their targets, and the simplest of them.
struct FindingCause {
  std::string name;
  std::size_t findings = 0;
  std::vector<std::string> targets;
  const fuzz::Stored* simplest = nullptr;
};

/// The findings by cause: the most severe first (fuzz::rank_of), then in the order of their names.
std::vector<FindingCause> causes_of(const std::vector<fuzz::Stored>& findings);

std::string table_of(const std::vector<FindingCause>& causes);

/// A case as text lines with remarks. Ulps are those of the precision.
std::string text_of(const fuzz::CaseText& text, const Claim& claim);

/// Adds a finding to a JSON object. Its lines are included in the form that they have in streams.
void add_finding(json::Members& object, const fuzz::Stored& finding);

}  // namespace lorentz::cli
