// A cell of a table of speed against error: the results of one engine on the queries of one scene, at one
// radius and one difficulty.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "question/tally.hpp"
#include "report/curves.hpp"
#include "report/share.hpp"

namespace lorentz::report {

/// Errors over many powers of two, counted in bins of a factor of two.
struct Histogram {
  std::size_t exact = 0;              ///< errors of zero
  int first = 0;                      ///< counts[i] errors are in [2^(first + i), 2^(first + i + 1))
  std::vector<std::size_t> counts;    ///< neither the first nor the last is zero
  double mean = 0, p99 = 0, max = 0;  ///< of all errors, including zeros; 0 without errors
};

/// The errors must be finite and not below zero; throws std::invalid_argument otherwise.
Histogram histogram_of(const std::vector<double>& errors);

/// The input with an engine's worst answer: wrong before ill-posed before the right obstacle with the largest
/// error of its time.
struct Worst {
  std::string verdict;         ///< "wrong", "ill-posed", "wrong-time" or "agree"
  std::optional<double> ulps;  ///< error of the time, if the obstacle is right
  std::string query;           ///< as JSON, with hexadecimal numbers
  std::string command;         ///< a shell line that shows it
};

inline constexpr std::string_view kTooSlow = "too slow";

struct Cell {
  std::string scene;
  std::optional<double> radius = {};  ///< nothing: the scene's own sizes
  int dimension = 2;
  std::string difficulty = {}, engine = {};
  std::size_t queries = 0;
  std::size_t outside = 0;                    ///< drawn queries that are outside of the engines' domain
  std::string_view skipped = {};              ///< why nothing was measured, such as kTooSlow
  std::optional<question::Speed> speed = {};  ///< empty if the program failed
  double mean_path = 0;                       ///< mean time of the flights that hit; 0 if none does
  question::Counts counts = {};               ///< of Counted::examinations
  Histogram ulps = {};                        ///< errors of the times of right hits, in ulps
  Histogram conditions = {};                  ///< the same in units of the condition (lorentz/margin.hpp)
  Calls calls = {};  ///< by how many radii the line enters or misses the obstacle in question
  std::optional<Worst> worst = {};
};

/// An object; the keys are the members' names. A skipped cell has null for all that was not measured.
void append_json(std::string& out, const Cell& cell);

}  // namespace lorentz::report
