#include "cli/file_options.hpp"
#include "golden/find_sets.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

#include <fmt/format.h>

#include <lorentz/errors.hpp>
#include "files/scene_file.hpp"

namespace lorentz::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* kStandardInput = "/dev/stdin";
constexpr const char* kStandardOutput = "/dev/stdout";

// A file and the option that names it.
struct NamedFile {
  std::string by, path;
  bool is_output;
};

// The program's or the library's file, and files among the program's words: its source, its scene.
std::vector<std::string> files_of_engine(const std::string& engine) {
  std::vector<std::string> files;
  const std::size_t begin = engine.find("cmd:");
  if (begin == engine.npos && engine.starts_with("lib:")) return {engine.substr(4)};
  if (begin == engine.npos) return files;
  std::istringstream words(engine.substr(begin + 4));
  for (std::string word; words >> word;) files.push_back(word);
  return files;
}

// The files that a value refers to, according to the value's name in help. Empty if there is no such file;
// the command itself reports the missing file.
std::vector<std::string> files_read(const std::string& type, const std::string& value) {
  try {
    if (type == "FILE") return {value == "-" ? kStandardInput : value};
    if (type == "SCENE") return {find_scene(value)};
    if (type == "SET") return golden::find_sets({value});
    if (type == "ENGINE") return files_of_engine(value);
    if (type == "NAME=FILE") return {value.substr(value.find('=') + 1)};
  } catch (const std::exception&) {
  }
  return {};
}

std::vector<std::string> values_of(const Option& option) {
  const std::vector<std::string> values = option.values();
  return values.empty() && option.type == "SET" && option.is_argument() ? golden::committed_sets() : values;
}

// Adds the files that exist beside a store while it is written.
void add_companions(const std::string& store, std::vector<NamedFile>& files) {
  for (const char* end : {".lock", "-wal", "-shm", "-journal"})
    files.push_back({"the store " + store, store + end, false});
}

std::vector<NamedFile> files_of(const Command& command) {
  std::vector<NamedFile> files{{"standard output", kStandardOutput, true}};
  for (const Option& option : command.options) {
    const std::string name = option.name();
    const bool makes_set = option.type == "SET" && !option.is_argument();  // names a recipe, not a file
    for (const std::string& value : values_of(option))
      if (option.traits & kOutput) {
        if (value.empty())
          throw InputError(name + ": the name is empty; give the file one, or leave the option out");
        if (value != "-") files.push_back({name, value, true});
        if (name == "--store") add_companions(value, files);
      } else if (!makes_set && !value.empty()) {
        for (const std::string& path : files_read(option.type, value)) files.push_back({name, path, false});
        if (option.type == "FILE") add_companions(value, files);
      }
  }
  return files;
}

// An option replaces files of its own kind only, so that a slip of the finger loses no run and no queries.
void refuse_other_kinds(const NamedFile& output) {
  if (!output.is_output || output.by == "--store") return;
  const std::string start = beginning_of(output.path);
  if (start.empty()) return;
  const bool wants_markup = output.by.ends_with("svg") || output.by == "--html" || output.by == "--junit";
  const bool is_other =
      wants_markup ? start[0] != '<' : output.by == "--csv" && (start[0] == '{' || start[0] == '<');
  if (start.starts_with("SQLite format 3"))
    throw InputError(
        fmt::format("{}: {} is a store, and is left as it is; name another file", output.by, output.path));
  if (is_other)
    throw InputError(
        fmt::format("{}: {} is a file of another kind, and is left as it is; remove it, or name another",
                    output.by, output.path));
}

bool is_same_file(const std::string& a, const std::string& b) {
  std::error_code error;
  const fs::file_status there = fs::status(a, error);
  if (fs::exists(there)) return fs::is_regular_file(there) && fs::equivalent(a, b, error);
  // A name that is too long has no path; opening the file reports that.
  const fs::path place = fs::weakly_canonical(fs::absolute(a), error);
  return !error && place == fs::weakly_canonical(fs::absolute(b), error) && !error;
}

}  // namespace

std::string beginning_of(const std::string& path) {
  std::error_code error;
  if (!fs::is_regular_file(path, error)) return "";
  std::ifstream in(path, std::ios::binary);
  std::string start(4096, '\0');
  in.read(start.data(), static_cast<std::streamsize>(start.size()));
  start.resize(static_cast<std::size_t>(in.gcount()));
  return start.substr(std::min(start.size(), start.find_first_not_of("\xef\xbb\xbf \t\r\n")));
}

void check_files(const Command& command) {
  const std::vector<NamedFile> files = files_of(command);
  for (const NamedFile& output : files)
    for (const NamedFile& other : files) {
      if (!output.is_output || &other == &output || !is_same_file(output.path, other.path)) continue;
      if (!other.is_output)
        throw InputError(fmt::format("{}: {} is what {} reads, and would be lost; name another file",
                                     output.by, other.path == kStandardInput ? "standard input" : other.path,
                                     other.by));
      throw InputError(fmt::format("{} and {} name the same file: {}; give each its own", output.by, other.by,
                                   other.path));
    }
  std::ranges::for_each(files, refuse_other_kinds);
}

}  // namespace lorentz::cli
