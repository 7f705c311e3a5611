#include "cli/whole_file.hpp"

#include <unistd.h>

#include <cerrno>
#include <filesystem>

#include <lorentz/errors.hpp>
#include "src/problem/write_error.hpp"

namespace lorentz::cli {

namespace fs = std::filesystem;

WholeFile::WholeFile(const std::string& path) : path_(path), place_(path), beside_(path) {
  std::error_code error;
  const fs::file_status there = fs::status(path, error);
  if (fs::is_regular_file(there) && ::access(path.c_str(), W_OK) != 0)  // renaming would not mind
    throw write_error(path_, errno);
  if (!fs::exists(there) || fs::is_regular_file(there)) {
    if (fs::is_symlink(fs::symlink_status(path, error))) {
      const fs::path target = fs::weakly_canonical(path, error);
      if (!error) place_ = target.string();
    }
    beside_ = place_ + '.' + std::to_string(::getpid()) + ".new";
  }
  if (beside_ != path_) unfinished_.emplace(beside_);
  file_ = std::fopen(beside_.c_str(), "wb");
  if (!file_) throw write_error(path_, errno);
  if (fs::is_regular_file(there)) fs::permissions(beside_, there.permissions(), error);
}

WholeFile::~WholeFile() {
  if (!file_) return;
  std::fclose(file_);
  if (beside_ != path_) std::remove(beside_.c_str());
}

void WholeFile::write(std::string_view text) {
  std::fwrite(text.data(), 1, text.size(), file_);
}

void WholeFile::commit() {
  if (std::fflush(file_) != 0 || std::ferror(file_)) fail();
  if (beside_ != path_ && ::fsync(::fileno(file_)) != 0) fail();  // or a crash could leave an empty file
  std::FILE* const file = file_;
  file_ = nullptr;
  if (std::fclose(file) != 0) fail();
  if (beside_ != path_ && std::rename(beside_.c_str(), place_.c_str()) != 0) fail();
}

void WholeFile::fail() {
  const int why = errno;
  if (beside_ != path_) std::remove(beside_.c_str());
  throw write_error(path_, why);
}

void write_whole(const std::string& path, std::string_view text) {
  WholeFile file(path);
  file.write(text);
  file.commit();
}

namespace {

bool is_same_file(const std::string& a, const std::string& b) {
  std::error_code error;
  const fs::file_status there = fs::status(a, error);
  if (fs::exists(there) && !fs::is_regular_file(there)) return false;
  return fs::weakly_canonical(fs::absolute(a), error) == fs::weakly_canonical(fs::absolute(b), error) ||
         fs::equivalent(a, b, error);
}

}  // namespace

void check_apart(std::initializer_list<FileOption> options) {
  for (const FileOption& option : options)
    if (option.path && option.path->empty())
      throw InputError(std::string(option.name) +
                       ": the name is empty; give the file one, or leave the option out");
  for (auto one = options.begin(); one != options.end(); ++one)
    for (auto other = options.begin(); other != one; ++other)
      if (one->path && other->path && is_same_file(*one->path, *other->path))
        throw InputError(std::string(other->name) + " and " + one->name +
                         " name the same file: " + *one->path + "; give each its own");
}

}  // namespace lorentz::cli
