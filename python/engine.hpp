// First hits of arrays, by any engine of this program. Private to python/.
#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "python/scene.hpp"
#include "question/column_engine.hpp"

namespace lorentz::python {

/// Throws InputError unless it is the name of an engine of this program.
question::EngineInfo own_engine(const std::string& name);

/// Columns of queries where NumPy has them, of any layout.
struct QueryArrays {
  Numbers x, v;                     ///< (N, d)
  std::optional<Numbers> max_time;  ///< (N,)
  using Integers32 = py::array_t<std::int32_t, py::array::forcecast>;
  using Integers64 = py::array_t<std::int64_t, py::array::forcecast>;
  std::optional<Integers32> from_lattice, from_atom;           ///< (N,); a lattice below 0: none
  std::optional<Integers64> from_cell;                         ///< (N, d)
  std::vector<std::pair<std::size_t, ObstacleId>> large_from;  ///< as in QueryRows

  /// `from`: None, or a tuple (lattice, atom, cell, large), the last a list of (row, lattice, atom, cell).
  static QueryArrays of(Numbers x, Numbers v, std::optional<Numbers> max_time, const py::object& from);

  /// Throws InputError if the shapes do not fit together.
  void check(int dimension) const;
  std::size_t count() const { return static_cast<std::size_t>(x.shape(0)); }

  /// The rows from `first` on, at most `most`, over what `rows` has of these queries. Needs no interpreter.
  void copy(std::size_t first, std::size_t most, QueryRows& rows) const;
};

class PyEngine {
 public:
  /// Throws InputError for an unknown engine, or a number of threads that it does not use.
  PyEngine(const PyScene& scene, const std::string& name, std::optional<double> max_time, int jobs);

  /// All answers. Lets other threads of Python run, and looks for Ctrl-C now and then. Throws InputError,
  /// naming the row, for the first that is no query, if `refuse`; else such rows are errors.
  /// `out`, if given, is written and returned: as many rows, so that what looks at its memory still may; all
  /// of its rows are errors after an exception.
  std::shared_ptr<AnswerRows> first_hit(const QueryArrays& queries, bool refuse,
                                        std::shared_ptr<AnswerRows> out);

  const std::string& name() const { return info_.name; }

 private:
  void answer(const QueryArrays& queries, bool refuse, AnswerRows& answers);

  const question::EngineInfo info_;
  const int dimension_;
  const std::size_t together_;  // rows
  std::mutex in_use_;           // one call at a time: the engine has room for one part of the rows
  question::ColumnEngine engine_;
};

}  // namespace lorentz::python
