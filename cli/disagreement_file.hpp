// The answers that differ from the exact ones, as a query stream that can be run again: scene lines, and
// queries with the additional keys `engine`, `verdict`, `departs` (in ulps), `expected` and `given`.
#pragma once

#include <optional>
#include <string>

#include "question/examine.hpp"
#include "report/files/whole_file.hpp"

namespace lorentz::cli {

class DisagreementFile {
 public:
  /// Writes nothing without a path. Throws FileError if the file cannot be written.
  explicit DisagreementFile(const std::optional<std::string>& path);

  /// Writes the scene of the first place, so that the file is a stream even if nothing disagrees.
  void begin(const std::shared_ptr<question::Place>& place);
  /// Writes an answer, and before it the scene, unless that is the one that was written last.
  void add(const question::Judged& judged, const std::string& engine);

  /// Moves the file to its final name. Throws FileError if something was not written.
  void close();

 private:
  void enter(const std::shared_ptr<question::Place>& place);

  std::optional<WholeFile> file_;
  std::string scene_;                       // the line of the scene that was written last
  std::shared_ptr<question::Place> place_;  // of that scene
};

}  // namespace lorentz::cli
