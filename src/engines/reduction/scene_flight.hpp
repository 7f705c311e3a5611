// A flight among all atoms of a scene: one atom, or the earliest hit among several. Private to the reduction
// engine, which compiles it for processors with the fused multiply-add and for those without.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "src/engines/reduction/flight_kernel.hpp"
#include "src/engines/reduction/kernels.hpp"

namespace lorentz {

template <class AtomFlight>
inline void set_time(const AtomFlight& found, const Task& task, Flight& flight) {
  if (task.time == Reduction::Time::close) {
    flight.time = found.time(task.ray.v).close(true);
    return;
  }
  double error;
  const Wide t = found.time(task.ray.v).rare(error);
  flight.time = t.hi + (t.lo + error);
  flight.time_is_rounded = flight.time == t.hi + (t.lo - error);
}

/// A time limit, in place of a hit at that time.
struct TimeLimit {
  double time_;

  double rough_time(double& error) const { return error = 0, time_; }
  TimeLimit time(const Vec&) const { return *this; }
  Wide rare(double& error) const { return error = 0, time_; }
};

// Is one hit before the other, or before a limit? Decided in binary64, then in double-double.
template <class OneFlight, class Other>
inline Decision is_sooner(const OneFlight& one, const Other& other, const Vec& v, Stage& stage) {
  double error, other_error;
  const double difference = other.rough_time(other_error) - one.rough_time(error);
  const Decision decision = is_positive(difference, error + other_error);
  if (decision != Decision::doubtful) return decision;
  stage = std::max(stage, Stage::double_double);
  const Wide close = other.time(v).rare(other_error) - one.time(v).rare(error);
  return is_positive(close.hi, error + other_error + kStable * std::fabs(close.hi));
}

/// If the hit is not before the limit, the outcome becomes `never`. False: undecided. (Not inlined, because
/// it would take its caller's registers.)
template <class AtomFlight>
[[gnu::noinline]] bool keep_limit(const AtomFlight& found, const Task& task, Flight& flight) {
  // No time is below zero, whatever it errs by.
  Decision sooner =
      task.max_time > 0 ? is_sooner(found, TimeLimit{task.max_time}, task.ray.v, flight.stage) : Decision::no;
  if (sooner == Decision::doubtful)
    if (const auto obstacle = found.unrounded(task)) sooner = is_entered_before(*obstacle, task.max_time);
  if (sooner == Decision::no) flight.outcome = Outcome::never;
  return sooner != Decision::doubtful;
}

/// The same without rounding, and where two are entered at once, has `one` the smaller name?
template <class OneFlight>
[[gnu::noinline]] Decision comes_first(const OneFlight& one, const OneFlight& other, const Task& task) {
  const auto a = one.unrounded(task), b = other.unrounded(task);
  const auto order = a && b ? order_of_entry(*a, *b) : std::nullopt;
  if (!order) return Decision::doubtful;
  return *order < 0 || (*order == 0 && one.has_smaller_name(other)) ? Decision::yes : Decision::no;
}

/// A flight in a scene with one atom.
template <class Arch, int D, bool kUnit, bool kBall>
inline void fly_one(const Task& task, Flight& flight) {
  const Bravais& lattice = task.scene.atoms[0];
  using Direction = AtomDirection<D, kUnit, kBall>;
  AtomFlight<Arch, D, kUnit ? SceneModel::unit : SceneModel::one_atom, kBall> atom;
  if (!atom.start(lattice, task.x)) return give_up(flight);
  const Decision inside = atom.inside(task);
  if (inside == Decision::doubtful) return give_up(flight);
  if (inside == Decision::no) {
    atom.find(Direction(Arch{}, lattice, task.ray.v), task, task.search_time);
    flight.outcome = atom.outcome;
  } else {
    flight.outcome = Outcome::inside;
  }
  flight.stage = atom.stage;
  if (flight.outcome == Outcome::hit && task.is_limited() && !keep_limit(atom, task, flight))
    return give_up(flight);
  const bool is_named = flight.outcome == Outcome::hit || flight.outcome == Outcome::inside;
  if (is_named && !atom.set_cell(task, flight)) return give_up(flight);
  if (flight.outcome == Outcome::hit) set_time(atom, task, flight);
}

/// The flights of several atoms. Those of the first few are kept from the inside tests for the searches.
template <class OneFlight>
class AtomFlights {
 public:
  /// The flight of this atom, started; null if the start is too far away.
  OneFlight* started(std::size_t atom, const Task& task) {
    OneFlight& flight = atom < kKept ? kept_[atom] : other_;
    return atom < started_ || flight.start(task.scene.atoms[atom], task.x) ? &flight : nullptr;
  }
  /// From now on the flights that are kept need not be started again.
  void keep() { started_ = kKept; }

 private:
  static constexpr std::size_t kKept = 6;
  OneFlight kept_[kKept], other_;
  std::size_t started_ = 0;
};

/// Names the obstacle of this atom that contains x: `one` of its lattice `a` or, if it has several, the smallest.
/// False: undecided.
template <class OneFlight>
[[gnu::noinline]] bool name_containing(const OneFlight& one, AtomFlights<OneFlight>& flights, std::size_t a,
                                       const Task& task, Flight& flight) {
  const std::vector<Bravais>& atoms = task.scene.atoms;
  flight.outcome = Outcome::inside;
  flight.lattice = atoms[a].lattice, flight.atom = atoms[a].atom;
  if (!one.cell(flight.cell)) return false;
  while (++a < atoms.size() && atoms[a].lattice == flight.lattice && atoms[a].atom == flight.atom) {
    OneFlight* other = flights.started(a, task);
    const Decision inside = other ? other->inside(task) : Decision::doubtful;
    if (other) flight.stage = std::max(flight.stage, other->stage);
    if (inside == Decision::no) continue;
    std::array<std::int64_t, 3> cell{};
    if (inside == Decision::doubtful || !other->cell(cell)) return false;
    flight.cell = std::min(flight.cell, cell);
  }
  return true;
}

/// Several atoms, in one lattice or several: the earliest of their hits.
template <class OneFlight, class Arch>
inline void fly_several(const Task& task, Flight& flight) {
  using Direction = typename OneFlight::Direction;
  const std::vector<Bravais>& atoms = task.scene.atoms;
  AtomFlights<OneFlight> flights;
  for (std::size_t a = 0; a < atoms.size(); ++a) {  // the smallest obstacle that contains x
    OneFlight* one = flights.started(a, task);
    if (!one) return give_up(flight);
    const Decision inside = one->inside(task);
    flight.stage = std::max(flight.stage, one->stage);
    if (inside == Decision::no) continue;
    if (inside == Decision::doubtful) return give_up(flight);
    if (!name_containing(*one, flights, a, task, flight)) give_up(flight);
    return;
  }
  flights.keep();
  flight.outcome = Outcome::never;
  OneFlight best;
  const Bravais* best_lattice = nullptr;
  std::optional<Direction> own;
  double limit = task.search_time;
  for (std::size_t a = 0; a < atoms.size(); ++a) {
    Direction::set(own, Arch{}, a > 0 ? &atoms[a - 1] : nullptr, atoms[a], task.ray.v);
    OneFlight* next = flights.started(a, task);
    if (!next) return give_up(flight);
    next->find(*own, task, limit);
    flight.stage = std::max(flight.stage, next->stage);
    if (next->outcome == Outcome::undecided) return give_up(flight);
    if (next->outcome == Outcome::never) continue;
    Decision sooner = best_lattice ? is_sooner(*next, best, task.ray.v, flight.stage) : Decision::yes;
    if (sooner == Decision::doubtful) sooner = comes_first(*next, best, task);
    if (sooner == Decision::doubtful) return give_up(flight);
    if (sooner == Decision::no) continue;
    best = *next, best_lattice = &atoms[a];
    double error;
    const double time = next->rough_time(error);
    limit = std::min(limit, time + error);
  }
  if (!best_lattice) return;
  flight.outcome = Outcome::hit;
  if (task.is_limited() && !keep_limit(best, task, flight)) return give_up(flight);
  if (flight.outcome == Outcome::never) return;
  flight.lattice = best_lattice->lattice, flight.atom = best_lattice->atom;
  if (!best.set_cell(task, flight)) return give_up(flight);
  set_time(best, task, flight);
}

template <class Arch, int D, SceneModel kModel, bool kBall>
inline void fly_with(const Task& task, Flight& flight) {
  if constexpr (kModel == SceneModel::unit || kModel == SceneModel::one_atom)
    fly_one<Arch, D, kModel == SceneModel::unit, kBall>(task, flight);
  else
    fly_several<AtomFlight<Arch, D, kModel, kBall>, Arch>(task, flight);
}

}  // namespace lorentz
