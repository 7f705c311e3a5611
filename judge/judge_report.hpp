// The report that `lorentz judge` gives at the end.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "judge/examination.hpp"
#include "judge/judge_paths.hpp"
#include "question/engines.hpp"

namespace lorentz::judge {

/// What readers should see first, one line each.
struct ThreeLines {
  std::string what;                  ///< the engine, and what it was judged by
  std::string how_bad;               ///< shares of drawn flights and of hard ones
  std::string worst;                 ///< the worst fault
  const Finding* finding = nullptr;  ///< this fault; null if there is none
};

struct JudgeReport {
  question::EngineInfo engine;
  std::uint64_t seed = 0;
  std::string command;  ///< the shell line that was typed
  std::vector<ExaminedRow> rows;
  std::vector<Finding> findings;
  Curves curves;
  std::optional<question::Introduction> introduction = {};
  std::optional<double> own_ns = {};  ///< per query, in the engine's own calls, if it reports that
  std::vector<FlownScene> flown;
  double timeout = 0;       ///< seconds of silence after which an external engine has failed
  double start_up = 0;      ///< seconds that an external engine took to start
  double first_answer = 0;  ///< seconds until its first answer
  std::optional<double> ns_per_query, ns_of_reduction;            ///< on the same drawn flights
  std::optional<double> processor_ns, processor_ns_of_reduction;  ///< the same in processor time
  std::string speed_of;                                           ///< which flights these were
  bool misbehaved = false;             ///< an external engine failed or misbehaved at least once
  bool was_stopped = false;            ///< before all questions were asked
  bool times = false;                  ///< wrong times count
  Claim claim = {};                    ///< by which it was judged
  double ulps = oracle::kDefaultUlps;  ///< the tolerance k
  bool strict = false;                 ///< answers to invalid questions count

  question::Tally total() const;
  /// Answers to invalid questions, which are not in the total.
  std::size_t nonsense() const;
  /// Rows in which an external engine was given up.
  std::size_t rows_given_up() const;
  /// The largest radii_off of all right obstacles.
  std::optional<double> max_radii() const;
  /// True if more than one answer in a hundred is missing.
  bool is_broken() const;

  /// right, wrong, ill-posed, undecided, broken: the worst that applies (docs/judge.md).
  std::string verdict() const;
  /// The verdict in one line, with the most frequent fault, shares, times, free paths and speed.
  std::string line() const;

  ThreeLines summary() const;

  std::string text() const;
  std::string json() const;
};

}  // namespace lorentz::judge
