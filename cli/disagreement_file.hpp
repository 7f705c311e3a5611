// The answers that depart from the exact ones, as a query stream that can be run again: scene lines, and
// queries with `engine`, `verdict`, `departs` (in ulps), `expected` and `given` beside what they ask.
#pragma once

#include <optional>
#include <string>

#include "files/whole_file.hpp"
#include "question/examine.hpp"

namespace lorentz::cli {

class DisagreementFile {
 public:
  /// Writes nothing without a path. Throws FileError if the file cannot be written.
  explicit DisagreementFile(const std::optional<std::string>& path);

  /// Writes the scene of the first place, so that the file is a stream even if nothing disagrees.
  void begin(const std::shared_ptr<question::Place>& place);
  void add(const question::Judged& judged, const std::string& engine);

  /// Puts the file in its place. Throws FileError if something was not written.
  void close();

 private:
  void enter(const std::shared_ptr<question::Place>& place);

  std::optional<WholeFile> file_;
  std::shared_ptr<question::Place> place_;  // of the scene that was written last
};

}  // namespace lorentz::cli
