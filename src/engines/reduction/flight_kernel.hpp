// One flight among one atom's obstacles: the inside test, the search, and the cell and time of the obstacle
// found. Private to the reduction engine, which compiles it twice, with and without the fused multiply-add.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <tuple>
#include <type_traits>

#include "src/engines/reduction/atom_direction.hpp"
#include "src/engines/reduction/atom_start.hpp"
#include "src/engines/reduction/entry_time.hpp"
#include "src/engines/reduction/kernels.hpp"
#include "src/engines/reduction/search_2d.hpp"
#include "src/engines/reduction/search_3d.hpp"
#include "src/engines/reduction/sparse_search.hpp"

namespace lorentz {

/// The first of one atom's obstacles that is entered.
template <class Arch, int D, SceneModel kModel, bool kBall>
class AtomFlight {
  static constexpr bool kUnit = kModel == SceneModel::unit, kTurned = kUnit && kBall;
  using SearchInCrystal =
      std::conditional_t<D == 2, Search2<Arch, kUnit, kBall>, Search3<Arch, kUnit, kBall>>;

 public:
  using Direction = std::conditional_t<kModel == SceneModel::sparse && kBall, SparseDirection<D>,
                                       AtomDirection<D, kUnit, kBall>>;

  Outcome outcome = Outcome::undecided;
  Stage stage = Stage::binary64;

  AtomFlight() {
    for (Wide& n : N_) n = Wide();
  }

  /// False if the start is too far away.
  bool start(const Bravais& lattice, const Vec& x) { return start_.template set<Arch>(lattice, x); }

  /// Does x lie in an obstacle (`from` excepted)?
  Decision inside(const Task& task) { return start_.inside(task, N_, stage); }

  /// Obstacles that are entered after max_time may be ignored.
  void find(const Direction& to, const Task& task, double max_time) {
    if constexpr (kModel == SceneModel::sparse || kModel == SceneModel::several)
      if (start_.lattice->rank < D) return search<SparseSearch<D, kBall>>(to, task, max_time);
    if constexpr (kModel != SceneModel::sparse) search<SearchInCrystal>(to, task, max_time);
  }

  /// Sets the cell of the obstacle found, in the scene's own primitive vectors; false if 64 bits do not hold
  /// it.
  bool cell(std::array<std::int64_t, 3>& cell) const { return start_.set_cell(N_, cell); }

  /// The same for a flight; where the task has a place for the larger cell of a hit, it is there.
  bool set_cell(const Task& task, Flight& flight) const {
    return cell(flight.cell) || set_far_cell(task, flight);
  }

  /// The obstacle found.
  std::optional<UnroundedObstacle> unrounded(const Task& task) const { return start_.unrounded(task, N_); }
  bool has_smaller_name(const AtomFlight& other) const {
    const auto name = [](const AtomFlight& flight) {
      std::array<std::int64_t, 3> cell{};
      flight.cell(cell);
      return std::tuple(flight.start_.lattice->lattice, flight.start_.lattice->atom, cell);
    };
    return name(*this) < name(other);
  }

  double rough_time(double& error) const { return entry_.rough_time(error); }

  EntryTime<Arch, D, kUnit, kBall> time(const Vec& v) const {
    return {*start_.lattice, start_.offset, N_, entry_, v};
  }

 private:
  template <class Search>
  [[gnu::always_inline]] void search(const Direction& to, const Task& task, double max_time) {
    const double s_limit = (max_time * to.direction.v2 + to.direction.s_rho) * (1 + kAmple);
    Offset<SplitProduct, D> turned;
    if constexpr (kTurned) to.octant.apply(start_.offset.d, turned.d), turned.error = start_.offset.error;
    Search search(*start_.lattice, to.direction, kTurned ? turned : start_.offset,
                  UnroundedLook<D, kUnit, kBall>{task, start_});
    Wide leaving[D];
    if (task.ray.from && start_.find_from(task.ray.from, leaving)) {
      Wide there[D];
      if constexpr (kTurned) to.octant.apply(leaving, there);
      outcome = search.run(kTurned ? there : leaving, s_limit);
    } else {
      outcome = search.run(nullptr, s_limit);
    }
    stage = std::max(stage, search.found.stage);
    if (outcome == Outcome::hit) take(to, search.found);
  }

  void take(const Direction& to, const Found<D>& found) {
    entry_.s = found.s, entry_.s_error = found.s_error;
    entry_.slack = found.slack, entry_.slack_error = found.slack_error;
    entry_.v2 = to.direction.v2;
    if constexpr (!kBall && D == 3) std::copy(to.direction.along, to.direction.along + D, entry_.along);
    if constexpr (!kBall && D == 2) {
      entry_.euclidean_v2 = to.direction.shape.euclidean_v2;
      entry_.across = found.h * to.direction.shape.skew;
      entry_.v2_error = 2 * to.direction.shape.rho_error;  // v2 is (rho / r)^2
    }
    if constexpr (kTurned)
      to.octant.undo(found.N, N_);
    else
      std::copy(found.N, found.N + D, N_);
  }

  [[gnu::noinline]] bool set_far_cell(const Task& task, Flight& flight) const {
    if (flight.outcome != Outcome::hit) return false;
    flight.is_far = true;
    return task.cell && start_.set_cell(N_, *task.cell);
  }

  AtomStart<D, kUnit, kBall> start_;
  Entry<SplitProduct, D, kBall> entry_;
  Wide N_[D];  ///< from the home cell to the obstacle found (zero until then), in the short basis
};

}  // namespace lorentz
