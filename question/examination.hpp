// One engine under examination: asked part after part, judged, and counted row by row.
#pragma once

#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "question/examine.hpp"
#include "question/tally.hpp"

namespace lorentz::question {

/// Questions of one kind (drawn in a scene, a golden set, a campaign), and an engine's results with them.
struct ExaminedRow {
  std::string name, explanation = {};
  bool is_hard = true;  ///< chosen to be difficult, in contrast to drawn flights
  Tally tally = {};     ///< with the mean ns_per_query; wall-clock time for an external program
  std::map<std::string, Tally> by_tag = {};   ///< the same for each tag of golden records
  std::optional<double> max_radii = {};       ///< the largest radii_off of a right obstacle
  std::optional<std::uint64_t> records = {};  ///< the size of a golden set
  std::size_t not_asked =
      0;  ///< questions that an external engine was not asked, because it was given up; counted in no tally
  bool is_exhausted = false;        ///< its source had no more questions that the engine supports
  std::size_t scenes_given_up = 0;  ///< scenes in which an external engine failed until it was given up
  std::string last_failure = {};    ///< in the last of these
  double seconds = 0;               ///< that the answers took

  std::size_t asked() const { return tally.queries + tally.counts.sum({Count::nonsense, Count::too_slow}); }
  /// Counts an answer, also for the question's tags.
  void count(const Judged& judged);
  /// Adds the results of a row of the same name.
  void add(const ExaminedRow& other);
};

class Examination {
 public:
  /// `jobs`: threads, of an engine of this program; any other is asked in one.
  Examination(const EngineInfo& engine, const AnswererOptions& options, double ulps, std::size_t jobs = 1);
  /// Examines another source of answers, such as a file of them.
  Examination(std::string name, std::unique_ptr<Answerer> answerer, double ulps);

  const std::string& name() const { return name_; }
  Answerer& answerer() const { return *answerers_[0]; }

  /// Adds a row, which stays where it is.
  ExaminedRow& add(ExaminedRow row);
  const std::deque<ExaminedRow>& rows() const { return rows_; }
  Tally total() const;

  /// Asks the questions, judges the answers, and passes them on in the order of the questions, after all have
  /// come. Returns the seconds until then, with one thread without the judging.
  double ask(std::span<const Question> questions, const Sink& sink);

  /// Lets an external engine that was given up be asked again, as before a new row.
  void try_again() { answerer().try_again(); }
  bool failed() const { return answerer().failed(); }
  void finish();

 private:
  const std::string name_;
  const double ulps_;
  std::vector<std::unique_ptr<Answerer>> answerers_;  // one per thread
  std::deque<ExaminedRow> rows_;
};

}  // namespace lorentz::question
