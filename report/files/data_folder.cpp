#include "report/files/data_folder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <set>

#include <lorentz/errors.hpp>

namespace lorentz {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path>& added_folders() {
  static std::vector<fs::path> added;
  return added;
}

std::vector<fs::path> data_folders() {
  std::vector<fs::path> folders;
  std::error_code error;
  if (const char* data = std::getenv("LORENTZ_DATA"); data && *data) {
    folders.emplace_back(data);
    if (!fs::is_directory(folders[0] / "scenes", error) && !fs::is_directory(folders[0] / "golden", error))
      throw FileError(
          fmt::format("LORENTZ_DATA is {}, which has no folder scenes or golden; unset it, or name the "
                      "project's data folder",
                      data));
  }
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  if (!error) {
    // Installed; first, because /usr/bin/../../data would not be ours.
    folders.push_back(program.parent_path() / "../share/lorentz");
    folders.push_back(program.parent_path() / "../data");
    folders.push_back(program.parent_path() / "../../data");
  }
  folders.insert(folders.end(), added_folders().begin(), added_folders().end());
  return folders;
}

}  // namespace

void add_data_folder(const std::string& path) {
  added_folders().emplace_back(path);
}

std::vector<std::string> data_files(const std::string& folder, const std::string& extension) {
  std::vector<std::string> files;
  for (const fs::path& data : data_folders()) {
    std::error_code error;
    for (const auto& file : fs::directory_iterator(data / folder, error))
      if (file.path().extension() == extension) files.push_back(fs::weakly_canonical(file.path(), error));
    if (!files.empty()) break;
  }
  std::sort(files.begin(), files.end());
  return files;
}

std::string data_places(const std::string& folder) {
  std::set<std::string> places;
  for (const fs::path& data : data_folders()) places.insert((data / folder).lexically_normal().string());
  const std::string searched = fmt::format("{}", fmt::join(places, ", "));
  std::error_code error;
  if (fs::exists("/proc/self/exe", error)) return searched;
  return (searched.empty() ? "no folder" : searched + ", and nowhere else") +
         ": without /proc the program does not know where it lies; set LORENTZ_DATA";
}

}  // namespace lorentz
