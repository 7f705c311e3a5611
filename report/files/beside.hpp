// A new file or folder beside the place that it will take. Its name is unpredictable, and it is not opened
// through a link. Leftovers of a killed process are removed by the next one that writes to the place.
#pragma once

#include <optional>
#include <string>

#include "report/files/signals.hpp"

namespace lorentz {

/// The file that a path means: links are followed, whether or not their target is there. Throws FileError if
/// they lead round in a circle.
std::string place_of(const std::string& path);

class Beside {
 public:
  /// PLACE.HEX.new, with sixteen random hexadecimal digits. A file has the permissions of any new file; a
  /// folder is accessible to this user only. Throws FileError.
  explicit Beside(const std::string& place, bool is_folder = false);
  /// Removes it with all its contents, unless it was renamed.
  ~Beside();
  Beside(const Beside&) = delete;
  Beside& operator=(const Beside&) = delete;

  const std::string& path() const { return path_; }
  int descriptor() const { return descriptor_; }  ///< of a file, open for writing

 private:
  bool open(bool is_folder);
  bool is_held();

  std::string path_;
  std::optional<Unfinished> unfinished_;
  int descriptor_ = -1;
};

}  // namespace lorentz
