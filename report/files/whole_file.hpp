// A file that is written beside its place and moved there when it is whole. If the program is killed, the old
// file stays, and any signal that can be caught leaves nothing beside it. And the text of a whole file.
#pragma once

#include <cstdio>
#include <optional>
#include <string>
#include <string_view>

#include "report/files/signals.hpp"

namespace lorentz {

/// The file that a path means: links are followed, whether or not their target is there. Throws FileError if
/// they lead round in a circle.
std::string place_of(const std::string& path);

class WholeFile {
 public:
  /// Opens PATH.HEX.new, with sixteen random hexadecimal digits, or `path` itself if it is not a regular file (a
  /// device, a pipe). Throws FileError.
  explicit WholeFile(const std::string& path);
  /// Leaves nothing behind without commit().
  ~WholeFile();
  WholeFile(const WholeFile&) = delete;
  WholeFile& operator=(const WholeFile&) = delete;

  /// commit() reports errors of writing.
  void write(std::string_view text);

  /// Replaces the old file. Throws FileError if something was not written; then the old file stays.
  void commit();

 private:
  void open_beside();

  std::string path_, place_, beside_;  // as given; with links followed; where it is written until it is whole
  std::optional<Unfinished> unfinished_;
  std::FILE* file_ = nullptr;
};

/// The file that an option asks for, or none. It is opened before the work, so that no work is lost if it
/// cannot be written.
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

/// Writes a file with this text, whole or not at all. Throws FileError.
void write_whole(const std::string& path, std::string_view text);

/// The whole text of a file, or of standard input for "-". Throws FileError.
std::string text_of_file(const std::string& path);

}  // namespace lorentz
