// What `lorentz judge` is to do: the engine, what it is asked, and by what it is judged.
#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <string>

#include <lorentz/claim.hpp>
#include <lorentz/verdict.hpp>
#include "question/engines.hpp"
#include "question/examine.hpp"
#include "question/starts/free_starts.hpp"

namespace lorentz::judge {

/// Sees each judged answer of all rows.
using OnJudged = std::function<void(const std::string& row, const question::Judged&)>;

struct JudgeOrder {
  question::EngineInfo engine = {};
  /// What the engine reports about itself, if it was asked.
  std::optional<question::Introduction> introduction = {};
  std::string command = {};  ///< the shell line as typed
  std::uint64_t seed = starts::kDefaultSeed;
  double ulps = oracle::kDefaultUlps;  ///< the tolerance k
  Claim claim = {};
  bool times = false;   ///< wrong times count
  bool strict = false;  ///< answers to invalid questions count

  bool quick = false;               ///< fewer flights in less time
  std::optional<double> time = {};  ///< seconds in all; nothing: the usual time
  /// The number of questions of each row, instead of a time: every machine asks the same.
  std::optional<std::size_t> questions = {};
  unsigned jobs = 1;                   ///< threads of the campaign; one if questions are counted
  std::optional<double> timeout = {};  ///< for an external engine; nothing: a tenth of the time
  question::Listener listener = {};
  std::function<void(const std::string& row)> on_progress = {};  ///< called often, with the name of the row
  OnJudged on_judged = {};  ///< called for each answer, but not for nonsense, if questions are counted
  std::chrono::steady_clock::time_point begun = std::chrono::steady_clock::now();  ///< of the time

  /// Duration from `begun` on; meaningless if questions are counted. Only an engine of this program or of the
  /// caller, which cannot be interrupted, makes the run longer.
  double seconds() const;
  /// Whether an external engine that has answered before and is silent for too long is too slow for the time of
  /// this run, which is not a fault.
  bool takes_silence_for_slowness() const { return !questions && !timeout; }
};

}  // namespace lorentz::judge
