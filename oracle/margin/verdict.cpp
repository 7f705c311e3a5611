#include <lorentz/verdict.hpp>

#include <cmath>

#include <lorentz/errors.hpp>
#include "oracle/margin/departure.hpp"

namespace lorentz::oracle {

namespace {

void check_tolerance(double ulps) {
  if (!(ulps >= 0)) throw InputError("ulps: must not be below zero or NaN");
}

}  // namespace

struct Judge::Impl {
  PerturbedScene scene;
  std::optional<double> time_tolerance;
  StartInside start;

  // For another answer than the exact one.
  Judgement judge_departure(const Query& query, const Answer& exact, const Answer& given, double ulps) const {
    Departure needed{kInfinity};
    bool used_tolerance = false;
    if (given.outcome == Outcome::never || !flaw_of(Query{query.x, query.v, given.obstacle}, scene.scene()))
      needed = scene.with(query, [&]<std::size_t D>(const PerturbedQuery<D>& perturbed) {
        DepartureBound<D> bound(perturbed, exact, ulps, time_tolerance, start == StartInside::miss);
        const Departure departure = bound.of(given);
        used_tolerance = bound.used_tolerance();
        return departure;
      });
    // With a tolerance of 0 nothing is forgiven, not even a tie.
    const bool forgiven = (ulps > 0 || used_tolerance) && needed.ulps <= ulps;
    return {forgiven ? Verdict::ill_posed : Verdict::wrong, {}, needed.ulps, false, false, needed.obstacle};
  }

  // By the rules `zero` and `exit` a hit of an obstacle that contains x stands for `inside`, and its time is judged as
  // such. Whether x lies in it is decided within the tolerance.
  Judgement judge_start(const Query& query, const Answer& exact, const Answer& given, double ulps) const {
    const Answer truth = as_inside(query, exact), said = as_inside(query, given);
    const bool is_inside = truth.outcome == Outcome::inside;
    if (truth.outcome == said.outcome && truth.obstacle == said.obstacle)
      return given.outcome == Outcome::hit ? judge_start_time(query, exact, given, is_inside, ulps)
                                           : Judgement{Verdict::agree};
    if (start == StartInside::exit && is_inside && said.outcome == Outcome::inside)
      return judge_order_of_exits(query, exact.obstacle, given.obstacle, ulps);
    const Judgement judgement = judge_departure(query, truth, said, ulps);
    if (said.outcome != Outcome::hit || query.from == said.obstacle) return judgement;
    const Judgement within = judge_departure(query, truth, Answer::inside(said.obstacle), ulps);
    return within.departs < judgement.departs ? within : judgement;
  }

  // The time is that of entry or, by the rule `exit` from inside, of exit; either if x is inside or not within the
  // tolerance.
  Judgement judge_start_time(const Query& query, const Answer& exact, const Answer& given, bool is_inside,
                             double ulps) const {
    const bool at_exit = is_inside && start == StartInside::exit;
    Judgement judgement{Verdict::agree};
    if (!given.time) return judgement;
    judge_time(query, {exact.obstacle, at_exit ? ChordEnd::exit : ChordEnd::entry, *exact.time}, *given.time,
               ulps, judgement);
    if (!judgement.wrong_time || start != StartInside::exit || ulps == 0) return judgement;
    const ChordEnd other = at_exit ? ChordEnd::entry : ChordEnd::exit;
    const double margin = scene.with(query, [&]<std::size_t D>(const PerturbedQuery<D>& perturbed) {
      return to_double(
          perturbed.atom_of(exact.obstacle).margin_of_containing(perturbed.centre_of(exact.obstacle)), kHuge);
    });
    if (margin > ulps) return judgement;
    Judgement excused{Verdict::agree};
    judge_time(query, {exact.obstacle, other, rounded_time(query, exact.obstacle, other)}, *given.time, ulps,
               excused);
    return excused.wrong_time ? judgement : excused;
  }

  bool contains(const Query& query, const ObstacleId& obstacle) const {
    return scene.with(query, [&](const auto& perturbed) {
      return perturbed.centre_of(obstacle).c2 < perturbed.atom_of(obstacle).view().radius2;
    });
  }

  // `inside` in place of a hit of an obstacle that contains x.
  Answer as_inside(const Query& query, const Answer& answer) const {
    if (answer.outcome != Outcome::hit || query.from == answer.obstacle ||
        flaw_of(Query{query.x, query.v, answer.obstacle}, scene.scene()))
      return answer;
    return contains(query, answer.obstacle) ? Answer::inside(answer.obstacle) : answer;
  }

  // Both contain x. The one that is left later is ill-posed if the inputs' ulps can make up for the difference.
  Judgement judge_order_of_exits(const Query& query, const ObstacleId& first, const ObstacleId& named,
                                 double ulps) const {
    const double departs = scene.with(query, [&]<std::size_t D>(const PerturbedQuery<D>& perturbed) {
      const Real later = time_in_own_units(perturbed, named, ChordEnd::exit) -
                         time_in_own_units(perturbed, first, ChordEnd::exit);
      const Real change =
          change_of_time(perturbed, named, ChordEnd::exit) + change_of_time(perturbed, first, ChordEnd::exit);
      return to_double(later / change, kHuge);
    });
    return {
        ulps > 0 && departs <= ulps ? Verdict::ill_posed : Verdict::wrong, {}, departs, false, false, named};
  }

  // Judges the times that are given for the right obstacle. A right answer may give neither.
  Judgement judge_times(const Query& query, const Answer& exact, const Answer& given, double ulps) const {
    Judgement judgement{Verdict::agree};
    if (exact.time && given.time)
      judge_time(query, {exact.obstacle, ChordEnd::entry, *exact.time}, *given.time, ulps, judgement);
    if (!given.exit_time) return judgement;
    Judgement of_exit;
    const double exit =
        exact.exit_time ? *exact.exit_time : rounded_time(query, exact.obstacle, ChordEnd::exit);
    judge_time(query, {exact.obstacle, ChordEnd::exit, exit}, *given.exit_time, ulps, of_exit);
    if (!judgement.wrong_time && of_exit.wrong_time) judgement.ulps = of_exit.ulps;
    judgement.wrong_time |= of_exit.wrong_time;
    judgement.other_quantity |= of_exit.other_quantity;
    judgement.departs = std::max(judgement.departs, of_exit.departs);
    return judgement;
  }

  // When the line enters or leaves an obstacle, correctly rounded.
  struct ExactTime {
    const ObstacleId& obstacle;
    ChordEnd end;
    double time;
  };

  // A time is wrong if it is off by more than k times the change that an ulp in each input can make, and by more than k
  // of its own ulps. If there is a tolerance of times, it is wrong if it is off by more than that.
  void judge_time(const Query& query, const ExactTime& exact, double given, double ulps,
                  Judgement& judgement) const {
    const double its = std::fabs(given - exact.time) / ulp(exact.time, scene.precision());
    if (std::isfinite(its)) judgement.ulps = its;
    if (given == exact.time || given == rounded(exact.time, scene.precision())) return;
    if (time_tolerance && std::isinf(*time_tolerance)) {
      judgement.ulps.reset();
      return;
    }
    const bool is_tolerated = time_tolerance ? is_within(*time_tolerance, exact.time, given)
                                             : judgement.ulps && *judgement.ulps <= ulps;
    if (is_tolerated) return;
    judgement.departs = in_conditions(query, exact, given);
    judgement.wrong_time = time_tolerance || ulps == 0 || judgement.departs > ulps;
    judgement.other_quantity =
        judgement.wrong_time && judgement.departs > other_quantity_from(scene.precision());
  }

  static bool is_within(double tolerance, double exact, double given) {
    if (!std::isfinite(exact) || !std::isfinite(given)) return false;
    return abs(Real(given) - Real(exact)) <= Real(tolerance) * abs(Real(exact));
  }

  double rounded_time(const Query& query, const ObstacleId& obstacle, ChordEnd end) const {
    return scene.with(query, [&]<std::size_t D>(const PerturbedQuery<D>& perturbed) {
      const ExactQuery<D>& exact = perturbed.query();
      const ExactEntry<D> meeting = exact.meeting(perturbed.scene(), obstacle);
      return round_to_binary64(end == ChordEnd::exit ? exact.exit_time_of(meeting) : exact.time_of(meeting));
    });
  }

  // The error of the time, divided by the change that an ulp in each input makes (at least an ulp of the
  // time). The exact time may be beyond the precision's range; an infinite time counts as the first power of
  // two there.
  double in_conditions(const Query& query, const ExactTime& exact, double given) const {
    if (std::isnan(given)) return kInfinity;
    const Real told =
        std::isinf(given) ? times_power_of_two(Real(std::copysign(1, given)), first_beyond()) : Real(given);
    return scene.with(query, [&]<std::size_t D>(const PerturbedQuery<D>& perturbed) {
      const Real time = std::isfinite(exact.time) ? Real(exact.time)
                                                  : time_in_own_units(perturbed, exact.obstacle, exact.end);
      const Real change = std::max(change_of_time(perturbed, exact.obstacle, exact.end),
                                   Real(ulp(exact.time, scene.precision())));
      return to_double(abs(time - told) / change, kHuge);
    });
  }

  long first_beyond() const { return scene.precision() == NumberFormat::binary64 ? 1024 : 128; }
};

Judge::Judge(const Scene& scene, const Claim& claim)
    : impl_(std::make_unique<const Impl>(
          Impl{PerturbedScene(scene, claim.precision), claim.time_tolerance, claim.inside})) {
  if (claim.time_tolerance && !(*claim.time_tolerance >= 0))
    throw InputError("time_tolerance: must not be below zero or NaN");
}
Judge::Judge(Judge&&) noexcept = default;
Judge& Judge::operator=(Judge&&) noexcept = default;
Judge::~Judge() = default;

Judgement Judge::judge(const Query& query, const Answer& exact, const Answer& given, double ulps) const {
  check_tolerance(ulps);
  if (exact.outcome == Outcome::error) return {Verdict::error};
  switch (given.outcome) {
    case Outcome::undecided:
      return {Verdict::undecided};
    case Outcome::later:
      return {Verdict::undecided};  // it looked no farther
    case Outcome::error:
      return {given.unsupported ? Verdict::unsupported : Verdict::error};
    default:
      break;
  }
  if (exact.outcome == Outcome::hit || exact.outcome == Outcome::inside)
    checked(exact.obstacle, impl_->scene.scene());
  const bool by_other_rule = impl_->start != StartInside::inside && impl_->start != StartInside::unsupported;
  if (by_other_rule && given.outcome == Outcome::inside) return {Verdict::wrong, {}, kInfinity};
  if (by_other_rule && impl_->start != StartInside::miss)
    return impl_->judge_start(query, exact, given, ulps);
  const bool names_obstacle = given.outcome != Outcome::never;
  if (given.outcome == exact.outcome && (!names_obstacle || given.obstacle == exact.obstacle))
    return impl_->judge_times(query, exact, given, ulps);
  return impl_->judge_departure(query, exact, given, ulps);
}

bool Judge::contains(const Query& query, const ObstacleId& obstacle) const {
  return impl_->contains(query, obstacle);
}

std::optional<std::vector<ExcusedAnswer>> Judge::excused(const Query& query, const Answer& exact, double ulps,
                                                         std::size_t most) const {
  check_tolerance(ulps);
  return impl_->scene.with(query, [&]<std::size_t D>(const PerturbedQuery<D>& perturbed) {
    return excused_answers<D>(perturbed, exact, ulps, most);
  });
}

}  // namespace lorentz::oracle
