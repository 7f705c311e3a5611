// What an engine did in all rows of a judge's report: counts, faults by cause, and curves.
#pragma once

#include <array>
#include <deque>
#include <vector>

#include "judge/findings.hpp"
#include "question/examination.hpp"
#include "report/curves.hpp"

namespace lorentz::judge {

using question::Count;
using question::Counted;
using question::ExaminedRow;
using question::Judged;

/// What makes a question hard: the measures by which an engine's answers are counted, in the order of `sizes`
/// in Results::take. The first is that of the page's `calls`.
inline constexpr std::array kMeasures{
    "radii by which the line enters or misses the obstacle in question",
    "radii from the start to the obstacle in question", "length of the flight, in lattice vectors",
    "distance of the start from the origin, in lattice vectors", "smallest radius, in lattice vectors"};

/// One curve for each measure.
using Curves = std::array<report::Calls, kMeasures.size()>;

struct Results {
  std::deque<ExaminedRow> rows = {};
  Findings findings = {};
  Curves curves = {};   ///< of the first questions of each row, limited in number so that rows weigh alike
  bool failed = false;  ///< an external engine failed or misbehaved at least once
  /// Times of hits whose exact time is not a binary32 number, and those of them that were given as one.
  std::size_t times = 0, times_in_binary32 = 0;

  /// The row of this name; a row without results is added if there is none.
  ExaminedRow& row(const ExaminedRow& like);

  /// Takes an answer in a row. `example`: what is wrong with it. An engine that is too slow has no answer to be
  /// counted, only a finding.
  void take(const Judged& judged, const std::optional<Example>& example, bool is_slowness, ExaminedRow& row);

  /// Adds the results of another examination of the same engine, row by row.
  void add(const Results& other);

  /// All findings; unsupported questions do not count as asked.
  std::vector<Finding> all_findings() const { return findings.all(rows); }
  /// The number of times if there are at least 20 and all are binary32 numbers; else 0.
  std::size_t all_in_binary32() const { return times >= 20 && times == times_in_binary32 ? times : 0; }
};

/// Sets the row's mean time from its seconds.
void set_speed(ExaminedRow& row);

}  // namespace lorentz::judge
