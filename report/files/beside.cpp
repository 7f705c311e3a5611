#include "report/files/beside.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <random>
#include <set>

#include <fmt/format.h>

#include "src/problem/write_error.hpp"

namespace lorentz {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kDigits = 16;
constexpr std::string_view kEnd = ".new";

// The beginning of all names beside a place, short enough to leave room for the rest.
std::string beginning_of(const fs::path& place) {
  constexpr std::size_t kLongestName = 255;
  return place.filename().string().substr(0, kLongestName - 1 - kDigits - kEnd.size()) + '.';
}

std::string new_path(const fs::path& place) {
  std::random_device device;
  const std::string name = fmt::format("{}{:08x}{:08x}{}", beginning_of(place), device(), device(), kEnd);
  return (place.parent_path() / name).string();
}

bool is_name_beside(std::string_view name, std::string_view beginning) {
  if (!name.starts_with(beginning) || !name.ends_with(kEnd)) return false;
  name.remove_prefix(beginning.size());
  return name.size() == kDigits + kEnd.size() && name.find_first_not_of("0123456789abcdef") == kDigits;
}

// The process that made the file holds a lock on it until it ends.
void remove_if_dead(const fs::path& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
  if (descriptor < 0) return;
  struct stat status {};
  const bool is_ours = ::fstat(descriptor, &status) == 0 && status.st_uid == ::geteuid() &&
                       (S_ISREG(status.st_mode) || S_ISDIR(status.st_mode));
  std::error_code error;
  if (is_ours && ::flock(descriptor, LOCK_EX | LOCK_NB) == 0) fs::remove_all(path, error);
  ::close(descriptor);
}

// Runs once per place, because some places are written every few seconds.
void clean_up(const fs::path& place) {
  static std::set<std::string> done;
  if (!done.insert(place.string()).second) return;
  const std::string beginning = beginning_of(place);
  const fs::path folder = place.has_parent_path() ? place.parent_path() : ".";
  std::vector<fs::path> found;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error))
    if (is_name_beside(entry->path().filename().string(), beginning)) found.push_back(entry->path());
  for (const fs::path& path : found) remove_if_dead(path);
}

}  // namespace

std::string place_of(const std::string& path) {
  constexpr int kMostLinks = 40;
  fs::path place = path;
  std::error_code error;
  for (int links = 0; fs::is_symlink(fs::symlink_status(place, error)); ++links) {
    if (links == kMostLinks) throw write_error(path, ELOOP);
    place = place.parent_path() / fs::read_symlink(place, error);  // an absolute target stands alone
  }
  return place.string();
}

Beside::Beside(const std::string& place, bool is_folder) {
  clean_up(place);
  do {
    path_ = new_path(place);
    unfinished_.emplace(path_);
    if (!open(is_folder) && errno != EEXIST) {
      const int why = errno;
      unfinished_.reset();
      throw write_error(place, why);
    }
  } while (descriptor_ < 0 || !is_held());
}

bool Beside::open(bool is_folder) {
  constexpr int kAlways = O_NOFOLLOW | O_CLOEXEC;
  if (!is_folder)
    descriptor_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | kAlways, 0666);
  else if (::mkdir(path_.c_str(), 0700) == 0)
    descriptor_ = ::open(path_.c_str(), O_RDONLY | O_DIRECTORY | kAlways);
  return descriptor_ >= 0;
}

// False if another process took it for a leftover before it was locked.
bool Beside::is_held() {
  struct stat status {};
  const bool locked = ::flock(descriptor_, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK;
  if (locked && ::fstat(descriptor_, &status) == 0 && status.st_nlink > 0) return true;
  ::close(descriptor_);
  descriptor_ = -1;
  return false;
}

Beside::~Beside() {
  std::error_code error;
  fs::remove_all(path_, error);
  ::close(descriptor_);
}

}  // namespace lorentz
