#include "src/engines/gpu/gpu_batch.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>
#include <random>
#include <stdexcept>

#include <lorentz/errors.hpp>
#include "src/engines/batch/stretch.hpp"

namespace lorentz::gpu {
namespace {

// Rows that are copied together, and those that a launch flies where they are.
constexpr std::size_t kTogether = std::size_t{1} << 17, kThere = std::size_t{1} << 20;

// The columns for a kernel, where `in` and `out` have put them.
template <class In, class Out>
CardColumns columns_of(const QueryColumns& queries, const FlightColumns& flights, const In& in,
                       const Out& out) {
  CardColumns columns{};
  columns.count = queries.size(), columns.x_step = columns.v_step = 1;
  for (int k = 0; k < 3; ++k) {
    columns.x[k] = in(queries.x[k]), columns.v[k] = in(queries.v[k]);
    columns.from_cell[k] = in(queries.from_cell[k]), columns.cell[k] = out(flights.cell[k]);
  }
  columns.max_time = in(queries.max_time);
  columns.from_lattice = in(queries.from_lattice), columns.from_atom = in(queries.from_atom);
  columns.time = out(flights.time), columns.lattice = out(flights.lattice), columns.atom = out(flights.atom);
  columns.outcome = out(flights.outcome), columns.stage = out(flights.stage);
  columns.time_is_rounded = out(flights.time_is_rounded);
  return columns;
}

// Pinned memory, from which the card reads the rows of a launch, and to which it writes their results.
class Staging {
  static constexpr std::size_t kRow = 192;  // no row has more bytes

 public:
  explicit Staging(const Card& card) : memory_(static_cast<char*>(card.pinned(kTogether * kRow))) {}

  const CardColumns& put(const QueryColumns& queries, const FlightColumns& flights) {
    flights_ = flights;
    char* free = memory_;
    const auto next = [&]<class T>(std::span<T> column) {
      auto* const here = reinterpret_cast<std::remove_const_t<T>*>(column.empty() ? nullptr : free);
      free += column.empty() ? 0 : kTogether * sizeof(T);
      return here;
    };
    const auto in = [&](const auto& column) {
      auto* const here = next(column);
      std::ranges::copy(column, here);
      return here;
    };
    return columns_ = columns_of(queries, flights, in, next);
  }

  void take() const {
    const auto take = [&](const auto* from, const auto& to) {
      if (from) std::copy_n(from, columns_.count, to.data());
    };
    take(columns_.time, flights_.time), take(columns_.outcome, flights_.outcome);
    take(columns_.stage, flights_.stage), take(columns_.time_is_rounded, flights_.time_is_rounded);
    take(columns_.lattice, flights_.lattice), take(columns_.atom, flights_.atom);
    for (int k = 0; k < 3; ++k) take(columns_.cell[k], flights_.cell[k]);
  }

 private:
  char* const memory_;
  FlightColumns flights_;
  CardColumns columns_{};
};

}  // namespace

// The driver compiles a kernel once, and no destructor waits for a driver that has ended.
struct CardKernel {
  const Card card;
  const Kernel kernel;
  Memory columns, left;
  Staging staging[2];
  bool is_compared = false;
  std::mutex mutex;

  CardKernel(const std::string& name, unsigned number)
      : card(number),
        kernel(card, column_kernels(), name, "columns_" + name),
        columns(card, sizeof(CardColumns)),
        left(card, (kThere + 1) * sizeof(std::uint64_t)),
        staging{Staging(card), Staging(card)} {}

  static CardKernel& named(const std::string& name, unsigned number) {
    static auto& mutex = *new std::mutex;
    static auto& all = *new std::map<std::pair<std::string, unsigned>, std::unique_ptr<CardKernel>>;
    const std::lock_guard lock(mutex);
    std::unique_ptr<CardKernel>& kind = all[{name, number}];
    if (!kind) kind = std::make_unique<CardKernel>(name, number);
    return *kind;
  }

  void start(const CardColumns& its) {
    columns.put(&its, sizeof its);
    kernel.start({columns.address()});
  }
};

std::string beyond(const PreparedScene& scene) {
  if (!scene.beyond.empty()) return scene.beyond;
  if (scene.least_rank < scene.atoms[0].dimension) return "does no lattices of fewer vectors than dimensions";
  if (scene.strides) return "does no obstacles that overlap their own translates";
  if (std::abs(scene.exponent) > kMaxLaneExponent) return "does no lengths so far from 1";
  for (const Bravais& atom : scene.atoms)
    for (const auto& row : atom.inverse)
      for (const std::int64_t entry : row)
        if (entry > kFarInverse || entry < -kFarInverse) return "does no lattices as skewed";
  return "";
}

std::string kind_of(const PreparedScene& scene) {
  const bool is_unit = scene.atoms.size() == 1 && scene.atoms[0].unit;
  const char* const atoms = is_unit && scene.ellipsoids ? "unit_ellipsoid"
                            : is_unit                   ? "unit"
                            : scene.ellipsoids          ? "ellipsoids"
                            : scene.atoms.size() == 1   ? "ball"
                                                        : "balls";
  return std::string(scene.atoms[0].dimension == 2 ? "plane_" : "space_") + atoms;
}

PreparedScene prepared(const Scene& scene) {
  PreparedScene prepared = prepare(scene);
  if (const std::string why = beyond(prepared); !why.empty())
    throw InputError("gpu " + why + "; certified-batch does");
  return prepared;
}

GpuBatch::GpuBatch(const Scene& scene, const Batch& here, unsigned number)
    : prepared_(prepared(scene)),
      kind_(CardKernel::named(kind_of(prepared_), number)),
      atoms_((kind_.card.enter(), kind_.card), prepared_.atoms.size() * sizeof(Bravais)) {
  atoms_.put(prepared_.atoms.data(), prepared_.atoms.size() * sizeof(Bravais));
  static std::mutex mutex;
  const std::lock_guard lock(mutex);
  if (!kind_.is_compared) compare(here);
  kind_.is_compared = true;
}

CardColumns GpuBatch::in_scene(CardColumns columns) const {
  columns.atoms = atoms_.at<const Bravais>(), columns.atom_count = prepared_.atoms.size();
  columns.unit = prepared_.unit, columns.inverse_unit = prepared_.inverse_unit;
  return columns;
}

// The rows of one launch are copied while the card flies those of another.
std::vector<std::size_t> GpuBatch::fly(const QueryColumns& queries, const FlightColumns& flights) const {
  const std::lock_guard lock(kind_.mutex);
  kind_.card.enter();
  const Staging* before = nullptr;
  for (std::size_t begin = 0; begin < queries.size(); begin += kTogether) {
    Staging& now = kind_.staging[begin / kTogether % 2];
    const std::size_t length = std::min(kTogether, queries.size() - begin);
    const CardColumns& columns = now.put(queries.part(begin, length), flights.part(begin));
    if (before) kind_.kernel.wait();
    kind_.start(in_scene(columns));
    if (before) before->take();
    before = &now;
  }
  if (before) kind_.kernel.wait(), before->take();
  std::vector<std::size_t> left;
  for (std::size_t i = 0; i < queries.size(); ++i)
    if (flights.outcome[i] == Outcome::undecided) left.push_back(i);
  return left;
}

std::vector<std::size_t> GpuBatch::fly_there(const QueryColumns& queries,
                                             const std::array<std::size_t, 2>& steps,
                                             const FlightColumns& flights) const {
  const std::lock_guard lock(kind_.mutex);
  kind_.card.enter();
  kind_.kernel.wait();  // until all columns are written
  const auto same = [](const auto& column) { return column.data(); };
  CardColumns columns = in_scene(columns_of(queries, flights, same, same));
  columns.x_step = steps[0], columns.v_step = steps[1], columns.left = kind_.left.at<std::uint64_t>();
  columns.no_lattice = -1;
  std::vector<std::size_t> left;
  for (; columns.first < queries.size(); columns.first += columns.count) {
    columns.count = std::min(kThere, queries.size() - columns.first);
    kind_.left.clear(sizeof(std::uint64_t));
    kind_.start(columns);
    kind_.kernel.wait();
    std::uint64_t count = 0;
    kind_.left.take(&count, sizeof count);
    const std::size_t before = left.size();
    left.resize(before + count);
    kind_.left.take(left.data() + before, count * sizeof(std::uint64_t), sizeof count);
    std::sort(left.begin() + static_cast<std::ptrdiff_t>(before), left.end());
  }
  return left;
}

std::pair<Query, double> GpuBatch::query_there(const QueryColumns& queries,
                                               const std::array<std::size_t, 2>& steps, std::size_t i) const {
  kind_.card.enter();
  const auto at = [&]<class T>(std::span<const T> column, std::size_t place, T missing) {
    if (!column.empty()) kind_.card.get(&missing, column.data() + place, sizeof missing);
    return missing;
  };
  Query query;
  for (int k = 0; k < prepared_.atoms[0].dimension; ++k)
    query.x[k] = at(queries.x[k], i * steps[0], 0.0), query.v[k] = at(queries.v[k], i * steps[1], 0.0);
  const std::int32_t lattice = at(queries.from_lattice, i, -1);
  if (lattice >= 0) {
    query.from.emplace(ObstacleId{lattice, at(queries.from_atom, i, 0), {}});
    for (int k = 0; k < 3; ++k) query.from->cell[k] = at(queries.from_cell[k], i, std::int64_t{0});
  }
  return {query, at(queries.max_time, i, HUGE_VAL)};
}

void GpuBatch::set_there(const FlightColumns& flights, std::size_t i, const Flight& flight) const {
  kind_.card.enter();
  const auto set = [&]<class T>(std::span<T> column, T value) {
    if (!column.empty()) kind_.card.put(column.data() + i, &value, sizeof value);
  };
  set(flights.outcome, flight.outcome), set(flights.time, flight.time);
  set(flights.lattice, flight.lattice), set(flights.atom, flight.atom);
  for (int k = 0; k < 3; ++k) set(flights.cell[k], flight.cell[k]);
}

namespace {

// Starts among the first cells: 100 000 in any direction, and 10 000 in hard ones.
QueryTable drawn_starts(const PreparedScene& scene) {
  constexpr int kDrawn = 100'000, kHard = 10'000;
  const Bravais& atom = scene.atoms[0];
  std::mt19937_64 random(1);
  const auto uniform = [&] { return static_cast<double>(random() >> 11) * 0x1p-53; };
  QueryTable table;
  for (int i = 0; i < kDrawn + kHard; ++i) {
    Query query;
    for (int k = 0; k < atom.dimension; ++k) {
      const double share = 4 * uniform() - 2;
      for (int j = 0; j < atom.dimension; ++j) query.x[j] += share * scene.unit * atom.primitive[k][j];
      query.v[k] = 2 * uniform() - 1;
    }
    if (i >= kDrawn) make_hard(query.x.data(), query.v.data(), atom.dimension);
    table.push_back(query);
  }
  return table;
}

// What follows these flights: each near hit is left in another direction, half of them up to the time of the
// flight before.
QueryTable next_starts(const QueryTable& starts, const FlightTable& flights, int dimension) {
  QueryTable table;
  for (std::size_t i = 0; i < starts.size(); ++i) {
    const Flight flight = flights[i];
    const auto is_near = [](std::int64_t n) { return std::abs(n) < kFarCell; };
    if (flight.outcome != Outcome::hit || !std::ranges::all_of(flight.cell, is_near)) continue;
    Query query = starts[i];
    for (int k = 0; k < dimension; ++k) query.x[k] += flight.time * query.v[k];
    std::reverse(query.v.begin(), query.v.begin() + dimension);
    query.from.emplace(
        ObstacleId{flight.lattice, flight.atom, {flight.cell[0], flight.cell[1], flight.cell[2]}});
    table.push_back(query, i % 2 && flight.time > 0 ? flight.time : HUGE_VAL);
  }
  return table;
}

}  // namespace

// Flies drawn and hard starts here and there, and what follows: what the driver makes of a kernel was in no
// test.
void GpuBatch::compare(const Batch& here) const {
  QueryTable starts = drawn_starts(prepared_);
  for (const bool again : {true, false}) {
    FlightTable own, its;
    own.resize(starts.size()), its.resize(starts.size());
    std::size_t left_here = here.fly(starts.columns(), own.columns(), Batch::Time::rounded), wrong = 0,
                next = 0;
    const std::vector<std::size_t> left = fly(starts.columns(), its.columns());
    for (std::size_t i = 0; i < starts.size(); ++i) {
      const Flight flight = own[i];
      left_here += flight.outcome == Outcome::hit && !flight.time_is_rounded;
      if (next < left.size() && left[next] == i)
        ++next;
      else
        wrong += flight != its[i];
    }
    if (left.size() > left_here) wrong += left.size() - left_here;
    if (wrong > 0)
      throw std::runtime_error("the graphics card (" + kind_.card.name() + ") flies " +
                               std::to_string(wrong) + " of " + std::to_string(starts.size()) +
                               " flights to other bits than the processor; it is not used: certified-batch "
                               "flies them here");
    if (again) starts = next_starts(starts, own, prepared_.atoms[0].dimension);
  }
}

}  // namespace lorentz::gpu
