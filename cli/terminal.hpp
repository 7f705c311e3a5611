// The progress and the messages of the work, on the user's terminal.
#pragma once

#include <memory>

#include <lorentz/horizon.hpp>
#include "cli/progress.hpp"
#include "question/listener.hpp"
#include "report/files/messages.hpp"

namespace lorentz::cli {

/// Prints messages on stderr, and progress bars one after the other if stderr is a terminal.
inline question::Listener terminal() {
  question::Listener listener;
  listener.message = [](const std::string& text) { say_text(text, Lines::kept); };
  if (isatty(STDERR_FILENO) == 1)
    listener.progress = [bar = std::shared_ptr<Progress>()](const std::string& what, std::size_t done,
                                                            std::size_t total) mutable {
      if (!bar || bar->what() != what) bar = std::make_shared<Progress>(what, total);
      bar->at(done);
      if (done >= total) bar.reset();
    };
  return listener;
}

/// A progress bar of a horizon search on stderr if that is a terminal. The bar disappears with the last copy
/// of the returned function.
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
