// The cells of a run as a file, so that a run that was interrupted can be gone on with.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "report/cell.hpp"

namespace lorentz::report {

/// A line that says of what run it is, and one for each cell.
struct CellStore {
  /// What the cells depend on; runs in which one of these differs are different runs.
  struct Run {
    std::string options, scenes, program;

    friend bool operator==(const Run&, const Run&) = default;
  };

  Run run;
  std::string manifest;  ///< of the first part of the run, as JSON
  std::vector<Cell> cells;

  std::string text() const;
  /// What text() gave. Throws InputError with the line.
  static CellStore of(std::string_view text);

  /// Throws InputError, saying what differs, if the cells are not of this run.
  void check(const Run& other) const;
};

}  // namespace lorentz::report
