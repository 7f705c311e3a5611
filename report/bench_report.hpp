// The output of `lorentz bench`: a table and conclusions for people, CSV, and the report as JSON.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <lorentz/claim.hpp>
#include "report/cell.hpp"

namespace lorentz::report {

/// How a time grows with a size: the exponent of a power law, by least squares in logarithms.
struct PowerFit {
  double exponent = 0;
  double low = 0, high = 0;  ///< 95 % interval by Student's t, for points that scatter about the power law
  double from = 0, to = 0;   ///< the smallest and the largest x
  std::string scene = {}, engine = {}, difficulty = {};  ///< whose it is
};

/// The exponent of y ~ x^exponent. Points are pairs (x, y), both finite and above zero; throws
/// std::invalid_argument otherwise. Nothing for fewer than three points, which give no interval, or if all x
/// are equal.
std::optional<PowerFit> power_fit(const std::vector<std::pair<double, double>>& points);

/// The median time of each engine as a power of the radius, in one scene and at one difficulty: for all that were
/// measured at three or more radii up to 0.01. At larger radii the obstacles, not the
/// space between them, determine the time.
std::vector<PowerFit> bench_fits(const std::vector<Cell>& cells);

/// Table, fits, and one conclusion per engine.
std::string bench_text(const std::vector<Cell>& cells, const std::vector<std::string>& engines);

/// A header, and one line per measured cell.
std::string bench_csv(const std::vector<Cell>& cells);

/// One JSON object; `manifest` is one, too. All cells were judged by the claim.
std::string bench_json(const std::vector<Cell>& cells, const std::string& manifest, const Claim& claim = {});

}  // namespace lorentz::report
