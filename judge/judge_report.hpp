// The report that `lorentz judge` gives at the end.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "judge/examination.hpp"
#include "judge/free_paths.hpp"
#include "question/engines.hpp"
#include "starts/free_starts.hpp"

namespace lorentz::judge {

/// What readers should see first, one line each.
struct ThreeLines {
  std::string what;                  ///< the engine, and what it was judged by
  std::string how_bad;               ///< shares of drawn flights and of hard ones
  std::string worst;                 ///< the worst fault
  const Finding* finding = nullptr;  ///< this fault; null if there is none
};

/// What is judged, and by what.
struct JudgeTerms {
  question::EngineInfo engine = {};
  /// What the engine reports about itself, if it was asked.
  std::optional<question::Introduction> introduction = {};
  std::string command = {};  ///< the shell line as typed
  std::uint64_t seed = starts::kDefaultSeed;
  double ulps = oracle::kDefaultUlps;  ///< the tolerance k
  Claim claim = {};
  bool times = false;   ///< wrong times count
  bool strict = false;  ///< answers to invalid questions count
};

struct JudgeReport : JudgeTerms {
  std::vector<ExaminedRow> rows = {};
  std::vector<Finding> findings = {};
  Curves curves = {};
  std::optional<double> own_ns = {};  ///< per query, in the engine's own calls, if it reports that
  std::vector<FlownScene> flown = {};
  double timeout = 0;       ///< seconds of silence after which an external engine has failed
  double start_up = 0;      ///< seconds that an external engine took to start
  double first_answer = 0;  ///< seconds until its first answer
  std::optional<double> ns_per_query = {}, ns_of_reduction = {};            ///< on the same drawn flights
  std::optional<double> processor_ns = {}, processor_ns_of_reduction = {};  ///< the same in processor time
  std::string speed_of = {};                                                ///< which flights these were
  bool misbehaved = false;   ///< an external engine failed or misbehaved at least once
  bool was_stopped = false;  ///< before all questions were asked

  /// "Ball 1.2", if the engine reports its name.
  std::optional<std::string> library() const;
  question::Tally total() const;
  /// Rows in which an external engine was given up.
  std::size_t rows_given_up() const;
  /// Rows in which it was silent for longer than one may take.
  std::size_t rows_too_slow() const;
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

/// A number with two digits, or with all digits before the point.
std::string two_digits(double a);

}  // namespace lorentz::judge
