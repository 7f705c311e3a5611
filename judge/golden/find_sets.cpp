#include "judge/golden/find_sets.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include <lorentz/errors.hpp>
#include <lorentz/exchange.hpp>
#include "report/files/data_folder.hpp"
#include "src/exchange/nearest_name.hpp"

namespace lorentz::golden {

namespace fs = std::filesystem;

std::vector<std::string> committed_sets() {
  return data_files("golden", ".ndjson");
}

namespace {

// Every *.ndjson in a folder, by name.
std::vector<std::string> sets_in(const std::string& folder) {
  std::vector<std::string> files;
  for (const auto& file : fs::directory_iterator(folder))
    if (file.path().extension() == ".ndjson") files.push_back(file.path().string());
  if (files.empty()) throw FileError(folder + ": no file in it is called *.ndjson");
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace

std::string find_set(const std::string& name_or_file) {
  std::error_code error;
  if (fs::exists(name_or_file, error) || name_or_file == "-") return name_or_file;
  std::vector<std::string> names;
  for (const std::string& file : committed_sets()) {
    names.push_back(fs::path(file).stem());
    if (names.back() == name_or_file) return file;
  }
  if (names.empty())
    throw FileError(fmt::format("no file is called {}, and there are no committed sets (looked for in {})",
                                json_quoted(name_or_file), data_places("golden")));
  const std::string missing =
      fmt::format("no file and no committed set is called {}{}; the sets are {}", json_quoted(name_or_file),
                  did_you_mean(name_or_file, names), fmt::join(names, ", "));
  if (name_or_file.find_first_of("/.") == name_or_file.npos) throw InputError(missing);  // a mistyped name
  throw FileError(missing);
}

std::vector<std::string> find_sets(const std::vector<std::string>& names_or_files) {
  std::vector<std::string> files;
  for (const std::string& one : names_or_files) {
    const std::string found = find_set(one);
    if (!fs::is_directory(found)) {
      files.push_back(found);
      continue;
    }
    const std::vector<std::string> sets = sets_in(found);
    files.insert(files.end(), sets.begin(), sets.end());
  }
  if (names_or_files.empty()) files = committed_sets();
  if (files.empty())
    throw FileError(
        fmt::format("there are no committed sets (looked for in {}); name files", data_places("golden")));
  return files;
}

}  // namespace lorentz::golden
