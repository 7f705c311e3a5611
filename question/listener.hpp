// Callbacks for the progress and the messages of long work.
#pragma once

#include <cstddef>
#include <functional>
#include <string>

namespace lorentz::question {

/// Each may be empty.
struct Listener {
  /// `done` of `total` items are done; `what` names them. Called often.
  std::function<void(const std::string& what, std::size_t done, std::size_t total)> progress;
  /// Something that a person should know, without a line end.
  std::function<void(const std::string& text)> message;
};

/// Reports that `done` of `total` are done, if the listener has a callback for it.
inline void report(const Listener& listener, const std::string& what, std::size_t done, std::size_t total) {
  if (listener.progress) listener.progress(what, done, total);
}

}  // namespace lorentz::question
