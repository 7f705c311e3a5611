#include <lorentz/batch.hpp>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <system_error>
#include <thread>

#include <lorentz/errors.hpp>

#include "src/engines/batch/stretch.hpp"

namespace lorentz {
namespace {

StretchKernels kernels_named(std::string_view instructions) {
  const std::vector<StretchKernels> kernels = stretch_kernels();
  if (instructions.empty()) return kernels.front();
  for (const StretchKernels& one : kernels)
    if (instructions == one.instructions) return one;
  throw UnsupportedError("this processor has no vector instructions " + std::string(instructions));
}

}  // namespace

struct Batch::Inside {
  Scene scene;
  PreparedScene prepared;
  Reduction single;
  StretchKernel kernel;

  Inside(const Scene& of_scene, std::string_view instructions)
      : scene(of_scene), prepared(prepare(of_scene)), single(of_scene) {
    kernel = kernels_named(instructions).of(prepared);
    if (std::abs(prepared.exponent) > kMaxLaneExponent) kernel = nullptr;
  }

  /// Returns the number of queries left to single flights.
  std::size_t fly(const QueryColumns& queries, const FlightColumns& flights, Time time) const;

 private:
  bool has_atom(int lattice, int atom) const;
  void ask(const QueryColumns& queries, StretchBuffer& buffer, Stretch& stretch) const;
  void tell(const StretchBuffer& buffer, const FlightColumns& flights, const Stretch& stretch) const;
  void fly_single(const QueryColumns& queries, std::size_t i, const FlightColumns& flights, Time time) const;
};

bool Batch::Inside::has_atom(int lattice, int atom) const {
  return lattice < static_cast<int>(scene.lattices.size()) && atom >= 0 &&
         atom < static_cast<int>(scene.lattices[lattice].atoms.size());
}

// Takes the caller's columns if they consist of whole vectors; otherwise copies, whose ends belong to no
// query.
void Batch::Inside::ask(const QueryColumns& queries, StretchBuffer& buffer, Stretch& stretch) const {
  const std::size_t n = queries.size();
  const bool whole = n % kMaxLanes == 0;
  const auto column = [&](const auto& given, auto* copy) -> const std::remove_pointer_t<decltype(copy)>* {
    if (given.empty()) return nullptr;
    if (whole) return given.data();
    std::fill_n(std::copy_n(given.data(), n, copy), kMaxLanes, 0);
    return copy;
  };
  stretch.count = n, stretch.left_count = 0;
  for (int k = 0; k < scene.dimension; ++k) {
    stretch.x[k] = column(queries.x[k], buffer.x[k]), stretch.v[k] = column(queries.v[k], buffer.v[k]);
    stretch.from_cell[k] = column(queries.from_cell[k], buffer.from_cell[k]);
  }
  stretch.max_time = column(queries.max_time, buffer.max_time);
  stretch.from_lattice = column(queries.from_lattice, buffer.from_lattice);
  stretch.from_atom = column(queries.from_atom, buffer.from_atom);
}

// Takes the caller's columns if they exist and consist of whole vectors; otherwise those of the buffer, which
// `tell` copies to the caller's.
void set_told(const FlightColumns& flights, std::size_t n, StretchBuffer& buffer, Stretch& stretch) {
  const bool whole = n % kMaxLanes == 0;
  const auto column = [&](const auto& given, auto* own) {
    return given.empty() || !whole ? own : given.data();
  };
  stretch.outcome = column(flights.outcome, buffer.outcome);
  stretch.stage = column(flights.stage, buffer.stage);
  stretch.time_is_rounded = column(flights.time_is_rounded, buffer.time_is_rounded);
  stretch.time = column(flights.time, buffer.time);
  for (int k = 0; k < 3; ++k) stretch.cell[k] = column(flights.cell[k], buffer.cell[k]);
  stretch.atom = buffer.atom;
}

void Batch::Inside::tell(const StretchBuffer& buffer, const FlightColumns& flights,
                         const Stretch& stretch) const {
  const std::size_t n = stretch.count;
  const auto copy = [n](const auto* told, const auto* own, const auto& wanted) {
    if (!wanted.empty() && told == own) std::copy_n(told, n, wanted.data());
  };
  copy(stretch.outcome, buffer.outcome, flights.outcome);
  copy(stretch.stage, buffer.stage, flights.stage);
  copy(stretch.time_is_rounded, buffer.time_is_rounded, flights.time_is_rounded);
  copy(stretch.time, buffer.time, flights.time);
  for (int k = 0; k < scene.dimension; ++k) copy(stretch.cell[k], buffer.cell[k], flights.cell[k]);
  if (scene.dimension == 2 && !flights.cell[2].empty()) std::fill_n(flights.cell[2].data(), n, 0);
  const auto name = [&](std::span<std::int32_t> wanted, int Bravais::*which) {
    if (wanted.empty()) return;
    if (prepared.atoms.size() == 1) return void(std::fill_n(wanted.data(), n, 0));
    for (std::size_t i = 0; i < n; ++i) wanted[i] = prepared.atoms[stretch.atom[i]].*which;
  };
  name(flights.lattice, &Bravais::lattice);
  name(flights.atom, &Bravais::atom);
}

void Batch::Inside::fly_single(const QueryColumns& queries, std::size_t i, const FlightColumns& flights,
                               Time time) const {
  const Query query = queries.query(i, scene.dimension);
  const double max_time = queries.max_time.empty() ? HUGE_VAL : queries.max_time[i];
  Flight flight;
  if (!flaw_of(query, scene, max_time))
    flight = single.fly(query, max_time, time);
  else
    flight.outcome = Outcome::error;
  flights.set(i, flight);
}

std::size_t Batch::Inside::fly(const QueryColumns& queries, const FlightColumns& flights, Time time) const {
  std::size_t left = 0;
  Stretch stretch;
  StretchBuffer buffer;
  stretch.rounded = time == Time::rounded;
  for (std::size_t begin = 0; begin < queries.size(); begin += kStretch) {
    const QueryColumns asked = queries.part(begin, std::min(kStretch, queries.size() - begin));
    const FlightColumns told = flights.part(begin);
    if (!kernel) {
      for (std::size_t i = 0; i < asked.size(); ++i) fly_single(asked, i, told, time);
      left += asked.size();
      continue;
    }
    ask(asked, buffer, stretch);
    set_told(told, asked.size(), buffer, stretch);
    kernel(prepared, stretch);
    tell(buffer, told, stretch);
    for (std::size_t i = 0; i < stretch.left_count; ++i) fly_single(asked, stretch.left_over[i], told, time);
    left += stretch.left_count;
    // Lanes check neither limits nor that the obstacle that is left belongs to an atom of the scene.
    for (std::size_t i = 0; i < asked.max_time.size(); ++i)
      if (std::isnan(asked.max_time[i])) fly_single(asked, i, told, time);
    for (std::size_t i = 0; i < asked.from_lattice.size(); ++i)
      if (asked.from_lattice[i] >= 0 && !has_atom(asked.from_lattice[i], asked.from_atom[i]))
        fly_single(asked, i, told, time);
  }
  return left;
}

Batch::Batch(const Scene& scene, std::string_view instructions)
    : inside_(std::make_unique<Inside>(scene, instructions)) {}
Batch::~Batch() = default;
Batch::Batch(Batch&&) noexcept = default;
Batch& Batch::operator=(Batch&&) noexcept = default;

const Reduction& Batch::one_at_a_time() const {
  return inside_->single;
}

std::size_t Batch::fly(const QueryColumns& queries, const FlightColumns& flights, Time time, int jobs) const {
  if (const auto flaw = flaw_of(queries, flights, inside_->scene.dimension)) throw InputError(*flaw);
  // Each free thread takes the next piece. The piece has its place in the columns, so the order is kept.
  constexpr std::size_t kPiece = 16 * kStretch;
  const std::size_t pieces = (queries.size() + kPiece - 1) / kPiece;
  std::atomic<std::size_t> next = 0, left = 0;
  const auto work = [&] {
    for (std::size_t piece; (piece = next++) < pieces;) {
      const std::size_t begin = piece * kPiece, length = std::min(kPiece, queries.size() - begin);
      left += inside_->fly(queries.part(begin, length), flights.part(begin), time);
    }
  };
  {
    std::vector<std::jthread> others;
    try {
      for (std::size_t job = 1; job < std::min<std::size_t>(std::max(jobs, 1), pieces); ++job)
        others.emplace_back(work);
    } catch (const std::system_error&) {  // those that could be started do it all
    }
    work();
  }
  return left;
}

std::vector<std::string> Batch::instruction_sets() {
  std::vector<std::string> names;
  for (const StretchKernels& kernels : stretch_kernels()) names.emplace_back(kernels.instructions);
  return names;
}

}  // namespace lorentz
