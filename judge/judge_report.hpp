// The report that `lorentz judge` gives at the end.
#pragma once

#include <atomic>
#include <optional>
#include <string>
#include <vector>

#include "judge/examination.hpp"
#include "judge/free_paths.hpp"

namespace lorentz::judge {

/// What readers should see first, one line each, and what they can do.
struct ThreeLines {
  std::string what;                  ///< the engine, and what it was judged by
  std::string how_bad;               ///< shares of drawn flights and of hard ones
  std::string worst;                 ///< the worst fault
  std::vector<std::string> next;     ///< what to do next
  const Finding* finding = nullptr;  ///< this fault; null if there is none
};

struct JudgeReport : JudgeOrder {
  std::deque<ExaminedRow> rows = {};
  std::vector<Finding> findings = {};
  Curves curves = {};
  std::optional<double> own_ns = {};  ///< per query, in the engine's own calls, if it reports that
  std::vector<FlownScene> flown = {};
  double longest_wait = 0;  ///< seconds of silence after which an external engine has failed
  double start_up = 0;      ///< seconds that an external engine took to start
  double first_answer = 0;  ///< seconds until its first answer
  std::optional<double> ns_per_query = {}, ns_of_reduction = {};            ///< on the same drawn flights
  std::optional<double> processor_ns = {}, processor_ns_of_reduction = {};  ///< the same in processor time
  std::string speed_of = {};                                                ///< which flights these were
  std::size_t outside = 0;  ///< questions that were not asked: they are outside of the engine's domain
  std::size_t times_in_binary32 = 0;       ///< Results::all_in_binary32
  std::optional<Domain> free_domain = {};  ///< Findings::domain_without_fault, unless a domain is claimed
  bool misbehaved = false;                 ///< an external engine failed or misbehaved at least once
  bool was_stopped = false;                ///< before all questions were asked

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

  /// The summary, the first findings in three lines each, and the verdict line; with `all`, the table and
  /// each finding in full.
  std::string text(bool all) const;
  std::string json() const;
};

/// The number of rows of a report.
std::size_t number_of_rows(const JudgeOrder& order);

/// Judges one engine: the full report on it; once `stop` is set, what was found until then. Throws FileError
/// without the catalogue or the golden sets.
JudgeReport judged(const JudgeOrder& order, const std::atomic<bool>& stop);

/// A number with two digits, or with all digits before the point.
std::string two_digits(double a);

}  // namespace lorentz::judge
