// What an answer did wrong, in words of the problem.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "question/question.hpp"

namespace lorentz::judge {

using question::Place;
using question::Question;

/// The ways of being wrong. docs/judge.md has them.
enum class Cause {
  passed_over_grazing,  ///< a later obstacle is named than the one that is hit first; the line enters that by
                        ///< less than kGrazing of its radii
  passed_over,          ///< the same, and it enters by more
  never_for_grazing,  ///< `never` is said, and the line enters an obstacle by less than kGrazing of its radii
  never_for_hit,      ///< the same, and it enters one by more
  false_hit_grazing,  ///< an obstacle is named that the line misses by less than kGrazing of its radii
  false_hit,          ///< or by more
  behind,             ///< one that lies behind the start
  leaving,            ///< the one that the particle leaves
  inside_not_seen,    ///< the start lies in an obstacle
  inside_not_so,      ///< the start does not lie in the obstacle named
  inside_another,     ///< it does, but in a smaller one, too
  tie,                ///< two are entered at the same time, and the larger one is named
  no_such_obstacle,   ///< the scene has no such lattice or atom
  other_quantity,     ///< the right obstacle with something else than the time of its entry
  wrong_time,         ///< the right obstacle, and a time that is off by more than rounding explains
  refused,            ///< a valid question is called an error
  no_answer,          ///< another program died, fell silent, or left the question out
  bad_line,           ///< it wrote something in the answer's place that is no answer
  answered_nonsense   ///< an invalid question was answered
};
inline constexpr int kCauses = 19;

/// Whose findings are, in the order in which reports tell of them.
enum class Blame { engine, ended, protocol, rounding };
inline constexpr std::array kBlames{Blame::engine, Blame::ended, Blame::protocol, Blame::rounding};

/// Below this part of an obstacle's radius it is only just met or missed.
inline constexpr double kGrazing = 1e-6;

/// How much it matters, the worst first. `nonsense`: the question is invalid.
enum class Severity { wrong, error, wrong_time, ill_posed, nonsense };

struct Diagnosis {
  Cause cause{};
  Severity severity{};
  /// By so many of its radii the obstacle in question is entered or missed, or x lies inside or outside of
  /// it. Of a wrong time: radii_off.
  std::optional<double> by_radii = {};

  Blame blame() const;
};

bool names_obstacle(const Answer& answer);

/// Of an answer that departs from the exact one, or has a wrong time, or is an error, or missing; else
/// nothing. Where several obstacles are in question it is about the one that the judgement rests on.
std::optional<Diagnosis> diagnosis_of(const Question& question, const Answer& given,
                                      const oracle::Judgement& judgement);

/// "passed-over-grazing", for programs.
std::string_view name_of(Cause cause);
/// "misses what it grazes", for people.
std::string_view title_of(Cause cause);
/// "the engine's own faults"
std::string_view title_of(Blame group);
std::string_view name_of(Severity severity);

/// "passes over obstacles that the line enters by less than 1e-09 of their radii": of all answers that went
/// wrong so, `by_radii` the most of any.
std::string sentence_of(Cause cause, std::optional<double> by_radii);

/// The least power of ten above x > 0, as text.
std::string power_of_ten_above(double x);

}  // namespace lorentz::judge
