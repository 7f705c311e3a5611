// What long work tells whoever waits for it: a person at a terminal, or nobody.
#pragma once

#include <cstddef>
#include <functional>
#include <string>

namespace lorentz::question {

/// Each may be empty: then nobody is told.
struct Listener {
  /// `done` of `total` of what `what` names are done. Called often.
  std::function<void(const std::string& what, std::size_t done, std::size_t total)> progress;
  /// Something that a person should know, without a line end.
  std::function<void(const std::string& text)> message;
};

/// `done` of `total` are done, for a listener who may not listen.
inline void report(const Listener& listener, const std::string& what, std::size_t done, std::size_t total) {
  if (listener.progress) listener.progress(what, done, total);
}

}  // namespace lorentz::question
