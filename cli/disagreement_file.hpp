// The answers that were wrong or ill-posed, as a query stream that can be run again: scene lines, and queries
// with `engine`, `verdict`, `departs` (in ulps), `expected` and `given` beside what they ask.
#pragma once

#include <cstdio>
#include <optional>
#include <string>

#include "compare/measure.hpp"

namespace lorentz::cli {

class DisagreementFile {
 public:
  /// Writes nothing without a path. Throws FileError if the file cannot be written.
  explicit DisagreementFile(const std::optional<std::string>& path);
  ~DisagreementFile();
  DisagreementFile(const DisagreementFile&) = delete;
  DisagreementFile& operator=(const DisagreementFile&) = delete;

  /// The cases that follow are of this set. Writes its first scene, so that the file is a stream even if
  /// nothing disagrees.
  void begin(const compare::CaseSet& set);
  void add(const compare::Case& one, const Answer& exact, const std::string& name, const Answer& given,
           const oracle::Judgement& judgement);

  /// Throws FileError if something was not written.
  void close();

 private:
  void write_scene(std::size_t scene);

  std::string path_;
  const compare::CaseSet* set_ = nullptr;
  std::FILE* file_ = nullptr;
  std::size_t scene_ = 0;
};

}  // namespace lorentz::cli
