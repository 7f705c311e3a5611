// One process at a time writes a file.
#pragma once

#include <string>

namespace lorentz::runs {

/// FILE.lock, beside the file that a path means (links are followed): held by the process that writes the
/// file, and removed with it. The system releases it however the process ends. (A lock on the file itself
/// would get in the way of SQLite's own, and would stay with the old file where a new one takes its place.)
/// A reader that only wants no other process to write makes no file: without a lock file there is no writer.
class LockFile {
 public:
  /// Throws FileError: if another process holds it, the file's name and `busy`; if FILE.lock is there and is
  /// no lock, for it has something in it.
  LockFile(const std::string& file, bool writes, const std::string& busy);
  ~LockFile();
  LockFile(const LockFile&) = delete;
  LockFile& operator=(const LockFile&) = delete;

 private:
  bool is_empty_file() const;
  bool is_the_one_there() const;
  void close();
  [[noreturn]] void fail(const std::string& what);

  const std::string path_;
  const bool writes_;
  int lock_ = -1;
};

}  // namespace lorentz::runs
