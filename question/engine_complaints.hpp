// What goes wrong with an engine of somebody else's, told on stderr.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include <lorentz/scene.hpp>
#include "question/listener.hpp"

namespace lorentz::question {

/// Tells of the first kMost failures, with a stream that shows them again, and how many more there were.
class EngineComplaints {
 public:
  static constexpr std::size_t kMost = 20;

  EngineComplaints(std::string engine, const Listener& listener)
      : engine_(std::move(engine)), listener_(listener) {}

  /// What is no failure.
  void tell(const std::string& what) const;

  void add(const std::string& what);
  /// `line`: the query at fault, as a stream has it. The scene is told where it is another than the last time.
  void add(const std::string& what, const Scene& scene, std::string line);

  /// No more are to come.
  void finish() const;

 private:
  const std::string engine_;
  const Listener listener_;
  std::size_t count_ = 0;
  std::optional<Scene> told_scene_;
};

}  // namespace lorentz::question
