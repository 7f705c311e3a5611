// First hits of arrays, by any engine of this program. Private to python/.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "python/scene.hpp"
#include "question/engines.hpp"

namespace lorentz::python {

/// The engine of this program with this name. Throws InputError if there is none.
question::EngineInfo own_engine(const std::string& name);

/// Columns of queries in NumPy's memory, of any layout.
struct QueryArrays {
  Numbers x, v;                     ///< (N, d)
  std::optional<Numbers> max_time;  ///< (N,)
  using Integers32 = py::array_t<std::int32_t, py::array::forcecast>;
  using Integers64 = py::array_t<std::int64_t, py::array::forcecast>;
  std::optional<Integers32> from_lattice, from_atom;           ///< (N,); a lattice below 0 means none
  std::optional<Integers64> from_cell;                         ///< (N, d)
  std::vector<std::pair<std::size_t, ObstacleId>> large_from;  ///< as in QueryRows

  /// `from`: None, or a tuple (lattice, atom, cell, large), the last a list of (row, lattice, atom, cell).
  static QueryArrays of(Numbers x, Numbers v, std::optional<Numbers> max_time, const py::object& from);

  /// Throws InputError if the shapes do not fit together.
  void check(int dimension) const;
  std::size_t count() const { return static_cast<std::size_t>(x.shape(0)); }

  /// Copies at most `most` rows from `first` on into `rows`, and overwrites its contents. Needs no
  /// interpreter.
  void copy(std::size_t first, std::size_t most, QueryRows& rows) const;
};

class PyEngine {
 public:
  /// Throws InputError for an unknown engine, or for a number of threads that it does not support.
  PyEngine(const PyScene& scene, const std::string& name, std::optional<double> max_time, int jobs);

  /// Returns all answers. Lets other Python threads run, and checks for Ctrl-C at intervals. If `refuse`,
  /// throws InputError with the row number of the first invalid query; otherwise such rows are errors. If
  /// `out` is given, it is overwritten and returned. It must have the same number of rows, so that views of
  /// its memory stay valid. After an exception all of its rows are errors.
  std::shared_ptr<AnswerRows> first_hit(const QueryArrays& queries, bool refuse,
                                        std::shared_ptr<AnswerRows> out);

  const std::string& name() const { return info_.name; }

 private:
  void answer(const QueryArrays& queries, bool refuse, AnswerRows& answers) const;

  const question::EngineInfo info_;
  const int dimension_;
  const std::size_t together_;  // rows
  const double max_time_;
  const int jobs_;
  const question::SceneEngine engine_;
};

}  // namespace lorentz::python
