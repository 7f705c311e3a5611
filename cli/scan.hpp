// Statistics of several scenes, at several radii, one after the other: `lyapunov`, `diffusion`, `flights`.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <lorentz/errors.hpp>
#include <lorentz/scene.hpp>
#include "cli/command.hpp"
#include "question/starts/free_starts.hpp"

namespace lorentz::cli {

struct ScanOptions {
  std::vector<std::string> scenes{"square"}, radii;
  std::uint64_t seed = starts::kDefaultSeed, jobs = 1;
  std::optional<std::string> csv, store;
  bool json = false;

  bool is_of_several() const { return scenes.size() > 1 || radii.size() > 1; }
};

/// The options that they share, and a command's own. `csv`: what --csv is of; `kept`: what a store keeps.
std::vector<Option> scan_rows(ScanOptions& options, const std::string& csv, const std::string& kept,
                              const std::vector<Option>& own);

/// One scene at one radius.
struct ScanPlace {
  std::string name;
  std::optional<double> radius;
  Scene scene;
};

/// All requested scenes and radii, scene by scene. `what`: the work on a scene ("flights are counted").
/// Throws InputError and FileError.
std::vector<ScanPlace> scan_places(const std::vector<std::string>& scenes,
                                   const std::vector<std::string>& radii, const std::string& what);

/// Calls `work`, then `keep`: also if `work` ends with an InputError, so that the results before it are kept.
template <class Work, class Keep>
void keeping_results(const Work& work, const Keep& keep) {
  try {
    work();
  } catch (const InputError&) {
    keep();
    throw;
  }
  keep();
}

/// The result for one place.
struct ScanFinding {
  std::string text;  ///< a table, or a line of JSON
  std::string csv;   ///< names in the first line, then rows
  bool is_whole = true;
};

/// Calls `find(place)` for each place in turn, prints the results, and writes all rows to --csv. With several
/// places, scene and radius are the first columns. The scan ends at the first empty or incomplete result or
/// InputError. `what`: as in scan_places. Returns an ExitStatus; throws InputError and FileError.
int scan(const ScanOptions& options, const std::string& what,
         const std::function<std::optional<ScanFinding>(const ScanPlace&)>& find);

}  // namespace lorentz::cli
