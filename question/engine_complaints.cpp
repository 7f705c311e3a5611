#include "question/engine_complaints.hpp"

#include <fmt/format.h>

#include <lorentz/exchange.hpp>
#include "src/problem/safe_text.hpp"

namespace lorentz::question {
namespace {

constexpr std::size_t kMostOfScene = 2000;  // bytes of a scene line in a message

}  // namespace

void EngineComplaints::tell(const std::string& what) const {
  if (listener_.message) listener_.message(engine_ + ": " + what);
}

void EngineComplaints::add(const std::string& what) {
  if (++count_ <= kMost) tell(what);
}

void EngineComplaints::add(const std::string& what, const Scene& scene, std::string line) {
  if (++count_ > kMost) return;
  std::string stream;
  if (told_scene_ != scene) append_scene_line(stream, scene);
  if (stream.size() > kMostOfScene) stream = shortened(stream, kMostOfScene) + '\n';
  told_scene_ = scene;
  line.pop_back();  // the line end
  tell(fmt::format("{}:\n{}{}", what, stream, line));
}

void EngineComplaints::finish() const {
  if (count_ > kMost) tell(fmt::format("{} more failures", count_ - kMost));
}

}  // namespace lorentz::question
