// Answers that went wrong, by cause.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "judge/circumstance.hpp"
#include "judge/diagnosis.hpp"

namespace lorentz::judge {

/// One answer that went wrong.
struct Example {
  Question question;
  Answer given;
  oracle::Judgement judgement;
  Diagnosis diagnosis;
  std::string last_words = {};  ///< the last line that a program wrote to its standard error meanwhile
};

/// The one that the judgement rests on, else the one that is hit or contains x, else the one that is named; nothing if
/// none of these is an obstacle.
std::optional<ObstacleId> obstacle_in_question(const Example& example);

/// Of its question, about the obstacle that the diagnosis is about.
Features features_in(const Example& example);

/// What a new start of a program made of a finding's simplest case.
enum class Recheck {
  fails,   ///< it went wrong in the same way; of an engine that always answers the same this is known
  passes,  ///< it did not, asked alone or kMostRepetitions times in a row
  no_time  ///< there was no time to see
};

/// All answers that went wrong in one way.
struct Finding {
  Example simplest;                                ///< by fuzz::complexity
  std::string where;                               ///< it was met first
  std::size_t count = 0;                           ///< answers
  std::optional<double> by_radii;                  ///< the most of any
  std::map<std::string, std::size_t> by_row = {};  ///< the same answers, by the row that asked
  double share_of_plain = 0,
         share_of_hard = 0;             ///< of all the plain flights that were asked; of the hard ones
  std::vector<Features> features = {};  ///< of the questions, the first of them
  std::optional<Circumstance> circumstance = {};
  Recheck recheck = Recheck::fails;
  /// If it fails: the number of times that a new start must be asked the simplest case until it does.
  std::size_t repetitions = 1;
  bool was_shrunk = false;  ///< the simplest is not what was met at `where`, but simpler

  Cause cause() const { return simplest.diagnosis.cause; }
  Severity severity() const { return simplest.diagnosis.severity; }
  /// What went wrong, and what sets the questions apart, if that is known.
  std::string summary() const;
  /// The same with numbers: of how many, and of how many right answers it is true as well.
  std::string explanation() const;
};

/// How many questions a row asked.
struct AskedOf {
  std::size_t number = 0;
  bool is_hard = false;  ///< chosen to be difficult
};
/// By the row's name.
using Asked = std::map<std::string, AskedOf>;

class Findings {
 public:
  /// Met in the row of this name.
  void add(const Example& example, const std::string& row);
  void add(const Findings& others);

  /// A right answer, for comparison.
  void add_right(const Features& features) { right_.push_back(features); }

  /// Group by group; in each the worst first, of these the most frequent in plain flights, then in hard ones.
  /// With their circumstances.
  std::vector<Finding> all(const Asked& asked) const;

 private:
  std::map<std::pair<Severity, Cause>, Finding> findings_;
  std::vector<Features> right_;
};

}  // namespace lorentz::judge
