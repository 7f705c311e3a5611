// Checks whether floating point behaves as this library requires. It is for programs that change its modes,
// or are linked with code that does (-ffast-math makes GCC's programs flush subnormal numbers to zero).
#pragma once

#include <string>
#include <vector>

namespace lorentz {

/// One property that binary64 arithmetic is expected to have, tested on the processor and on this build of
/// the library.
struct ArithmeticCheck {
  std::string name;      ///< such as "rounding mode"
  bool fit = false;      ///< true if `found` is as expected
  std::string found;     ///< such as "to nearest" or "upward"
  std::string expected;  ///< such as "to nearest"
};

/// Checks the calling thread's arithmetic: rounding mode, subnormal results and operands, excess precision
/// (x87), and that this build fuses no product with a sum. If one check is not `fit`, every promise of the
/// engines is void: right obstacles, bounds of times, same bits everywhere. Modes belong to a thread, so call
/// this in the thread that computes flights. Takes about ten operations; throws nothing but bad_alloc.
///
/// Source: IEEE 754-2019, 4.3, 5 and 7.5; docs/determinism.md.
std::vector<ArithmeticCheck> arithmetic_checks();

}  // namespace lorentz
