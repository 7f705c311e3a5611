// Finds the simplest case that goes wrong in the same way.
#pragma once

#include "judge/examination.hpp"

namespace lorentz::judge {

/// Shrinks the finding's simplest example (fuzz/examine/shrink.hpp) for at most `seconds`. The engine must
/// keep going wrong with the same cause and severity and the same outcomes, and by no more radii than in the
/// finding, so that all statements about the finding also hold for its case. The example is returned
/// unchanged if there is nothing to shrink, or if the engine does not repeat its fault.
Example simplest(const Finding& finding, Examination& examination, double seconds);

}  // namespace lorentz::judge
