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
  if (scene_.empty()) enter(place);
}

void DisagreementFile::enter(const std::shared_ptr<Place>& place) {
  if (!file_ || place_ == place) return;
  place_ = place;
  std::string line;
  append_scene_line(line, place->scene());
  if (line != scene_) file_->write(scene_ = std::move(line));
}

void DisagreementFile::add(const Judged& judged, const std::string& engine) {
  if (!file_) return;
  const auto& [question, reply, judgement] = judged;
  const Scene& scene = question.place->scene();
  enter(question.place);
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
  file_->write(json::line_of([&](json::Members& line) {
    line.add("id", json::Raw{question.id});
    add_query(line, question.query, components, question.max_time);
    line.add("engine", engine, "verdict", verdict, "departs", judgement.departs, "expected",
             answer(question.exact), "given", answer(reply.answer));
  }));
}

void DisagreementFile::close() {
  if (file_) file_->commit();
  file_.reset();
}

}  // namespace lorentz::cli
