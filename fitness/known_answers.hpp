// Questions whose exact answers are known, put to everybody who claims to be exact.
#pragma once

#include <vector>

#include "fitness/examination.hpp"

namespace lorentz::fitness {

/// By both oracles, `certified`, the check of certificates, and the certified path of problem 2 of the
/// 100-digit challenge.
std::vector<Finding> examine_known_answers();

}  // namespace lorentz::fitness
