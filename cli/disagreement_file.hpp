// The answers that depart from the exact ones, as a query stream that can be run again: scene lines, and
// queries with `engine`, `verdict`, `departs` (in ulps), `expected` and `given` beside what they ask.
#pragma once

#include <optional>
#include <string>

#include "cli/whole_file.hpp"
#include "compare/measure.hpp"

namespace lorentz::cli {

class DisagreementFile {
 public:
  /// Writes nothing without a path. Throws FileError if the file cannot be written.
  explicit DisagreementFile(const std::optional<std::string>& path);

  /// The cases that follow are of this set. Writes its first scene, so that the file is a stream even if
  /// nothing disagrees.
  void begin(const compare::CaseSet& set);
  void add(const compare::Case& one, const Answer& exact, const std::string& name, const Answer& given,
           const oracle::Judgement& judgement);

  /// Puts the file in its place. Throws FileError if something was not written.
  void close();

 private:
  void write_scene(std::size_t scene);

  const compare::CaseSet* set_ = nullptr;
  std::optional<WholeFile> file_;
  std::size_t scene_ = 0;
};

}  // namespace lorentz::cli
