#include "cli/set_output.hpp"

#include <algorithm>
#include <filesystem>

#include <lorentz/errors.hpp>
#include "cli/file_options.hpp"
#include "cli/output.hpp"
#include "judge/golden/find_sets.hpp"
#include "judge/golden/index.hpp"
#include "report/files/data_folder.hpp"
#include "report/files/whole_file.hpp"
#include "src/exchange/exchange_json.hpp"

namespace lorentz::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char *kIndex = "index.json", *kSums = "SHA256SUMS", *kSchema = "schema.json";

bool is_index(const fs::path& file) {
  try {
    json::Document document;
    const std::string text = text_of_file(file);
    document.open(text);
    json::Object index = document.object();
    return index["format"].natural() > 0 && (index["sets"].array(), true);
  } catch (const json::Error&) {
    return false;
  }
}

// Copies the schema of the project's sets unless the folder has one. Returns its name.
std::string add_schema(const fs::path& folder) {
  if (fs::exists(folder / kSchema)) return kSchema;
  const std::vector<std::string> schemas = data_files("golden", ".json");
  const auto schema =
      std::ranges::find(schemas, kSchema, [](const fs::path& file) { return file.filename(); });
  if (schema == schemas.end()) throw FileError("there is no schema.json in " + data_places("golden"));
  write_whole(folder / kSchema, text_of_file(*schema));  // a failure names what cannot be written
  return kSchema;
}

// The folder that a path means, created and checked; empty if the path means a file.
std::optional<std::string> folder_in(const std::optional<std::string>& path) {
  if (!path || !path->ends_with('/')) return std::nullopt;
  std::error_code error;
  fs::create_directories(*path, error);
  if (!fs::is_directory(*path)) throw FileError(*path + ": can't be made; name another folder");
  check_folder(*path);
  for (const fs::directory_entry& file : fs::directory_iterator(*path))
    if (file.path().extension() == ".ndjson") refuse_other_kinds(file.path(), OutputKind::golden_set);
  return path;
}

}  // namespace

// The checksums of sets have an index beside them.
void check_folder(const std::string& path) {
  const fs::path folder = path;
  if (fs::exists(folder / kIndex) && is_index(folder / kIndex)) return;
  for (const char* name : {kIndex, kSums})
    if (fs::exists(folder / name))
      throw InputError((folder / name).string() +
                       ": was not written by this command, and is left as it is; move it, or the sets");
}

void write_beside_sets(const std::string& folder) {
  if (!fs::is_directory(folder)) throw FileError(folder + ": is not a folder");
  check_folder(folder);
  std::vector<std::string> names;
  for (const std::string& file : golden::find_sets({folder})) names.push_back(fs::path(file).filename());
  const std::string index = golden::index_of(folder, names);  // reads every set, before anything is written
  golden::write_index(folder, index, names, {add_schema(folder)});
  say("{}: {}, {} and {} of {}", folder, kIndex, kSchema, kSums, fmt::join(names, ", "));
}

SetOutput::SetOutput(const std::optional<std::string>& path, const std::string& name)
    : folder_(folder_in(path)), file_(folder_ ? *folder_ + name + ".ndjson" : path) {}

}  // namespace lorentz::cli
