// Lists the answers that the judge forgives. Every candidate is searched and judged: obstacles that are met,
// or missed by at most the tolerance, up to the first one that is entered with more to spare; obstacles that
// contain x, or nearly; and `never`.
#include "oracle/margin/perturbed_query.hpp"

#include <algorithm>
#include <set>
#include <tuple>

#include "oracle/margin/departure.hpp"

namespace lorentz::oracle {
namespace {

template <std::size_t D>
class ExcusedSearch {
 public:
  ExcusedSearch(const PerturbedQuery<D>& perturbed, const Answer& exact, double ulps, std::size_t most)
      : query_(perturbed), exact_(exact), ulps_(ulps), most_(most) {}

  std::optional<std::vector<ExcusedAnswer>> run() {
    look_around();
    if (!is_inside_) look_along();
    if (!is_never_out_ && !is_too_much_) judge(Answer::never());
    if (is_too_much_) return std::nullopt;
    std::stable_sort(found_.begin(), found_.end(),
                     [](const ExcusedAnswer& a, const ExcusedAnswer& b) { return a.ulps < b.ulps; });
    return found_;
  }

 private:
  // The range of the search in radii, as powers of two. A hit beyond kFarthestHit is too far away for a list.
  static constexpr long kFarthestHit = 100, kFarthest = 160;
  static constexpr int kMostRows = 10'000;  // of one stretch

  void judge(const Answer& answer) {
    const bool names_one = answer.outcome != Outcome::never;
    if (answer.outcome == exact_.outcome && (!names_one || answer.obstacle == exact_.obstacle)) return;
    DepartureBound<D> bound(query_, exact_, ulps_, std::nullopt);
    const double needed = bound.of(answer).ulps;
    is_too_much_ |= (judged_steps_ += bound.passed_over()) > kMostPassedOver;
    if (needed <= ulps_) found_.push_back({answer, needed});
    is_too_much_ |= found_.size() > most_;
  }

  static Answer hit_of(const ObstacleId& obstacle) {
    Answer answer;
    answer.outcome = Outcome::hit, answer.obstacle = obstacle;
    return answer;
  }

  static constexpr long kStretch = 20;  // the cost of a stretch of the line, in obstacles

  // Returns whether the budget is exceeded.
  bool spend(long steps) {
    is_too_much_ |= (budget_ -= steps) < 0;
    return is_too_much_;
  }

  // Looks at the points of a row, from the nearest to the farthest, until `look` returns true.
  template <class Look>
  void look_at_row(const View<D>& view, LatticePoint<D> point, LatticePoint<D> step, const Z& last,
                   const Look& look) {
    if (dot(view.velocity.v, step.p) < 0) {
      point.add_multiple(last, step);
      step.negate();
    }
    for (Z k = 0; k <= last && !spend(1) && !look(Centre<D>(view.velocity, point)); ++k)
      point.add_multiple(1, step);
  }

  // The obstacles that contain x, or nearly.
  void look_around() {
    for (const Uncertain<D>& atom : query_.atoms()) {
      const View<D>& view = atom.view();
      const auto look = [&](const Centre<D>& centre) {
        if (query_.is_from(atom, centre.point.n)) return false;
        const bool is_near = is_excused(atom.margin_of_containing(centre)),
                   contains = centre.c2 < view.radius2;
        is_inside_ |= contains && !is_near;
        if (contains || is_near) judge(Answer::inside(query_.id_of(atom, centre.point.n)));
        return false;
      };
      const Z wide = ceiling(real(view.radius) + Real(ulps_) * atom.largest_change(Real(0)));
      const auto look_there = [&](const LatticePoint<D>& first, const LatticePoint<D>& step, const Z& last) {
        look_at_row(view, first, step, last, look);
        return is_too_much_;
      };
      if (view.rank == 0)  // what completes the lattice may be shorter than `wide`
        look(query_.centre_of({atom.lattice(), atom.atom(), {}}));
      else
        visit_ball<D>(view.basis, view.offset, wide * wide, look_there);
    }
  }

  bool is_excused(const Real& margin) const { return to_double(margin, kHuge) <= ulps_; }

  // The obstacles along the flight, in windows of time that double.
  void look_along() {
    if (exact_.outcome == Outcome::hit) {
      const Uncertain<D>& hit = query_.atom_of(exact_.obstacle);
      const Centre<D> centre = query_.centre_of(exact_.obstacle);
      is_too_much_ |= !is_order_certain(hit, centre);  // then all its translates are excused, to first order
      note_certain(hit, centre);
    }
    const std::optional<Real> last = end_of_scene();
    Real low = 0, high = longest_radius();
    const Real farthest = times_power_of_two(high, kFarthest);
    is_too_much_ |=
        exact_.outcome == Outcome::hit && time_of(exact_.obstacle) > times_power_of_two(high, kFarthestHit);
    for (; low < farthest && !is_too_much_; low = high, high *= 2) {
      if ((until_ && low > *until_) || (last && low > *last)) return;
      const Real end = until_ ? std::min(high, *until_) : high;
      for (const Uncertain<D>& atom : query_.atoms()) look(atom, low, end);
      judge_candidates();
    }
    // Even a slightly uncertain direction reaches other obstacles farther on. (A zero component is exact.)
    is_too_much_ |= std::ranges::count_if(query_.ulps().v, [](const Real& ulp) { return ulp > 0; }) > 1;
  }

  Real time_of(const ObstacleId& obstacle) const {
    return query_.atom_of(obstacle).time_of(query_.centre_of(obstacle));
  }

  // The time beyond which no obstacle comes near, if no lattice fills space.
  std::optional<Real> end_of_scene() const {
    Real latest = 0;
    for (const Uncertain<D>& atom : query_.atoms()) {
      const std::optional<Z> last = last_s(atom.view());
      if (!last) return std::nullopt;
      latest = std::max(latest, Real(real(*last) / real(atom.view().velocity.v2)));
    }
    return latest;
  }

  // The longest radius, in time.
  Real longest_radius() const {
    Real longest = 0;
    for (const Uncertain<D>& atom : query_.atoms())
      longest = std::max(longest, Real(real(atom.view().radius) / sqrt(real(atom.view().velocity.v2))));
    return longest;
  }

  void look(const Uncertain<D>& atom, const Real& low, const Real& high) {
    const View<D>& view = atom.view();
    if (view.rank == 0) {
      if (low == 0) weigh(atom, query_.centre_of({atom.lattice(), atom.atom(), {}}));
      return;
    }
    const Real v2 = real(view.velocity.v2);
    const Real wide = real(view.radius) + Real(ulps_) * atom.largest_change_across(high);
    const Z reach2 = ceiling(wide * wide * v2);
    is_too_much_ |= view.rank < D && wide > 3 * real(view.radius);  // stretches reach no farther (Stretches)
    // The first window includes what lies behind the start by no more than is excused.
    const Z begin = low == 0 ? Z(-ceiling(wide * sqrt(v2))) : ceiling(low * v2) - 1;
    const Stretches<D> stretches(view, reach2);
    const RowVisitor<D> visit = [&](const LatticePoint<D>& first, const LatticePoint<D>& step,
                                    const Z& last) {
      look_at_row(view, first, step, last, [&](const Centre<D>& centre) {
        weigh(atom, centre);
        return until_ && atom.time_of(centre) > *until_;
      });
      return is_too_much_;
    };
    stretches.cut(begin, ceiling(high * v2), [&](const RowStretch<D>& stretch) {
      is_too_much_ |= stretch.rows > kMostRows;
      return spend(kStretch) || stretches.visit(stretch, visit, kMostRows);
    });
  }

  void weigh(const Uncertain<D>& atom, const Centre<D>& centre) {
    if (query_.is_from(atom, centre.point.n)) return;
    if (centre.c2 < atom.view().radius2 && !is_excused(atom.margin_of_containing(centre))) return;
    if (centre.s <= 0 && !is_excused(atom.margin_of_ahead(centre))) return;
    if (centre.h2 >= atom.rho2() && !is_excused(atom.margin_of_meeting(centre))) return;
    note_certain(atom, centre);
    candidates_.push_back({atom.time_of(centre), atom.lattice(), atom.atom(), centre.point.n});
    if (candidates_.size() > 4 * most_ && !until_) judge_candidates();
  }

  // Notes an obstacle that is entered with more to spare. An obstacle that is entered later than this one, by
  // more than the uncertainty of their order, is not excused.
  void note_certain(const Uncertain<D>& atom, const Centre<D>& centre) {
    if (!atom.is_entered(centre) || is_excused(atom.margin_of_meeting(centre))) return;
    is_never_out_ |= is_met_for_certain(atom, centre);
    const Real until =
        atom.time_of(centre) + 2 * Real(ulps_) * atom.change_of_time(centre) + 4 * longest_radius();
    if (!until_ || until < *until_) until_ = until;
  }

  // False if the obstacle is grazed so closely that, to first order, it cannot be told apart from its
  // translates along the flight, because its time depends so much on v.
  bool is_order_certain(const Uncertain<D>& atom, const Centre<D>& centre) const {
    const PerturbedArrival<D> arrival = atom.arrival(centre);
    Real slope = 0;
    for (std::size_t i = 0; i < D; ++i) slope += abs(arrival.by_x[i]) * query_.ulps().v[i];
    return 2 * Real(ulps_) * slope < 1;
  }

  // True if the obstacle is met however the inputs move by at most the tolerance. (A margin is only
  // first-order: in space it may be too large if the line passes near the centre.) Then no open corridor is
  // that near, and the search for one is not needed.
  bool is_met_for_certain(const Uncertain<D>& atom, const Centre<D>& centre) const {
    const Real v2 = real(atom.view().velocity.v2),
               room = real(atom.view().radius) - sqrt(real(centre.h2) / v2);
    return room > 2 * Real(ulps_) * atom.largest_change_across(real(centre.s) / v2);
  }

  // Judges the candidates in order of time, each once, because neighbouring stretches share their ends.
  void judge_candidates() {
    std::sort(candidates_.begin(), candidates_.end());
    for (const auto& [time, lattice, atom, n] : candidates_) {
      if (is_too_much_ || (until_ && time > *until_)) break;
      if (judged_.insert({lattice, atom, n}).second) judge(hit_of({lattice, atom, to_cell<D>(n)}));
    }
    candidates_.clear();
  }

  using Candidate = std::tuple<Real, int, int, ZVec<D>>;  // the time, the obstacle

  const PerturbedQuery<D>& query_;
  const Answer& exact_;
  const double ulps_;
  const std::size_t most_;
  std::vector<ExcusedAnswer> found_;
  std::vector<Candidate> candidates_;
  std::set<std::tuple<int, int, ZVec<D>>> judged_;
  std::optional<Real> until_;  // no obstacle entered later is excused
  bool is_inside_ = false;     // by more than is excused
  bool is_never_out_ = false;
  bool is_too_much_ = false;
  long budget_ = kExcusedBudget;
  std::size_t judged_steps_ = 0;  // of all answers that were judged
};

}  // namespace

template <std::size_t D>
std::optional<std::vector<ExcusedAnswer>> excused_answers(const PerturbedQuery<D>& perturbed,
                                                          const Answer& exact, double ulps,
                                                          std::size_t most) {
  return ExcusedSearch<D>(perturbed, exact, ulps, most).run();
}

template std::optional<std::vector<ExcusedAnswer>> excused_answers(const PerturbedQuery<2>&, const Answer&,
                                                                   double, std::size_t);
template std::optional<std::vector<ExcusedAnswer>> excused_answers(const PerturbedQuery<3>&, const Answer&,
                                                                   double, std::size_t);

}  // namespace lorentz::oracle
