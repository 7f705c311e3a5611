// What is wrong with an answer, in words of the problem.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "question/question.hpp"

namespace lorentz::judge {

using question::Place;
using question::Question;

/// The ways in which an answer can be wrong (docs/judge.md).
enum class Cause {
  passed_over_grazing,  ///< a later obstacle is named than the first hit, which the line enters by less than
                        ///< kGrazing of its radii
  passed_over,          ///< the same, but the line enters it by more
  never_for_grazing,  ///< the answer is `never`, but the line enters an obstacle by less than kGrazing of its
                      ///< radii
  never_for_hit,      ///< the same, but the line enters one by more
  later_for_hit,      ///< the answer is `later`, but an obstacle is entered before the limit
  false_hit_grazing,  ///< the named obstacle is missed by the line by less than kGrazing of its radii
  false_hit,          ///< the same, but missed by more
  behind,             ///< the named obstacle lies behind the start
  leaving,            ///< the named obstacle is the one that the particle leaves
  inside_unseen,      ///< the answer does not say that the start lies in an obstacle
  inside_not_so,      ///< the start does not lie in the obstacle named
  inside_another,     ///< it does, but also in one that comes before it in the order (lattice, atom, cell)
  tie,                ///< two are entered at the same time, and the later one in this order is named
  no_obstacle,        ///< the scene has no such lattice or atom
  not_the_time,       ///< the right obstacle, with another quantity as a time
  wrong_time,         ///< the right obstacle, with a time that is off by more than rounding explains
  refused,            ///< a valid question was answered with an error
  no_answer,          ///< an external engine died, fell silent, or left the question out
  bad_line,           ///< an external engine wrote an invalid line in place of the answer
  answers_nonsense    ///< an invalid question was answered
};

/// What is to blame for a finding, in the order of reports.
enum class Blame { engine, ended, protocol, rounding };
inline constexpr std::array kBlames{Blame::engine, Blame::ended, Blame::protocol, Blame::rounding};

/// An obstacle is only just met or missed if the gap is below this part of its radius.
inline constexpr double kGrazing = 1e-6;

/// How much a fault matters, the worst first. `nonsense`: the question is invalid.
enum class Severity { wrong, error, wrong_time, ill_posed, nonsense };

struct Diagnosis {
  Cause cause{};
  Severity severity{};
  /// By how many of its radii the obstacle in question is entered or missed, or x lies inside or outside it.
  /// For a wrong time: radii_off.
  std::optional<double> by_radii = {};
  std::string_view quantity = {};  ///< for a wrong time: quantity_of

  Blame blame() const;
};

/// Quantities that are given in place of the time of the entry.
inline constexpr std::string_view kDistance = "the distance (|v| times the time)",
                                  kExit = "the time of the exit from that obstacle",
                                  kNearest = "the time midway between entry and exit",
                                  kFraction = "the fraction of the limit (the time over max_time)";

/// For an answer with the right obstacle: what its time is, to 1e-6 of itself (in binary32, 1e-4), if that is
/// another quantity than the time; else empty.
std::string_view quantity_of(const Question& question, const Answer& given);

/// The diagnosis of an answer that departs from the exact one, has a wrong time, is an error, or is missing;
/// nothing for any other answer. If several obstacles are in question, it is about the one that the judgement
/// rests on.
std::optional<Diagnosis> diagnosis_of(const Question& question, const Answer& given,
                                      const oracle::Judgement& judgement);

/// "passed-over-grazing", for programs.
std::string_view name_of(Cause cause);
/// "misses what it grazes", for people.
std::string_view title_of(Cause cause);
/// "the engine's own faults"
std::string_view title_of(Blame group);
std::string_view name_of(Severity severity);

/// "passes over obstacles that the line enters by less than 1e-09 of their radii": describes all answers with
/// this cause. `by_radii`: the largest among them.
std::string sentence_of(Cause cause, std::optional<double> by_radii);

}  // namespace lorentz::judge
