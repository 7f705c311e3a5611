// Whether floating point does here what this library was written for: for programs that change its modes, or
// are linked with what does (-ffast-math makes GCC's programs flush subnormal numbers to zero).
#pragma once

#include <string>
#include <vector>

namespace lorentz {

/// One thing that binary64 arithmetic is expected to do, asked of the processor and of this build of the
/// library.
struct ArithmeticCheck {
  std::string name;      ///< "rounding mode"
  bool fit = false;      ///< as expected
  std::string found;     ///< "to nearest", "upward", ..
  std::string expected;  ///< "to nearest"
};

/// held by "Broken arithmetic is seen, and named"
///
/// The calling thread's arithmetic: rounding mode, subnormal results and operands, excess precision (x87),
/// and that this build fuses no product with a sum. What is not fit makes every promise of the engines void:
/// right obstacles, bounds of times, same bits everywhere. Modes belong to a thread: ask in the one that
/// flies. Some ten operations; throws nothing but bad_alloc.
///
/// Source: IEEE 754-2019, 4.3, 5 and 7.5; docs/determinism.md.
std::vector<ArithmeticCheck> arithmetic_checks();

}  // namespace lorentz
