// The file in which `lorentz bench --store` keeps the cells that are done.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cli/bench_cells.hpp"
#include "fuzz/campaign/lock_file.hpp"
#include "report/cell_store.hpp"

namespace lorentz::cli {

class BenchStore {
 public:
  /// Without a path nothing is kept in a file. A file that is there must be of this run; one that is not is
  /// begun. No other process may write it meanwhile. Throws InputError or FileError.
  BenchStore(std::optional<std::string> path, report::CellStore::Run run, std::string manifest);

  /// The cells of a group, one an engine in their order, if all of them are there.
  std::optional<std::vector<report::Cell>> find(const BenchGroup& group,
                                                const std::vector<std::string>& engines) const;

  /// Keeps them; killed at any moment, all or none of them are in the file.
  void add(const std::vector<report::Cell>& cells);

  /// Of the run's first part.
  const std::string& manifest() const { return store_.manifest; }

 private:
  void save() const;

  std::optional<std::string> path_;
  std::unique_ptr<fuzz::LockFile> lock_;
  report::CellStore store_;
};

}  // namespace lorentz::cli
