#include "cli/file_options.hpp"

#include <filesystem>
#include <set>

#include <fmt/format.h>

#include <lorentz/errors.hpp>
#include "cli/golden.hpp"
#include "cli/scene_option.hpp"

namespace lorentz::cli {
namespace {

namespace fs = std::filesystem;

std::set<const CLI::Option*>& outputs() {
  static std::set<const CLI::Option*> all;
  return all;
}

constexpr const char* kInput = "/dev/stdin";
constexpr const char* kOutput = "/dev/stdout";

// A file, and what names it.
struct Named {
  std::string by, path;
  bool is_output;
};

// The files that a value means, by the name that help gives to it. Empty if there is no such file: the
// command itself reports that.
std::vector<std::string> files_read(const std::string& type, const std::string& value) {
  try {
    if (type == "FILE") return {value == "-" ? kInput : value};
    if (type == "SCENE") return {find_scene(value)};
    if (type == "SET") return find_sets({value});
    if (type == "NAME=FILE") return {value.substr(value.find('=') + 1)};
  } catch (const std::exception&) {
  }
  return {};
}

std::vector<std::string> values_of(const CLI::Option& option) {
  if (!option.empty()) return option.results();
  if (option.get_type_name() == "SET" && option.get_positional()) return committed_sets();
  return {option.get_default_str()};
}

// What stands beside a store while it is written.
void add_companions(const std::string& store, std::vector<Named>& files) {
  for (const char* end : {".lock", "-wal", "-shm", "-journal"})
    files.push_back({"the store " + store, store + end, false});
}

std::vector<Named> files_of(const CLI::App& command) {
  std::vector<Named> files{{"standard output", kOutput, true}};
  for (const CLI::Option* option : command.get_options()) {
    const std::string type = option->get_type_name(), name = option->get_name(option->get_positional());
    const bool makes_set = type == "SET" && !option->get_positional();  // the name is of a recipe
    for (const std::string& value : values_of(*option))
      if (outputs().contains(option)) {
        if (value.empty() && !option->empty())
          throw InputError(name + ": the name is empty; give the file one, or leave the option out");
        if (!value.empty() && value != "-") files.push_back({name, value, true});
        if (!value.empty() && name == "--store") add_companions(value, files);
      } else if (!makes_set && !value.empty()) {
        for (const std::string& path : files_read(type, value)) files.push_back({name, path, false});
        if (type == "FILE") add_companions(value, files);
      }
  }
  return files;
}

bool is_same_file(const std::string& a, const std::string& b) {
  std::error_code error;
  const fs::file_status there = fs::status(a, error);
  if (fs::exists(there)) return fs::is_regular_file(there) && fs::equivalent(a, b, error);
  // A name that is too long has no place; opening it says so.
  const fs::path place = fs::weakly_canonical(fs::absolute(a), error);
  return !error && place == fs::weakly_canonical(fs::absolute(b), error) && !error;
}

}  // namespace

CLI::Option* names_output(CLI::Option* option) {
  outputs().insert(option);
  return option;
}

void check_files(const CLI::App& command) {
  const std::vector<Named> files = files_of(command);
  for (const Named& output : files)
    for (const Named& other : files) {
      if (!output.is_output || &other == &output || !is_same_file(output.path, other.path)) continue;
      if (!other.is_output)
        throw InputError(fmt::format("{}: {} is what {} reads, and would be lost; name another file",
                                     output.by, other.path == kInput ? "standard input" : other.path,
                                     other.by));
      throw InputError(fmt::format("{} and {} name the same file: {}; give each its own", output.by, other.by,
                                   other.path));
    }
}

}  // namespace lorentz::cli
