#include "cli/disagreement_file.hpp"
#include "src/exchange/exchange_write.hpp"

#include <fmt/format.h>

#include <lorentz/exchange.hpp>

namespace lorentz::cli {

using namespace compare;

DisagreementFile::DisagreementFile(const std::optional<std::string>& path) {
  if (path) file_.emplace(*path);
}

void DisagreementFile::begin(const CaseSet& set) {
  set_ = &set;
  if (file_ && !set.scenes.empty()) write_scene(0);
}

void DisagreementFile::write_scene(std::size_t scene) {
  std::string out;
  append_scene_line(out, set_->scenes[scene]);
  file_->write(out);
  scene_ = scene;
}

void DisagreementFile::add(const Case& one, const Answer& exact, const std::string& name, const Answer& given,
                           const oracle::Judgement& judgement) {
  if (!file_) return;
  if (one.scene != scene_) write_scene(one.scene);
  const int dimension = set_->scenes[one.scene].dimension;
  const std::string_view verdict = judgement.verdict == oracle::Verdict::wrong ? "wrong"
                                   : judgement.wrong_time                      ? "wrong-time"
                                                                               : "ill-posed";
  const auto answer = [&](const Answer& its) {
    return [&](json::Members& object) {
      object.add("id", json::Raw{one.id});
      add_answer(object, its, dimension);
    };
  };
  file_->write(json::line_of([&](json::Members& line) {
    line.add("id", json::Raw{one.id});
    add_query(line, one.query, dimension);
    line.add("engine", name, "verdict", verdict, "departs", judgement.departs, "expected", answer(exact),
             "given", answer(given));
  }));
}

void DisagreementFile::close() {
  if (file_) file_->commit();
  file_.reset();
}

}  // namespace lorentz::cli
