#include "cli/disagreement_file.hpp"
#include "src/exchange/exchange_write.hpp"

#include <fmt/format.h>

#include <lorentz/exchange.hpp>

namespace lorentz::cli {

using namespace compare;

DisagreementFile::DisagreementFile(const std::optional<std::string>& path) {
  if (path) file_.emplace(*path);
}

void DisagreementFile::begin(const Scene& scene) {
  if (file_ && scene_line_.empty()) write_scene(scene);
}

void DisagreementFile::write_scene(const Scene& scene) {
  std::string line;
  append_scene_line(line, scene);
  if (line != scene_line_) file_->write(line);
  scene_line_ = std::move(line);
}

void DisagreementFile::add(const Judged& judged, const std::string& engine) {
  if (!file_) return;
  const auto& [question, given, origin, judgement] = judged;
  write_scene(question.place->scene());
  const int dimension = question.place->scene().dimension;
  const std::string_view verdict = judgement.verdict == oracle::Verdict::wrong ? "wrong"
                                   : judgement.wrong_time                      ? "wrong-time"
                                                                               : "ill-posed";
  const auto answer = [&](const Answer& its) {
    return [&](json::Members& object) {
      object.add("id", json::Raw{judged.question.id});
      add_answer(object, its, dimension);
    };
  };
  file_->write(json::line_of([&](json::Members& line) {
    line.add("id", json::Raw{judged.question.id});
    add_query(line, judged.question.query, dimension);
    line.add("engine", engine, "verdict", verdict, "departs", judged.judgement.departs, "expected",
             answer(judged.question.exact), "given", answer(judged.given));
  }));
}

void DisagreementFile::close() {
  if (file_) file_->commit();
  file_.reset();
}

}  // namespace lorentz::cli
