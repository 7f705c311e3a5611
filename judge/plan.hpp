// The plan of `judge`: the parts of a run with their times, and the rows of its report with their questions.
#pragma once

#include <vector>

#include "judge/free_paths.hpp"
#include "judge/questions.hpp"

namespace lorentz::judge {

/// The parts of a run. Each has a time of its own, however many rows it has.
enum class JudgePart { drawn, hard, paths, golden, campaign, simplest, speed };

/// Seconds of a part: its share of the order's, or less if `left`, which also the parts behind it need, is
/// less than planned.
double seconds_of(JudgePart part, const JudgeOrder& order, double left);

/// A row, and what it asks. Its source goes on where it was left.
struct PlannedRow {
  JudgePart part;
  ExaminedRow row;  ///< without results
  Source source;
  question::Sink look = {};  ///< sees each answer
};

/// The row of the campaign, the last one of the report.
ExaminedRow campaign_row();

/// All other rows, in the order of the report. Sources and looks refer to the plan.
class JudgePlan {
 public:
  explicit JudgePlan(const JudgeOrder& order);
  JudgePlan(const JudgePlan&) = delete;
  JudgePlan& operator=(const JudgePlan&) = delete;

  std::vector<PlannedRow>& rows() { return rows_; }

  /// The questions of the campaign: scenes of the kind in which the engine has answered so far. Part 0 goes on
  /// where it was left, unless there are more such scenes by now.
  Source campaign(unsigned part, unsigned parts);

  /// The places of the drawn rows.
  const std::vector<NamedPlace>& places() const { return places_; }
  /// The flights of the row `free paths`, in each scene in which the engine flew.
  std::vector<FlownScene> flown() const;

 private:
  void add(JudgePart part, ExaminedRow row, Source source);

  const JudgeOrder& order_;
  std::vector<std::vector<NamedPlace>> sceneries_;
  std::vector<NamedPlace> places_, flown_places_;
  std::vector<FlownScene> flown_;  // in the order of their places
  std::vector<PlannedRow> rows_;
  fuzz::Scope scope_;  // of campaign_
  Source campaign_;
};

}  // namespace lorentz::judge
