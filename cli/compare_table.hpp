// What engines came to beside the oracle, for people; and the tolerance that people ask for.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "compare/measure.hpp"

namespace lorentz::cli {

/// The tolerance k of the verdicts, as given on the command line. Throws InputError.
double tolerance(const std::optional<std::string>& ulps);

/// A table for people, one row a tally.
std::string table_of(const std::vector<compare::Tally>& tallies, bool judged);

}  // namespace lorentz::cli
