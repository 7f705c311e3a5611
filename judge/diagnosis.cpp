#include "judge/diagnosis.hpp"

#include <fmt/format.h>

#include <cmath>

#include "fuzz/campaign/examiner.hpp"
#include "src/problem/same_answer.hpp"

namespace lorentz::judge {
namespace {

// Below, diagnoses are of wrong answers, and `decisive` is the obstacle that the judgement rests on.

Diagnosis of_wrong(Cause cause, std::optional<double> by_radii = {}) {
  return {cause, Severity::wrong, by_radii};
}

Diagnosis graded(Cause grazing, Cause gross, double gap) {
  return of_wrong(std::fabs(gap) < kGrazing ? grazing : gross, std::fabs(gap));
}

// The answer says that x lies in an obstacle, which must exist.
Diagnosis of_false_inside(const Question& question, const Answer& given, const ObstacleId& decisive) {
  const double gap = question.place->margins().approach(question.query, given.obstacle).start_gap;
  if (question.exact.outcome == Outcome::inside && (gap < 0 || decisive != given.obstacle))
    return of_wrong(Cause::inside_another);
  return of_wrong(Cause::inside_not_so, gap);  // x lies outside, else it is the case above or right
}

// The answer names another obstacle than the exact one, or one where nothing is hit.
Diagnosis of_false_hit(const Question& question, const Answer& given, const ObstacleId& decisive) {
  const question::Place& place = *question.place;
  const oracle::Approach approach = place.margins().approach(question.query, decisive);
  if (decisive == given.obstacle) {
    if (!approach.ahead && approach.start_gap >= 0) return of_wrong(Cause::behind);
    return graded(Cause::false_hit_grazing, Cause::false_hit, approach.gap);
  }
  if (fuzz::is_tie(place.judge(), question.query, question.exact, given)) return of_wrong(Cause::tie);
  return graded(Cause::passed_over_grazing, Cause::passed_over, approach.gap);
}

// True if the obstacle that is said to be hit is only touched. (Asked if the inputs need not move; then it is
// not missed, nor does it lie behind.)
bool is_touched(const Question& question, const Answer& given) {
  return given.outcome == Outcome::hit &&
         question.place->margins().approach(question.query, given.obstacle).gap >= 0;
}

Diagnosis of_another_answer(const Question& question, const Answer& given,
                            const std::optional<ObstacleId>& needed) {
  const Query& query = question.query;
  const Answer& exact = question.exact;
  const bool names = names_obstacle(given);
  if (names && !names_obstacle(given, query, question.place->scene())) return of_wrong(Cause::no_obstacle);
  if (names && query.from == given.obstacle) return of_wrong(Cause::leaving);
  // A judgement that rests on no obstacle has margin 0: there is a tie, or an obstacle is touched.
  const ObstacleId& decisive = needed                        ? *needed
                               : is_touched(question, given) ? given.obstacle
                                                             : exact.obstacle;
  if (given.outcome == Outcome::inside) return of_false_inside(question, given, decisive);
  const oracle::Approach approach = question.place->margins().approach(query, decisive);
  if (exact.outcome == Outcome::inside && approach.start_gap < 0)
    return of_wrong(Cause::inside_unseen, std::fabs(approach.start_gap));
  if (given.outcome == Outcome::hit) return of_false_hit(question, given, decisive);
  if (given.outcome == Outcome::later) return of_wrong(Cause::later_for_hit);
  return graded(Cause::never_for_grazing, Cause::never_for_hit, approach.gap);
}

// How a sentence about a cause ends: by less than which power of ten of its radii an obstacle is entered or
// missed, by up to which part of them, or by how many radii along the ray a time is off.
enum class SentenceEnd { none, below, part, along };

struct CauseWords {
  std::string_view name, title, sentence;
  SentenceEnd end = SentenceEnd::none;
  std::string_view how = "";  ///< before the part
};
constexpr CauseWords kCauseWords[]{
    {"passed-over-grazing", "names a later obstacle than one it grazes",
     "passes over obstacles that the line enters", SentenceEnd::below},
    {"passed-over", "passes through an obstacle",
     "passes over an obstacle that the line enters, and names a later one", SentenceEnd::part, "entered"},
    {"never-for-grazing", "misses what it grazes", "says never of lines that enter obstacles",
     SentenceEnd::below},
    {"never-for-hit", "misses what it hits", "says never where an obstacle is hit", SentenceEnd::part,
     "entered"},
    {"later-for-hit", "misses a hit before the limit",
     "says later, where an obstacle is entered before the limit (max_time)"},
    {"false-hit-grazing", "hits what it misses by a hair", "hits obstacles that the line misses",
     SentenceEnd::below},
    {"false-hit", "hits what it misses", "hits an obstacle that the line misses", SentenceEnd::part,
     "missed"},
    {"behind", "hits what lies behind the start", "hits an obstacle that lies behind the start"},
    {"leaving", "hits the obstacle that it leaves",
     "hits the obstacle that the particle leaves (from), which is to be ignored"},
    {"inside-unseen", "starts inside unseen", "does not see that the start lies inside an obstacle",
     SentenceEnd::part, "inside"},
    {"inside-not-so", "says inside, and starts outside",
     "says inside of an obstacle that the start lies outside of", SentenceEnd::part, "outside"},
    {"inside-another", "starts inside several, and names another",
     "names one of several obstacles that contain the start, but not the first in the order (lattice, atom, "
     "cell)"},
    {"tie", "names the other of a tie",
     "names one of several obstacles that are entered at the same time, but not the first in the order "
     "(lattice, atom, cell)"},
    {"no-obstacle", "names an obstacle that does not exist",
     "names an obstacle that the scene does not have"},
    {"not-the-time", "another quantity as the time",
     "gives times of the right obstacle that are so far off that they are another quantity",
     SentenceEnd::along},
    {"wrong-time", "wrong time",
     "gives times of the right obstacle that are off by more than rounding of the inputs explains",
     SentenceEnd::along},
    {"refused", "refuses a valid question", "calls a valid question an error"},
    {"no-answer", "died or silent", "gives no answer: it dies, falls silent, or leaves the question out"},
    {"bad-line", "bad lines", "writes lines that are not answers"},
    {"answers-nonsense", "answers an invalid question", "answers invalid questions, where error is right"},
};
static_assert(std::size(kCauseWords) == static_cast<std::size_t>(Cause::answers_nonsense) + 1);

const CauseWords& words_for(Cause cause) {
  return kCauseWords[static_cast<std::size_t>(cause)];
}

}  // namespace

std::string_view quantity_of(const Question& question, const Answer& given) {
  const auto &entry = question.exact.time, &its = given.time;
  if (question.exact.outcome != Outcome::hit || !entry || !its || !std::isfinite(*its)) return {};
  const double same = question.place->claim().precision == NumberFormat::binary64 ? 1e-6 : 1e-4;
  const auto is = [&](double quantity) {
    const double size = std::fabs(quantity);
    return std::fabs(*its - quantity) <= same * size && std::fabs(*entry - quantity) > 10 * same * size;
  };
  // Nothing that is near to the time can be another quantity.
  if (std::fabs(*its - *entry) <= 8 * same * std::fabs(*its)) return {};
  const Vec& v = question.query.v;
  if (is(*entry * std::hypot(v[0], v[1], v[2]))) return kDistance;
  if (question.has_limit() && is(*entry / question.max_time)) return kFraction;
  const double exit = question::exit_time(question);
  return is(exit) ? kExit : is(*entry / 2 + exit / 2) ? kNearest : std::string_view();
}

std::optional<Diagnosis> diagnosis_of(const Question& question, const Answer& given,
                                      const oracle::Judgement& judgement) {
  using oracle::Verdict;
  if (judgement.wrong_time)
    return Diagnosis{judgement.other_quantity ? Cause::not_the_time : Cause::wrong_time, Severity::wrong_time,
                     question::radii_off(question, given), quantity_of(question, given)};
  if (judgement.verdict == Verdict::error) return Diagnosis{Cause::refused, Severity::error};
  if (judgement.verdict == Verdict::missing) return Diagnosis{Cause::no_answer, Severity::error};
  const bool is_excused = judgement.verdict == Verdict::ill_posed;
  if (judgement.verdict != Verdict::wrong && !is_excused) return std::nullopt;
  if (!question.is_query()) return Diagnosis{Cause::answers_nonsense, Severity::nonsense};
  Diagnosis diagnosis = of_another_answer(question, given, judgement.obstacle);
  if (is_excused) diagnosis.severity = Severity::ill_posed;
  return diagnosis;
}

Blame Diagnosis::blame() const {
  if (severity == Severity::ill_posed) return Blame::rounding;
  if (cause == Cause::no_answer) return Blame::ended;
  const bool is_protocol =
      cause == Cause::bad_line || cause == Cause::answers_nonsense || cause == Cause::refused;
  return is_protocol ? Blame::protocol : Blame::engine;
}

std::string_view name_of(Cause cause) {
  return words_for(cause).name;
}

std::string_view title_of(Cause cause) {
  return words_for(cause).title;
}

std::string_view title_of(Blame group) {
  constexpr std::string_view kTitles[] = {
      "the engine's own faults", "died or silent",
      "protocol: bad lines, invalid questions answered, valid ones refused",
      "of floating point, no blame (ill-posed)"};
  return kTitles[static_cast<int>(group)];
}

std::string_view name_of(Severity severity) {
  constexpr std::string_view kSeverityNames[] = {"wrong", "error", "wrong-time", "ill-posed", "nonsense"};
  return kSeverityNames[static_cast<int>(severity)];
}

std::string sentence_of(Cause cause, std::optional<double> by_radii) {
  const CauseWords& its = words_for(cause);
  std::string text(its.sentence);
  if (its.end == SentenceEnd::below)
    text += by_radii && *by_radii > 0 ? fmt::format(" by less than {:g} of their radii",
                                                    std::pow(10, std::floor(std::log10(*by_radii)) + 1))
                                      : " at one point only";
  if (its.end == SentenceEnd::part && by_radii)
    text += fmt::format(" ({} by up to {:.3g} of its radii)", its.how, *by_radii);
  if (its.end == SentenceEnd::along && by_radii && std::isfinite(*by_radii))
    text += fmt::format(", by up to {:.3g} radii along the ray", *by_radii);
  return text;
}

}  // namespace lorentz::judge
