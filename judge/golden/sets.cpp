#include "judge/golden/sets.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <limits>

#include <lorentz/errors.hpp>
#include <lorentz/exchange.hpp>
#include "question/cases/bad_queries.hpp"
#include "report/files/data_folder.hpp"
#include "src/exchange/nearest_name.hpp"

namespace lorentz::golden {
namespace {

constexpr std::string_view kBadQueries = "bad-queries";
constexpr std::uint64_t kEndless = std::numeric_limits<std::uint64_t>::max();
// From 20 and 25 scenes.
constexpr std::uint64_t kCount = 640, kCountInBinary32 = 200;
constexpr std::uint64_t kCasesOfScene = 8;  // in a set in binary32

constexpr std::string_view kCommittedInBinary32[] = {
    "near-rational", "grazing",     "ties",    "boundary-starts", "corridor-edge",    "long-flight",
    "generic-3d",    "tricylinder", "ball-2d", "ball-3d",         "axis-and-diagonal"};

Set set_of(const cases::Family& family, NumberFormat precision) {
  const std::string name(family.name());
  const bool is_wide = precision == NumberFormat::binary64;
  return {name + (is_wide ? "" : "-binary32"),
          name,
          std::string(family.description(precision)),
          family.tags(precision),
          precision,
          is_wide ? kCount : kCountInBinary32,
          kEndless,
          is_wide || std::ranges::count(kCommittedInBinary32, name) > 0};
}

std::vector<Set> make_sets() {
  std::vector<Set> all;
  for (const cases::Family& family : cases::families()) all.push_back(set_of(family, NumberFormat::binary64));
  const std::uint64_t bad = cases::bad_queries().size();
  all.push_back({std::string(kBadQueries), std::string(kBadQueries),
                 "Questions that are none: the answer is `error`.", cases::bad_query_tags(),
                 NumberFormat::binary64, bad, bad, true});
  for (const cases::Family& family : cases::families()) all.push_back(set_of(family, NumberFormat::binary32));
  return all;
}

}  // namespace

SetQuestion Set::question(std::uint64_t seed, std::uint64_t index) const {
  if (family == kBadQueries) {
    const cases::BadQuery& bad = cases::bad_queries()[index];
    return {cases::bad_query_scene(), bad.text, {}, {bad.tag}};
  }
  if (precision == NumberFormat::binary32)
    index = index / kCasesOfScene * cases::kCasesPerScene + index % kCasesOfScene;
  cases::Case one = cases::family_named(family)->make(seed, index, precision);
  std::string text = question_of(one.query, one.scene);
  return {std::move(one.scene), std::move(text), std::move(one.query), std::move(one.tags)};
}

const std::vector<Set>& sets() {
  static const std::vector<Set> all = make_sets();
  return all;
}

const Set* set_named(std::string_view name, NumberFormat precision) {
  for (const Set& set : sets())
    if (set.family == name && set.precision == precision) return &set;
  for (const Set& set : sets())
    if (set.name == name) return &set;
  return nullptr;
}

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
