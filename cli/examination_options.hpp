// The options of all commands that examine engines: each is a row of one table, and a command picks its own.
#pragma once

#include <initializer_list>
#include <optional>
#include <string>
#include <vector>

#include "cli/claim_options.hpp"
#include "cli/known_failures.hpp"
#include "question/starts/free_starts.hpp"
#include "report/files/unknown_keys.hpp"

namespace lorentz::cli {

struct ExaminationOptions {
  std::vector<std::string> engines, answers, scenes, radii, difficulties, sets;
  std::optional<std::string> queries, disagreements, id, csv, html, golden;
  std::optional<double> ulps, timeout, seconds;
  std::optional<std::uint64_t> first, questions;
  std::uint64_t count = 10'000, seed = starts::kDefaultSeed, jobs = 1, failures = 3;
  ClaimOptions claim;
  FailureFiles files;
  bool json = false, all = false, no_oracle = false, strict = false, times = false, quick = false;

  /// The rows of these names, in this order. The defaults in help are those that the members have now.
  std::vector<Option> rows(std::initializer_list<const char*> names);

  double tolerance() const;     ///< --ulps, or the usual one
  double longest_wait() const;  ///< --timeout, or the usual one

  /// The engines that --engine names. Throws InputError if it names none or, with an option whose file is about one
  /// engine, several.
  std::vector<question::EngineInfo> named_engines() const;
};

}  // namespace lorentz::cli
