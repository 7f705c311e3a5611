// Judges one engine: what `lorentz judge` does between its options and its report.
#pragma once

#include <atomic>
#include <functional>
#include <optional>
#include <string>

#include <lorentz/verdict.hpp>
#include "judge/judge_report.hpp"
#include "starts/free_starts.hpp"

namespace lorentz::judge {

/// What is to be done.
struct JudgeOrder {
  question::EngineInfo engine;
  /// What the engine says of itself, if it was asked.
  std::optional<question::Introduction> introduction = {};
  std::string command;         ///< that was typed, for the report
  bool quick = false;          ///< fewer flights in less time
  std::optional<double> time;  ///< seconds in all, about; nothing: the usual time
  /// The number of questions of each row, instead of a time: every machine asks the same.
  std::optional<std::size_t> questions = {};
  std::uint64_t seed = starts::kDefaultSeed;
  unsigned jobs = 1;  ///< threads of the campaign; one where questions are counted
  double ulps = oracle::kDefaultUlps;
  Claim claim = {};
  std::optional<double> timeout;  ///< of another program; nothing: a tenth of the time
  bool times = false;             ///< wrong times count
  bool strict = false;            ///< answers to invalid questions count
  question::Listener listener = {};
  std::function<void(const std::string& row)> on_progress = {};  ///< called often, with what is asked
  OnJudged on_judged = {};  ///< called of each answer, if questions are counted

  /// How long it will take, about; not where questions are counted.
  double seconds() const;
};

/// Of a report.
std::size_t number_of_rows(NumberFormat precision);

/// All that can be said of the engine; when `stop` is set, what was found until then. Throws
/// FileError without the catalogue or the golden sets.
JudgeReport judged(const JudgeOrder& order, const std::atomic<bool>& stop);

}  // namespace lorentz::judge
