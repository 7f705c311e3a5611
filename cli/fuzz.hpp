// Private to cli/fuzz*.cpp: the parts of `lorentz fuzz`.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <string>
#include <vector>

#include "cli/app.hpp"
#include "fuzz/campaign/store.hpp"

namespace lorentz::cli {

/// lorentz fuzz list, show, merge; and export.
void add_fuzz_store(CLI::App& fuzz, Action& action);
void add_fuzz_export(CLI::App& fuzz, Action& action);

/// What came of a campaign: its manifest, what each target met, and its findings.
struct FuzzReport {
  fuzz::Manifest manifest;
  std::vector<std::string> targets;
  std::vector<fuzz::TargetTally> tallies;  ///< one for each target
  std::vector<fuzz::Stored> findings;      ///< of this campaign

  std::uint64_t total(fuzz::Kind kind) const;
  std::string text() const;
  std::string json() const;
};

/// The findings of one cause: how many, of which targets, and the simplest of them.
struct Cause {
  std::string name;
  std::size_t findings = 0;
  std::vector<std::string> targets;
  const fuzz::Stored* simplest = nullptr;
};

/// By cause, in the order of their names.
std::vector<Cause> causes_of(const std::vector<fuzz::Stored>& findings);

std::string table_of(const std::vector<Cause>& causes);

/// A finding as one JSON object; its lines are in it as they stand in streams.
std::string json_of(const fuzz::Stored& finding);

}  // namespace lorentz::cli
