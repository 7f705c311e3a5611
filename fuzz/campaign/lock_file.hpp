// One process at a time writes a file.
#pragma once

#include <string>

namespace lorentz::fuzz {

/// FILE.lock, beside a file: held by whoever writes that, and gone with him; the system lets go of it however
/// the process ends. (A lock on the file itself would get in the way of SQLite's own, and would stay with the
/// old file where a new one takes its place.) Who only wants nobody to write makes no file: none that is
/// there is none that is held.
class LockFile {
 public:
  /// Throws FileError: if somebody else holds it, the file's name and `busy`.
  LockFile(const std::string& file, bool writes, const std::string& busy);
  ~LockFile();
  LockFile(const LockFile&) = delete;
  LockFile& operator=(const LockFile&) = delete;

 private:
  bool is_the_one_there() const;
  void close();

  const std::string path_;
  const bool writes_;
  int lock_ = -1;
};

}  // namespace lorentz::fuzz
