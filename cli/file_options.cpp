#include "cli/file_options.hpp"
#include "judge/golden/sets.hpp"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

#include <fmt/format.h>

#include <lorentz/errors.hpp>
#include "report/files/scene_file.hpp"
#include "report/files/whole_file.hpp"

namespace lorentz::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* kStandardInput = "/dev/stdin";
constexpr const char* kStandardOutput = "/dev/stdout";

// A file and the option that names it.
struct NamedFile {
  std::string by, path;
  bool is_output;
  std::optional<OutputKind> kind = {};  // of what replaces it
};

// What a file of a kind begins with, in small letters and without white space, and what is in its beginning.
struct KindMarks {
  const char *words, *beginning, *or_beginning, *content;
};

const KindMarks& marks_of(OutputKind kind) {
  static constexpr KindMarks kMarks[] = {
      {"a golden set", "{\"golden\"", "{\"golden\"", ""},
      {"a query stream", "{\"scene\"", "{\"golden\"", ""},
      {"an SVG", "<svg", "<?xml", "<svg"},
      {"a page", "<!doctypehtml", "<html", ""},
      {"a report of JUnit", "<?xml", "<testsuite", "<testsuite"},
      {"a CSV table", "", "", ","},
  };
  return kMarks[static_cast<std::size_t>(kind)];
}

// The first 4096 bytes.
std::string beginning_of(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) throw FileError(path + ": " + std::strerror(errno));
  std::string start(4096, '\0');
  in.read(start.data(), static_cast<std::streamsize>(start.size()));
  start.resize(static_cast<std::size_t>(in.gcount()));
  return start;
}

// The first line of a table names its columns; a sentence has blanks after its commas.
bool names_columns(std::string_view line) {
  return !line.empty() && std::isalpha(static_cast<unsigned char>(line[0])) && line.find(',') != line.npos &&
         line.find(", ") == line.npos;
}

bool is_of_kind(std::string start, OutputKind kind) {
  if (kind == OutputKind::table) return names_columns(start.substr(0, start.find('\n')));
  std::erase_if(start, [](unsigned char c) { return std::isspace(c); });
  std::ranges::transform(start, start.begin(), [](unsigned char c) { return std::tolower(c); });
  if (start.starts_with("\xef\xbb\xbf")) start.erase(0, 3);
  const KindMarks& its = marks_of(kind);
  return (start.starts_with(its.beginning) || start.starts_with(its.or_beginning)) &&
         start.find(its.content) != start.npos;
}

bool is_set(const Command& command, const std::string& flag) {
  const Option* option = command.option_called(flag);
  const auto* target = option ? std::get_if<bool*>(&option->target) : nullptr;
  return target && **target;
}

// Nothing for stores and lists of known failures, which are read, too: their readers look at these files.
std::optional<OutputKind> kind_of(const Command& command, const std::string& option) {
  if (option.ends_with("svg") || command.name == "draw") return OutputKind::picture;
  if (option == "--html") return OutputKind::page;
  if (option == "--junit") return OutputKind::test_report;
  if (option == "--csv") return OutputKind::table;
  if (option == "--disagreements") return OutputKind::queries;
  if (option == "--store" || option == "--baseline" || command.name == "merge") return std::nullopt;
  return is_set(command, "--queries") ? OutputKind::queries : OutputKind::golden_set;
}

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
  std::vector<NamedFile> files{{"standard output", kStandardOutput, true},
                               {"the running program", "/proc/self/exe", false}};
  for (const Option& option : command.options) {
    const std::string name = option.name();
    const bool makes_set = option.type == "SET" && !option.is_argument();  // names a recipe, not a file
    for (const std::string& value : values_of(option))
      if (option.traits & kOutput) {
        if (value.empty())
          throw InputError(name + ": the name is empty; give the file one, or leave the option out");
        if (value == "-" && !(option.traits & kTakesStdout))
          throw InputError(name + ": needs a file, and not -");
        if (value != "-") files.push_back({name, value, true, kind_of(command, name)});
        if (name == "--store") add_companions(value, files);
      } else if (!makes_set && !value.empty()) {
        for (const std::string& path : files_read(option.type, value)) files.push_back({name, path, false});
        if (option.type == "FILE") add_companions(value, files);
      }
  }
  return files;
}

bool is_same_file(const std::string& a, const std::string& b) {
  std::error_code error;
  const fs::file_status there = fs::status(a, error);
  if (fs::exists(there)) return fs::is_regular_file(there) && fs::equivalent(a, b, error);
  // A name that is too long has no path; opening the file reports that.
  const fs::path place = fs::weakly_canonical(fs::absolute(place_of(a)), error);
  return !error && place == fs::weakly_canonical(fs::absolute(place_of(b)), error) && !error;
}

}  // namespace

void refuse_other_kinds(const std::string& path, OutputKind kind, const std::string& by) {
  std::error_code error;
  if (!fs::is_regular_file(path, error) || fs::file_size(path, error) == 0) return;
  if (is_of_kind(beginning_of(path), kind)) return;
  throw InputError(fmt::format("{}{}: is not {}, and is left as it is; remove it, or name another file",
                               by.empty() ? "" : by + ": ", path, marks_of(kind).words));
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
  for (const NamedFile& output : files)
    if (output.kind) refuse_other_kinds(output.path, *output.kind, output.by);
}

}  // namespace lorentz::cli
