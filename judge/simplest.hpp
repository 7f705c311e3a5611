// The simplest case that goes wrong in the same way.
#pragma once

#include "judge/examination.hpp"

namespace lorentz::judge {

/// The finding's simplest example shrunk (fuzz/examine/shrink.hpp) for so many seconds while the engine keeps
/// going wrong with the same cause and severity and the same outcomes, and by no more radii than it was met
/// with: what is said of the finding is true of its case, too. As it was where there is nothing to shrink, or
/// the engine does not repeat itself.
Example simplest(const Finding& finding, Examination& examination, double seconds);

}  // namespace lorentz::judge
