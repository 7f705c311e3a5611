// The file in which `lorentz bench --store` keeps finished cells.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "question/cells/cells.hpp"
#include "runs/piece_store.hpp"

namespace lorentz::question {

/// Scene, radius, difficulty and engine; they identify a cell of a run.
using CellKey = std::tuple<std::string, std::optional<double>, std::string, std::string>;

class BenchStore {
 public:
  /// Without a path nothing is kept in a file. An existing file must be of this run. `words`: what its cells
  /// depend on besides the plan and the groups. Throws InputError or FileError.
  BenchStore(std::optional<std::string> path, const BenchPlan& plan, const std::vector<BenchGroup>& groups,
             const runs::Plan& words, std::string manifest);

  /// The cells of a group, one per engine in the engines' order, if all of them are stored.
  std::optional<std::vector<report::Cell>> find(const BenchGroup& group) const;

  /// Stores the cells. If the program is killed, all or none of them are in the file.
  void add(const std::vector<report::Cell>& cells);

  /// The manifest of the run's first part, as JSON.
  const std::string& manifest() const { return manifest_; }

 private:
  bool keep(report::Cell cell);  ///< false if it was there

  const BenchPlan& plan_;
  std::string manifest_;
  std::map<CellKey, report::Cell> cells_;
  runs::PieceStore store_;
};

}  // namespace lorentz::question
