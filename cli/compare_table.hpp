// What engines came to beside the oracle, for people.
#pragma once

#include <string>
#include <vector>

#include "question/tally.hpp"

namespace lorentz::cli {

/// A table for people, one row a tally.
std::string table_of(const std::vector<question::Tally>& tallies, bool judged);

/// "3 ill-posed, 2 undecided": what was not answered, or not as it is, but for what is wrong; empty if that
/// is nothing.
std::string others_of(const question::Tally& tally);

/// In a line what to make of a tally's answers: how many are wrong, and what its wrong times are worth.
std::string verdict_of(const question::Tally& tally);

}  // namespace lorentz::cli
