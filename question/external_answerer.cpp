#include "question/external_answerer.hpp"

#include <fmt/format.h>

#include "question/engines.hpp"
#include "src/problem/safe_text.hpp"

namespace lorentz::question {
namespace {

constexpr std::size_t kMostComplaints = 20;
constexpr const char* kOthers = "other failures";
constexpr int kMostFailuresInRow = 5;
constexpr std::size_t kMostOfScene = 2000;  // bytes of a scene line in a message

}  // namespace

void ExternalAnswerer::try_again() {
  if (!given_up_ || is_hopeless()) return;
  given_up_ = false;
  failures_in_row_ = 0;
}

void ExternalAnswerer::tell(const std::string& what) const {
  if (options_.listener.message) options_.listener.message(name_ + ": " + what);
}

bool ExternalAnswerer::is_new(const std::string& what) {
  std::string kind = what;
  std::erase_if(kind, [](char c) { return c >= '0' && c <= '9'; });
  const bool has_room = complaints_.size() < kMostComplaints;
  Complaint& complaint = complaints_[has_room || complaints_.contains(kind) ? kind : kOthers];
  if (complaint.what.empty()) complaint.what = has_room ? what : kOthers;
  return ++complaint.times == 1 && has_room;
}

void ExternalAnswerer::complain(const std::string& what) {
  failed_ = true;
  if (is_new(what)) tell(what);
}

void ExternalAnswerer::complain(const std::string& what, const Scene& scene, std::string line) {
  failed_ = true;
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

void ExternalAnswerer::finish_complaints() {
  for (const auto& [kind, complaint] : std::exchange(complaints_, {})) {
    const std::size_t more = kind == kOthers ? complaint.times : complaint.times - 1;
    if (more > 0) tell(fmt::format("{} more times: {}", more, complaint.what));
  }
}

void ExternalAnswerer::note_answer() {
  failures_in_row_ = 0;
  ever_answered_ = true;
}

bool ExternalAnswerer::note_failure() {
  if (++failures_in_row_ < kMostFailuresInRow) return false;
  const std::string what =
      fmt::format("is given up after {} failures in a row without an answer", kMostFailuresInRow);
  if (is_new(what)) tell(what);
  return given_up_ = true;
}

void ExternalAnswerer::allow_one_more_start() {
  if (!given_up_ || !ever_answered_) return;
  given_up_ = false;
  failures_in_row_ = kMostFailuresInRow - 1;
}

Reply ExternalAnswerer::not_asked() const {
  return {error(fmt::format("was given up after {} failures in a row; this query was not asked",
                            kMostFailuresInRow)),
          Origin::not_asked};
}

void ExternalAnswerer::complete(Answer& answer, const Query& query, const Scene& scene,
                                double max_time) const {
  answer = limited(std::move(answer), max_time);
  if (options_.request.detail) add_detail(query, scene, answer);
}

}  // namespace lorentz::question
