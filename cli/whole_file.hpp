// A file that is written beside its place and put there when it is whole: killed at any moment, the old file
// stands.
#pragma once

#include <cstdio>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>

namespace lorentz::cli {

class WholeFile {
 public:
  /// Opens NAME.PROCESS.new in the folder of `path`, or what `path` itself names if that is no regular file
  /// (a device, a pipe). Throws FileError.
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
  [[noreturn]] void fail();

  std::string path_, place_, beside_;  // as it was named; without links; where it is written
  std::FILE* file_;
};

/// A file of this text, whole or not at all. Signals that would end the program wait meanwhile, so that
/// nothing is left beside it. Throws FileError.
void write_whole(const std::string& path, std::string_view text);

/// Throws FileError if no such file can be made: now, rather than when there is something to write after
/// minutes. Leaves nothing behind; devices and pipes are left alone.
void check_writable(const std::optional<std::string>& path);

/// An option that names a file to be written, if it was given.
struct FileOption {
  const char* name;
  std::optional<std::string> path;
};

/// Throws InputError if an option has an empty name, or two name the same file, of which one would be lost.
/// (Devices and pipes take both.)
void check_apart(std::initializer_list<FileOption> options);

}  // namespace lorentz::cli
