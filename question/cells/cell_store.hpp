// The file in which `lorentz bench --store` keeps the cells that are done.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "question/cells/cells.hpp"
#include "runs/piece_store.hpp"

namespace lorentz::question {

/// Scene, radius, difficulty, engine: what tells the cells of a run apart.
using CellKey = std::tuple<std::string, std::optional<double>, std::string, std::string>;

class BenchStore {
 public:
  /// Without a path nothing is kept in a file. One that is there must be of this run. `words`: what its cells
  /// depend on besides the plan and the groups. Throws InputError or FileError.
  BenchStore(std::optional<std::string> path, const BenchPlan& plan, const std::vector<BenchGroup>& groups,
             const runs::Plan& words, std::string manifest);

  /// The cells of a group, one an engine in their order, if all of them are there.
  std::optional<std::vector<report::Cell>> find(const BenchGroup& group) const;

  /// Keeps them; killed at any moment, all or none of them are in the file.
  void add(const std::vector<report::Cell>& cells);

  /// Of the run's first part, as JSON.
  const std::string& manifest() const { return manifest_; }

 private:
  void read(const std::string& piece, const std::vector<BenchGroup>& groups);

  const BenchPlan& plan_;
  std::string manifest_;
  std::map<CellKey, report::Cell> cells_;
  runs::PieceStore store_;
};

}  // namespace lorentz::question
