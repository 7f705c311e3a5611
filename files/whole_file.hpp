// A file that is written beside its place and put there when it is whole: killed at any moment, the old file
// stands, and nothing is left beside it by any signal that can be met.
#pragma once

#include <cstdio>
#include <optional>
#include <string>
#include <string_view>

#include "files/beside.hpp"

namespace lorentz {

class WholeFile {
 public:
  /// Opens a file beside `path`, or what `path` itself names if that is no regular file (a device, a pipe).
  /// Throws FileError.
  explicit WholeFile(const std::string& path);
  /// Without commit() nothing is left behind.
  ~WholeFile();
  WholeFile(const WholeFile&) = delete;
  WholeFile& operator=(const WholeFile&) = delete;

  /// What could not be written is said by commit().
  void write(std::string_view text);

  /// Takes the place of what was there. Throws FileError if something was not written; then the old file
  /// stands.
  void commit();

 private:
  std::string path_, place_;      // as it was named; without links
  std::optional<Beside> beside_;  // where it is written
  std::FILE* file_ = nullptr;
};

/// What an option asks for, or no file. Opened before the work, so that a file that cannot be written costs
/// none.
class RequestedFile {
 public:
  explicit RequestedFile(const std::optional<std::string>& path) {
    if (path) file_.emplace(*path);
  }
  /// Writes the text that `make_text` makes and puts the file in its place. Throws FileError.
  template <class MakeText>
  void write(const MakeText& make_text) {
    if (!file_) return;
    file_->write(make_text());
    file_->commit();
  }

 private:
  std::optional<WholeFile> file_;
};

/// A file of this text, whole or not at all. Throws FileError.
void write_whole(const std::string& path, std::string_view text);

}  // namespace lorentz
