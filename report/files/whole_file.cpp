#include "report/files/whole_file.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>

#include <lorentz/line_reader.hpp>
#include "src/problem/write_error.hpp"

namespace lorentz {

namespace fs = std::filesystem;

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
    beside_.emplace(place_);
    if (fs::exists(there)) ::fchmod(beside_->descriptor(), static_cast<mode_t>(there.permissions()));
    file_ = ::fdopen(::dup(beside_->descriptor()), "wb");
  }
  if (!file_) throw write_error(path_, errno);
}

WholeFile::~WholeFile() {
  if (file_) std::fclose(file_);
}

void WholeFile::write(std::string_view text) {
  std::fwrite(text.data(), 1, text.size(), file_);
}

void WholeFile::commit() {
  const bool written = std::fflush(file_) == 0 && !std::ferror(file_) &&
                       (!beside_ || ::fsync(::fileno(file_)) == 0);  // or a crash could leave an empty file
  const int why = errno;
  const bool closed = std::fclose(file_) == 0;
  file_ = nullptr;
  if (!written) throw write_error(path_, why);
  if (!closed || (beside_ && std::rename(beside_->path().c_str(), place_.c_str()) != 0))
    throw write_error(path_, errno);
  beside_.reset();
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
