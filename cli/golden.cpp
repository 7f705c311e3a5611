// lorentz golden: sets of cases with their exact answers and the proofs of these.
#include "cli/golden.hpp"

#include <algorithm>
#include <filesystem>

#include <lorentz/exchange.hpp>
#include "cli/data_folder.hpp"
#include "cli/exit_status.hpp"
#include "cli/messages.hpp"
#include "cli/table.hpp"
#include "golden/reader.hpp"
#include "golden/sets.hpp"
#include "src/exchange/json_writer.hpp"
#include "src/exchange/nearest_name.hpp"

namespace lorentz::cli {
namespace {

namespace fs = std::filesystem;

int list(bool as_json) {
  Table table({"set", "records", "committed", "tags", "what"});
  table.with_prose();
  std::vector<std::string> json;
  for (const golden::Set& set : golden::sets()) {
    std::string committed = "-";
    std::uint64_t count = 0;
    for (const std::string& file : committed_sets())
      if (fs::path(file).stem() == set.name)
        committed = std::to_string(count = golden::Reader(file).header().count);
    const bool endless = set.most > set.committed;
    table.add({set.name, endless ? "any" : std::to_string(set.most), committed,
               std::to_string(set.tags.size()), set.description});
    json.push_back(json::text_of([&](json::Members& one) {
      one.add("name", set.name, "committed", count, "description", set.description, "tags",
              [&](json::Members& tags) {
                for (const cases::Tag& tag : set.tags) tags.add_named(tag.name, tag.note);
              });
    }));
  }
  print(as_json ? json::line_of([&](json::Members& object) { object.add("sets", json::raw(json)); })
                : table.text());
  return kDone;
}

}  // namespace

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
  throw FileError(fmt::format("no file and no committed set is called {}{}; the sets are {}",
                              json_quoted(name_or_file), did_you_mean(name_or_file, names),
                              fmt::join(names, ", ")));
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

Command golden_list_command() {
  auto json = std::make_shared<bool>(false);
  return {"list",
          "The sets, and how many records of each are committed.",
          {
              {"--json", json.get(), "", "one JSON object, with all tags and what they are out to break"},
          },
          "Example:\n  lorentz golden list",
          [json] { return list(*json); }};
}

Command golden_command() {
  return {
      "golden",
      "Golden sets: cases with their exact answers and the proofs of these. Make, check, verify, explain.",
      {},

      "Example:\n  lorentz golden check --engine reduction near-rational\n"
      "docs/formats.md has the format, docs/certificates.md the proofs, data/README.md the committed sets.",
      {},
      {golden_make_command(), golden_check_command(), golden_verify_command(), golden_explain_command(),
       golden_list_command()}};
}

}  // namespace lorentz::cli
