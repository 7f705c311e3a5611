// lorentz golden index: what lies beside sets: index.json, schema.json, SHA256SUMS.
#include <algorithm>
#include <filesystem>

#include <lorentz/errors.hpp>
#include "cli/exit_status.hpp"
#include "cli/golden.hpp"
#include "cli/known_failures.hpp"
#include "cli/output.hpp"
#include "files/data_folder.hpp"
#include "golden/find_sets.hpp"
#include "golden/index.hpp"
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
    return document.object()["format"].natural() > 0;
  } catch (const json::Error&) {
    return false;
  }
}

// The sums of other files are not overwritten: sets have an index beside theirs.
void check_folder(const fs::path& folder) {
  if (fs::exists(folder / kIndex) && is_index(folder / kIndex)) return;
  for (const char* name : {kIndex, kSums})
    if (fs::exists(folder / name))
      throw InputError((folder / name).string() +
                       ": was not written by this command, and is left as it is; move it, or the sets");
}

// Copies the schema of the project's sets, unless the folder has one; returns its name.
std::string add_schema(const fs::path& folder) {
  if (fs::exists(folder / kSchema)) return kSchema;
  const std::vector<std::string> schemas = data_files("golden", ".json");
  const auto schema =
      std::ranges::find(schemas, kSchema, [](const fs::path& file) { return file.filename(); });
  if (schema == schemas.end()) throw FileError("there is no schema.json in " + data_places("golden"));
  fs::copy_file(*schema, folder / kSchema);
  return kSchema;
}

int act(const std::string& folder) {
  if (!fs::is_directory(folder)) throw FileError(folder + ": is no folder");
  check_folder(folder);
  std::vector<std::string> names;
  for (const std::string& file : golden::find_sets({folder})) names.push_back(fs::path(file).filename());
  golden::write_index(folder, names, {add_schema(folder)});
  say("{}: {}, {} and {} of {} sets", folder, kIndex, kSchema, kSums, names.size());
  return kDone;
}

}  // namespace

Command golden_index_command() {
  auto folder = std::make_shared<std::string>();
  return {"index",
          "Writes index.json, schema.json and SHA256SUMS beside the sets in a folder.",
          {{"folder", folder.get(), "FOLDER", "with sets, *.ndjson", kRequired}},
          "Example:\n  mkdir mine; lorentz golden sample --count 20 ties > mine/ties.ndjson; lorentz golden "
          "index "
          "mine",
          [folder] { return act(*folder); }};
}

}  // namespace lorentz::cli
