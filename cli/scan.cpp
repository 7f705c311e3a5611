#include "cli/scan.hpp"

#include <fmt/format.h>

#include "cli/numbers.hpp"
#include "cli/output.hpp"
#include "report/files/scene_file.hpp"
#include "report/files/whole_file.hpp"
#include "src/exchange/csv_table.hpp"

namespace lorentz::cli {
namespace {

// The table with additional columns in front of each row.
std::string with_columns(const std::string& csv, const std::string& names, const std::string& values,
                         bool is_first) {
  std::string table;
  for (std::size_t begin = 0; begin < csv.size();) {
    const std::size_t end = csv.find('\n', begin) + 1;
    const bool is_header = begin == 0;
    if (!is_header || is_first) table += (is_header ? names : values) + csv.substr(begin, end - begin);
    begin = end;
  }
  return table;
}

}  // namespace

std::vector<ScanPlace> scan_places(const std::vector<std::string>& scenes,
                                   const std::vector<std::string>& radii, const std::string& what) {
  std::vector<std::optional<double>> numbers;
  for (const std::string& radius : radii) numbers.push_back(positive_number(radius, "--radius"));
  if (numbers.empty()) numbers.emplace_back();
  std::vector<ScanPlace> places;
  for (const std::string& name : scenes)
    for (const std::optional<double>& radius : numbers)
      places.push_back({name, radius, load_crystal(name, radius, what)});
  return places;
}

std::vector<Option> scan_rows(ScanOptions& options, const std::string& csv, const std::string& kept,
                              const std::vector<Option>& own) {
  const std::vector<Option> shared{
      {"--scene", &options.scenes, "SCENE",
       "a file, or a name of the catalogue; several, with commas between them, one after the other", kCommas},
      {"--radius", &options.radii, "R",
       "radius of every ball; several, with commas between them: each gives what it gives alone", kCommas},
      {"--seed", Whole{&options.seed}, "N", "seed of the starts"},
      {"--csv", &options.csv, "FILE",
       csv + ", to a file; of several scenes or radii one table, with both in its first columns", kOutput},
      {"--json", &options.json, "", "one JSON object a line instead of a table, for each scene and radius"},
      {"--jobs", Whole{&options.jobs, 1, 1024}, "N", "threads; the result is the same"},
      {"--store", &options.store, "FILE", "keeps " + kept + " in FILE; the same command resumes there",
       kOutput}};
  return joined(shared, own);
}

int scan(const ScanOptions& options, const std::string& what,
         const std::function<std::optional<ScanFinding>(const ScanPlace&)>& find) {
  const std::vector<ScanPlace> places = scan_places(options.scenes, options.radii, what);
  RequestedFile csv(options.csv);
  std::string rows;
  int status = kDone;
  const auto find_each = [&] {
    for (const ScanPlace& place : places) {
      const std::optional<ScanFinding> found = find(place);
      status = found && found->is_whole ? kDone : kFailed;
      if (!found) return;
      const bool is_first = &place == &places[0];
      print((is_first || options.json ? "" : "\n") + found->text);
      const std::string values =
          fmt::format("{},{},", csv_field(place.name), place.radius ? fmt::format("{}", *place.radius) : "");
      rows += places.size() == 1 ? found->csv : with_columns(found->csv, "scene,radius,", values, is_first);
      if (status != kDone) return;
    }
  };
  keeping_results(find_each, [&] {
    if (!rows.empty()) csv.write([&] { return rows; });
  });
  return status;
}

}  // namespace lorentz::cli
