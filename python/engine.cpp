#include "python/engine.hpp"

#include <algorithm>
#include <cstring>

#include <lorentz/errors.hpp>

namespace lorentz::python {
namespace {

// Rows that are flown together: so few that they stay in the cache, so many that threads have enough.
constexpr std::size_t kRowsTogether = 4096;
constexpr std::size_t kRowsBetweenSignals = 1 << 14;

std::string shape_text(const py::array& array) {
  std::string text = "(";
  for (py::ssize_t i = 0; i < array.ndim(); ++i)
    text += (i == 0 ? "" : ", ") + std::to_string(array.shape(i));
  return text + (array.ndim() == 1 ? ",)" : ")");
}

void check_shape(const py::array& array, const char* name, py::ssize_t count, int components) {
  const bool fits = components == 0
                        ? array.ndim() == 1 && array.shape(0) == count
                        : array.ndim() == 2 && array.shape(0) == count && array.shape(1) == components;
  if (fits) return;
  const std::string second = components == 0 ? "" : " " + std::to_string(components);
  throw InputError(std::string(name) + ": has the shape " + shape_text(array) + ", needs (" +
                   std::to_string(count) + "," + second + ")");
}

// Numbers in every layout, `stride` bytes apart.
template <class Number>
void append(const py::array& array, std::size_t first, std::size_t count, int component,
            std::vector<Number>& column) {
  const py::ssize_t stride = array.strides(0);
  const char* from = static_cast<const char*>(array.data()) + static_cast<py::ssize_t>(first) * stride;
  if (array.ndim() == 2) from += component * array.strides(1);
  column.resize(count);
  for (std::size_t i = 0; i < count; ++i, from += stride) std::memcpy(&column[i], from, sizeof(Number));
}

// Of a column engine of that name.
const std::string& checked(const std::string& name, int threads) {
  check_own_engine(name);
  if (threads < 1 || threads > 1024) throw InputError("threads: needs a number from 1 to 1024");
  if (threads > 1 && !compare::traits_of(name).in_bulk)
    throw InputError("threads: only the engines batch and certified-batch use more than one");
  return name;
}

void refuse_first(const AnswerRows& answers, std::size_t begin) {
  for (std::size_t i = begin; i < answers.reasons.size(); ++i)
    if (const AnswerRows::Reason& reason = answers.reasons[i]; !reason.unsupported)
      throw InputError("row " + std::to_string(reason.row) + ": " + reason.message);
}

}  // namespace

void check_own_engine(const std::string& name) {
  compare::check_name(name);
  if (compare::is_command(name) || compare::is_guest(name))
    throw InputError("engine: arrays are for engines of this program; judge() takes others");
}

void look_for_signals() {
  const py::gil_scoped_acquire gil;
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
}

QueryArrays QueryArrays::of(Numbers x, Numbers v, std::optional<Numbers> max_time, const py::object& from) {
  QueryArrays queries{std::move(x), std::move(v), std::move(max_time), {}, {}, {}};
  if (from.is_none()) return queries;
  const auto parts = from.cast<py::tuple>();
  queries.from_lattice = parts[0].cast<QueryArrays::Integers32>();
  queries.from_atom = parts[1].cast<QueryArrays::Integers32>();
  queries.from_cell = parts[2].cast<QueryArrays::Integers64>();
  return queries;
}

void QueryArrays::check(int dimension) const {
  const py::ssize_t rows = x.ndim() == 0 ? 0 : x.shape(0);
  check_shape(x, "x", rows, dimension);
  check_shape(v, "v", rows, dimension);
  if (max_time) check_shape(*max_time, "max_time", rows, 0);
  if (from_lattice) check_shape(*from_lattice, "start_from.lattice", rows, 0);
  if (from_atom) check_shape(*from_atom, "start_from.atom", rows, 0);
  if (from_cell) check_shape(*from_cell, "start_from.cell", rows, dimension);
}

void QueryArrays::copy(std::size_t first, std::size_t most, QueryRows& rows) const {
  rows.clear();
  rows.count = std::min(most, count() - first);
  for (int k = 0; k < static_cast<int>(x.shape(1)); ++k) {
    append(x, first, rows.count, k, rows.x[k]);
    append(v, first, rows.count, k, rows.v[k]);
    if (from_cell) append(*from_cell, first, rows.count, k, rows.from_cell[k]);
  }
  if (max_time) append(*max_time, first, rows.count, 0, rows.max_time);
  if (from_lattice) append(*from_lattice, first, rows.count, 0, rows.from_lattice);
  if (from_atom) append(*from_atom, first, rows.count, 0, rows.from_atom);
}

PyEngine::PyEngine(const PyScene& scene, const std::string& name, std::optional<double> max_time, int threads)
    : name_(checked(name, threads)),
      dimension_(scene.dimension()),
      together_(kRowsTogether * static_cast<std::size_t>(threads)),
      engine_(name_, scene.scene(), max_time, threads) {}

std::shared_ptr<AnswerRows> PyEngine::first_hit(const QueryArrays& queries, bool refuse,
                                                std::shared_ptr<AnswerRows> out) {
  queries.check(dimension_);
  if (out && (out->count != queries.count() || out->dimension != dimension_))
    throw InputError("out: is of " + std::to_string(out->count) + " queries in " +
                     std::to_string(out->dimension) + " dimensions");
  const auto answers = out ? std::move(out) : std::make_shared<AnswerRows>();
  const py::gil_scoped_release release;
  const std::lock_guard lock(in_use_);
  answers->resize(queries.count(), dimension_);
  QueryRows rows;
  for (std::size_t first = 0, looked = 0; first < queries.count(); first += rows.count) {
    const std::size_t told = answers->reasons.size();
    queries.copy(first, together_, rows);
    engine_.answer_from(first, rows, *answers);
    if (refuse) refuse_first(*answers, told);
    if (first >= looked + kRowsBetweenSignals) look_for_signals(), looked = first;
  }
  return answers;
}

}  // namespace lorentz::python
