#include "report/runs/lock_file.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>

#include <lorentz/errors.hpp>
#include "report/files/whole_file.hpp"
#include "src/problem/write_error.hpp"

namespace lorentz::runs {

LockFile::LockFile(const std::string& file, const std::string& busy)
    : path_(std::filesystem::weakly_canonical(place_of(file)).string() + ".lock") {
  do {
    close();
    lock_ = ::open(path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0666);
    if (lock_ == -1) throw write_error(path_, errno);
    if (!is_empty_file())
      fail(path_ + ": is there and is not a lock of this program; move it away, or name another store");
    if (::flock(lock_, LOCK_EX | LOCK_NB) != 0) fail(file + ": " + busy);
  } while (!is_the_one_there());
}

LockFile::~LockFile() {
  ::unlink(path_.c_str());
  close();
}

// A lock is empty. A file with content belongs to the user, and would be removed.
bool LockFile::is_empty_file() const {
  struct stat ours {};
  return ::fstat(lock_, &ours) == 0 && S_ISREG(ours.st_mode) && ours.st_size == 0;
}

// False if another process removed the file between our opening and locking it.
bool LockFile::is_the_one_there() const {
  struct stat ours {
  }, there{};
  return ::fstat(lock_, &ours) == 0 && ::stat(path_.c_str(), &there) == 0 && ours.st_ino == there.st_ino;
}

void LockFile::close() {
  ::close(lock_);  // -1 is refused without further effect
}

// If a constructor throws, its destructor does not run.
void LockFile::fail(const std::string& what) {
  close();
  throw FileError(what);
}

}  // namespace lorentz::runs
