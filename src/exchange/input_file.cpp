#include "src/exchange/input_file.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include <lorentz/errors.hpp>

namespace lorentz {

InputFile::InputFile(const std::string& path) : name_(path == "-" ? "standard input" : path) {
  descriptor_ = path == "-" ? STDIN_FILENO : open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor_ < 0) throw FileError(path + ": " + std::strerror(errno));
  struct stat status {};
  if (fstat(descriptor_, &status) == 0 && S_ISDIR(status.st_mode)) {
    if (descriptor_ != STDIN_FILENO) close(descriptor_);
    throw FileError(name_ + ": is a directory, not a file");
  }
}

InputFile::~InputFile() {
  if (descriptor_ > STDIN_FILENO) close(descriptor_);
}

std::size_t InputFile::read(char* bytes, std::size_t most) {
  ssize_t count;
  do {
    count = ::read(descriptor_, bytes, most);
  } while (count < 0 && errno == EINTR);
  if (count < 0) throw FileError(name_ + ": " + std::strerror(errno));
  return static_cast<std::size_t>(count);
}

std::size_t InputFile::read_all(char* bytes, std::size_t count) {
  std::size_t done = 0;
  while (done < count) {
    const std::size_t more = read(bytes + done, count - done);
    if (more == 0) break;
    done += more;
  }
  return done;
}

bool InputFile::is_ready() const {
  return lorentz::is_ready(descriptor_);
}

bool is_ready(int descriptor) {
  pollfd asked{descriptor, POLLIN, 0};
  return poll(&asked, 1, 0) != 0;
}

}  // namespace lorentz
