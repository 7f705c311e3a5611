// Reports on stderr what goes wrong with an engine outside this program.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include <lorentz/scene.hpp>
#include "question/listener.hpp"

namespace lorentz::question {

/// Reports the first kMost failures, each with a stream that reproduces it, and how many more there were.
class EngineComplaints {
 public:
  static constexpr std::size_t kMost = 20;

  EngineComplaints(std::string engine, const Listener& listener)
      : engine_(std::move(engine)), listener_(listener) {}

  /// Reports something that is not a failure.
  void tell(const std::string& what) const;

  void add(const std::string& what);
  /// `line`: the query at fault, as in a stream. The scene is reported if it differs from the last time.
  void add(const std::string& what, const Scene& scene, std::string line);

  /// Must be called after the last failure.
  void finish() const;

 private:
  const std::string engine_;
  const Listener listener_;
  std::size_t count_ = 0;
  std::optional<Scene> told_scene_;
};

}  // namespace lorentz::question
