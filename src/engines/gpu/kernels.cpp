// Kernels that fly queries in columns, each thread one row after the other. Compiled by clang for graphics
// cards, each kind of scene (LORENTZ_KIND) by itself, and for the processor, where tests run them.
#include "src/engines/gpu/device.hpp"

#if !defined(LORENTZ_EMULATED_DEVICE)
#pragma clang force_cuda_host_device begin
#endif
#include "src/engines/gpu/columns.hpp"
#include "src/engines/gpu/flight.hpp"

namespace lorentz::device {

// A row's limit, and the obstacle that it leaves.
template <int D, bool kUnit, bool kBall, class Atoms>
struct AskedRow {
  const gpu::CardColumns& columns;
  std::uint64_t i;

  // False for what lanes do not check, and cells that are far away.
  LORENTZ_EACH bool is_plain(const Atoms& atoms) const {
    if (columns.max_time && !(columns.max_time[i] > 0)) return false;
    if (!columns.from_lattice || columns.from_lattice[i] < 0) return true;
    for (int k = 0; k < D; ++k) {
      const std::int64_t cell = columns.from_cell[k][i];
      if (cell <= -gpu::kFarCell || cell >= gpu::kFarCell) return false;
    }
    for (std::size_t a = 0; a < atoms.size(); ++a)
      if (leaves(atoms[a])) return true;
    return false;
  }

  static constexpr bool wants_rounded() { return true; }
  LORENTZ_EACH bool is_limited() const { return columns.max_time != nullptr; }
  LORENTZ_EACH double limit() const { return columns.max_time[i]; }
  static constexpr bool put_off(bool, const LaneEntry<D, kBall>&) { return false; }

  LORENTZ_EACH bool find_leaving(const Start<D, kUnit, kBall>& start, Leaving<D>& leaving) const {
    if (!columns.from_lattice || !leaves(*start.lattice)) return false;
    constexpr std::int64_t kFar = std::int64_t{1} << 53;
    leaving.any = true;
    for (int j = 0; j < D; ++j) {
      std::int64_t sum = -static_cast<std::int64_t>(start.home[j]);
      for (int k = 0; k < D; ++k)
        sum += columns.from_cell[k][i] * (kUnit ? k == j : start.lattice->inverse[k][j]);
      if (sum > kFar || sum < -kFar) leaving.any = false;
      leaving.n[j] = static_cast<double>(sum);
    }
    return leaving.any;
  }

 private:
  LORENTZ_EACH bool leaves(const Bravais& atom) const {
    return columns.from_lattice[i] == atom.lattice && columns.from_atom[i] == atom.atom;
  }
};

template <class Number, class Value>
LORENTZ_EACH void put(Number* column, std::uint64_t i, Value value) {
  if (column) column[i] = static_cast<Number>(value);
}

template <int D, class Flight, class Atoms>
LORENTZ_EACH void tell(const gpu::CardColumns& columns, std::uint64_t i, const Flight& flight,
                       const Atoms& atoms) {
  const bool is_limited = columns.max_time && columns.max_time[i] < HUGE_VAL;
  columns.outcome[i] = flight.found    ? Outcome::hit
                       : flight.inside ? Outcome::inside
                       : is_limited    ? Outcome::later
                                       : Outcome::never;
  put(columns.stage, i, flight.stage2 ? Stage::double_double : Stage::binary64);
  put(columns.time_is_rounded, i, flight.found);
  put(columns.time, i, flight.found ? flight.time : 0);
  const auto& atom = atoms[static_cast<std::size_t>(flight.atom)];
  const bool is_named = flight.found || flight.inside;
  put(columns.lattice, i, is_named ? atom.lattice : columns.no_lattice);
  put(columns.atom, i, is_named ? atom.atom : 0);
  for (int k = 0; k < 3; ++k) put(columns.cell[k], i, k < D && is_named ? flight.cell[k < D ? k : 0] : 0);
}

template <int D, bool kUnit, bool kBall, bool kOneAtom>
LORENTZ_EACH void fly_columns(const gpu::CardColumns& columns) {
  using Scene = Atoms<kOneAtom>;
  using Asked = AskedRow<D, kUnit, kBall, Scene>;
  const Scene atoms{columns.atoms, columns.atom_count, columns.unit, columns.inverse_unit};
  for (std::uint64_t i = columns.first + thread(); i < columns.first + columns.count; i += threads()) {
    double x[D], v[D];
    for (int k = 0; k < D; ++k)
      x[k] = columns.x[k][i * columns.x_step], v[k] = columns.v[k][i * columns.v_step];
    const Asked row{columns, i};
    LaneFlight<D, kUnit, kBall, false, Scene, Asked> flight(atoms, row, row.is_plain(atoms), x, v);
    flight.run();
    if (flight.inside || (flight.lanes.active && (!flight.found || flight.rounded))) {
      tell<D>(columns, i, flight, atoms);
    } else {
      columns.outcome[i] = Outcome::undecided;
      if (columns.left) columns.left[1 + add(columns.left, 1)] = i;
    }
  }
}

}  // namespace lorentz::device

#if !defined(LORENTZ_EMULATED_DEVICE)
#pragma clang force_cuda_host_device end
#endif

#define LORENTZ_KIND(name, ...)                                              \
  LORENTZ_KERNEL(columns_##name)(const lorentz::gpu::CardColumns* columns) { \
    lorentz::device::fly_columns<__VA_ARGS__>(*columns);                     \
  }
#ifdef LORENTZ_ONE_KIND
LORENTZ_ONE_KIND
#else
#include "src/engines/gpu/kinds.inc"
#endif
