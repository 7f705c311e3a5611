// A new file, or folder, beside a place that it is to take: its name cannot be foreseen, it is opened through
// no link, and what a process left that was killed is taken away by the next that writes to the place.
#pragma once

#include <optional>
#include <string>

#include "files/signals.hpp"

namespace lorentz {

class Beside {
 public:
  enum class Kind { file, folder };

  /// PLACE.HEX.new, sixteen random hexadecimal digits. A file has the permissions that any new file has, a
  /// folder is this user's alone. Throws FileError.
  Beside(const std::string& place, Kind kind);
  /// It is gone with all that is in it, unless it was renamed.
  ~Beside();
  Beside(const Beside&) = delete;
  Beside& operator=(const Beside&) = delete;

  const std::string& path() const { return path_; }
  int descriptor() const { return descriptor_; }  ///< a file's, open for writing

 private:
  bool open(Kind kind);
  bool is_held();

  std::string path_;
  std::optional<Unfinished> unfinished_;
  int descriptor_ = -1;
};

}  // namespace lorentz
