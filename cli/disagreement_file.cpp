#include "cli/disagreement_file.hpp"

#include <cerrno>
#include <cstring>

#include <lorentz/exchange.hpp>

namespace lorentz::cli {

using namespace compare;

DisagreementFile::DisagreementFile(const std::optional<std::string>& path) {
  if (!path) return;
  path_ = *path;
  file_ = std::fopen(path_.c_str(), "w");
  if (!file_) throw FileError(path_ + ": " + std::strerror(errno));
}

DisagreementFile::~DisagreementFile() {
  if (file_) std::fclose(file_);
}

void DisagreementFile::begin(const CaseSet& set) {
  set_ = &set;
  if (file_ && !set.scenes.empty()) write_scene(0);
}

void DisagreementFile::write_scene(std::size_t scene) {
  std::string out;
  append_scene_line(out, set_->scenes[scene]);
  std::fputs(out.c_str(), file_);
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
  out += judgement.verdict == oracle::Verdict::wrong ? ",\"verdict\":\"wrong\",\"departs\":"
                                                     : ",\"verdict\":\"ill-posed\",\"departs\":";
  append_number(out, judgement.departs);
  out += ",\"expected\":";
  append_answer_line(out, one.id, exact, dimension);
  out.back() = ',';
  out += "\"given\":";
  append_answer_line(out, one.id, given, dimension);
  out.back() = '}';
  std::fputs((out + '\n').c_str(), file_);
}

void DisagreementFile::close() {
  if (!file_) return;
  const bool failed = std::ferror(file_) != 0;
  const bool not_closed = std::fclose(file_) != 0;
  file_ = nullptr;
  if (failed || not_closed) throw FileError(path_ + ": writing failed");
}

}  // namespace lorentz::cli
