// Statistics of several scenes, at several radii, one after the other: `lyapunov`, `diffusion`, `survival`.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <lorentz/scene.hpp>
#include "cli/command.hpp"
#include "starts/free_starts.hpp"

namespace lorentz::cli {

struct ScanOptions {
  std::vector<std::string> scenes{"square"}, radii;
  std::uint64_t seed = starts::kDefaultSeed;
  std::optional<std::string> csv;
  bool json = false;

  bool is_of_several() const { return scenes.size() > 1 || radii.size() > 1; }
};

/// The options of all of them. `rows_of_csv`: what a row of --csv is.
std::vector<Option> scan_rows(ScanOptions& options, const std::string& rows_of_csv);

/// One scene at one radius, of those that were asked for.
struct ScanPlace {
  std::string name;
  std::optional<double> radius;
  Scene scene;
};

/// All that was asked for, scene by scene. `what`: what is done with a scene ("flights are counted"). Throws
/// InputError and FileError.
std::vector<ScanPlace> scan_places(const std::vector<std::string>& scenes,
                                   const std::vector<std::string>& radii, const std::string& what);

/// What was found there.
struct ScanFinding {
  std::string text;  ///< a table, or a line of JSON
  std::string csv;   ///< names in the first line, then rows
  bool is_whole = true;
};

/// Has `find(place)` look at each place in turn, prints what it finds, and writes the rows of all to --csv: of
/// several places with scene and radius before them. Nothing found, or not whole, or an InputError, ends it.
/// `what`: as in scan_places. Returns an ExitStatus; throws InputError and FileError.
int scan(const ScanOptions& options, const std::string& what,
         const std::function<std::optional<ScanFinding>(const ScanPlace&)>& find);

}  // namespace lorentz::cli
