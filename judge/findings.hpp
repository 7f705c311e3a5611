// Answers that went wrong, by cause, and what distinguishes their questions from the others.
#pragma once

#include <array>
#include <deque>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "judge/diagnosis.hpp"
#include "question/examination.hpp"

namespace lorentz::judge {

/// Features of a question, by which the failing questions can be distinguished from the others.
struct Features {
  static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

  bool in_space = false;              ///< 3D
  bool zero_component = false;        ///< a component of v is 0
  std::array<bool, 3> negative = {};  ///< which components of v are below 0
  bool is_unit_speed = false;         ///< |v| is 1 within 1e-9
  bool leaving = false;               ///< `from` is given
  bool several_lattices = false, several_atoms = false, ellipsoids = false;
  bool other_cell = false;  ///< not a single unit square or cubic lattice
  bool negative_start =
      false;  ///< a coordinate of x is negative, counted in the first full lattice's vectors
  bool outside_first_cell = false;  ///< one of these is negative, or 1 or more
  Outcome outcome = Outcome::hit;   ///< the exact one
  // Lengths in units of the shortest primitive vector.
  double flight = kNone;  ///< to the obstacle that is hit
  double radius = kNone;  ///< the smallest
  double start = kNone;   ///< distance of x from the origin
  double cell = kNone;    ///< the largest absolute value in a cell, of the obstacle hit or of `from`
  double depth = kNone;   ///< by how many of its radii the line enters the obstacle that is hit
  // In the scene's own units.
  double speed = kNone;   ///< |v|
  double time = kNone;    ///< of the hit
  double chord = kNone;   ///< length in the obstacle that is hit; for an ellipsoid as in its inscribed ball
  double centre = kNone;  ///< distance of the centre of the obstacle in question from the origin
  double coordinates = kNone;  ///< the largest component of x and of the positions of atoms
  // In radii (for an ellipsoid, its smallest semiaxis).
  double distance = kNone;         ///< from x to the centre of the obstacle in question
  double start_gap = kNone;        ///< from x to the surface of the obstacle in question
  double flight_in_radii = kNone;  ///< to the obstacle that is hit, in its radii
};

/// `in_question`: the obstacle in question; nothing: the scene's only obstacle, if it has just one.
Features features_of(const Question& question, const std::optional<ObstacleId>& in_question = {});

/// What distinguishes the questions on which an engine fails.
struct Circumstance {
  std::string_view name;  ///< for programs: "flight"
  std::string text;       ///< a clause: "after flights of 100 lattice vectors or more"
  std::function<bool(const Features&)> holds = [](const Features&) { return true; };
  double Features::*quantity = nullptr;  ///< what a question needs to be compared; null: nothing
  bool is_limit = false;                 ///< on the quantity
  bool is_of_scene = false;              ///< which all questions of a row may share by accident
  std::size_t number = 0;                ///< of the failing questions, those that have it
  std::size_t of = 0;                    ///< the failing questions that were compared
  double share = 0;   ///< the share of the right answers that have it, of those with the quantity
  double weight = 0;  ///< D, as below

  double part() const { return of == 0 ? 1 : static_cast<double>(number) / static_cast<double>(of); }
  bool can_hold(const Features& f) const { return !quantity || f.*quantity >= 0; }
};

/// A circumstance covers a finding if at least this part of its questions have it.
inline constexpr double kNearlyAll = 0.9;
/// If one covers at least this part, and no other covers the finding as well, the finding is two.
inline constexpr double kClearPart = 0.1;

/// The property of at least a part `least`, and of less than `below`, of the failing questions that chance
/// explains least.
///  - Right answers are compared if they have the quantity, and the exact outcome of nearly all failing
///    questions; there must be 20 of them. At most half of them may have the property; fewer, if some failing
///    questions lack it.
///  - If each failing question had it with the probability p of a right one, a part q or more of n would have
///    it with a probability of at most exp(-n D), D = q ln(q/p) + (1-q) ln((1-q)/(1-p)) (Chernoff's bound of
///    the binomial tail; p^n if all have it). This must be at most 1 in 50 000. The largest q D is chosen.
///  - Limits are powers of ten, or of two for lengths in radii, at quantiles of the failing questions.
std::optional<Circumstance> circumstance_of(const std::vector<Features>& failing,
                                            const std::vector<Features>& right, double least = kNearlyAll,
                                            double below = 2);

/// One answer that went wrong.
struct Example {
  Question question;
  Answer given;
  oracle::Judgement judgement;
  Diagnosis diagnosis;
  std::string last_words = {};  ///< last line that a program wrote to its standard error meanwhile
  std::string row = {};         ///< of the report
  Features features = {};       ///< of a valid question, with respect to the obstacle in question
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
  Example simplest;                                ///< among the examples that the sentence is true of
  std::string where;                               ///< where the simplest was met
  std::size_t count = 0;                           ///< answers
  std::optional<double> by_radii;                  ///< the largest of any
  std::map<std::string, std::size_t> by_row = {};  ///< the same answers, by the row that asked
  double share_of_plain = 0,
         share_of_hard = 0;            ///< of all plain and of all hard flights that were asked
  std::vector<Example> examples = {};  ///< the first kKept of each row
  std::optional<Circumstance> circumstance = {};
  /// What nearly all give in place of the time (Diagnosis::quantity), and how many do.
  std::string_view quantity = {};
  std::size_t of_quantity = 0;
  bool is_part = false;  ///< of the answers with its cause: those with the circumstance, or the others
  Recheck recheck = Recheck::fails;
  /// If it fails: how many times a new start must be asked the simplest case until it does.
  std::size_t repetitions = 1;
  bool was_shrunk = false;  ///< the simplest is simpler than the case met at `where`

  static constexpr std::size_t kKept = 500;

  Cause cause() const { return simplest.diagnosis.cause; }
  Severity severity() const { return simplest.diagnosis.severity; }
  /// True if the sentence is true of this example with the finding's cause.
  bool is_about(const Example& example) const;
  /// What went wrong, and what distinguishes the questions, if known.
  std::string summary() const;
  /// The same with numbers: how many answers went wrong, and the share of right answers with the same
  /// circumstance.
  std::string explanation() const;
  /// The likely line of code and the remedy, with the document that has more (advice.cpp).
  std::string why() const;
};

class Findings {
 public:
  /// Adds an example that was met in the row of this name.
  void add(Example example, const std::string& row);
  void add(const Findings& others);

  /// Adds an answer with the right obstacle, for comparison.
  void add_right(const Features& features, bool is_time_right = true) {
    (is_time_right ? right_ : mistimed_).push_back(features);
  }

  /// All findings with their circumstances, group by group. Answers with one cause are several findings if a
  /// circumstance sets a clear part of them apart. In each group the worst comes first, and of these the one
  /// with the largest shares of plain and of hard flights; what is 20 times rarer than the most frequent
  /// comes last. Unsupported questions of the rows do not count as asked.
  std::vector<Finding> all(const std::deque<question::ExaminedRow>& rows) const;

  /// The domain of speeds, of coordinates, or of both, between powers of ten, that has at least half of the
  /// right answers and no wrong one, nor a wrong time; nothing if there is none, or if not all wrong answers
  /// are known.
  std::optional<Domain> domain_without_fault() const;

 private:
  void add(const std::pair<Severity, Cause>& key, const Finding& other);

  std::map<std::pair<Severity, Cause>, Finding> findings_;
  std::vector<Features> right_, mistimed_;
};

}  // namespace lorentz::judge
