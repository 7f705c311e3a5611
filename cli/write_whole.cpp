#include "cli/write_whole.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>

#include <lorentz/errors.hpp>

namespace lorentz::cli {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const std::string& file) {
  throw FileError(file + ": " + std::strerror(errno));
}

void write_all(int file, const std::string& text, const std::string& name) {
  for (std::size_t done = 0; done < text.size();) {
    const ssize_t size = write(file, text.data() + done, text.size() - done);
    if (size < 0 && errno != EINTR) fail(name);
    if (size > 0) done += static_cast<std::size_t>(size);
  }
}

// A file that is gone again unless it is renamed.
class Draft {
 public:
  Draft(const std::string& name, mode_t mode) : name_(name + ".XXXXXX") {
    file_ = mkstemp(name_.data());
    if (file_ < 0) fail(name);
    fchmod(file_, mode);
  }
  ~Draft() {
    if (file_ >= 0) close(file_);
    if (!name_.empty()) unlink(name_.c_str());
  }
  Draft(const Draft&) = delete;
  Draft& operator=(const Draft&) = delete;

  int file() const { return file_; }
  void become(const std::string& name) {
    if (fsync(file_) != 0) fail(name);
    const int status = close(file_);
    file_ = -1;
    if (status != 0 || std::rename(name_.c_str(), name.c_str()) != 0) fail(name);
    name_.clear();
  }

 private:
  std::string name_;
  int file_ = -1;
};

// What a new file would have, or the old one has.
mode_t mode_of(const std::string& file) {
  struct stat status {};
  if (stat(file.c_str(), &status) == 0) return status.st_mode & 07777;
  const mode_t mask = umask(0);
  umask(mask);
  return 0666 & ~mask;
}

}  // namespace

void write_whole(const std::string& file, const std::string& text) {
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  if (fs::exists(status) && !fs::is_regular_file(status)) {
    const int out = open(file.c_str(), O_WRONLY);
    if (out < 0) fail(file);
    write_all(out, text, file);
    if (close(out) != 0) fail(file);
    return;
  }
  // The file itself, if this is a link to it.
  const std::string name = fs::exists(status) ? fs::canonical(file, error).string() : file;
  if (fs::exists(status) && access(name.c_str(), W_OK) != 0) fail(file);
  Draft draft(name, mode_of(name));
  write_all(draft.file(), text, file);
  draft.become(name);
}

bool is_other_than_svg(const std::string& file) {
  std::error_code error;
  if (!fs::is_regular_file(file, error)) return false;
  std::ifstream in(file, std::ios::binary);
  if (!in) fail(file);
  std::string start(4096, '\0');
  in.read(start.data(), static_cast<std::streamsize>(start.size()));
  start.resize(static_cast<std::size_t>(in.gcount()));
  if (start.empty()) return false;
  const auto first = start.find_first_not_of("\xef\xbb\xbf \t\r\n");
  return first == std::string::npos || start[first] != '<' || start.find("<svg") == std::string::npos;
}

}  // namespace lorentz::cli
