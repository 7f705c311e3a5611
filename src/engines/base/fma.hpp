// The error of a product, exactly: by one fused multiply-add where the processor has it, by splitting the
// factors where it has not. Both give the same bits, so code written against either gives the same answers;
// it is compiled once for each (reduction/kernels_*.cpp) and chosen when the program starts.
#pragma once

#include <cfloat>
#include <cmath>

#if defined(__FAST_MATH__) || FLT_EVAL_METHOD != 0
#error \
    "lorentz computes in plain binary64: compile it without -ffast-math, and for 32-bit x86 with -msse2 -mfpmath=sse"
#endif

// A function that is inlined as a whole into one for one kind of processor, so that an fma is one instruction
// or none. (Not under the sanitizers, whose checks make such a function a matter of minutes to compile.)
#if defined(__SANITIZE_ADDRESS__)
#define LORENTZ_FLATTEN
#else
#define LORENTZ_FLATTEN gnu::flatten
#endif

// The one for processors that have it: x86 has to be told; others have it or not as long as they are
// themselves.
#if defined(__x86_64__)
#define LORENTZ_WITH_FMA gnu::target("fma"), LORENTZ_FLATTEN
#else
#define LORENTZ_WITH_FMA LORENTZ_FLATTEN
#endif

namespace lorentz {

struct SplitProduct;

/// What an Arch computes with, here one flight's numbers (src/engines/batch/lanes-inl.hpp has those of many).
struct OneNumber {
  using Number = double;
  using Mask = bool;
  using Apart = SplitProduct;  ///< the Arch of functions that are not inlined
  static constexpr bool kOne = true;
};

/// a * b = p + product_error(a, b, p) exactly, where p is the rounded product; required of the caller is that
/// nothing overflows and that |p| >= 2^-960 or p = 0, so that the error is a binary64.
struct HardwareFma : OneNumber {
  static double product_error(double a, double b, double p) { return __builtin_fma(a, b, -p); }

  /// a - k b, required to be a binary64: then it is exact.
  static double remainder(double a, double k, double b) { return __builtin_fma(-k, b, a); }
};

/// The same without the instruction: Veltkamp's splitting and Dekker's product (Numer. Math. 18, 1971).
struct SplitProduct : OneNumber {
  static double product_error(double a, double b, double p) {
    const double a_high = high_part(a), a_low = a - a_high, b_high = high_part(b), b_low = b - b_high;
    return ((a_high * b_high - p) + a_high * b_low + a_low * b_high) + a_low * b_low;
  }

  static double remainder(double a, double k, double b) {
    const double p = k * b;
    return (a - p) - product_error(k, b, p);
  }

 private:
  static double high_part(double a) {
    const double c = 0x1.0000002p27 * a;  // 2^27 + 1
    return c - (c - a);
  }
};

}  // namespace lorentz
