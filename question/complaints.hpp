// What is reported about an engine outside this program: each failure once, with a stream that reproduces it.
#pragma once

#include <fmt/format.h>

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include <lorentz/exchange.hpp>
#include "question/listener.hpp"
#include "src/problem/safe_text.hpp"

namespace lorentz::question {

/// Messages that differ in numbers only are one. At most kMost are reported; finish() says how often each came
/// again.
class Complaints {
 public:
  Complaints(std::string name, Listener listener) : name_(std::move(name)), listener_(std::move(listener)) {}

  /// Reports something that is not a failure.
  void tell(const std::string& what) const {
    if (listener_.message) listener_.message(name_ + ": " + what);
  }
  /// The same, if it is the first of its kind.
  void tell_once(const std::string& what) {
    if (is_new(what)) tell(what);
  }
  /// `line`: the query at fault, as in a stream. The scene is reported if it differs from the last time.
  void tell_once(const std::string& what, const Scene& scene, std::string line) {
    if (!is_new(what)) return;
    std::string stream;
    if (told_scene_ != scene) {
      append_scene_line(stream, scene);
      if (stream.size() > kMostOfScene) stream = shortened(stream, kMostOfScene) + '\n';
      told_scene_ = scene;
    }
    line.pop_back();  // the line end
    tell(fmt::format("{}:\n{}{}", what, stream, line));
  }
  /// Must be called after the last failure.
  void finish() {
    for (const auto& [kind, one] : std::exchange(by_kind_, {})) {
      const std::size_t more = kind == kOthers ? one.second : one.second - 1;
      if (more > 0) tell(fmt::format("{} more times: {}", more, one.first));
    }
  }

 private:
  static constexpr std::size_t kMost = 20, kMostOfScene = 2000;  // bytes of a scene line in a message
  static constexpr const char* kOthers = "other failures";

  // True the first time.
  bool is_new(const std::string& what) {
    std::string kind = what;
    std::erase_if(kind, [](char c) { return c >= '0' && c <= '9'; });
    const bool has_room = by_kind_.size() < kMost;
    auto& [its, times] = by_kind_[has_room || by_kind_.contains(kind) ? kind : kOthers];
    if (its.empty()) its = has_room ? what : kOthers;
    return ++times == 1 && has_room;
  }

  const std::string name_;
  const Listener listener_;
  std::map<std::string, std::pair<std::string, std::size_t>> by_kind_;  // by the message without its numbers
  std::optional<Scene> told_scene_;
};

}  // namespace lorentz::question
