// One query with all of its uncertainty, the starting point of margins and judgements. Private to oracle/.
#pragma once

#include <deque>
#include <optional>
#include <string>
#include <vector>

#include <lorentz/errors.hpp>
#include <lorentz/margin.hpp>
#include <lorentz/verdict.hpp>
#include "oracle/margin/perturbation.hpp"

namespace lorentz::oracle {

template <std::size_t D>
class PerturbedQuery {
 public:
  PerturbedQuery(const Scene& scene, const ExactScene<D>& exact_scene, const Query& query,
                 NumberFormat precision)
      : exact_scene_(exact_scene),
        exact_(exact_scene, query, kFiner),
        ulps_(scene, query, exact_, precision) {
    for_each_atom(exact_scene,
                  [&](int l, int a) { atoms_.emplace_back(scene, exact_scene, exact_, ulps_, l, a); });
  }
  PerturbedQuery(const PerturbedQuery&) = delete;
  PerturbedQuery& operator=(const PerturbedQuery&) = delete;

  const ExactScene<D>& scene() const { return exact_scene_; }
  const ExactQuery<D>& query() const { return exact_; }
  const InputUlps<D>& ulps() const { return ulps_; }
  const std::deque<Uncertain<D>>& atoms() const { return atoms_; }

  /// The atom of an obstacle, which must exist.
  const Uncertain<D>& atom_of(const ObstacleId& id) const {
    for (const Uncertain<D>& atom : atoms_)
      if (atom.lattice() == id.lattice && atom.atom() == id.atom) return atom;
    throw InputError("obstacle: the scene has no lattice " + std::to_string(id.lattice) + " with an atom " +
                     std::to_string(id.atom));
  }

  Centre<D> centre_of(const ObstacleId& id) const {
    const Uncertain<D>& atom = atom_of(id);
    LatticePoint<D> point;
    point.n = to_zvec<D>(id.cell);
    point.p =
        oracle::centre_of<D>(exact_scene_, id.lattice, id.atom, point.n, exact_.x, exact_.length_exponent);
    if (const auto& frame = exact_scene_.lattices[id.lattice].atoms[id.atom].frame)
      point.p = frame->to_ball * point.p;
    return Centre<D>(atom.view().velocity, std::move(point));
  }

  bool is_from(const Uncertain<D>& atom, const ZVec<D>& n) const {
    const ZVec<D>* from = exact_.from_in(atom.lattice(), atom.atom());
    return from && *from == n;
  }

  static ObstacleId id_of(const Uncertain<D>& atom, const ZVec<D>& n) {
    return {atom.lattice(), atom.atom(), to_cell<D>(n)};
  }

 private:
  static constexpr long kFiner = 64;  // so that lengths far below an ulp are integers, too

  const ExactScene<D>& exact_scene_;
  ExactQuery<D> exact_;
  InputUlps<D> ulps_;
  std::deque<Uncertain<D>> atoms_;  // they refer to ulps_
};

/// True if all lattices repeat in fewer directions than the space has: a flight passes a bounded stretch of them,
/// or runs along a lattice for ever.
template <std::size_t D>
bool is_open_everywhere(const ExactScene<D>& scene) {
  return std::ranges::all_of(scene.lattices, [](const auto& lattice) { return lattice.rank < D; });
}

/// The hardest of the decisions that it is shown. Most are far easier than the hardest so far: then the margin
/// is not computed.
template <std::size_t D>
class HardestSoFar {
 public:
  const Real& margin() const { return smallest_; }
  HardestDecision decision() const {
    HardestDecision its = decision_;
    its.margin = to_double(smallest_, kLargestMargin);
    return its;
  }

  bool may_be(Estimate least) const { return !(least >= enough_); }  // NaN: nothing is known

  void containing(const Uncertain<D>& atom, const Centre<D>& centre) {
    if (may_be(atom.least_of_containing(centre)))
      see(DecisionKind::containing, atom, centre, centre.c2 < atom.view().radius2,
          atom.margin_of_containing(centre));
  }
  void meeting(const Uncertain<D>& atom, const Centre<D>& centre) {
    if (may_be(atom.least_of_meeting(centre)))
      see(DecisionKind::meeting, atom, centre, centre.h2 < atom.rho2(), atom.margin_of_meeting(centre));
  }
  void see(DecisionKind kind, const Uncertain<D>& atom, const Centre<D>& centre, bool yes, Real margin) {
    if (margin >= smallest_) return;
    decision_ = {kind, PerturbedQuery<D>::id_of(atom, centre.point.n), yes, 0};
    enough_ = estimate(margin) * (1 + 0x1p-30L);  // more than the rounding of all estimates
    smallest_ = std::move(margin);
  }

 private:
  Real smallest_ = kLargestMargin;
  Estimate enough_ = kLargestMargin;
  HardestDecision decision_;
};

/// The largest change of the time at which an obstacle is entered or left, in the query's own units.
template <std::size_t D>
Real change_of_time(const PerturbedQuery<D>& perturbed, const ObstacleId& id,
                    ChordEnd end = ChordEnd::entry) {
  return times_power_of_two(perturbed.atom_of(id).change_of_time(perturbed.centre_of(id), end),
                            perturbed.query().time_exponent());
}

/// The time at which an obstacle is entered or left, in the query's own units; it may be beyond binary64.
template <std::size_t D>
Real time_in_own_units(const PerturbedQuery<D>& perturbed, const ObstacleId& id,
                       ChordEnd end = ChordEnd::entry) {
  return times_power_of_two(perturbed.atom_of(id).time_of(perturbed.centre_of(id), end),
                            perturbed.query().time_exponent());
}

/// A scene for queries with uncertainty.
class PerturbedScene {
 public:
  PerturbedScene(const Scene& scene, NumberFormat precision)
      : scene_(scene), precision_(precision), exact_scene_(any_exact_scene(scene)) {}

  const Scene& scene() const { return scene_; }
  NumberFormat precision() const { return precision_; }

  /// Calls `work` with the query's PerturbedQuery<2> or PerturbedQuery<3>, and returns its result. Throws
  /// InputError if the query is invalid.
  template <class Work>
  auto with(const Query& query, const Work& work) const {
    checked(query, scene_);
    return std::visit(
        [&]<std::size_t D>(const ExactScene<D>& exact) {
          return work(PerturbedQuery<D>(scene_, exact, query, precision_));
        },
        exact_scene_);
  }

 private:
  Scene scene_;
  NumberFormat precision_;
  AnyExactScene exact_scene_;
};

/// True if an open corridor or channel contains x (a corridor or planar channel may miss x by `ulps` ulps),
/// and its direction is within `ulps` ulps of v in every component, where a zero is exact. The directions
/// tried are those of lattice vectors and (3D) of lattice planes, the shortest few near v. Each is decided
/// exactly. x must lie in no obstacle by more than `ulps` ulps.
template <std::size_t D>
bool open_near(const PerturbedQuery<D>& perturbed, double ulps);

/// As Judge::excused says.
template <std::size_t D>
std::optional<std::vector<ExcusedAnswer>> excused_answers(const PerturbedQuery<D>& perturbed,
                                                          const Answer& exact, double ulps, std::size_t most);

}  // namespace lorentz::oracle
