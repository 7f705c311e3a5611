// Answers that went wrong, by cause, and what distinguishes their questions from the others.
#pragma once

#include <deque>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "judge/diagnosis.hpp"
#include "question/examination.hpp"

namespace lorentz::judge {

/// Features of a question, by which the failing questions can be distinguished from the others.
struct Features {
  static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

  bool in_space = false;        ///< 3D
  bool zero_component = false;  ///< a component of v is 0
  bool leaving = false;         ///< `from` is given
  bool several_lattices = false, several_atoms = false, ellipsoids = false;
  bool other_cell = false;  ///< not a single unit square or cubic lattice
  bool never = false;       ///< nothing is ever hit
  // Lengths in units of the shortest primitive vector.
  double flight = kNone;  ///< to the obstacle that is hit
  double radius = kNone;  ///< the smallest
  double start = kNone;   ///< distance of x from the origin
  double cell = kNone;    ///< the largest absolute value in a cell, of the obstacle hit or of `from`
  double depth = kNone;   ///< by how many of its radii the line enters the obstacle that is hit
  double speed = kNone;   ///< |v|, in the scene's own unit
  // In radii (for an ellipsoid, its smallest semiaxis).
  double distance = kNone;         ///< from x to the centre of the obstacle in question
  double flight_in_radii = kNone;  ///< to the obstacle that is hit, in its radii
};

/// `in_question`: the obstacle in question; nothing: the scene's only obstacle, if it has just one.
Features features_of(const Question& question, const std::optional<ObstacleId>& in_question = {});

/// What distinguishes the questions on which an engine fails.
struct Circumstance {
  std::string text;          ///< a clause after "only "
  double share = 0;          ///< the share of the right answers that have it, too
  bool is_of_depth = false;  ///< says that the obstacle is only just entered
  std::function<bool(const Features&)> holds = [](const Features&) { return true; };
};

/// A property of all failing questions and of at most half of the right ones, which all failing ones would
/// have by chance with a probability below 1 in 1000 (share^number). Limits are powers of ten; those of
/// lengths in radii are powers of two. If several properties qualify, it is the one that is rarest among the
/// right answers; if no property does, nothing.
std::optional<Circumstance> circumstance_of(const std::vector<Features>& failing,
                                            const std::vector<Features>& right);

/// One answer that went wrong.
struct Example {
  Question question;
  Answer given;
  oracle::Judgement judgement;
  Diagnosis diagnosis;
  std::string last_words = {};  ///< last line that a program wrote to its standard error meanwhile
};

/// The obstacle that the judgement rests on, else the one that is hit or contains x, else the one that the
/// answer names; nothing if none of these is an obstacle.
std::optional<ObstacleId> obstacle_in_question(const Example& example);

/// The features of its question, with respect to the obstacle that the diagnosis is about.
Features features_in(const Example& example);

/// How a new start of a program answered a finding's simplest case.
enum class Recheck {
  fails,   ///< wrong in the same way; known without asking if an engine always answers the same
  passes,  ///< not so, asked alone or kMostRepetitions times in a row
  no_time  ///< there was no time to ask
};

/// All answers that went wrong in one way.
struct Finding {
  Example simplest;                                ///< by fuzz::complexity
  std::string where;                               ///< where the simplest was met
  std::size_t count = 0;                           ///< answers
  std::optional<double> by_radii;                  ///< the largest of any
  std::map<std::string, std::size_t> by_row = {};  ///< the same answers, by the row that asked
  double share_of_plain = 0,
         share_of_hard = 0;             ///< of all plain and of all hard flights that were asked
  std::vector<Features> features = {};  ///< of the first of the questions
  std::optional<Circumstance> circumstance = {};
  Recheck recheck = Recheck::fails;
  /// If it fails: how many times a new start must be asked the simplest case until it does.
  std::size_t repetitions = 1;
  bool was_shrunk = false;  ///< the simplest is simpler than the case met at `where`

  Cause cause() const { return simplest.diagnosis.cause; }
  Severity severity() const { return simplest.diagnosis.severity; }
  /// What went wrong, and what distinguishes the questions, if known.
  std::string summary() const;
  /// The same with numbers: how many answers went wrong, and the share of right answers with the same
  /// circumstance.
  std::string explanation() const;
};

class Findings {
 public:
  /// Adds an example that was met in the row of this name.
  void add(const Example& example, const std::string& row);
  void add(const Findings& others);

  /// Adds a right answer, for comparison.
  void add_right(const Features& features) { right_.push_back(features); }

  /// All findings with their circumstances, group by group. In each group the worst comes first; among equals
  /// the one most frequent in plain flights, then in hard ones.
  /// Unsupported questions of the rows do not count as asked.
  std::vector<Finding> all(const std::deque<question::ExaminedRow>& rows) const;

 private:
  void add(const std::pair<Severity, Cause>& key, const Finding& other);

  std::map<std::pair<Severity, Cause>, Finding> findings_;
  std::vector<Features> right_;
};

}  // namespace lorentz::judge
