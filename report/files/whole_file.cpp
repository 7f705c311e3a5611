#include "report/files/whole_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <random>

#include <lorentz/line_reader.hpp>
#include "src/problem/write_error.hpp"

namespace lorentz {

namespace fs = std::filesystem;

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

WholeFile::WholeFile(const std::string& path) : path_(path) {
  if (path == "-") throw FileError("-: this output needs a file; /dev/stdout is one");
  std::error_code error;
  const fs::file_status there = fs::status(path, error);
  if (fs::is_regular_file(there) && ::access(path.c_str(), W_OK) != 0)  // renaming would not notice
    throw write_error(path_, errno);
  if (fs::exists(there) && !fs::is_regular_file(there)) {
    file_ = std::fopen(path.c_str(), "wb");
  } else {
    place_ = place_of(path);
    open_beside();
    if (fs::exists(there)) ::fchmod(::fileno(file_), static_cast<mode_t>(there.permissions()));
  }
  if (!file_) throw write_error(path_, errno);
}

// The name is unpredictable, and the file is not opened through a link.
void WholeFile::open_beside() {
  constexpr std::size_t kLongestName = 255, kRest = std::string_view(".0123456789abcdef.new").size();
  const fs::path place = place_;
  const std::string beginning = place.filename().string().substr(0, kLongestName - kRest);
  std::random_device device;
  do {
    beside_ = place.parent_path() / fmt::format("{}.{:08x}{:08x}.new", beginning, device(), device());
    unfinished_.emplace(beside_);
    const int descriptor =
        ::open(beside_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
    if (descriptor >= 0) file_ = ::fdopen(descriptor, "wb");
  } while (!file_ && errno == EEXIST);
  if (!file_) throw write_error(place_, errno);
}

WholeFile::~WholeFile() {
  if (file_) std::fclose(file_);
  if (!beside_.empty()) ::unlink(beside_.c_str());
}

void WholeFile::write(std::string_view text) {
  std::fwrite(text.data(), 1, text.size(), file_);
}

void WholeFile::commit() {
  const bool written =
      std::fflush(file_) == 0 && !std::ferror(file_) &&
      (beside_.empty() || ::fsync(::fileno(file_)) == 0);  // or a crash could leave an empty file
  const int why = errno;
  const bool closed = std::fclose(file_) == 0;
  file_ = nullptr;
  if (!written) throw write_error(path_, why);
  if (!closed || (!beside_.empty() && std::rename(beside_.c_str(), place_.c_str()) != 0))
    throw write_error(path_, errno);
  beside_.clear();
  unfinished_.reset();
}

void write_whole(const std::string& path, std::string_view text) {
  WholeFile file(path);
  file.write(text);
  file.commit();
}

std::string text_of_file(const std::string& path) {
  std::string text;
  LineReader lines(path);
  for (LineReader::Line line; lines.next(line);) text.append(line.text) += '\n';
  return text;
}

}  // namespace lorentz
