// The simplest case that goes wrong in the same way.
#pragma once

#include "judge/examination.hpp"

namespace lorentz::judge {

/// The example shrunk (fuzz/examine/shrink.hpp) for so many seconds while the engine keeps going wrong with
/// the same cause and severity and the same outcomes. As it was where there is nothing to shrink, or the
/// engine does not repeat itself.
Example simplest(const Example& example, Examination& examination, double seconds);

}  // namespace lorentz::judge
