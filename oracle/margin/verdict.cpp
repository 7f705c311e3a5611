#include <lorentz/verdict.hpp>

#include <cmath>

#include <lorentz/errors.hpp>
#include "oracle/margin/departure.hpp"
#include "oracle/margin/excused.hpp"

namespace lorentz::oracle {

namespace {

void check_tolerance(double ulps) {
  if (!(ulps >= 0)) throw InputError("ulps: must not be below zero or NaN");
}

}  // namespace

struct Judge::Impl {
  PerturbedScene scene;
  std::optional<double> time_tolerance;

  // Judges the times that are given for the right obstacle. A right answer may give neither.
  Judgement judge_times(const Query& query, const Answer& exact, const Answer& given, double ulps) const {
    Judgement judgement{Verdict::agree};
    if (exact.time && given.time)
      judge_time(query, {exact.obstacle, End::entry, *exact.time}, *given.time, ulps, judgement);
    if (!given.exit_time) return judgement;
    Judgement of_exit;
    const double exit = exact.exit_time ? *exact.exit_time : exit_time(query, exact.obstacle);
    judge_time(query, {exact.obstacle, End::exit, exit}, *given.exit_time, ulps, of_exit);
    judgement.wrong_time |= of_exit.wrong_time;
    judgement.other_quantity |= of_exit.other_quantity;
    judgement.departs = std::max(judgement.departs, of_exit.departs);
    return judgement;
  }

  // When the line enters or leaves an obstacle, correctly rounded.
  struct ExactTime {
    const ObstacleId& obstacle;
    End end;
    double time;
  };

  // A time is wrong if it is off by more than k times the change that an ulp in each input can make, and by more than k
  // of its own ulps. If there is a tolerance of times, it is wrong if it is off by more than that.
  void judge_time(const Query& query, const ExactTime& exact, double given, double ulps,
                  Judgement& judgement) const {
    const double its = off(exact.time, given);
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

  // The error of the time, in ulps.
  double off(double exact, double given) const {
    return std::fabs(given - exact) / ulp(exact, scene.precision());
  }

  static bool is_within(double tolerance, double exact, double given) {
    if (!std::isfinite(exact) || !std::isfinite(given)) return false;
    return abs(Real(given) - Real(exact)) <= Real(tolerance) * abs(Real(exact));
  }

  double exit_time(const Query& query, const ObstacleId& obstacle) const {
    return scene.with(query, [&]<std::size_t D>(const PerturbedQuery<D>& perturbed) {
      const ExactQuery<D>& exact = perturbed.query();
      return round_to_binary64(exact.exit_time_of(exact.meeting(perturbed.scene(), obstacle)));
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
    : impl_(
          std::make_unique<const Impl>(Impl{PerturbedScene(scene, claim.precision), claim.time_tolerance})) {
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
  const bool names_obstacle = given.outcome != Outcome::never;
  if (given.outcome == exact.outcome && (!names_obstacle || given.obstacle == exact.obstacle))
    return impl_->judge_times(query, exact, given, ulps);
  Departure needed{kInfinity};
  bool used_tolerance = false;
  if (!names_obstacle || !flaw_of(Query{query.x, query.v, given.obstacle}, impl_->scene.scene()))
    needed = impl_->scene.with(query, [&]<std::size_t D>(const PerturbedQuery<D>& perturbed) {
      DepartureBound<D> bound(perturbed, exact, ulps, impl_->time_tolerance);
      const Departure departure = bound.of(given);
      used_tolerance = bound.used_tolerance();
      return departure;
    });
  // With a tolerance of 0 nothing is forgiven, not even a tie.
  const bool forgiven = (ulps > 0 || used_tolerance) && needed.ulps <= ulps;
  return {forgiven ? Verdict::ill_posed : Verdict::wrong, {}, needed.ulps, false, false, needed.obstacle};
}

std::optional<std::vector<ExcusedAnswer>> Judge::excused(const Query& query, const Answer& exact, double ulps,
                                                         std::size_t most) const {
  check_tolerance(ulps);
  return impl_->scene.with(query, [&]<std::size_t D>(const PerturbedQuery<D>& perturbed) {
    return excused_answers<D>(perturbed, exact, ulps, most);
  });
}

}  // namespace lorentz::oracle
