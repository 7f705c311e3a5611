#include "cli/disagreement_file.hpp"

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
  std::string out;
  append_query_line(out, one.id, one.query, dimension);
  out.resize(out.size() - 2);  // "}\n": the object goes on
  out += ",\"engine\":" + json_quoted(name);
  const char* verdict = judgement.verdict == oracle::Verdict::wrong ? "wrong"
                        : judgement.wrong_time                      ? "wrong-time"
                                                                    : "ill-posed";
  out += fmt::format(",\"verdict\":\"{}\",\"departs\":", verdict);
  append_number(out, judgement.departs);
  out += ",\"expected\":";
  append_answer_line(out, one.id, exact, dimension);
  out.back() = ',';
  out += "\"given\":";
  append_answer_line(out, one.id, given, dimension);
  out.back() = '}';
  file_->write(out + '\n');
}

void DisagreementFile::close() {
  if (file_) file_->commit();
  file_.reset();
}

}  // namespace lorentz::cli
