// The listener that reports progress and messages of the work to the user's terminal.
#pragma once

#include <memory>

#include "cli/progress.hpp"
#include "files/messages.hpp"
#include "question/listener.hpp"

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

}  // namespace lorentz::cli
