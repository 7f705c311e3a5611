// Lets only one process at a time write a file.
#pragma once

#include <string>

namespace lorentz::runs {

/// FILE.lock, beside the file to which a path leads (links are followed). The process that writes the file
/// holds it, and removes it at the end. The system releases it however the process ends. (A lock on the file
/// itself would interfere with SQLite's own, and would stay with the old file if a new one takes its place.)
class LockFile {
 public:
  /// Throws FileError if another process holds the lock (with the file's name and `busy`), or if FILE.lock
  /// exists and is not a lock, because it is not empty.
  LockFile(const std::string& file, const std::string& busy);
  ~LockFile();
  LockFile(const LockFile&) = delete;
  LockFile& operator=(const LockFile&) = delete;

 private:
  bool is_empty_file() const;
  bool is_the_one_there() const;
  void close();
  [[noreturn]] void fail(const std::string& what);

  const std::string path_;
  int lock_ = -1;
};

}  // namespace lorentz::runs
