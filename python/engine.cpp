#include "python/engine.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <lorentz/errors.hpp>
#include "python/signals.hpp"

namespace lorentz::python {
namespace {

// The number of rows that are flown together: few enough for the cache, enough to keep threads busy. For
// engines that are slow per row, few enough that Ctrl-C does not wait.
std::size_t rows_together(const question::EngineInfo& engine, int jobs) {
  const std::size_t together = engine.traits.together;
  return together > 0 ? together * static_cast<std::size_t>(jobs) : 16;
}

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

// Copies rows of an array of any layout to columns, all components of a row at once, so that each row is
// loaded into the cache once.
template <std::size_t components, class Number>
void copy_rows(const py::array& array, std::size_t first, std::size_t count, std::vector<Number>* columns) {
  std::array<Number*, components> to;
  for (std::size_t k = 0; k < components; ++k) columns[k].resize(count), to[k] = columns[k].data();
  const py::ssize_t row = array.strides(0), component = array.ndim() == 2 ? array.strides(1) : 0;
  const char* from = static_cast<const char*>(array.data()) + static_cast<py::ssize_t>(first) * row;
  for (std::size_t i = 0; i < count; ++i, from += row)
    for (std::size_t k = 0; k < components; ++k)
      std::memcpy(to[k] + i, from + static_cast<py::ssize_t>(k) * component, sizeof(Number));
}

template <class Number>
void copy_vectors(const py::array& array, std::size_t first, std::size_t count,
                  std::array<std::vector<Number>, 3>& columns) {
  if (array.shape(1) == 2)
    copy_rows<2>(array, first, count, columns.data());
  else
    copy_rows<3>(array, first, count, columns.data());
}

// The engine of this name. Throws InputError if it does not support this number of threads.
question::EngineInfo checked(const std::string& name, int jobs) {
  question::EngineInfo engine = own_engine(name);
  if (jobs < 1 || jobs > 1024) throw InputError("jobs: needs a number from 1 to 1024");
  if (jobs > 1 && engine.traits.together == 0)
    throw InputError("jobs: only the engines batch, certified-batch and gpu use more than one thread");
  return engine;
}

// Throws the error of the first bad row from reason `begin` on.
void refuse_first(const AnswerRows& answers, std::size_t begin) {
  if (begin == answers.reasons.size()) return;
  const RowFlaw& reason = answers.reasons[begin];
  const std::string text = "row " + std::to_string(reason.row) + ": " + reason.message;
  if (reason.unsupported) throw UnsupportedError(text);
  throw InputError(text);
}

}  // namespace

question::EngineInfo own_engine(const std::string& name) {
  question::EngineInfo engine = question::engine_named(name);
  if (!engine.is_own())
    throw InputError("engine: arrays are for engines of this program; judge() takes others");
  return engine;
}

QueryArrays QueryArrays::of(Numbers x, Numbers v, std::optional<Numbers> max_time, const py::object& from) {
  QueryArrays queries{std::move(x), std::move(v), std::move(max_time), {}, {}, {}, {}};
  if (from.is_none()) return queries;
  const auto parts = from.cast<py::tuple>();
  queries.from_lattice = parts[0].cast<QueryArrays::Integers32>();
  queries.from_atom = parts[1].cast<QueryArrays::Integers32>();
  queries.from_cell = parts[2].cast<QueryArrays::Integers64>();
  for (const auto& [row, lattice, atom, cell] :
       parts[3].cast<std::vector<std::tuple<std::size_t, int, int, std::vector<py::object>>>>()) {
    ObstacleId from{lattice, atom, {}};
    for (std::size_t k = 0; k < std::min(cell.size(), std::size_t{3}); ++k)
      from.cell[k] = integer_from(cell[k], "start_from");
    queries.large_from.emplace_back(row, from);
  }
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
  rows.count = std::min(most, count() - first);
  copy_vectors(x, first, rows.count, rows.x);
  copy_vectors(v, first, rows.count, rows.v);
  if (max_time) copy_rows<1>(*max_time, first, rows.count, &rows.max_time);
  if (from_lattice) copy_rows<1>(*from_lattice, first, rows.count, &rows.from_lattice);
  if (from_atom) copy_rows<1>(*from_atom, first, rows.count, &rows.from_atom);
  if (from_cell) copy_vectors(*from_cell, first, rows.count, rows.from_cell);
  rows.large_from.clear();
  const auto is_before = [](const auto& one, std::size_t row) { return one.first < row; };
  for (auto one = std::lower_bound(large_from.begin(), large_from.end(), first, is_before);
       one != large_from.end() && one->first < first + rows.count; ++one)
    rows.large_from.emplace_back(one->first - first, one->second);
}

PyEngine::PyEngine(const PyScene& scene, const std::string& name, std::optional<double> max_time, int jobs)
    : info_(checked(name, jobs)),
      dimension_(scene.dimension()),
      together_(rows_together(info_, jobs)),
      max_time_(max_time.value_or(question::kForEver)),
      jobs_(jobs),
      engine_(info_.in(scene.scene())) {}

std::shared_ptr<AnswerRows> PyEngine::first_hit(const QueryArrays& queries, bool refuse,
                                                std::shared_ptr<AnswerRows> out) {
  queries.check(dimension_);
  if (out && (out->count != queries.count() || out->dimension != dimension_))
    throw InputError("out: is of " + std::to_string(out->count) + " queries in " +
                     std::to_string(out->dimension) + " dimensions");
  const auto answers = out ? std::move(out) : std::make_shared<AnswerRows>();
  const py::gil_scoped_release release;
  answers->resize(queries.count(), dimension_);
  try {
    answer(queries, refuse, *answers);
  } catch (...) {
    answers->resize(queries.count(), dimension_);  // no mixture of these answers with older ones
    for (std::size_t i = 0; i < answers->count; ++i) answers->set_plain(i, Outcome::error);
    throw;
  }
  return answers;
}

void PyEngine::answer(const QueryArrays& queries, bool refuse, AnswerRows& answers) const {
  QueryRows rows;
  SignalWatch watch;
  for (std::size_t first = 0; first < queries.count(); first += rows.count) {
    const std::size_t told = answers.reasons.size();
    queries.copy(first, together_, rows);
    engine_.answer(rows, answers, first, max_time_, jobs_);
    if (refuse) refuse_first(answers, told);
    watch.look();
  }
}

}  // namespace lorentz::python
