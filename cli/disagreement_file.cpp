#include "cli/disagreement_file.hpp"
#include "src/exchange/exchange_write.hpp"

#include <utility>

#include <lorentz/exchange.hpp>

namespace lorentz::cli {

using namespace question;

DisagreementFile::DisagreementFile(const std::optional<std::string>& path) {
  if (path) file_.emplace(*path);
}

void DisagreementFile::begin(const std::shared_ptr<Place>& place) {
  if (!file_ || !scene_.empty()) return;
  append_scene_line(scene_, place->scene());
  file_->write(scene_);
}

void DisagreementFile::add(const Judged& judged, const std::string& engine) {
  if (!file_) return;
  const auto& [question, reply, judgement] = judged;
  const Scene& scene = question.place->scene();
  if (place_ != question.place) append_scene_line(added_, scene);
  place_ = question.place;
  const Components components(scene);
  const std::string_view verdict = judgement.verdict == oracle::Verdict::wrong ? "wrong"
                                   : judgement.wrong_time                      ? "wrong-time"
                                                                               : "ill-posed";
  const auto answer = [&](const Answer& its) {
    return [&](json::Members& object) {
      object.add("id", json::Raw{question.id});
      add_answer(object, its, components);
    };
  };
  added_ += json::line_of([&](json::Members& line) {
    line.add("id", json::Raw{question.id});
    add_query(line, question.query, components);
    line.add("engine", engine, "verdict", verdict, "departs", judgement.departs, "expected",
             answer(question.exact), "given", answer(reply.answer));
  });
}

std::string DisagreementFile::take() {
  place_.reset();
  return std::exchange(added_, {});
}

void DisagreementFile::put(std::string_view stream) {
  while (file_ && !stream.empty()) {
    const std::string_view line = stream.substr(0, stream.find('\n') + 1);
    stream.remove_prefix(line.size());
    if (line.starts_with("{\"scene\"")) {
      if (line == scene_) continue;
      scene_ = line;
    }
    file_->write(line);
  }
}

void DisagreementFile::close() {
  put(take());
  if (file_) file_->commit();
  file_.reset();
}

}  // namespace lorentz::cli
