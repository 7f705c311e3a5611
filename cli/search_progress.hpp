// The progress of a horizon search, on a terminal's stderr.
#pragma once

#include <memory>

#include <lorentz/horizon.hpp>
#include "cli/progress.hpp"

namespace lorentz::cli {

/// A progress bar on stderr if that is a terminal. The bar disappears with the last copy of the returned
/// function.
inline oracle::SearchProgress search_progress() {
  if (isatty(STDERR_FILENO) != 1) return {};
  return [bar = std::make_shared<std::unique_ptr<Progress>>(), begun = Progress::Clock::now()](
             const std::string& what, std::size_t done, std::size_t total) {
    if (!*bar || (*bar)->what() != what || (*bar)->total() != total)
      *bar = std::make_unique<Progress>(what, total, 1, begun);
    (*bar)->at(done);
  };
}

}  // namespace lorentz::cli
