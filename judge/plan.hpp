// The plan of `judge`: where its questions come from, the parts of a run with their times, and the rows of its report.
#pragma once

#include <atomic>
#include <cstdint>
#include <string>
#include <vector>

#include "fuzz/campaign/campaign.hpp"
#include "judge/examination.hpp"
#include "judge/free_paths.hpp"
#include "question/starts/varied_starts.hpp"

namespace lorentz::judge {

// ---- Sources of questions: drawn flights, golden sets, the families of hard cases (questions.cpp), and the same flights
// in other words (retold.cpp)

/// A scene and its name: "square, r = 0.1".
struct NamedPlace {
  std::string name;
  std::shared_ptr<Place> place;
};

/// The place in which an engine with this claim is asked: the scene's numbers are rounded to its precision.
std::shared_ptr<Place> place_for(const Scene& scene, const Claim& claim);

/// Counts questions that are not asked because they are outside of the engine's domain. For many threads.
using Outside = std::atomic<std::size_t>;

/// The questions that `ask(place, index)` gives, if it gives any, in blocks of several places in turn: `count` numbers
/// in all. Places beyond the engine are left out.
Source in_turn(const std::vector<std::shared_ptr<Place>>& places, std::size_t count,
               const std::function<std::optional<Question>(std::size_t place, std::size_t index)>& ask);

/// The question with its exact answer, at another speed if that brings it into the engine's domain. Nothing if it stays
/// outside, which is counted.
std::optional<Question> question_in(const std::shared_ptr<Place>& place, const Query& start,
                                    std::string where, Outside& outside);

/// `count` starts of a kind (for `uniform`: VariedStarts), a few of each place in turn. Places beyond the engine are
/// left out. The places must outlast the source, and so must `outside` of all sources.
Source drawn(const std::vector<NamedPlace>& places, starts::Kind kind, std::uint64_t seed, std::size_t count,
             Outside& outside);

/// The ways to ask the same plain flights.
enum class Retelling { plain, moved, mirrored, faster, limited };
struct RowWords {
  const char *name, *explanation;
};
RowWords row_words_of(Retelling how);

/// `count` plain flights, told in this way; as for drawn().
Source retold(const std::vector<NamedPlace>& places, Retelling how, std::uint64_t seed, std::size_t count,
              Outside& outside);

/// The records of a golden set that consist of numbers of the claim's precision; only the first ones of a
/// scene that is beyond the engine. Throws as golden::Reader does.
Source golden_set(const std::string& path, const Claim& claim, Outside& outside);

/// Cases of all targets of campaigns in turn, without end; and for one case of each scene the variants that
/// climb to the smallest margin. Only scenes that the scope admits are used, and of these only number `part`
/// modulo `parts`. All cases consist of numbers of the claim's precision. The targets get the same time (a few
/// take a hundred times as long as others), or the same number of scenes.
Source campaign(std::uint64_t seed, const fuzz::Scope& scope, bool same_time, unsigned part, unsigned parts,
                const Claim& claim, Outside& outside);

/// The narrowest scope that contains all the places in which the engine answered (a single ball and a single
/// disc are in one scope); all scenes if it answered nowhere.
fuzz::Scope scope_of(const std::vector<NamedPlace>& places);

// ---- The plan

/// The parts of a run, in the order in which they run. Each has a time of its own, however many rows it has.
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
  /// Questions that were not asked: they are outside of the engine's domain.
  std::size_t outside() const { return outside_; }

 private:
  void add(JudgePart part, ExaminedRow row, Source source);

  const JudgeOrder& order_;
  std::vector<std::vector<NamedPlace>> sceneries_;
  std::vector<NamedPlace> places_, plain_places_, flown_places_;
  std::vector<FlownScene> flown_;  // in the order of their places
  std::vector<PlannedRow> rows_;
  Outside outside_ = 0;
  fuzz::Scope scope_;  // of campaign_
  Source campaign_;
};

}  // namespace lorentz::judge
