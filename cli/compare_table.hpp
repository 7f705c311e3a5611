// Tables of the comparison of engines with the oracle.
#pragma once

#include <string>
#include <vector>

#include "question/tally.hpp"

namespace lorentz::cli {

/// A table as text, one row per tally.
std::string table_of(const std::vector<question::Tally>& tallies, bool judged);

/// For example "3 ill-posed, 2 undecided": the numbers of answers that are neither right nor wrong; empty if
/// there are none.
std::string others_of(const question::Tally& tally);

/// The verdict on a tally: how many answers are wrong, and how large the errors of wrong times are.
std::string verdict_of(const question::Tally& tally);

}  // namespace lorentz::cli
