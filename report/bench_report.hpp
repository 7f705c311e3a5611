// The output of `lorentz bench`: a table and conclusions for people, CSV, and the report as JSON.
#pragma once

#include <string>
#include <vector>

#include <lorentz/claim.hpp>
#include "report/cell.hpp"

namespace lorentz::report {

/// Table, and one conclusion per engine.
std::string bench_text(const std::vector<Cell>& cells, const std::vector<std::string>& engines);

/// A header, and one line per measured cell.
std::string bench_csv(const std::vector<Cell>& cells);

/// One JSON object; `manifest` is one, too. All cells were judged by the claim.
std::string bench_json(const std::vector<Cell>& cells, const std::string& manifest, const Claim& claim = {});

}  // namespace lorentz::report
