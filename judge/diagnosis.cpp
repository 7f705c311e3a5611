#include "judge/diagnosis.hpp"

#include <fmt/format.h>

#include <cmath>

#include "fuzz/examine/tie.hpp"

namespace lorentz::judge {
namespace {

bool names_obstacle(const Answer& answer) {
  return answer.outcome == Outcome::hit || answer.outcome == Outcome::inside;
}

bool exists(const Question& question, const ObstacleId& obstacle) {
  return !flaw_of(Query{question.query.x, question.query.v, obstacle}, question.place->scene());
}

struct Fault {
  Cause cause;
  std::optional<double> by_radii = {};
};

Fault graded(Cause grazing, Cause gross, double gap) {
  return {std::fabs(gap) < kGrazing ? grazing : gross, std::fabs(gap)};
}

// In what follows `decisive` is the obstacle that the judgement rests on.

// The answer says that x lies in an obstacle, which must exist.
Fault of_false_inside(const Question& question, const Answer& given, const ObstacleId& decisive) {
  const double gap = question.place->margins().approach(question.query, given.obstacle).start_gap;
  if (question.exact.outcome == Outcome::inside && (gap < 0 || decisive != given.obstacle))
    return {Cause::inside_another};
  return {Cause::inside_not_so, gap};  // x lies outside: else it were the one above, or right
}

// The answer says that another obstacle is hit than the exact one, or that one is where none is.
Fault of_false_hit(const Question& question, const Answer& given, const ObstacleId& decisive) {
  const question::Place& place = *question.place;
  const oracle::Approach approach = place.margins().approach(question.query, decisive);
  if (decisive == given.obstacle) {
    if (!approach.ahead && approach.start_gap >= 0) return {Cause::behind};
    return graded(Cause::false_hit_grazing, Cause::false_hit, approach.gap);
  }
  if (fuzz::is_tie(place.scene(), place.judge(), question.query, question.exact, given)) return {Cause::tie};
  return graded(Cause::passed_over_grazing, Cause::passed_over, approach.gap);
}

// Is the obstacle that is said to be hit only touched? (Asked where the inputs need not move: such a one is
// not missed, nor does it lie behind.)
bool is_touched(const Question& question, const Answer& given) {
  return given.outcome == Outcome::hit &&
         question.place->margins().approach(question.query, given.obstacle).gap >= 0;
}

Fault of_another_answer(const Question& question, const Answer& given,
                        const std::optional<ObstacleId>& needed) {
  const Query& query = question.query;
  const Answer& exact = question.exact;
  if (names_obstacle(given) && !exists(question, given.obstacle)) return {Cause::no_such_obstacle};
  if (names_obstacle(given) && query.from == given.obstacle) return {Cause::leaving};
  // A judgement that rests on no obstacle is one of margin 0: of a tie, or of an obstacle that is touched.
  const ObstacleId& decisive = needed                        ? *needed
                               : is_touched(question, given) ? given.obstacle
                                                             : exact.obstacle;
  if (given.outcome == Outcome::inside) return of_false_inside(question, given, decisive);
  const oracle::Approach approach = question.place->margins().approach(query, decisive);
  if (exact.outcome == Outcome::inside && approach.start_gap < 0)
    return {Cause::inside_not_seen, std::fabs(approach.start_gap)};
  if (given.outcome == Outcome::hit) return of_false_hit(question, given, decisive);
  return graded(Cause::never_for_grazing, Cause::never_for_hit, approach.gap);
}

constexpr std::array<std::string_view, kCauses> kCauseNames{"passed-over-grazing",
                                                            "passed-over",
                                                            "never-for-grazing",
                                                            "never-for-hit",
                                                            "false-hit-grazing",
                                                            "false-hit",
                                                            "behind",
                                                            "leaving",
                                                            "inside-unseen",
                                                            "inside-not-so",
                                                            "inside-another",
                                                            "tie",
                                                            "no-obstacle",
                                                            "not-the-time",
                                                            "wrong-time",
                                                            "refused",
                                                            "no-answer",
                                                            "answers-nonsense"};

}  // namespace

std::optional<Diagnosis> diagnosis_of(const Question& question, const Answer& given,
                                      const oracle::Judgement& judgement) {
  using oracle::Verdict;
  if (judgement.wrong_time)
    return Diagnosis{judgement.other_quantity ? Cause::other_quantity : Cause::wrong_time,
                     Severity::wrong_time};
  if (judgement.verdict == Verdict::error) return Diagnosis{Cause::refused, Severity::error};
  if (judgement.verdict == Verdict::missing) return Diagnosis{Cause::no_answer, Severity::error};
  const bool wrong = judgement.verdict == Verdict::wrong;
  if (!wrong && judgement.verdict != Verdict::ill_posed) return std::nullopt;
  if (!question.is_query()) return Diagnosis{Cause::answered_nonsense, Severity::nonsense};
  const Fault fault = of_another_answer(question, given, judgement.obstacle);
  return Diagnosis{fault.cause, wrong ? Severity::wrong : Severity::ill_posed, fault.by_radii};
}

std::string_view name_of(Cause cause) {
  return kCauseNames[static_cast<std::size_t>(cause)];
}

std::string_view name_of(Severity severity) {
  constexpr std::string_view kSeverityNames[] = {"wrong", "error", "wrong-time", "ill-posed", "nonsense"};
  return kSeverityNames[static_cast<int>(severity)];
}

std::string power_of_ten_above(double x) {
  return fmt::format("{:g}", std::pow(10, std::floor(std::log10(x)) + 1));
}

std::string sentence_of(Cause cause, std::optional<double> by_radii) {
  const auto up_to = [&](const char* what, const char* how) {
    return by_radii ? fmt::format("{} ({} by up to {:.3g} of its radii)", what, how, *by_radii)
                    : std::string(what);
  };
  const auto below = [&](const char* what) {
    return by_radii && *by_radii > 0
               ? fmt::format("{} by less than {} of their radii", what, power_of_ten_above(*by_radii))
               : fmt::format("{} at one point only", what);
  };
  switch (cause) {
    case Cause::passed_over_grazing:
      return below("passes over obstacles that the line enters");
    case Cause::passed_over:
      return up_to("passes over the obstacle that is hit first, and names a later one", "entered");
    case Cause::never_for_grazing:
      return below("says never of lines that enter obstacles");
    case Cause::never_for_hit:
      return up_to("says never where an obstacle is hit", "entered");
    case Cause::false_hit_grazing:
      return below("hits obstacles that the line misses");
    case Cause::false_hit:
      return up_to("hits an obstacle that the line misses", "missed");
    case Cause::behind:
      return "hits an obstacle that lies behind the start";
    case Cause::leaving:
      return "hits the obstacle that the particle leaves (from), which is to be ignored";
    case Cause::inside_not_seen:
      return up_to("does not see that the start lies inside an obstacle", "inside");
    case Cause::inside_not_so:
      return up_to("says inside of an obstacle that the start lies outside of", "outside");
    case Cause::inside_another:
      return "names, of several obstacles that contain the start, another than the first by name";
    case Cause::tie:
      return "names, of obstacles that are entered at the same time, another than the first by name";
    case Cause::no_such_obstacle:
      return "names an obstacle that the scene does not have";
    case Cause::other_quantity:
      return "gives, for the right obstacle, something else than the time at which it is entered";
    case Cause::wrong_time:
      return "gives times of the right obstacle that are off by more than rounding of the inputs explains";
    case Cause::refused:
      return "calls a valid question an error";
    case Cause::no_answer:
      return "gives no answer: it dies, falls silent, or writes something that is no answer";
    case Cause::answered_nonsense:
      return "answers invalid questions, where error is right";
  }
  return "";
}

}  // namespace lorentz::judge
