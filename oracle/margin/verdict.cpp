#include <lorentz/verdict.hpp>

#include <cmath>
#include <limits>

#include "oracle/exact/cylinder.hpp"
#include "oracle/margin/corridor.hpp"
#include "oracle/margin/situation.hpp"

namespace lorentz::oracle {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kHuge = 1e300;  // reported for what is more

// By how many ulps the inputs must move for an answer to be right, computed until it is certain that they are
// more than the tolerance.
template <std::size_t D>
class Hearing {
 public:
  Hearing(const Situation<D>& situation, const Answer& exact, double ulps)
      : situation_(situation), exact_(exact), ulps_(ulps) {}

  double departure(const Answer& given) {
    switch (given.outcome) {
      case Outcome::hit:
        hear_hit(given.obstacle);
        break;
      case Outcome::inside:
        hear_inside(given.obstacle);
        break;
      default:
        hear_never();
    }
    return departs_;
  }

 private:
  bool condemned() const { return departs_ > ulps_; }
  void needs(const Real& margin) { departs_ = std::max(departs_, to_double(margin, kHuge)); }

  // X is entered, or missed by no more than k; nothing contains x or is entered earlier with more than k to
  // spare.
  void hear_hit(const ObstacleId& id) {
    const Uncertain<D>& atom = situation_.atom_of(id);
    const Centre<D> centre = situation_.centre_of(id);
    if (situation_.is_from(atom, centre.point.n)) departs_ = kInfinity;
    if (centre.h2 >= atom.rho2()) needs(atom.margin_of_meeting(centre));
    if (centre.c2 < atom.view().radius2) needs(atom.margin_of_containing(centre));
    if (centre.s <= 0) needs(atom.margin_of_ahead(centre));
    if (!condemned()) hear_containing([](const Uncertain<D>&, const ZVec<D>&) { return true; });
    if (!condemned() && exact_.outcome == Outcome::hit)
      hear_earlier(atom, centre, situation_.atom_of(exact_.obstacle), situation_.centre_of(exact_.obstacle));
    for (const Uncertain<D>& other : situation_.atoms())
      if (!condemned()) hear_all_earlier(atom, centre, other);
  }

  // X contains x, or nearly; no smaller one does with more than k to spare.
  void hear_inside(const ObstacleId& id) {
    const Uncertain<D>& atom = situation_.atom_of(id);
    const Centre<D> centre = situation_.centre_of(id);
    if (situation_.is_from(atom, centre.point.n)) departs_ = kInfinity;
    if (centre.c2 >= atom.view().radius2) needs(atom.margin_of_containing(centre));
    if (condemned()) return;
    const auto key = std::tuple(id.lattice, id.atom, centre.point.n);
    hear_containing([&](const Uncertain<D>& other, const ZVec<D>& n) {
      return std::tuple(other.lattice(), other.atom(), n) < key;
    });
  }

  // Nothing contains x with more than k to spare, and there is an open corridor that contains x, whose
  // direction is within k ulps of v.
  void hear_never() {
    hear_containing([](const Uncertain<D>&, const ZVec<D>&) { return true; });
    if (!condemned() && exact_.outcome != Outcome::never && !open_near(situation_, ulps_))
      departs_ = kInfinity;
  }

  // The obstacles that contain x, of those that count.
  template <class Counts>
  void hear_containing(const Counts& counts) {
    if (exact_.outcome != Outcome::inside) return;
    for (const Uncertain<D>& atom : situation_.atoms()) {
      const View<D>& view = atom.view();
      visit_ball<D>(view.basis, view.offset, view.radius2,
                    [&](const LatticePoint<D>& first, const LatticePoint<D>& step, const Z& last) {
                      visit_extremes<D>(view.flight, first, step, last, [&](const LatticePoint<D>& point) {
                        if (!situation_.is_from(atom, point.n) && counts(atom, point.n))
                          needs(atom.margin_of_containing(Centre<D>(view.flight, point)));
                      });
                      return condemned();
                    });
      if (condemned()) return;
    }
  }

  // Obstacles of one atom that are entered before X (which may be missed by a little: then where the line is
  // nearest).
  void hear_all_earlier(const Uncertain<D>& target, const Centre<D>& hit, const Uncertain<D>& atom) {
    const View<D>& view = atom.view();
    const Cylinder<D> cylinder(view, atom.rho2());
    const Z end = ceiling(target.time_of(hit) * real(view.flight.v2)) + root_below(atom.rho2()) + 1;
    const RowVisitor<D> visit = [&](const LatticePoint<D>& first, const LatticePoint<D>& step,
                                    const Z& last) {
      visit_extremes<D>(view.flight, first, step, last, [&](const LatticePoint<D>& point) {
        hear_earlier(target, hit, atom, Centre<D>(view.flight, point));
      });
      return condemned();
    };
    if (end >= 1)
      cylinder.cut(1, end, [&](const Stretch<D>& stretch) { return cylinder.visit(stretch, visit); });
  }

  // One obstacle that may be entered before X: with how much to spare?
  void hear_earlier(const Uncertain<D>& target, const Centre<D>& hit, const Uncertain<D>& atom,
                    const Centre<D>& centre) {
    const bool is_target = &atom == &target && centre.point.n == hit.point.n;
    if (is_target || situation_.is_from(atom, centre.point.n)) return;
    if (centre.s <= 0 || centre.h2 >= atom.rho2() || centre.c2 < atom.view().radius2) return;
    const Z chord2 = target.rho2() - hit.h2, grazing = chord2 > 0 ? chord2 : Z(0);
    if (compare_entries(centre.s, atom.rho2() - centre.h2, atom.view().flight.v2, hit.s, grazing,
                        target.view().flight.v2) > 0)
      return;
    Real spare = atom.margin_of_meeting(centre);
    if (spare <= ulps_) return;
    if (chord2 > 0)
      spare = std::min(spare, margin_of_order(situation_.ulps(), atom, centre, target, hit));
    else
      spare = std::min(spare, Real((target.time_of(hit) - atom.time_of(centre)) /
                                   largest_change(situation_.ulps(), atom, atom.arrival(centre))));
    needs(spare);
  }

  const Situation<D>& situation_;
  const Answer& exact_;
  const double ulps_;
  double departs_ = 0;
};

}  // namespace

struct Judge::Impl {
  Situations situations;

  // Off by more than k times what an ulp in each input can make of the time, and by more than k of its own
  // ulps?
  Judgement judge_time(const Query& query, const Answer& exact, const Answer& given, double ulps) const {
    Judgement judgement{Verdict::agree};
    if (!exact.time || !given.time || *given.time == *exact.time) {
      if (exact.time && given.time && std::isfinite(*exact.time)) judgement.ulps = 0;
      return judgement;
    }
    const double off = std::fabs(*given.time - *exact.time);
    if (std::isfinite(off)) {
      judgement.ulps = off / ulp(*exact.time);
      if (*judgement.ulps <= ulps) return judgement;
    }
    double excess = kInfinity;
    if (std::isfinite(*given.time))
      excess = situations.with(query, [&]<std::size_t D>(const Situation<D>& situation) {
        // The exact time may lie beyond binary64.
        const Real far = std::isfinite(off)
                             ? Real(off)
                             : Real(time_in_own_units(situation, exact.obstacle) - Real(*given.time));
        const Real change = change_of_time(situation, exact.obstacle);
        return to_double(far / std::max(change, Real(ulp(*exact.time))), kHuge);
      });
    if (excess > ulps) judgement = {Verdict::wrong, judgement.ulps, excess, true};
    return judgement;
  }
};

Judge::Judge(const Scene& scene) : impl_(std::make_unique<const Impl>(Impl{Situations(scene)})) {}
Judge::Judge(Judge&&) noexcept = default;
Judge& Judge::operator=(Judge&&) noexcept = default;
Judge::~Judge() = default;

Judgement Judge::judge(const Query& query, const Answer& exact, const Answer& given, double ulps) const {
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
  const bool names_obstacle = given.outcome != Outcome::never;
  if (given.outcome == exact.outcome && (!names_obstacle || given.obstacle == exact.obstacle))
    return given.outcome == Outcome::hit ? impl_->judge_time(query, exact, given, ulps)
                                         : Judgement{Verdict::agree};
  double departs = kInfinity;
  if (!names_obstacle || !flaw_of(Query{query.x, query.v, given.obstacle}, impl_->situations.scene()))
    departs = impl_->situations.with(query, [&]<std::size_t D>(const Situation<D>& situation) {
      return Hearing<D>(situation, exact, ulps).departure(given);
    });
  return {departs <= ulps ? Verdict::ill_posed : Verdict::wrong, {}, departs};
}

}  // namespace lorentz::oracle
